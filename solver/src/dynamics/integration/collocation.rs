//! The integrator made for this system: exponential Gauss-Legendre collocation with error control.
//!
//! The magnet's rest force R(s) acts on everything through one scalar, the tip displacement s. In a step s at the
//! eight nodes obeys s = (linear response) + K R(s), a small Volterra equation solved by fixed-point iteration:
//! the kernel is of the order of the step squared, so each pass gains about two digits. Linear vibration, damping
//! and circuit are carried exactly by [`StepTables`], so stiff high modes and short circuit times cost nothing.
//!
//! Steps are fractions of the excitation period (or, under any other motion of the base, of the time between two of its samples), halved and doubled by an estimate of the interpolation error of
//! R; stroboscopic points therefore fall on the grid. The method stops working when R changes within a step by
//! more than the iteration can follow; the step is then halved, and a motion that needs steps below 2^-20 of a
//! period has escaped, touched, or is reported as unresolvable.
//!
//! Reference: collocation at Gauss points is of order 2m (Hairer, Norsett & Wanner, "Solving Ordinary
//! Differential Equations I", section II.7); its exponential form is in Hochbruck & Ostermann, Acta Numerica 2010.
//!
//! The propagator ([`super::propagator`]) doubles a Taylor series over a short duration until it reaches the step, so that
//! a rate of 10^7 costs 20 doublings and no digits; dense output uses the same flows. Consequences:
//!
//! * The same code serves any number of modes and any force law; a step costs about 0.2 µs for two modes.
//! * Stiff high modes and short circuit times do not limit the step, and no device is too stiff to prepare. A Taylor
//!   series of the whole system, the method tried first on paper, is as fast for two modes but needs steps of
//!   1/omega_N for N.
//! * The end of a step is of order sixteen.
//! * Work inside a step is over fixed arrays of eight, which compilers turn into vector code for x86 and wasm alike.
//!
//! Error control: the two highest Legendre coefficients of R in a step, times how far they move s within the step
//! (`StepTables::gain`) and at its end (`StepTables::end_gain`), are held below the tolerance and its square.
//!
//! What is read off a run lies on the motion, not on its grid: `integration::extremes` keeps the steps that may hold
//! an extreme and reads it there by dense output; means are over whole pairs of excitation periods.

use std::sync::Arc;

use super::grid::{DEEPEST_LEVEL, Grid};
use super::linear::LinearPart;
use super::outcome::{ESCAPE_DISPLACEMENT, IntegrationError, Outcome};
use super::propagator::{BLOCK, Propagator, StepRest, Workspace};
use super::rule::{NODES, NodeValues, RULE, add_scaled};
use super::rung::Rung;
use super::step::Step;
use super::tables::StepTables;
use crate::model::base_motion::Signal;
use crate::model::{ReducedSystem, RestForce};

/// Most passes of the fixed-point iteration before a step counts as too long.
const MAX_PASSES: usize = 14;

/// Relative accuracy below which rounding hides every error.
pub(in crate::dynamics) const ROUNDING: f64 = 1e-14;

/// Steps that a run may take beyond [`MOST_SHORTENED`]: none may go on for minutes.
const SPARE_STEPS: u64 = 200_000;
/// How many times shorter than the longest step the steps of a long run may be on average.
const MOST_SHORTENED: u64 = 64;
/// Halvings of a step in which the tip escapes: they find the instant to 1e-12 of the step.
const HALVINGS_TO_ESCAPE: usize = 40;

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

/// An integrator of one system, holding the present state.
#[derive(Debug, Clone)]
pub struct Collocation {
    part: LinearPart,
    /// Of the longest step, whose flow is for dense output, too.
    longest: Arc<Rung>,
    force: RestForce,
    settings: Settings,
    grid: Grid,
    excitation: Excitation,
    gap: f64,
    /// Those of each level used so far; a step takes its own out and puts it back.
    rungs: Vec<Option<Arc<Rung>>>,
    extended: Vec<f64>,
    end: Vec<f64>,
    rest: NodeValues,
    tip: NodeValues,
    steps: u64,
}

/// What shakes the base.
#[derive(Debug, Clone)]
enum Excitation {
    /// A sine of this amplitude, whose frequency and phase are the grid's.
    Sine { beta: f64 },
    /// Any acceleration (dimensionless), from this sample on.
    Signal(Arc<Signal>, usize),
}

/// What happened to an attempted step.
enum Attempt {
    Accepted { error: f64 },
    Rejected,
}

