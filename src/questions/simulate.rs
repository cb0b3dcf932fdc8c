//! Simulate requests, by either integrator.

use nalgebra::Complex;
use serde::{Deserialize, Serialize};

use super::checks::count;
use super::error::RequestError;
use super::question::Question;
use crate::dynamics::integration::Step;
use crate::dynamics::integration::rk4::{RungeKutta4, amplification};
use crate::dynamics::{Collocation, IntegrationError, Outcome, Settings, Trajectory};
use crate::model::{ModelError, ReducedSystem};
use crate::scenario::Scenario;
use crate::scheduler::Budget;
use crate::spacing::equally_spaced;
use crate::theory::CoupledModes;

const TOLERANCES: (f64, f64) = (1e-10, 1e-2);
const STEPS_PER_PERIOD: (f64, f64) = (10.0, 1e6);
/// A run longer than this many steps is refused rather than left to run for minutes.
const MOST_STEPS: f64 = 2e9;
const SAMPLES: (usize, usize) = (2, 200_000);
const END_TIME: (f64, f64) = (1e-6, 20_000.0);
/// Steps after which the budget is looked at.
const PIECE: usize = 1 << 14;

/// A run in time, from the scenario's start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Simulate {
    /// End time (dimensionless).
    pub t_end: f64,
    /// Integrator.
    pub method: Method,
    /// Steps a period, for `rk4`.
    pub steps_per_period: u32,
    /// Bound on the error within a step, for `adaptive`.
    pub tolerance: f64,
    /// Number of equally spaced times at which the state is given, the first and the last included.
    pub samples: usize,
}

impl Default for Simulate {
    fn default() -> Self {
        Self {
            t_end: 600.0,
            method: Method::Adaptive,
            steps_per_period: crate::dynamics::integration::rk4::PAPER_STEPS_PER_PERIOD,
            tolerance: Settings::default().tolerance,
            samples: 101,
        }
    }
}

/// The integrators of a simulate request.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// The classical Runge-Kutta method with fixed steps, as the paper runs it.
    Rk4,
    /// The exponential collocation with error control.
    Adaptive,
}

/// A run in time.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SimulateAnswer {
    /// Times of the samples (dimensionless).
    pub t: Vec<f64>,
    /// One row (q_1..q_N, dq_1/dt..dq_N/dt, v) a time.
    pub state: Vec<Vec<f64>>,
    /// "completed", "escaped" or "contact"; "unstable_steps" when it ended because the steps of `rk4` are too long for it,
    /// so that the numbers grow by themselves; "unfinished" when the budget was spent.
    pub outcome: &'static str,
    /// Time at which the run ended.
    pub t_outcome: f64,
    /// Integration steps done.
    pub steps: u64,
}

/// When the steps of a method without error control are too long.
const UNSTABLE: &str = "unstable_steps";
/// When the budget ends before the run.
const UNFINISHED: &str = "unfinished";

impl Question for Simulate {
    const TASK: &'static str = "simulate";
    const TAKES: &'static [&'static str] = &["initial"];
    type Answer = SimulateAnswer;

    fn answer(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<SimulateAnswer, RequestError> {
        let t_end = ModelError::check("t_end", self.t_end, END_TIME, "")?;
        ModelError::check("tolerance", self.tolerance, TOLERANCES, "")?;
        ModelError::check("steps_per_period", f64::from(self.steps_per_period), STEPS_PER_PERIOD, "")?;
        count("samples", self.samples, SAMPLES)?;
        let system = scenario.model.system(scenario.parameters)?;
        let initial = scenario.initial.unwrap_or_else(|| vec![0.0; system.dimension()]);
        match self.method {
            Method::Adaptive => Ok(self.adaptive(&system, &initial, budget)?),
            Method::Rk4 => {
                let limit = MOST_STEPS * system.parameters.period() / f64::from(self.steps_per_period);
                ModelError::check("t_end", t_end, (END_TIME.0, limit), "")?;
                self.classical(&system, &initial, budget)
            }
        }
    }
}

