//! The lowest excitation at which the forced motion is unstable, by its Floquet multipliers.
//!
//! The forced motion, the one that grows out of rest as beta grows from 0, is followed in beta at a fixed frequency;
//! where a multiplier leaves the unit circle, the crossing is located by a smooth test function of all multipliers
//! (see [`Instability::test`]). No smallness of anything is assumed. Two crossings within one step of the march, a
//! window of instability narrower than a hundredth of the range, can be overlooked.

use nalgebra::Complex;

use super::OrbitError;
use super::bracket::root;
use super::floquet::Instability;
use super::newton::OrbitSolver;
use crate::model::ReducedSystem;
use crate::theory::Resonance;

/// Steps of the march from beta = 0 to its limit.
const STEPS: f64 = 128.0;
/// The march gives up when its step has been shortened to this fraction.
const SHORTEST: f64 = 1e-5;
/// Accuracy of the located beta, relative to the limit.
const LOCATED: f64 = 1e-10;
/// A modulus above 1 by less than this is an undamped multiplier and rounding.
const MARGIN: f64 = 1e-9;
/// How far the cubic through the last two points is trusted, in their distances.
const CUBIC_REACH: f64 = 2.0;
/// Distance between a predicted and a converged orbit, relative to the latter's own distance from the last one,
/// beyond which it is another orbit.
const CONTINUOUS: f64 = 0.5;

/// What the march in beta found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CriticalExcitation {
    /// The forced motion loses its stability.
    Unstable {
        /// The lowest unstable beta (dimensionless).
        beta: f64,
        /// How.
        instability: Instability,
        /// The multiplier that leaves the unit circle, the upper of a pair.
        multiplier: Complex<f64>,
    },
    /// It is stable (in the ways asked about) up to the limit.
    Stable,
    /// It cannot be followed to the limit: it meets another motion and both end, or it escapes, or touches.
    Ends {
        /// The last beta that was reached (dimensionless), good to about a ten-thousandth of a step.
        beta: f64,
    },
}

impl CriticalExcitation {
    /// The lowest unstable beta, if there is one below the limit and before the forced motion ends.
    pub fn beta(&self) -> Option<f64> {
        match *self {
            Self::Unstable { beta, .. } => Some(beta),
            Self::Stable | Self::Ends { .. } => None,
        }
    }
}

impl Resonance {
    /// How the forced motion loses stability at this resonance.
    pub const fn instability(self) -> Instability {
        match self {
            Self::Sum => Instability::NeimarkSacker,
            Self::First | Self::Second => Instability::PeriodDoubling,
        }
    }
}

/// The lowest beta up to `limit` at which the forced motion of `system` at frequency `omega` is unstable, in the way
/// `only` if given, else in any way. The beta and omega of the system itself are not used.
///
/// # Errors
/// [`OrbitError::Model`] when `omega` is out of range, and [`OrbitError::Multipliers`].
pub fn critical_excitation(
    system: &ReducedSystem,
    omega: f64,
    limit: f64,
    only: Option<Instability>,
) -> Result<CriticalExcitation, OrbitError> {
    let system = system.with_excitation(0.0, omega)?;
    let (found, _) = search(&mut OrbitSolver::new(&system), limit, only)?;
    Ok(found)
}

/// The largest Floquet multiplier of the forced motion of `system` at frequency `omega` for each of the ascending
/// `betas`: one column of a stability chart. `None` from where the motion cannot be followed.
///
/// # Errors
/// As [`critical_excitation`].
pub fn largest_multipliers(
    system: &ReducedSystem,
    omega: f64,
    betas: &[f64],
) -> Result<Vec<Option<Complex<f64>>>, OrbitError> {
    let mut solver = OrbitSolver::new(&system.with_excitation(0.0, omega)?);
    let mut here = Some(Forced::at_rest(&mut solver)?);
    let mut values = Vec::with_capacity(betas.len());
    for beta in betas {
        here = match here {
            Some(forced) => forced.march_to(&mut solver, *beta)?,
            None => None,
        };
        values.push(here.as_ref().and_then(|forced| forced.multipliers.first().copied()));
    }
    Ok(values)
}

/// A point of the branch of forced motions.
#[derive(Debug, Clone)]
pub(super) struct Forced {
    pub(super) beta: f64,
    pub(super) state: Vec<f64>,
    slope: Vec<f64>,
    pub(super) multipliers: Vec<Complex<f64>>,
    /// The point it was reached from.
    before: Option<Tangent>,
}

/// Where a branch passes, and in which direction.
#[derive(Debug, Clone)]
struct Tangent {
    beta: f64,
    state: Vec<f64>,
    slope: Vec<f64>,
}

impl Forced {
    /// The solver's present orbit.
    fn read(solver: &OrbitSolver, beta: f64) -> Result<Self, OrbitError> {
        Ok(Self {
            beta,
            state: solver.state().to_vec(),
            slope: solver.beta_slope()?,
            multipliers: solver.multipliers()?,
            before: None,
        })
    }

    /// The state expected at `beta`: on the cubic through this point and the one before with their tangents, or on
    /// the tangent where that would reach too far.
    fn predict(&self, beta: f64) -> Vec<f64> {
        let step = beta - self.beta;
        let mut guess: Vec<f64> =
            self.state.iter().zip(&self.slope).map(|(y, slope)| y + step * slope).collect();
        if let Some(before) = &self.before {
            let width = self.beta - before.beta;
            let t = step / width;
            if t.abs() <= CUBIC_REACH {
                // Both bend the tangent: the double zero at t = 0 keeps point and slope here.
                let (value, slope) = (t * t * (2.0 * t + 3.0), t * t * (t + 1.0) * width);
                for (i, guess) in guess.iter_mut().enumerate() {
                    let chord = before.state[i] - self.state[i];
                    *guess +=
                        value * (chord + width * self.slope[i]) + slope * (before.slope[i] - self.slope[i]);
                }
            }
        }
        guess
    }

