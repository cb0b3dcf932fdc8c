//! Periodic motions: found by Newton's iteration on the stroboscopic map, measured, and judged by their multipliers.

use nalgebra::Complex;

use super::floquet::Instability;
use super::march::Forced;
use super::newton::{Convergence, OrbitSolver};
use super::orbit_error::OrbitError;
use super::period_map::{MOST_PERIODS, distance, scales};
use crate::dynamics::integration::Measures;
use crate::dynamics::integration::measures::Observer;
use crate::model::ReducedSystem;
use crate::theory::LinearResponse;

/// Distance between stroboscopic points, over the gap, below which they are the same point.
const SAME_POINT: f64 = 1e-8;
/// Decay within one step beyond which rounding hides its determinant.
const MEASURABLE_DECAY: f64 = 12.0;

/// A periodic motion of a system.
#[derive(Debug, Clone, PartialEq)]
pub struct Orbit {
    /// Its shortest period, in excitation periods; it may be a part of what was asked for.
    pub periods: usize,
    /// State at t = 0, length 2N + 1.
    pub state: Vec<f64>,
    /// Floquet multipliers over the shortest period by descending modulus, 2N + 1 of them, or 2N without a load,
    /// where the conserved charge adds a trivial 1.
    pub multipliers: Vec<Complex<f64>>,
    /// Means and extremes.
    pub measures: Measures,
    /// Largest defect of periodicity, as a displacement over the gap s0 (dimensionless).
    pub residual: f64,
    /// Evaluations of the map that Newton's iteration took.
    pub iterations: usize,
    /// Collocation steps of one excitation period.
    pub steps_per_period: usize,
    /// |det(monodromy) / exp(m T tr A) - 1| with the determinants multiplied step by step (Liouville's formula; the
    /// product of the multipliers, whose smallest ones rounding may have blurred). `None` when the motion decays so
    /// fast that a single step's determinant is lost to rounding.
    pub liouville_defect: Option<f64>,
}

impl Orbit {
    /// The orbit of `periods` excitation periods of `system` under its own excitation and force law that Newton's
    /// iteration reaches from `guess` (length 2N + 1); without one, the orbit of [`Self::from_rest`], whose period is
    /// the excitation's.
    ///
    /// Orbits of longer period need a guess near them, such as a state taken from a run. Where the iteration over all
    /// `periods` fails, as it must over many periods of a motion that is strongly unstable over one, the shorter
    /// periods of which they are multiples are tried, and the orbit nearest to the guess is taken.
    ///
    /// # Errors
    /// As [`OrbitSolver::find`] over `periods`, and as [`Self::from_rest`].
    pub fn find(system: &ReducedSystem, guess: Option<&[f64]>, periods: usize) -> Result<Self, OrbitError> {
        if !(1..=MOST_PERIODS).contains(&periods) {
            return Err(OrbitError::Periods { periods, most: MOST_PERIODS });
        }
        let Some(guess) = guess else { return Ok(Self::from_rest(system)?.0) };
        let beta = system.parameters.beta;
        let mut solver = OrbitSolver::new(system);
        let reason = match solver.find(guess, beta, periods) {
            Ok(convergence) => return Self::read(system, &mut solver, convergence, beta, periods),
            Err(reason) => reason,
        };
        let mut nearest: Option<(f64, Self)> = None;
        for part in (1..periods).filter(|part| periods.is_multiple_of(*part)) {
            let Ok(convergence) = solver.find(guess, beta, part) else { continue };
            let distance = distance(solver.state(), guess, &scales(system));
            if nearest.as_ref().is_none_or(|(other, _)| distance < *other)
                && let Ok(orbit) = Self::read(system, &mut solver, convergence, beta, part)
            {
                nearest = Some((distance, orbit));
            }
        }
        nearest.map(|(_, orbit)| orbit).ok_or(reason)
    }

