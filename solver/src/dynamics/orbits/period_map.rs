//! The stroboscopic map over whole excitation periods, with its exact derivative.
//!
//! A period is a fixed number of equal steps of the integrator (`integration::collocation`), so one set of tables serves
//! every step, and every beta, which enters through the extended state. Inside a step the variational equations are
//! solved at the same nodes (in `integration::variation`): what comes out is the derivative of the map as computed, to
//! rounding. That it is also the derivative of the true map is watched by the same error estimate as the
//! integrator's, applied to the motion and to R'(s) times each variation; when it fails, [`PeriodMap::refine`]
//! doubles the steps.

use std::f64::consts::TAU;
use std::sync::Arc;

use nalgebra::DMatrix;

use super::orbit_error::OrbitError;
use crate::dynamics::integration::collocation::{ROUNDING, check_state};
use crate::dynamics::integration::grid::coarsest_steps;
use crate::dynamics::integration::linear::LinearPart;
use crate::dynamics::integration::rule::{NodeValues, add_scaled};
use crate::dynamics::integration::rung::Rung;
use crate::dynamics::integration::variation::{add_combination, differentiate, high_degrees};
use crate::dynamics::integration::{ESCAPE_DISPLACEMENT, Step};
use crate::model::{ReducedSystem, RestForce};

/// Bound on the estimated error at the end of a step, relative to the gap s0 or to a variation.
const TOLERANCE: f64 = 1e-10;
/// The same within a step, where only the tip's extremes are read.
const TOLERANCE_WITHIN: f64 = 1e-5;
/// Passes of the fixed-point iteration before a step counts as too long.
const MAX_PASSES: usize = 24;
/// How often the coarsest grid may be halved.
const DEEPEST_LEVEL: u32 = 10;
/// Most excitation periods a map may cover.
pub const MOST_PERIODS: usize = 64;

/// The derivative of one step, as shown to the observer of [`PeriodMap::apply`].
#[derive(Debug)]
pub struct StepDerivative<'a> {
    columns: &'a [f64],
    stride: usize,
    dimension: usize,
}

impl StepDerivative<'_> {
    /// d(state at the end)/d(state at the start), (2N + 1) x (2N + 1).
    pub fn matrix(&self) -> DMatrix<f64> {
        DMatrix::from_fn(self.dimension, self.dimension, |i, j| self.columns[j * self.stride + i])
    }
}

/// The map of one structure at one excitation frequency.
#[derive(Debug, Clone)]
pub struct PeriodMap {
    /// Steps a period, and what belongs to one of their length.
    steps: usize,
    rung: Arc<Rung>,
    /// Sine and cosine of the excitation's phase at the start of each step.
    phases: Arc<[(f64, f64)]>,
    force: RestForce,
    period: f64,
    gap: f64,
    level: u32,
    /// How often the coarsest grid may be halved.
    deepest: u32,
    scales: Vec<f64>,
    extended: Vec<f64>,
    end: Vec<f64>,
    /// Columns of the step's derivative and then d/dbeta, `stride` entries each.
    step: Vec<f64>,
    /// The same for the map so far.
    product: Vec<f64>,
    next: Vec<f64>,
}

impl PeriodMap {
    /// Prepares the map of `system` under its own force law on the coarsest grid. The system's beta is not used.
    pub fn new(system: &ReducedSystem) -> Self {
        Self::with_level(system, 0)
    }

    /// Prepares the map on the coarsest grid halved `level` times.
    pub(in crate::dynamics) fn with_level(system: &ReducedSystem, level: u32) -> Self {
        let period = system.parameters.period();
        let steps = coarsest_steps(system) << level;
        let rung = Rung::new(&LinearPart::new(system), period / steps as f64);
        let size = rung.tables.stride() * (rung.tables.dimension() + 1);
        Self {
            extended: vec![0.0; rung.propagator.part().extended_dimension()],
            end: vec![0.0; rung.tables.stride()],
            step: vec![0.0; size],
            product: vec![0.0; size],
            next: vec![0.0; size],
            scales: scales(system),
            gap: system.equilibrium.gap,
            level,
            deepest: DEEPEST_LEVEL,
            steps,
            phases: phases(steps),
            rung: Arc::new(rung),
            force: system.rest_force(),
            period,
        }
    }

    /// The same map, on a grid that is halved at most `deepest` times: what it cannot follow then it gives up sooner.
    pub(in crate::dynamics) fn limited(self, deepest: u32) -> Self {
        Self { deepest: deepest.min(DEEPEST_LEVEL), ..self }
    }

    /// What belongs to a step of the map's length.
    pub(in crate::dynamics) fn rung(&self) -> &Arc<Rung> {
        &self.rung
    }

