//! A run kept step by step, with dense output: the state at any time, as accurate as the steps themselves.

use super::collocation::{Collocation, Settings};
use super::outcome::{IntegrationError, Outcome};
use super::propagator::{Propagator, StepRest, Workspace};
use super::rule::NodeValues;
use super::step::Step;
use crate::model::ReducedSystem;

/// The steps of a run. Between them the linear part is propagated exactly under the step's polynomial R.
#[derive(Debug, Clone)]
pub struct Trajectory {
    propagator: Propagator,
    /// Start times of the steps, ascending, and the end time of the last one.
    times: Vec<f64>,
    /// Extended states at the start of the steps, `width` numbers each.
    states: Vec<f64>,
    rests: Vec<NodeValues>,
    width: usize,
    end_time: f64,
    final_state: Vec<f64>,
    /// How the run ended.
    pub outcome: Outcome,
}

impl Trajectory {
    /// Integrates `system` from `initial` (length 2N + 1) to `t_end` under its own force law.
    ///
    /// # Errors
    /// [`IntegrationError`] as [`Collocation::advance`].
    pub fn compute(
        system: &ReducedSystem,
        initial: &[f64],
        t_end: f64,
        settings: Settings,
    ) -> Result<Self, IntegrationError> {
        let mut integrator = Collocation::new(system, initial, settings)?;
        let mut recorder = Self::recorder(&integrator);
        loop {
            let outcome = integrator.advance(t_end, usize::MAX, &mut |step| recorder.record(step))?;
            if let Some(outcome) = outcome {
                recorder.finish(&integrator, outcome);
                return Ok(recorder);
            }
        }
    }

    /// An empty trajectory that [`Self::record`] fills from the run of `integrator`.
    pub fn recorder(integrator: &Collocation) -> Self {
        let propagator = integrator.propagator().clone();
        Self {
            width: propagator.part().extended_dimension(),
            propagator,
            times: Vec::new(),
            states: Vec::new(),
            rests: Vec::new(),
            end_time: integrator.time(),
            final_state: integrator.state().to_vec(),
            outcome: Outcome::Completed,
        }
    }

    /// Appends a step.
    pub fn record(&mut self, step: &Step<'_>) {
        self.times.push(step.time);
        self.states.extend_from_slice(step.start);
        self.rests.push(*step.rest);
        self.end_time = step.time + step.tables.step;
    }

    /// Closes the record of `integrator`'s run with its `outcome`.
    pub fn finish(&mut self, integrator: &Collocation, outcome: Outcome) {
        self.outcome = outcome;
        self.final_state = integrator.state().to_vec();
        self.end_time = integrator.time();
    }

    /// The linear part's flow over the longest step and its fractions.
    pub fn propagator(&self) -> &Propagator {
        &self.propagator
    }

    /// Time at which the record ends (dimensionless).
    pub fn end_time(&self) -> f64 {
        self.end_time
    }

    /// State at [`Self::end_time`], length 2N + 1.
    pub fn final_state(&self) -> &[f64] {
        &self.final_state
    }

    /// Number of steps recorded.
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Whether no step is recorded.
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// The state (length 2N + 1) at `time`, which is clamped to the record.
    pub fn state_at(&self, time: f64) -> Vec<f64> {
        let mut cursor = Cursor::default();
        let mut out = vec![0.0; self.propagator.part().dimension()];
        self.read(time, &mut cursor, &mut out);
        out
    }

    /// Calls `read` with time and state (length 2N + 1) at `count` >= 2 equally spaced times from `from` to `to`.
    pub fn sample(&self, from: f64, to: f64, count: usize, read: impl FnMut(f64, &[f64])) {
        let spacing = (to - from) / (count.max(2) - 1) as f64;
        self.read_each((0..count).map(|i| from + spacing * i as f64), read);
    }

    /// Calls `read` with time and state (length 2N + 1) at each of the ascending `times`.
    pub fn read_at(&self, times: &[f64], read: impl FnMut(f64, &[f64])) {
        self.read_each(times.iter().copied(), read);
    }

    fn read_each(&self, times: impl Iterator<Item = f64>, mut read: impl FnMut(f64, &[f64])) {
        let mut cursor = Cursor::default();
        let mut out = vec![0.0; self.propagator.part().dimension()];
        for time in times {
            self.read(time, &mut cursor, &mut out);
            read(time, &out);
        }
    }

    fn read(&self, time: f64, cursor: &mut Cursor, out: &mut [f64]) {
        let dimension = self.propagator.part().dimension();
        if self.is_empty() || time >= self.end_time {
            out.copy_from_slice(&self.final_state);
            return;
        }
        let step = self.times.partition_point(|start| *start <= time).saturating_sub(1);
        let start = self.times[step];
        let next = self.times.get(step + 1).copied().unwrap_or(self.end_time);
        let length = next - start;
        let offset = (time - start).clamp(0.0, length);
        // Going on from the last sample of the same step is cheaper than from its start.
        if cursor.step != Some(step) || cursor.offset > offset {
            cursor.step = Some(step);
            cursor.rest = StepRest::new(&self.rests[step], length);
            cursor.offset = 0.0;
            cursor.state.clear();
            cursor.state.extend_from_slice(&self.states[step * self.width..(step + 1) * self.width]);
        }
        if offset > cursor.offset {
            let Cursor { state, rest, workspace, .. } = cursor;
            self.propagator.carry(state, cursor.offset, offset, rest, workspace);
            cursor.offset = offset;
        }
        out.copy_from_slice(&cursor.state[..dimension]);
    }
}

/// Where a sequence of reads stands.
#[derive(Default)]
struct Cursor {
    step: Option<usize>,
    offset: f64,
    rest: StepRest,
    state: Vec<f64>,
    workspace: Workspace,
}
