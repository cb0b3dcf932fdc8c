//! Periodic motions: found by Newton's iteration on the stroboscopic map, measured, and judged by their multipliers.

use nalgebra::Complex;
use serde::Serialize;

use super::floquet::Instability;
use super::march::Forced;
use super::newton::{Convergence, OrbitSolver};
use super::orbit_error::OrbitError;
use super::period_map::{MOST_PERIODS, scales};
use crate::dynamics::integration::extremes::{Highest, Scalar};
use crate::dynamics::integration::propagator::Propagator;
use crate::dynamics::integration::{NODES, Step};
use crate::model::ReducedSystem;
use crate::model::quadrature::gauss_legendre;
use crate::theory::LinearResponse;

/// Distance between stroboscopic points, over the gap, below which they are the same point.
const SAME_POINT: f64 = 1e-8;
/// Decay within one step beyond which rounding hides its determinant.
const MEASURABLE_DECAY: f64 = 12.0;

/// Means and extremes of a periodic motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Measures {
    /// Root mean square of the voltage (V).
    pub v_rms: f64,
    /// Mean electrical power kappa v^2 in the load (dimensionless).
    pub power: f64,
    /// Lowest tip displacement from equilibrium, towards the fixed magnet, in beam lengths.
    pub tip_min: f64,
    /// Highest tip displacement, in beam lengths.
    pub tip_max: f64,
    /// Largest |v| (V).
    pub v_peak: f64,
    /// Largest |slope| at the tip from equilibrium (rad).
    pub slope: f64,
}

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
            let components = solver.state().iter().zip(guess).zip(scales(system));
            let distance = components.map(|((a, b), scale)| (a - b).abs() / scale).fold(0.0, f64::max);
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
        let mut observer = Observer::default();
        let residual = solver.evaluate_observed(beta, periods, |step, derivative| {
            observer.record(step);
            observer.logarithm += derivative.matrix().determinant().ln();
        })?;
        let steps_per_period = solver.map().steps_per_period();
        let duration = solver.map().period() * periods as f64;
        let exponent = system.jacobian(0.0).trace() * duration;
        let measurable = -exponent < MEASURABLE_DECAY * (steps_per_period * periods) as f64;
        Ok(Self {
            multipliers: solver.multipliers()?,
            measures: observer.measures(system.parameters.kappa),
            liouville_defect: measurable.then(|| (observer.logarithm - exponent).exp_m1().abs()),
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
        map.apply(&state, beta, part, |_, _| ())?;
        let distances =
            map.image().iter().zip(&state).zip(map.scales()).map(|((a, b), scale)| (a - b).abs() / scale);
        if distances.fold(0.0, f64::max) < SAME_POINT * map.gap() {
            return Ok(part);
        }
    }
    Ok(periods)
}

/// Reads a motion step by step.
pub(in crate::dynamics) struct Observer {
    weights: Vec<f64>,
    square: f64,
    steps: f64,
    lowest: Highest,
    highest: Highest,
    /// Of v and of -v.
    voltage: [Highest; 2],
    /// Of the slope at the tip and of its negative.
    slope: [Highest; 2],
    /// From the first step.
    propagator: Option<Propagator>,
    /// Logarithm of the determinant of the map's derivative.
    logarithm: f64,
}

impl Default for Observer {
    fn default() -> Self {
        Self {
            weights: gauss_legendre(NODES).1,
            square: 0.0,
            steps: 0.0,
            lowest: Highest::new(Scalar::Tip, -1.0),
            highest: Highest::new(Scalar::Tip, 1.0),
            voltage: [1.0, -1.0].map(|sign| Highest::new(Scalar::Voltage, sign)),
            slope: [1.0, -1.0].map(|sign| Highest::new(Scalar::TipSlope, sign)),
            propagator: None,
            logarithm: 0.0,
        }
    }
}

impl Observer {
    pub(in crate::dynamics) fn record(&mut self, step: &Step<'_>) {
        let voltage = step.tables.voltage.at_nodes(step.start, step.rest);
        self.square += self.weights.iter().zip(&voltage).map(|(w, v)| w * v * v).sum::<f64>();
        self.steps += 1.0;
        self.propagator.get_or_insert_with(|| step.propagator.clone());
        self.lowest.see(step, step.tip);
        self.highest.see(step, step.tip);
        self.voltage.iter_mut().for_each(|highest| highest.see(step, &voltage));
        let slope = step.tables.tip_slope.at_nodes(step.start, step.rest);
        self.slope.iter_mut().for_each(|highest| highest.see(step, &slope));
    }

    pub(in crate::dynamics) fn measures(&self, kappa: f64) -> Measures {
        // The steps are equally long, so the mean is that of their means.
        let mean = self.square / self.steps;
        let (tip_min, tip_max, v_peak, slope) = match &self.propagator {
            Some(propagator) => {
                let largest = |both| Highest::larger(both, propagator);
                let (low, high) = (-self.lowest.value(propagator), self.highest.value(propagator));
                (low, high, largest(&self.voltage), largest(&self.slope))
            }
            None => (f64::INFINITY, f64::NEG_INFINITY, 0.0, 0.0),
        };
        Measures { v_rms: mean.sqrt(), power: kappa * mean, tip_min, tip_max, v_peak, slope }
    }
}