    /// The forced motion at `beta`, reached from this one.
    pub(super) fn move_to(&self, solver: &mut OrbitSolver, beta: f64) -> Result<Self, OrbitError> {
        let guess = self.predict(beta);
        let convergence = solver.follow(&guess, beta, 1)?;
        let scales = solver.map().scales().to_vec();
        let distance = |from: &[f64]| {
            let components = solver.state().iter().zip(from).zip(&scales);
            components.map(|((a, b), scale)| ((a - b) / scale).abs()).fold(0.0, f64::max)
        };
        if distance(&guess) > CONTINUOUS * distance(&self.state).max(1e-9) {
            let (iterations, residual) = (convergence.iterations, convergence.residual);
            return Err(OrbitError::NoConvergence { iterations, residual });
        }
        let (state, slope) = (self.state.clone(), self.slope.clone());
        let before = Some(Tangent { beta: self.beta, state, slope });
        Ok(Self { before, ..Self::read(solver, beta)? })
    }

    /// The motion without excitation.
    pub(super) fn at_rest(solver: &mut OrbitSolver) -> Result<Self, OrbitError> {
        let rest = vec![0.0; solver.state().len()];
        solver.follow(&rest, 0.0, 1)?;
        Self::read(solver, 0.0)
    }

    /// The forced motion at `beta`, reached in as many steps as needed; `None` when they become too short.
    pub(super) fn march_to(self, solver: &mut OrbitSolver, beta: f64) -> Result<Option<Self>, OrbitError> {
        let shortest = SHORTEST * (beta - self.beta);
        let mut here = self;
        let mut step = beta - here.beta;
        while here.beta < beta {
            match here.move_to(solver, (here.beta + step).min(beta)) {
                Ok(next) => here = next,
                Err(OrbitError::Multipliers) => return Err(OrbitError::Multipliers),
                Err(_) if step > shortest => step *= 0.5,
                Err(_) => return Ok(None),
            }
        }
        Ok(Some(here))
    }

    /// The largest unstable multiplier, of the kind `only` if given.
    fn unstable(&self, only: Option<Instability>) -> Option<Complex<f64>> {
        let outside = self.multipliers.iter().take_while(|mu| mu.norm() > 1.0 + MARGIN);
        outside.copied().find(|mu| only.is_none_or(|kind| kind == Instability::of(*mu)))
    }
}

/// The march and the location; beside the answer the orbit where it was found.
pub(super) fn search(
    solver: &mut OrbitSolver,
    limit: f64,
    only: Option<Instability>,
) -> Result<(CriticalExcitation, Forced), OrbitError> {
    let mut here = Forced::at_rest(solver)?;
    let longest = limit / STEPS;
    let mut step = longest;
    while here.beta < limit {
        let beta = (here.beta + step).min(limit);
        let next = match here.move_to(solver, beta) {
            Ok(next) => next,
            Err(OrbitError::Multipliers) => return Err(OrbitError::Multipliers),
            Err(_) if step > SHORTEST * longest => {
                step *= 0.5;
                continue;
            }
            Err(_) => return Ok((CriticalExcitation::Ends { beta: here.beta }, here)),
        };
        if let Some(multiplier) = next.unstable(only) {
            let instability = Instability::of(multiplier);
            let found = locate(solver, &here, &next, limit, instability, only)?;
            let nearest = found.multipliers.iter().copied().filter(|mu| Instability::of(*mu) == instability);
            let distance = |mu: &Complex<f64>| (mu.norm() - 1.0).abs();
            let multiplier = nearest.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(multiplier);
            let unstable = CriticalExcitation::Unstable { beta: found.beta, instability, multiplier };
            return Ok((unstable, found));
        }
        here = next;
        step = (2.0 * step).min(longest);
    }
    Ok((CriticalExcitation::Stable, here))
}

/// The crossing between a stable and an unstable orbit.
fn locate(
    solver: &mut OrbitSolver,
    stable: &Forced,
    unstable: &Forced,
    limit: f64,
    kind: Instability,
    only: Option<Instability>,
) -> Result<Forced, OrbitError> {
    let test = |orbit: &Forced| kind.test(&orbit.multipliers);
    let (a, b) = (test(stable), test(unstable));
    let mut last = unstable.clone();
    // Without damping the product of pairs is all rounding, whatever its sign, and only stability itself is left to
    // ask for.
    let damped = stable.multipliers.iter().all(|mu| (mu.norm() - 1.0).abs() > MARGIN);
    let smooth = (a < 0.0) != (b < 0.0) && (damped || kind != Instability::NeimarkSacker);
    let (a, b) = if smooth { (a, b) } else { (-1.0, 1.0) };
    root((stable.beta, a), (unstable.beta, b), LOCATED * limit, |beta| {
        let start = if (beta - stable.beta).abs() < (beta - last.beta).abs() { stable } else { &last };
        last = start.move_to(solver, beta)?;
        let value = if last.unstable(only).is_some() { 1.0 } else { -1.0 };
        Ok::<f64, OrbitError>(if smooth { test(&last) } else { value })
    })?;
    Ok(last)
}