    /// Length 2N + 1 of the state.
    pub fn dimension(&self) -> usize {
        self.rung.tables.dimension()
    }

    /// Excitation period 2 pi / omega (dimensionless).
    pub fn period(&self) -> f64 {
        self.period
    }

    /// The gap s0, the unit in which displacements are judged, in beam lengths.
    pub fn gap(&self) -> f64 {
        self.gap
    }

    /// How often the coarsest grid has been halved.
    pub(in crate::dynamics) fn level(&self) -> u32 {
        self.level
    }

    /// Steps of one excitation period.
    pub fn steps_per_period(&self) -> usize {
        self.steps
    }

    /// What each component of the state is when its energy is that of a unit displacement of its mode (1, omega_k,
    /// and for the voltage omega_1 sqrt(eta_21 / c)), length 2N + 1. Divided by these, components compare.
    pub fn scales(&self) -> &[f64] {
        &self.scales
    }

    /// Doubles the steps of a period.
    ///
    /// # Errors
    /// [`OrbitError::Unresolved`] when the grid is as fine as it may become.
    pub fn refine(&mut self) -> Result<(), OrbitError> {
        if self.level >= self.deepest {
            return Err(OrbitError::Unresolved { steps: self.steps });
        }
        self.level += 1;
        self.steps *= 2;
        self.rung = self.rung.half();
        self.phases = phases(self.steps);
        Ok(())
    }

    /// Carries `state` (length 2N + 1, at t = 0) over `periods` excitation periods at amplitude `beta`, and its
    /// derivative along. Each step is shown to `observer`.
    ///
    /// Returns the largest estimated error of a step in units of what is allowed: above 1 the grid is too coarse.
    ///
    /// # Errors
    /// [`OrbitError::Escaped`], [`OrbitError::Contact`], [`OrbitError::Unresolved`] when the grid cannot follow
    /// the motion at all, [`OrbitError::Periods`], [`crate::dynamics::IntegrationError::InitialState`].
    pub fn apply(
        &mut self,
        state: &[f64],
        beta: f64,
        periods: usize,
        observer: impl FnMut(&Step<'_>, &StepDerivative<'_>),
    ) -> Result<f64, OrbitError> {
        self.run::<true>(state, beta, periods, observer)
    }

    /// Carries `state` alone, in the same manner: a third of the work, and the derivative is then meaningless.
    ///
    /// # Errors
    /// As [`Self::apply`].
    pub(in crate::dynamics) fn carry(
        &mut self,
        state: &[f64],
        beta: f64,
        periods: usize,
    ) -> Result<f64, OrbitError> {
        self.run::<false>(state, beta, periods, |_, _| ())
    }

    fn run<const DERIVED: bool>(
        &mut self,
        state: &[f64],
        beta: f64,
        periods: usize,
        mut observer: impl FnMut(&Step<'_>, &StepDerivative<'_>),
    ) -> Result<f64, OrbitError> {
        let rung = Arc::clone(&self.rung);
        let Rung { propagator, tables, .. } = &*rung;
        let (dimension, stride) = (tables.dimension(), tables.stride());
        check_state(state, dimension)?;
        if !(1..=MOST_PERIODS).contains(&periods) {
            return Err(OrbitError::Periods { periods, most: MOST_PERIODS });
        }
        self.extended[..dimension].copy_from_slice(state);
        if DERIVED {
            self.product.fill(0.0);
            for j in 0..dimension {
                self.product[j * stride + j] = 1.0;
            }
        }
        let mut worst: f64 = 0.0;
        for number in 0..periods * self.steps {
            let index = number % self.steps;
            let time = self.period * (number as f64 / self.steps as f64);
            let (sine, cosine) = self.phases[index];
            self.extended[dimension] = beta * sine;
            self.extended[dimension + 1] = beta * cosine;
            // Compiled twice, once for the paper's law alone, which then stays in registers.
            let (tip, rest) = match self.force {
                RestForce::Quadratic { c2 } => self.solve(&RestForce::Quadratic { c2 }, time),
                _ => self.solve(&self.force, time),
            }?;
            let mut variation = 0.0;
            if DERIVED {
                let slopes = self.force.slope_at(&tip);
                variation = differentiate(tables, &slopes, (sine, cosine), &self.scales, &mut self.step)
                    .ok_or(OrbitError::Unresolved { steps: self.steps })?;
            }
            let gap = tip.iter().fold(self.gap, |most, s| most.max(s.abs()));
            let end = tables.end_gain / TOLERANCE;
            let motion = high_degrees(&rest) / gap * end.max(tables.gain / TOLERANCE_WITHIN);
            worst = worst.max(motion).max(variation * end);
            if DERIVED {
                let start = &self.extended;
                let step = Step { time, start, rest: &rest, tip: &tip, tables, propagator, index };
                observer(&step, &StepDerivative { columns: &self.step, stride, dimension });
            }
            tables.end(&self.extended, &rest, &mut self.end);
            self.extended[..dimension].copy_from_slice(&self.end[..dimension]);
            if DERIVED {
                self.accumulate();
            }
        }
        Ok(worst)
    }

