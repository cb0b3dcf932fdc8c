//! The integrator made for this system: exponential Gauss-Legendre collocation with error control.
//!
//! The magnet's rest force R(s) acts on everything through one scalar, the tip displacement s. In a step s at the
//! eight nodes obeys s = (linear response) + K R(s), a small Volterra equation solved by fixed-point iteration:
//! the kernel is of the order of the step squared, so each pass gains about two digits. Linear vibration, damping
//! and circuit are carried exactly by [`StepTables`], so stiff high modes and short circuit times cost nothing.
//!
//! Steps are fractions of the excitation period, halved and doubled by an estimate of the interpolation error of
//! R; stroboscopic points therefore fall on the grid. The method stops working when R changes within a step by
//! more than the iteration can follow; the step is then halved, and a motion that needs steps below 2^-20 of a
//! period has escaped, touched, or is reported as unresolvable.
//!
//! Reference: collocation at Gauss points is of order 2m (Hairer, Norsett & Wanner, "Solving Ordinary
//! Differential Equations I", section II.7); its exponential form is in Hochbruck & Ostermann, Acta Numerica 2010.

use std::f64::consts::TAU;

use super::linear::LinearPart;
use super::propagator::Propagator;
use super::tables::{BLOCK, NODES, NodeValues, RULE, StepTables, add_scaled};
use super::{ESCAPE_DISPLACEMENT, IntegrationError, Outcome};
use crate::model::{ReducedSystem, RestForce};

/// Largest number of halvings of the longest step.
const DEEPEST_LEVEL: usize = 20;
/// Most passes of the fixed-point iteration before a step counts as too long.
const MAX_PASSES: usize = 14;
/// Relative accuracy below which rounding hides every error.
pub(super) const ROUNDING: f64 = 1e-14;
/// Steps that a run may take beyond [`MOST_SHORTENED`]: none may go on for minutes.
const SPARE_STEPS: u64 = 200_000;
/// How many times shorter than the longest step the steps of a long run may be on average.
const MOST_SHORTENED: u64 = 64;

/// How a run is carried out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Bound on the error of the tip displacement anywhere within a step, relative to the gap s0
    /// (dimensionless). The ends of steps, and so stroboscopic points and final states, are held to its square.
    pub tolerance: f64,
}

impl Default for Settings {
    /// Tolerance 1e-5, with which the paper's longest run ends within 1e-8 of the exact motion.
    fn default() -> Self {
        Self { tolerance: 1e-5 }
    }
}

/// One accepted step, shown to the observer of a run.
#[derive(Debug)]
pub struct Step<'a> {
    /// Time at the start of the step (dimensionless).
    pub time: f64,
    /// Extended state at the start, length 2N + 3: the state, then beta times sine and cosine of omega t.
    pub start: &'a [f64],
    /// R at the nodes.
    pub rest: &'a NodeValues,
    /// Tip displacement at the nodes, in beam lengths.
    pub tip: &'a NodeValues,
    /// The tables of this step's length.
    pub tables: &'a StepTables,
    /// The linear part's flow, for the motion within the step.
    pub propagator: &'a Propagator,
    /// Position within the excitation period, in steps of this length; 0 at t = 2 pi k / omega, where a run that began
    /// at a phase of its own has that phase again.
    pub index: usize,
}

/// An integrator of one system, holding the present state.
#[derive(Debug, Clone)]
pub struct Collocation {
    part: LinearPart,
    /// Over the longest step, for its tables and for dense output.
    propagator: Propagator,
    force: RestForce,
    settings: Settings,
    period: f64,
    beta: f64,
    /// Of the excitation at time 0 (radians).
    phase: f64,
    gap: f64,
    /// Steps a period at level 0.
    coarsest: usize,
    /// Tables of each level used so far, boxed because a step takes them out and puts them back.
    tables: Vec<Option<Box<StepTables>>>,
    level: usize,
    /// Whole periods done, and steps of the present level done in the current one.
    periods: u64,
    index: usize,
    /// Time since the last grid point, once the run's shortened last step is done.
    overtime: f64,
    extended: Vec<f64>,
    end: Vec<f64>,
    rest: NodeValues,
    tip: NodeValues,
    steps: u64,
}

