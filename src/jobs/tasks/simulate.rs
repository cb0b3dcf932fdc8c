//! Simulate requests, by either integrator.

use serde::{Deserialize, Serialize};

use super::{Answer, count};
use crate::dynamics::rk4::RungeKutta4;
use crate::dynamics::{Collocation, IntegrationError, Outcome, Settings, Trajectory};
use crate::jobs::RequestError;
use crate::model::{ModelError, ParameterSet, ReducedSystem};
use crate::scenario::ModelChoice;

const TOLERANCES: (f64, f64) = (1e-10, 1e-2);
const STEPS_PER_PERIOD: (f64, f64) = (10.0, 1e6);
/// A run longer than this many steps is refused rather than left to run for minutes.
const MOST_STEPS: f64 = 2e9;
const SAMPLES: (usize, usize) = (2, 200_000);
const END_TIME: (f64, f64) = (1e-6, 20_000.0);

/// A run in time.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SimulateRequest {
    /// The ten numbers; missing ones are the paper's.
    pub parameters: ParameterSet,
    /// Modes and force law.
    pub model: ModelChoice,
    /// End time (dimensionless).
    pub t_end: f64,
    /// State at time 0, length 2N + 1; rest when absent.
    pub initial: Option<Vec<f64>>,
    /// Integrator.
    pub method: Method,
    /// Steps a period, for `rk4`.
    pub steps_per_period: u32,
    /// Bound on the error within a step, for `adaptive`.
    pub tolerance: f64,
    /// Number of equally spaced times at which the state is given, the first and the last included.
    pub samples: usize,
}

impl Default for SimulateRequest {
    fn default() -> Self {
        Self {
            parameters: ParameterSet::default(),
            model: ModelChoice::default(),
            t_end: 600.0,
            initial: None,
            method: Method::Adaptive,
            steps_per_period: crate::dynamics::rk4::PAPER_STEPS_PER_PERIOD,
            tolerance: Settings::default().tolerance,
            samples: 101,
        }
    }
}

/// The integrators of a simulate request.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
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
    /// "completed", "escaped" or "contact".
    pub outcome: &'static str,
    /// Time at which the run ended.
    pub t_outcome: f64,
    /// Integration steps done.
    pub steps: u64,
}

/// The word for an outcome.
fn word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Completed => "completed",
        Outcome::Escaped { .. } => "escaped",
        Outcome::Contact { .. } => "contact",
    }
}

impl SimulateRequest {
    /// Computes the answer.
    ///
    /// # Errors
    /// [`RequestError`] when a number is out of range or the motion cannot be integrated.
    pub fn answer(&self) -> Result<Answer, RequestError> {
        let t_end = ModelError::check("t_end", self.t_end, END_TIME, "")?;
        ModelError::check("tolerance", self.tolerance, TOLERANCES, "")?;
        ModelError::check("steps_per_period", f64::from(self.steps_per_period), STEPS_PER_PERIOD, "")?;
        count("samples", self.samples, SAMPLES)?;
        let system = self.model.system(self.parameters)?;
        let initial = self.initial.clone().unwrap_or_else(|| vec![0.0; system.dimension()]);
        let answer = match self.method {
            Method::Adaptive => self.adaptive(&system, &initial)?,
            Method::Rk4 => {
                let limit = MOST_STEPS * system.parameters.period() / f64::from(self.steps_per_period);
                ModelError::check("t_end", t_end, (END_TIME.0, limit), "")?;
                self.classical(&system, &initial)?
            }
        };
        Ok(Answer::Simulate(answer))
    }

    fn adaptive(&self, system: &ReducedSystem, initial: &[f64]) -> Result<SimulateAnswer, IntegrationError> {
        let mut integrator = Collocation::new(system, initial, Settings { tolerance: self.tolerance })?;
        let mut trajectory = Trajectory::recorder(&integrator);
        let outcome = loop {
            let steps = integrator.advance(self.t_end, usize::MAX, &mut |step| trajectory.record(step))?;
            if let Some(outcome) = steps {
                break outcome;
            }
        };
        trajectory.finish(&integrator, outcome);
        let t = self.sample_times(trajectory.end_time());
        let mut state = Vec::with_capacity(t.len());
        trajectory.read_at(&t, |_, values| state.push(values.to_vec()));
        let t_outcome = trajectory.end_time();
        Ok(SimulateAnswer { t, state, outcome: word(outcome), t_outcome, steps: integrator.steps() })
    }

    /// Samples are given at the grid point nearest to their time, the method having no dense output; the last step is
    /// shortened to end at `t_end`.
    fn classical(&self, system: &ReducedSystem, initial: &[f64]) -> Result<SimulateAnswer, IntegrationError> {
        let mut run = RungeKutta4::new(system, initial, self.steps_per_period)?;
        let length = run.step_length();
        // What is left of rounding is no step.
        let whole = (self.t_end / length * (1.0 + 1e-12)).floor() as u64;
        let mut due = self.sample_times(self.t_end);
        due.pop();
        let mut due = due.into_iter().map(|t| ((t / length).round() as u64).min(whole));
        let mut next = due.next();
        let (mut t, mut state) = (Vec::new(), Vec::new());
        let mut outcome = None;
        loop {
            while next.is_some_and(|step| step <= run.steps()) {
                t.push(run.time());
                state.push(run.state().to_vec());
                next = due.next();
            }
            if run.steps() >= whole || outcome.is_some() {
                break;
            }
            outcome = run.step();
        }
        let early = outcome.or_else(|| run.step_to(self.t_end));
        let t_outcome = if early.is_some() { run.time() } else { self.t_end };
        t.push(t_outcome);
        state.push(run.state().to_vec());
        let outcome = word(early.unwrap_or(Outcome::Completed));
        Ok(SimulateAnswer { t, state, outcome, t_outcome, steps: run.steps() })
    }

    /// The times of the samples that a run ending at `end` reaches, and last `end` itself.
    fn sample_times(&self, end: f64) -> Vec<f64> {
        let count = self.samples;
        let time = |i: usize| self.t_end * i as f64 / (count - 1) as f64;
        let mut times: Vec<f64> = (0..count - 1).map(time).filter(|time| *time < end).collect();
        times.push(end);
        times
    }
}