    /// The state that the last [`Self::apply`] ended in, length 2N + 1.
    pub fn image(&self) -> &[f64] {
        &self.extended[..self.dimension()]
    }

    /// Entry (`row`, `column`) of the derivative of the last [`Self::apply`] with respect to the state; column
    /// 2N + 1 is the derivative with respect to beta.
    pub fn derivative(&self, row: usize, column: usize) -> f64 {
        self.product[column * self.rung.tables.stride() + row]
    }

    /// The derivative of the last [`Self::apply`] in the components that [`Self::scales`] makes comparable,
    /// (2N + 1) x (2N + 1). Over m periods on an orbit it is the monodromy matrix, well balanced.
    pub fn scaled_derivative(&self) -> DMatrix<f64> {
        let n = self.dimension();
        DMatrix::from_fn(n, n, |i, j| self.derivative(i, j) * (self.scales[j] / self.scales[i]))
    }

    /// Solves a step from the present extended state under the map's own `force`: s and R at the nodes.
    #[inline(always)]
    fn solve(&self, force: &RestForce, time: f64) -> Result<(NodeValues, NodeValues), OrbitError> {
        let Rung { tables, propagator, .. } = &*self.rung;
        let n = propagator.part().modes;
        let free = tables.tip.free(&self.extended);
        let s: f64 = self.extended[..n].iter().sum();
        let w: f64 = self.extended[n..2 * n].iter().sum();
        let mut tip = free;
        add_scaled(&mut tip, force.rest(s), &tables.guess[0]);
        add_scaled(&mut tip, force.slope(s) * w, &tables.guess[1]);
        // Each pass gains digits, so a change of this size leaves rounding only.
        let settled = 100.0 * ROUNDING * self.gap.max(s.abs());
        let contact = force.contact();
        let mut last = false;
        for _ in 0..MAX_PASSES {
            let rest = force.rest_at(&tip);
            if last {
                return Ok((tip, rest));
            }
            let mut next = free;
            for (value, row) in rest.iter().zip(&tables.tip.from_rest) {
                add_scaled(&mut next, *value, row);
            }
            let change = next.iter().zip(&tip).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
            tip = next;
            let (lowest, highest) =
                tip.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), s| (a.min(*s), b.max(*s)));
            if contact.is_some_and(|contact| lowest <= contact) {
                return Err(OrbitError::Contact { time });
            }
            if !(change.is_finite() && highest.max(-lowest) < ESCAPE_DISPLACEMENT) {
                return Err(OrbitError::Escaped { time });
            }
            last = change <= settled;
        }
        Err(OrbitError::Unresolved { steps: self.steps })
    }

    /// Multiplies the step's derivative onto that of the map so far.
    #[inline]
    fn accumulate(&mut self) {
        let stride = self.rung.tables.stride();
        let dimension = self.rung.tables.dimension();
        let columns = self.next.chunks_exact_mut(stride).zip(self.product.chunks_exact(stride));
        for (j, (next, old)) in columns.enumerate() {
            if j < dimension {
                next.fill(0.0);
            } else {
                next.copy_from_slice(&self.step[j * stride..]);
            }
            add_combination(next, old[..dimension].iter().copied(), |k| &self.step[k * stride..]);
        }
        std::mem::swap(&mut self.next, &mut self.product);
    }
}

/// Sine and cosine of the phase at the start of each of `steps` steps.
fn phases(steps: usize) -> Arc<[(f64, f64)]> {
    (0..steps).map(|i| (TAU * i as f64 / steps as f64).sin_cos()).collect()
}

/// What each component of a state is when its energy is that of a unit displacement of its mode, length 2N + 1: see
/// [`PeriodMap::scales`].
pub(in crate::dynamics) fn scales(system: &ReducedSystem) -> Vec<f64> {
    let first = &system.modes[0];
    let voltage = first.omega * (first.eta2 / system.capacitance).sqrt();
    let velocities = system.modes.iter().map(|mode| mode.omega);
    std::iter::repeat_n(1.0, system.modes.len()).chain(velocities).chain([voltage]).collect()
}

/// Largest component of the difference of two states, each over its entry of `scales`.
pub(in crate::dynamics) fn distance(a: &[f64], b: &[f64], scales: &[f64]) -> f64 {
    a.iter().zip(b).zip(scales).map(|((a, b), scale)| ((a - b) / scale).abs()).fold(0.0, f64::max)
}
