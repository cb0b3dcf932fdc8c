//! Simulate requests, by either integrator.

use super::RequestError;
use super::answer::{Answer, SimulateAnswer, word};
use super::request::{Method, SimulateRequest};
use crate::dynamics::rk4::RungeKutta4;
use crate::dynamics::{Collocation, IntegrationError, Outcome, Settings, Trajectory};
use crate::model::reduced::ForceVisitor;
use crate::model::{ModelError, ReducedSystem, RestForce};

const TOLERANCES: (f64, f64) = (1e-10, 1e-2);
const STEPS_PER_PERIOD: (f64, f64) = (10.0, 1e6);
/// A run longer than this many steps is refused rather than left to run for minutes.
const MOST_STEPS: f64 = 2e9;
const SAMPLES: (usize, usize) = (2, 200_000);
const END_TIME: (f64, f64) = (1e-6, 20_000.0);

pub(super) fn answer(request: &SimulateRequest) -> Result<Answer, RequestError> {
    let t_end = ModelError::check("t_end", request.t_end, END_TIME, "")?;
    ModelError::check("tolerance", request.tolerance, TOLERANCES, "")?;
    ModelError::check("steps_per_period", f64::from(request.steps_per_period), STEPS_PER_PERIOD, "")?;
    let (minimum, maximum) = SAMPLES;
    if !(minimum..=maximum).contains(&request.samples) {
        return Err(ModelError::Count { field: "samples", value: request.samples, minimum, maximum }.into());
    }
    let system = request.model.system(request.parameters)?;
    let initial = request.initial.clone().unwrap_or_else(|| vec![0.0; system.dimension()]);
    let answer = match request.method {
        Method::Adaptive => {
            let settings = Settings { tolerance: request.tolerance };
            system.dispatch(Adaptive { system: &system, initial: &initial, t_end, settings, request })?
        }
        Method::Rk4 => {
            let limit = MOST_STEPS * system.parameters.period() / f64::from(request.steps_per_period);
            ModelError::check("t_end", t_end, (END_TIME.0, limit), "")?;
            system.dispatch(Classical { system: &system, initial: &initial, t_end, request })?
        }
    };
    Ok(Answer::Simulate(answer))
}

/// The times of the samples that a run ending at `end` reaches, and last `end` itself.
fn sample_times(request: &SimulateRequest, end: f64) -> Vec<f64> {
    let count = request.samples;
    let time = |i: usize| request.t_end * i as f64 / (count - 1) as f64;
    let mut times: Vec<f64> = (0..count - 1).map(time).filter(|time| *time < end).collect();
    times.push(end);
    times
}

struct Adaptive<'a> {
    system: &'a ReducedSystem,
    initial: &'a [f64],
    t_end: f64,
    settings: Settings,
    request: &'a SimulateRequest,
}

impl ForceVisitor for Adaptive<'_> {
    type Output = Result<SimulateAnswer, IntegrationError>;

    fn visit<F: RestForce + 'static>(self, force: F) -> Self::Output {
        let mut integrator = Collocation::new(self.system, force, self.initial, self.settings)?;
        let mut trajectory = Trajectory::recorder(&integrator);
        let outcome = loop {
            let steps = integrator.advance(self.t_end, usize::MAX, |step| trajectory.record(step))?;
            if let Some(outcome) = steps {
                break outcome;
            }
        };
        trajectory.finish(&integrator, outcome);
        let t = sample_times(self.request, trajectory.end_time());
        let mut state = Vec::with_capacity(t.len());
        trajectory.read_at(&t, |_, values| state.push(values.to_vec()));
        let t_outcome = trajectory.end_time();
        Ok(SimulateAnswer { t, state, outcome: word(outcome), t_outcome, steps: integrator.steps() })
    }
}

struct Classical<'a> {
    system: &'a ReducedSystem,
    initial: &'a [f64],
    t_end: f64,
    request: &'a SimulateRequest,
}

impl ForceVisitor for Classical<'_> {
    type Output = Result<SimulateAnswer, IntegrationError>;

    /// Samples are given at the grid point nearest to their time: the method has no dense output.
    fn visit<F: RestForce + 'static>(self, force: F) -> Self::Output {
        let mut run = RungeKutta4::new(self.system, force, self.initial, self.request.steps_per_period)?;
        let length = run.step_length();
        let last = (self.t_end / length).round() as u64;
        let mut due = sample_times(self.request, self.t_end).into_iter().map(|t| (t / length).round() as u64);
        let mut next = due.next();
        let (mut t, mut state) = (Vec::new(), Vec::new());
        let mut outcome = Outcome::Completed;
        loop {
            while next.is_some_and(|step| step <= run.steps()) {
                t.push(run.time());
                state.push(run.state().to_vec());
                next = due.next();
            }
            if run.steps() >= last {
                break;
            }
            if let Some(early) = run.step() {
                outcome = early;
                t.push(run.time());
                state.push(run.state().to_vec());
                break;
            }
        }
        Ok(SimulateAnswer { t, state, outcome: word(outcome), t_outcome: run.time(), steps: run.steps() })
    }
}