/// What happened to an attempted step.
enum Attempt {
    Accepted { error: f64 },
    Rejected,
}

impl Collocation {
    /// An integrator of `system` under its own force law, at time 0 in the state `initial` (length 2N + 1).
    ///
    /// # Errors
    /// [`IntegrationError::InitialState`] when `initial` has the wrong length or is not finite.
    pub fn new(
        system: &ReducedSystem,
        initial: &[f64],
        settings: Settings,
    ) -> Result<Self, IntegrationError> {
        Self::from_phase(system, initial, 0.0, settings)
    }

    /// The same with the excitation's `phase` (radians) at time 0: how a motion goes on when a number has changed.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn from_phase(
        system: &ReducedSystem,
        initial: &[f64],
        phase: f64,
        settings: Settings,
    ) -> Result<Self, IntegrationError> {
        let dimension = system.dimension();
        check_state(initial, dimension)?;
        let part = LinearPart::new(system);
        let period = system.parameters.period();
        let coarsest = coarsest_steps(system);
        let propagator = Propagator::new(&part, period / coarsest as f64);
        let mut extended = initial.to_vec();
        let beta = system.parameters.beta;
        extended.extend([beta * phase.sin(), beta * phase.cos()]);
        Ok(Self {
            coarsest,
            phase,
            part,
            propagator,
            force: system.rest_force(),
            settings,
            period,
            beta,
            gap: system.equilibrium.gap,
            tables: vec![None; DEEPEST_LEVEL + 1],
            level: 0,
            periods: 0,
            index: 0,
            overtime: 0.0,
            extended,
            end: vec![0.0; dimension.next_multiple_of(BLOCK)],
            rest: [0.0; NODES],
            tip: [0.0; NODES],
            steps: 0,
        })
    }

    /// Present time (dimensionless).
    pub fn time(&self) -> f64 {
        let whole = self.periods as f64 + self.index as f64 / self.steps_per_period() as f64;
        whole * self.period + self.overtime
    }

    /// Present state, length 2N + 1.
    pub fn state(&self) -> &[f64] {
        &self.extended[..self.part.modes * 2 + 1]
    }

    /// Steps accepted so far.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// The linear part.
    pub fn linear_part(&self) -> &LinearPart {
        &self.part
    }

    /// The linear part's flow over the longest step and its fractions, for dense output.
    pub fn propagator(&self) -> &Propagator {
        &self.propagator
    }

    fn steps_per_period(&self) -> usize {
        self.coarsest << self.level
    }

    /// Goes on towards `t_end` for at most `most_steps` steps, each shown to `observer`, and returns the outcome
    /// once there is one. The last step is shortened to end at `t_end`; after an outcome the run is over. Without an end
    /// (infinite `t_end`) every stroboscopic instant stays on the grid.
    ///
    /// # Errors
    /// [`IntegrationError::StepTooSmall`] when no step is short enough and yet nothing escaped or touched,
    /// [`IntegrationError::TooManySteps`] when the motion needs so many that the run would hardly end.
    pub fn advance(
        &mut self,
        t_end: f64,
        most_steps: usize,
        observer: &mut dyn FnMut(&Step<'_>),
    ) -> Result<Option<Outcome>, IntegrationError> {
        for _ in 0..most_steps {
            if self.steps > SPARE_STEPS + MOST_SHORTENED * self.coarsest as u64 * self.periods {
                return Err(IntegrationError::TooManySteps { time: self.time(), steps: self.steps });
            }
            let remaining = t_end - self.time();
            if remaining <= 1e-12 * self.period {
                return Ok(Some(Outcome::Completed));
            }
            let length = self.step_length();
            let last = remaining < length * (1.0 - 1e-9);
            let tables = match self.tables[self.level].take() {
                Some(tables) if !last => tables,
                kept => {
                    let tables = if last || self.level > 0 {
                        StepTables::new(&self.part, if last { remaining } else { length })
                    } else {
                        StepTables::of(&self.propagator)
                    };
                    let tables = Box::new(tables);
                    self.tables[self.level] = kept;
                    tables
                }
            };
            let attempt = self.attempt(&tables);
            if let Attempt::Accepted { .. } = attempt {
                observer(&self.present(&tables));
            }
            if !last {
                self.tables[self.level] = Some(tables);
            }
            match attempt {
                Attempt::Accepted { .. } if last => {
                    self.move_to_end();
                    self.overtime = remaining;
                    return Ok(Some(self.ended().unwrap_or(Outcome::Completed)));
                }
                Attempt::Accepted { error } => {
                    self.move_to_end();
                    self.next_grid_point();
                    if let Some(outcome) = self.ended() {
                        return Ok(Some(outcome));
                    }
                    self.lengthen(error);
                }
                Attempt::Rejected if self.level == DEEPEST_LEVEL => return self.give_up().map(Some),
                Attempt::Rejected => {
                    self.level += 1;
                    self.index *= 2;
                }
            }
        }
        Ok(None)
    }

    fn step_length(&self) -> f64 {
        self.period / self.steps_per_period() as f64
    }

    fn present<'a>(&'a self, tables: &'a StepTables) -> Step<'a> {
        Step {
            time: self.time(),
            start: &self.extended,
            rest: &self.rest,
            tip: &self.tip,
            tables,
            propagator: &self.propagator,
            index: self.index,
        }
    }

    /// Solves the step from the present state; leaves R and s at the nodes in `self`.
    fn attempt(&mut self, tables: &StepTables) -> Attempt {
        // Compiled twice, once for the paper's law alone, which then stays in registers.
        let solution = match self.force {
            RestForce::Quadratic { c2 } => self.solve(&RestForce::Quadratic { c2 }, tables),
            _ => self.solve(&self.force, tables),
        };
        match solution {
            Some((rest, tip, scale)) => self.judge(tables, rest, tip, scale),
            None => Attempt::Rejected,
        }
    }

    /// R and s at the nodes under the integrator's own `force`, and the size of s by which their error is judged; `None`
    /// when the step is too long.
    #[inline(always)]
    fn solve(&self, force: &RestForce, tables: &StepTables) -> Option<(NodeValues, NodeValues, f64)> {
        let free = tables.tip.free(&self.extended);
        let n = self.part.modes;
        let s: f64 = self.extended[..n].iter().sum();
        let w: f64 = self.extended[n..2 * n].iter().sum();
        let mut tip = free;
        add_scaled(&mut tip, force.rest(s), &tables.guess[0]);
        add_scaled(&mut tip, force.slope(s) * w, &tables.guess[1]);
        let scale = self.gap.max(s.abs());
        // Each pass shrinks the error by an order of magnitude or more, so the last change bounds what is left.
        let settled = (1e-4 * self.settings.tolerance).max(ROUNDING) * scale;
        let contact = force.contact();
        for _ in 0..MAX_PASSES {
            let rest = force.rest_at(&tip);
            let mut next = free;
            for (value, row) in rest.iter().zip(&tables.tip.from_rest) {
                add_scaled(&mut next, *value, row);
            }
            let change = largest_difference(&next, &tip);
            tip = next;
            let lowest = tip.iter().copied().fold(f64::INFINITY, f64::min);
            let beyond = contact.is_some_and(|contact| lowest <= contact);
            if !change.is_finite() || beyond {
                return None;
            }
            if change <= settled {
                return Some((force.rest_at(&tip), tip, scale));
            }
        }
        None
    }

    fn judge(&mut self, tables: &StepTables, rest: NodeValues, tip: NodeValues, scale: f64) -> Attempt {
        let mut highest = 0.0;
        for row in &RULE.highest {
            let coefficient: f64 = row.iter().zip(&rest).map(|(a, b)| a * b).sum();
            highest += coefficient.abs();
        }
        // R's polynomial ends where its last coefficients are; what they move s by bounds what the missing ones do.
        let tolerance = self.settings.tolerance;
        let within = tables.gain / tolerance;
        let end = tables.end_gain / (tolerance * tolerance).max(ROUNDING);
        let error = highest * within.max(end) / scale;
        if !(error <= 1.0) {
            return Attempt::Rejected;
        }
        self.rest = rest;
        self.tip = tip;
        tables.end(&self.extended, &self.rest, &mut self.end);
        Attempt::Accepted { error }
    }

    fn move_to_end(&mut self) {
        let dimension = self.part.modes * 2 + 1;
        self.extended[..dimension].copy_from_slice(&self.end[..dimension]);
        self.steps += 1;
    }

    /// Counts the step, and takes the phase from the grid rather than from the last step, so that it cannot drift.
    fn next_grid_point(&mut self) {
        self.index += 1;
        if self.index == self.steps_per_period() {
            self.index = 0;
            self.periods += 1;
        }
        let dimension = self.part.modes * 2 + 1;
        let angle = self.phase + TAU * self.index as f64 / self.steps_per_period() as f64;
        let (sine, cosine) = angle.sin_cos();
        self.extended[dimension] = self.beta * sine;
        self.extended[dimension + 1] = self.beta * cosine;
    }

    /// Doubles the step when the error leaves ample room and the grid allows it.
    fn lengthen(&mut self, error: f64) {
        const ROOM: f64 = 1.0 / 512.0;
        if self.level > 0 && error < ROOM && self.index.is_multiple_of(2) {
            self.level -= 1;
            self.index /= 2;
        }
    }

    fn ended(&self) -> Option<Outcome> {
        let s: f64 = self.extended[..self.part.modes].iter().sum();
        (s.abs() >= ESCAPE_DISPLACEMENT || !s.is_finite()).then(|| Outcome::Escaped { time: self.time() })
    }

    fn give_up(&self) -> Result<Outcome, IntegrationError> {
        let s: f64 = self.extended[..self.part.modes].iter().sum();
        let time = self.time();
        match self.force.contact() {
            Some(contact) if s < 0.9 * contact => Ok(Outcome::Contact { time }),
            _ if s.abs() > 4.0 * self.gap => Ok(Outcome::Escaped { time }),
            _ => Err(IntegrationError::StepTooSmall { time, tolerance: self.settings.tolerance }),
        }
    }
}

