//! The forced motion, the one that grows out of rest, followed in beta at a fixed frequency.
//!
//! Its stations lie where they lie, whatever the beta that is asked for: a step is as long as prediction and multipliers
//! allow, so that what is found on the way does not depend on how far one looks.

use nalgebra::Complex;

use super::newton::OrbitSolver;
use super::orbit_error::OrbitError;

/// First and longest step in beta (dimensionless).
const STEPS: (f64, f64) = (3e-4, 4e-3);
/// The march gives up when its step has become shorter than this (dimensionless).
const SHORTEST: f64 = 2e-9;
/// Most stations: no march seen takes a tenth of them.
const MOST_STATIONS: usize = 5000;
/// How far a multiplier may move in a step.
const TURN: f64 = 0.2;
/// How far the cubic through the last two points is trusted, in their distances.
const CUBIC_REACH: f64 = 2.0;
/// Distance between a predicted and a converged orbit, relative to the latter's own distance from the last one,
/// beyond which it is another orbit; and that distance in units of the gap below which it is none in any case.
const CONTINUOUS: (f64, f64) = (0.3, 1e-6);
/// Smallest cosine between the directions in which two neighbouring orbits change with beta: beyond a fold the other
/// orbit changes the opposite way, however near it is.
const STRAIGHT: f64 = 0.5;

/// A point of the branch of forced motions.
#[derive(Debug, Clone)]
pub(in crate::dynamics) struct Forced {
    pub(in crate::dynamics) beta: f64,
    pub(in crate::dynamics) state: Vec<f64>,
    slope: Vec<f64>,
    pub(in crate::dynamics) multipliers: Vec<Complex<f64>>,
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
    pub(in crate::dynamics) fn move_to(
        &self,
        solver: &mut OrbitSolver,
        beta: f64,
    ) -> Result<Self, OrbitError> {
        let guess = self.predict(beta);
        let convergence = solver.follow(&guess, beta, 1)?;
        let scales = solver.map().scales().to_vec();
        let distance = |a: &[f64], b: &[f64]| {
            let components = a.iter().zip(b).zip(&scales);
            components.map(|((a, b), scale)| ((a - b) / scale).abs()).fold(0.0, f64::max)
        };
        let next = Self::read(solver, beta)?;
        let (missed, moved) = (distance(&next.state, &guess), distance(&next.state, &self.state));
        let jumps = missed > (CONTINUOUS.0 * moved).max(CONTINUOUS.1 * solver.map().gap());
        if jumps || self.turn(&next) > TURN || self.bends(&next, &scales) {
            let (iterations, residual) = (convergence.iterations, convergence.residual);
            return Err(OrbitError::NoConvergence { iterations, residual });
        }
        let (state, slope) = (self.state.clone(), self.slope.clone());
        Ok(Self { before: Some(Tangent { beta: self.beta, state, slope }), ..next })
    }

    /// Whether `next` changes with beta in another direction.
    fn bends(&self, next: &Self, scales: &[f64]) -> bool {
        let product = |a: &[f64], b: &[f64]| -> f64 {
            a.iter().zip(b).zip(scales).map(|((a, b), scale)| (a / scale) * (b / scale)).sum()
        };
        let (here, there) = (&self.slope, &next.slope);
        product(here, there) < STRAIGHT * (product(here, here) * product(there, there)).sqrt()
    }

    /// How far the multipliers have moved to those of `next`, each measured against the nearest.
    fn turn(&self, next: &Self) -> f64 {
        let farthest = |from: &[Complex<f64>], to: &[Complex<f64>]| {
            let nearest = |mu: &Complex<f64>| {
                to.iter().map(|other| (other - mu).norm_sqr()).fold(f64::INFINITY, f64::min)
            };
            from.iter().map(nearest).fold(0.0, f64::max)
        };
        let (here, there) = (&self.multipliers, &next.multipliers);
        farthest(here, there).max(farthest(there, here)).sqrt()
    }

    /// The motion without excitation.
    pub(in crate::dynamics) fn at_rest(solver: &mut OrbitSolver) -> Result<Self, OrbitError> {
        let rest = vec![0.0; solver.state().len()];
        solver.follow(&rest, 0.0, 1)?;
        Self::read(solver, 0.0)
    }

    /// The forced motion at `beta`, reached in as many steps as needed; `None` when they become too short.
    pub(in crate::dynamics) fn march_to(
        self,
        solver: &mut OrbitSolver,
        beta: f64,
    ) -> Result<Option<Self>, OrbitError> {
        let mut march = March::from(self, beta);
        while march.here.beta < beta {
            let Some(next) = march.step(solver, beta)? else { return Ok(None) };
            march.here = next;
        }
        Ok(Some(march.here))
    }
}

/// A march upwards in beta.
pub(in crate::dynamics) struct March {
    /// The last station.
    pub(in crate::dynamics) here: Forced,
    step: f64,
    longest: f64,
    stations: usize,
}

impl March {
    /// From rest, in steps that do not depend on how far it goes.
    pub(in crate::dynamics) fn from_rest(solver: &mut OrbitSolver) -> Result<Self, OrbitError> {
        Ok(Self { here: Forced::at_rest(solver)?, step: STEPS.0, longest: STEPS.1, stations: 0 })
    }

    /// From `here` towards `beta`, at once if possible.
    fn from(here: Forced, beta: f64) -> Self {
        let step = beta - here.beta;
        Self { here, step, longest: f64::INFINITY, stations: 0 }
    }

    /// The station after [`Self::here`], not beyond `limit`; `None` where the motion cannot be followed.
    ///
    /// # Errors
    /// [`OrbitError::Multipliers`].
    pub(in crate::dynamics) fn step(
        &mut self,
        solver: &mut OrbitSolver,
        limit: f64,
    ) -> Result<Option<Forced>, OrbitError> {
        self.stations += 1;
        while self.stations <= MOST_STATIONS {
            match self.here.move_to(solver, (self.here.beta + self.step).min(limit)) {
                Ok(next) => {
                    self.step = (2.0 * self.step).min(self.longest);
                    return Ok(Some(next));
                }
                Err(OrbitError::Multipliers) => return Err(OrbitError::Multipliers),
                Err(_) if self.step > SHORTEST => self.step *= 0.5,
                Err(_) => break,
            }
        }
        Ok(None)
    }
}