    /// The forced motion of `system`, the one that grows out of rest as beta grows from 0 to its own, and `true`. Where
    /// that ends below, at a fold or because it touches or escapes, the orbit that Newton's iteration reaches from the
    /// linear response, and `false`.
    ///
    /// # Errors
    /// [`OrbitError::MotionEnds`] where there is neither, [`OrbitError::Multipliers`].
    pub fn from_rest(system: &ReducedSystem) -> Result<(Self, bool), OrbitError> {
        let beta = system.parameters.beta;
        let mut solver = OrbitSolver::new(system);
        let forced = Forced::at_rest(&mut solver)?.march_to(&mut solver, beta)?;
        if let Some(forced) = forced {
            return Ok((Self::read_at(system, &mut solver, &forced.state)?, true));
        }
        let guess = linear_response(system);
        let other = solver.find(&guess, beta, 1).map_err(|_| OrbitError::MotionEnds { beta })?;
        Ok((Self::read(system, &mut solver, other, beta, 1)?, false))
    }

    /// The orbit of the excitation's own period at `state`, which is on it but for a last correction.
    ///
    /// # Errors
    /// As [`OrbitSolver::find`] and [`Self::read`].
    pub(in crate::dynamics) fn read_at(
        system: &ReducedSystem,
        solver: &mut OrbitSolver,
        state: &[f64],
    ) -> Result<Self, OrbitError> {
        let beta = system.parameters.beta;
        let convergence = solver.find(state, beta, 1)?;
        Self::read(system, solver, convergence, beta, 1)
    }

    /// Everything about the orbit of `periods` excitation periods that `solver` found last.
    ///
    /// # Errors
    /// As [`super::PeriodMap::apply`] and [`OrbitSolver::multipliers`].
    pub fn read(
        system: &ReducedSystem,
        solver: &mut OrbitSolver,
        convergence: Convergence,
        beta: f64,
        periods: usize,
    ) -> Result<Self, OrbitError> {
        let periods = shortest_period(solver, beta, periods)?;
        // One more pass over the shortest period: the derivative at the final state, and what is seen on the way.
        let state = solver.state().to_vec();
        let (mut observer, mut logarithm) = (Observer::default(), 0.0);
        let residual = solver.evaluate_observed(beta, periods, |step, derivative| {
            // The steps are equally long.
            observer.record(step, 1.0);
            logarithm += derivative.matrix().determinant().ln();
        })?;
        let steps_per_period = solver.map().steps_per_period();
        let duration = solver.map().period() * periods as f64;
        let exponent = system.jacobian(0.0).trace() * duration;
        let measurable = -exponent < MEASURABLE_DECAY * (steps_per_period * periods) as f64;
        Ok(Self {
            multipliers: solver.multipliers()?,
            measures: observer.measures(system.parameters.kappa).unwrap_or_default(),
            liouville_defect: measurable.then(|| (logarithm - exponent).exp_m1().abs()),
            iterations: convergence.iterations,
            state,
            periods,
            residual,
            steps_per_period,
        })
    }

    /// Whether every multiplier is inside the unit circle.
    pub fn stable(&self) -> bool {
        self.largest_multiplier().norm() < 1.0
    }

    /// The multiplier of largest modulus.
    pub fn largest_multiplier(&self) -> Complex<f64> {
        self.multipliers.first().copied().unwrap_or_default()
    }

    /// How the motion is unstable, by its largest multiplier; `None` when it is stable.
    pub fn instability(&self) -> Option<Instability> {
        (!self.stable()).then(|| Instability::of(self.largest_multiplier()))
    }
}

/// State of the linear response at t = 0, or rest where there is none.
pub(super) fn linear_response(system: &ReducedSystem) -> Vec<f64> {
    LinearResponse::new(system).map_or_else(|_| vec![0.0; system.dimension()], |response| response.state(0.0))
}

/// The shortest number of excitation periods after which the orbit that `solver` found last repeats.
///
/// # Errors
/// As [`super::PeriodMap::apply`].
pub(super) fn shortest_period(
    solver: &mut OrbitSolver,
    beta: f64,
    periods: usize,
) -> Result<usize, OrbitError> {
    let state = solver.state().to_vec();
    for part in (1..periods).filter(|part| periods.is_multiple_of(*part)) {
        let map = solver.map();
        map.carry(&state, beta, part)?;
        if distance(map.image(), &state, map.scales()) < SAME_POINT * map.gap() {
            return Ok(part);
        }
    }
    Ok(periods)
}