impl Simulate {
    fn adaptive(
        &self,
        system: &ReducedSystem,
        initial: &[f64],
        budget: &Budget<'_>,
    ) -> Result<SimulateAnswer, IntegrationError> {
        let mut integrator = Collocation::new(system, initial, Settings { tolerance: self.tolerance })?;
        let mut trajectory = Trajectory::recorder(&integrator);
        let mut end = None;
        while end.is_none() {
            let mut record = |step: &Step<'_>| trajectory.record(step);
            let Some(piece) = budget.piece(|| integrator.advance(self.t_end, PIECE, &mut record)) else {
                break;
            };
            end = piece?;
            budget.report(integrator.time() / self.t_end);
        }
        trajectory.finish(&integrator, end.unwrap_or(Outcome::Completed));
        let t = self.sample_times(trajectory.end_time());
        let mut state = Vec::with_capacity(t.len());
        trajectory.read_at(&t, |_, values| state.push(values.to_vec()));
        let t_outcome = trajectory.end_time();
        let outcome = end.map_or(UNFINISHED, Outcome::word);
        Ok(SimulateAnswer { t, state, outcome, t_outcome, steps: integrator.steps() })
    }

    /// Samples are given at the grid point nearest to their time, the method having no dense output; the last step is
    /// shortened to end at `t_end`.
    fn classical(
        &self,
        system: &ReducedSystem,
        initial: &[f64],
        budget: &Budget<'_>,
    ) -> Result<SimulateAnswer, RequestError> {
        let mut run = RungeKutta4::new(system, initial, self.steps_per_period)?;
        let length = run.step_length();
        // What is left of rounding is no step.
        let whole = (self.t_end / length * (1.0 + 1e-12)).floor() as u64;
        let mut due = self.sample_times(self.t_end);
        due.pop();
        let mut due = due.into_iter().map(|t| ((t / length).round() as u64).min(whole));
        let mut next = due.next();
        let (mut t, mut state) = (Vec::new(), Vec::new());
        // Whether the run is over, and with which outcome.
        let mut piece = || {
            for _ in 0..PIECE {
                while next.is_some_and(|step| step <= run.steps()) {
                    t.push(run.time());
                    state.push(run.state().to_vec());
                    next = due.next();
                }
                if run.steps() >= whole {
                    return Some(run.step_to(self.t_end).unwrap_or(Outcome::Completed));
                }
                if let Some(early) = run.step() {
                    // Beyond all bounds there is no state to show.
                    if run.state().iter().all(|value| value.is_finite()) {
                        t.push(run.time());
                        state.push(run.state().to_vec());
                    }
                    return Some(early);
                }
            }
            None
        };
        let mut done = 0;
        let end = loop {
            match budget.piece(&mut piece) {
                Some(None) => done += PIECE,
                Some(end) => break end,
                None => break None,
            }
            budget.report(done as f64 / whole as f64);
        };
        if end.is_none() {
            t.push(run.time());
            state.push(run.state().to_vec());
        }
        let completed = end == Some(Outcome::Completed);
        if completed {
            t.push(self.t_end);
            state.push(run.state().to_vec());
        }
        let t_outcome = if completed { self.t_end } else { run.time() };
        let outcome = match end {
            None => UNFINISHED,
            Some(Outcome::Completed) => Outcome::Completed.word(),
            Some(early) => {
                let linear = CoupledModes::new(system)?;
                let grows = |rate: &Complex<f64>| rate.re <= 0.0 && amplification(rate * length) > 1.0 + 1e-9;
                if linear.eigenvalues().iter().any(grows) { UNSTABLE } else { early.word() }
            }
        };
        Ok(SimulateAnswer { t, state, outcome, t_outcome, steps: run.steps() })
    }

    /// The times of the samples that a run ending at `end` reaches, and last `end` itself.
    fn sample_times(&self, end: f64) -> Vec<f64> {
        let all = equally_spaced((0.0, self.t_end), self.samples).take(self.samples - 1);
        let mut times: Vec<f64> = all.filter(|time| *time < end).collect();
        times.push(end);
        times
    }
}