impl Excitation {
    /// The sine of a system.
    fn of(system: &ReducedSystem) -> Self {
        Self::Sine { beta: system.parameters.beta }
    }
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
        let grid = Grid::new(system, phase);
        let rung = Rung::new(&LinearPart::new(system), grid.longest_step());
        Self::prepared(system, Excitation::of(system), initial, (grid, Arc::new(rung)), settings)
    }

    /// An integrator of `system` whose base has the acceleration `signal` (dimensionless: in beam lengths and the model's unit
    /// of time) from its sample `first` on, at time 0 in the state `initial` (length 2N + 1). Its own sine plays no role. Every
    /// sample is the end of a step, so a run may last as long as the signal.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn under(
        system: &ReducedSystem,
        (signal, first): (Arc<Signal>, usize),
        initial: &[f64],
        settings: Settings,
    ) -> Result<Self, IntegrationError> {
        let grid = Grid::under(system, &signal);
        let rung = Rung::new(&LinearPart::under(system, &signal), grid.longest_step());
        Self::prepared(system, Excitation::Signal(signal, first), initial, (grid, Arc::new(rung)), settings)
    }

    /// As [`Self::from_phase`], with the voltage held at that of `initial`.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(super) fn clamped(
        system: &ReducedSystem,
        initial: &[f64],
        settings: Settings,
    ) -> Result<Self, IntegrationError> {
        let grid = Grid::new(system, 0.0);
        let rung = Rung::new(&LinearPart::new(system).clamped(), grid.longest_step());
        Self::prepared(system, Excitation::of(system), initial, (grid, Arc::new(rung)), settings)
    }

    /// As [`Self::new`], where what belongs to the longest step of `system` is there already.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(in crate::dynamics) fn with_rung(
        system: &ReducedSystem,
        initial: &[f64],
        rung: &Arc<Rung>,
        settings: Settings,
    ) -> Result<Self, IntegrationError> {
        let grid = Grid::new(system, 0.0);
        Self::prepared(system, Excitation::of(system), initial, (grid, Arc::clone(rung)), settings)
    }

    fn prepared(
        system: &ReducedSystem,
        excitation: Excitation,
        initial: &[f64],
        (grid, longest): (Grid, Arc<Rung>),
        settings: Settings,
    ) -> Result<Self, IntegrationError> {
        let dimension = system.dimension();
        check_state(initial, dimension)?;
        let part = longest.propagator.part().clone();
        let mut integrator = Self {
            extended: vec![0.0; part.extended_dimension()],
            part,
            longest,
            grid,
            force: system.rest_force(),
            settings,
            excitation,
            gap: system.equilibrium.gap,
            rungs: vec![None; DEEPEST_LEVEL + 1],
            end: vec![0.0; dimension.next_multiple_of(BLOCK)],
            rest: [0.0; NODES],
            tip: [0.0; NODES],
            steps: 0,
        };
        integrator.extended[..dimension].copy_from_slice(initial);
        integrator.excite();
        Ok(integrator)
    }

    /// Begins anew at time 0 in the state `initial` (length 2N + 1), with the excitation's `phase` (radians) there and steps as
    /// long as the last.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(super) fn begin_at(&mut self, initial: &[f64], phase: f64) -> Result<(), IntegrationError> {
        let dimension = self.part.modes * 2 + 1;
        check_state(initial, dimension)?;
        self.grid.begin_at(phase);
        self.extended[..dimension].copy_from_slice(initial);
        self.excite();
        self.steps = 0;
        Ok(())
    }

    /// Present time (dimensionless).
    pub fn time(&self) -> f64 {
        self.grid.time()
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
        &self.longest.propagator
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
            if self.steps > SPARE_STEPS + MOST_SHORTENED * self.grid.longest_steps_done() {
                return Err(IntegrationError::TooManySteps { time: self.time(), steps: self.steps });
            }
            let remaining = t_end - self.time();
            if remaining <= 1e-12 * self.grid.period() {
                return Ok(Some(Outcome::Completed));
            }
            let length = self.grid.step_length();
            let level = self.grid.level();
            let last = remaining < length * (1.0 - 1e-9);
            let rung = if last {
                Arc::new(Rung::new(&self.part, remaining))
            } else {
                self.rungs[level].take().unwrap_or_else(|| self.rung_of(level))
            };
            let tables = &rung.tables;
            let attempt = self.attempt(tables);
            if let Attempt::Accepted { .. } = attempt {
                if let Some(outcome) = self.escape_within(tables, observer) {
                    return Ok(Some(outcome));
                }
                observer(&self.present(tables));
            }
            if !last {
                self.rungs[level] = Some(rung);
            }
            match attempt {
                Attempt::Accepted { .. } if last => {
                    self.move_to_end();
                    self.grid.leave(remaining);
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
                Attempt::Rejected => {
                    if !self.grid.halve() {
                        return self.give_up().map(Some);
                    }
                }
            }
        }
        Ok(None)
    }

    fn rung_of(&self, level: usize) -> Arc<Rung> {
        (0..level).fold(Arc::clone(&self.longest), |rung, _| rung.half())
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

    fn present<'a>(&'a self, tables: &'a StepTables) -> Step<'a> {
        Step {
            time: self.time(),
            start: &self.extended,
            rest: &self.rest,
            tip: &self.tip,
            tables,
            propagator: &self.longest.propagator,
            index: self.grid.index(),
        }
    }

    fn move_to_end(&mut self) {
        let dimension = self.part.modes * 2 + 1;
        self.extended[..dimension].copy_from_slice(&self.end[..dimension]);
        self.steps += 1;
    }

    /// Whether the tip escapes in the step solved last, that of `tables`. The run then ends where |s| is
    /// [`ESCAPE_DISPLACEMENT`], found by dense output, with a step shortened to there.
    fn escape_within(&mut self, tables: &StepTables, observer: &mut dyn FnMut(&Step<'_>)) -> Option<Outcome> {
        let n = self.part.modes;
        let escaped = |state: &[f64]| state[..n].iter().sum::<f64>().abs() >= ESCAPE_DISPLACEMENT;
        if !escaped(&self.end) || escaped(&self.extended) {
            return None;
        }
        let rest = StepRest::new(&self.rest, tables.step);
        let mut workspace = Workspace::default();
        let (mut inside, mut outside) = (0.0, tables.step);
        let mut state = self.extended.clone();
        for _ in 0..HALVINGS_TO_ESCAPE {
            let middle = 0.5 * (inside + outside);
            let mut there = state.clone();
            self.longest.propagator.carry(&mut there, inside, middle, &rest, &mut workspace);
            if escaped(&there) {
                outside = middle;
            } else {
                (inside, state) = (middle, there);
            }
        }
        let tables = StepTables::new(&self.part, outside);
        let Attempt::Accepted { .. } = self.attempt(&tables) else { return None };
        observer(&self.present(&tables));
        self.move_to_end();
        self.grid.leave(outside);
        Some(Outcome::Escaped { time: self.time() })
    }

    /// Counts the step.
    fn next_grid_point(&mut self) {
        self.grid.go_on();
        self.excite();
    }

    /// The excitation at the present grid point.
    fn excite(&mut self) {
        let dimension = self.part.modes * 2 + 1;
        match &self.excitation {
            Excitation::Sine { beta } => {
                let (sine, cosine) = self.grid.sine_and_cosine();
                self.extended[dimension] = beta * sine;
                self.extended[dimension + 1] = beta * cosine;
            }
            Excitation::Signal(signal, first) => {
                let (index, place) = self.grid.place();
                self.extended[dimension..].copy_from_slice(&signal.derivatives(first + index, place));
            }
        }
    }

    /// Doubles the step when the error leaves ample room and the grid allows it.
    fn lengthen(&mut self, error: f64) {
        const ROOM: f64 = 1.0 / 512.0;
        if error < ROOM {
            self.grid.double();
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ForceLaw, ParameterSet, Parameters};

    #[test]
    fn integrators_that_share_their_tables_go_the_same_way() -> Result<(), Box<dyn std::error::Error>> {
        let set = ParameterSet { alpha: 1e-4, beta: 0.01, omega: 8.0969, ..Default::default() };
        let system = ReducedSystem::new(Parameters::new(set)?, 2, ForceLaw::Exact)?;
        let (initial, settings) = ([0.01, 0.0, 0.1, 0.0, 0.0], Settings { tolerance: 1e-8 });
        let mut alone = Collocation::new(&system, &initial, settings)?;
        let mut first = Collocation::new(&system, &[0.0; 5], Settings::default())?;
        first.advance(40.0, usize::MAX, &mut |_| ())?;
        let mut second = Collocation::with_rung(&system, &initial, &first.longest, settings)?;
        for run in [&mut alone, &mut second] {
            run.advance(40.0, usize::MAX, &mut |_| ())?;
        }
        assert_eq!(
            (second.state(), second.time(), second.steps()),
            (alone.state(), alone.time(), alone.steps())
        );
        // The halved steps of one are the other's, too.
        let half = |run: &Collocation| Arc::as_ptr(&run.rung_of(1));
        assert!(half(&first) == half(&second) && half(&first) != half(&alone));
        assert!(Collocation::with_rung(&system, &[0.0; 4], &first.longest, settings).is_err());
        Ok(())
    }
}