/// Largest |a - b|, by pairs: one chain of eight comparisons would take as long as a pass of the iteration. A NaN
/// may get lost, but not in the estimate of the error, which adds up all nodes.
fn largest_difference(a: &NodeValues, b: &NodeValues) -> f64 {
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let eight: NodeValues = std::array::from_fn(|i| (a[i] - b[i]).abs());
    let four: [f64; 4] = std::array::from_fn(|i| larger(eight[i], eight[i + 4]));
    larger(larger(four[0], four[2]), larger(four[1], four[3]))
}

/// Checks length and finiteness of a state.
///
/// # Errors
/// [`IntegrationError::InitialState`].
pub fn check_state(state: &[f64], expected: usize) -> Result<(), IntegrationError> {
    if state.len() != expected {
        return Err(IntegrationError::InitialState { expected, got: format!("{} numbers", state.len()) });
    }
    match state.iter().position(|value| !value.is_finite() || value.abs() > 1e6) {
        None => Ok(()),
        Some(i) => {
            Err(IntegrationError::InitialState { expected, got: format!("{} at place {}", state[i], i + 1) })
        }
    }
}

/// Steps a period at level 0: one step for about two thirds of a vibration of the faster of the excitation's
/// second harmonic and the second mode, which R follows.
pub(super) fn coarsest_steps(system: &ReducedSystem) -> usize {
    let modes = &system.modes;
    let fastest = (2.0 * system.parameters.omega).max(modes[modes.len().min(2) - 1].omega);
    ((fastest * system.parameters.period() / 4.0).ceil() as usize).max(1)
}
