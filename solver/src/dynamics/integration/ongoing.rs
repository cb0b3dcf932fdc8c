//! A motion that goes on without an end and is read at ever later times.
//!
//! The integrator is [`Collocation`]; kept of it is the present step alone, within which the motion is read as a
//! [`Trajectory`](super::Trajectory) reads it. When a number changes, another motion begins where this one was read
//! last, at the phase that the excitation had there.

use std::sync::Arc;

use super::collocation::{Collocation, Settings};
use super::outcome::{IntegrationError, Outcome};
use super::propagator::{StepRest, Workspace};
use super::step::Step;
use crate::model::ReducedSystem;
use crate::model::base_motion::Signal;

/// A motion with dense output of its present step.
#[derive(Debug)]
pub struct Ongoing {
    integrator: Collocation,
    present: Present,
    /// How the motion ended.
    outcome: Option<Outcome>,
}

/// Whether a motion was read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reach {
    /// The state at the time asked for.
    There,
    /// Not yet: the steps allowed were not enough.
    Later,
    /// It ended before.
    Ended(Outcome),
}

/// The present step, and how far into it the motion was read.
#[derive(Default)]
struct Present {
    from: f64,
    length: f64,
    /// Extended state at the start, and at `offset` after it.
    start: Vec<f64>,
    state: Vec<f64>,
    offset: f64,
    rest: StepRest,
    workspace: Workspace,
}

impl std::fmt::Debug for Present {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Present").field("from", &self.from).field("length", &self.length).finish()
    }
}

impl Present {
    fn take(&mut self, step: &Step<'_>) {
        (self.from, self.length, self.offset) = (step.time, step.tables.step, 0.0);
        self.rest = StepRest::new(step.rest, step.tables.step);
        self.start.clear();
        self.start.extend_from_slice(step.start);
        self.state.clone_from(&self.start);
    }
}

impl Ongoing {
    /// The motion of `system` from `state` (length 2N + 1) at time 0, where the excitation has `phase` (radians).
    ///
    /// # Errors
    /// [`IntegrationError::InitialState`] as [`Collocation::new`].
    pub fn new(system: &ReducedSystem, state: &[f64], phase: f64) -> Result<Self, IntegrationError> {
        let integrator = Collocation::from_phase(system, state, phase, Settings::default())?;
        Ok(Self { integrator, present: Present::default(), outcome: None })
    }

    /// The motion of `system` from `state` (length 2N + 1) at time 0 under `signal` (dimensionless) from its sample `first` on. It
    /// must not be read beyond the signal's end.
    ///
    /// # Errors
    /// As [`Collocation::under`].
    pub fn under(
        system: &ReducedSystem,
        signal: (Arc<Signal>, usize),
        state: &[f64],
    ) -> Result<Self, IntegrationError> {
        let integrator = Collocation::under(system, signal, state, Settings::default())?;
        Ok(Self { integrator, present: Present::default(), outcome: None })
    }

    /// Goes on for at most `most_steps` steps and reads the state (length 2N + 1) at `time` (dimensionless) into `out`,
    /// once it is there. Times must not descend below the step that was read last.
    ///
    /// # Errors
    /// [`IntegrationError`] as [`Collocation::advance`].
    pub fn read(&mut self, time: f64, most_steps: usize, out: &mut [f64]) -> Result<Reach, IntegrationError> {
        for _ in 0..most_steps {
            if self.outcome.is_some() || self.integrator.time() >= time && !self.present.start.is_empty() {
                break;
            }
            let present = &mut self.present;
            self.outcome = self.integrator.advance(f64::INFINITY, 1, &mut |step| present.take(step))?;
        }
        if self.integrator.time() < time || self.present.start.is_empty() {
            return Ok(self.outcome.map_or(Reach::Later, Reach::Ended));
        }
        let present = &mut self.present;
        let offset = (time - present.from).clamp(0.0, present.length);
        if offset < present.offset {
            present.state.clone_from(&present.start);
            present.offset = 0.0;
        }
        if offset > present.offset {
            let Present { state, rest, workspace, .. } = present;
            self.integrator.propagator().carry(state, present.offset, offset, rest, workspace);
            present.offset = offset;
        }
        out.copy_from_slice(&present.state[..out.len()]);
        Ok(Reach::There)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::dynamics::integration::trajectory::Trajectory;
    use crate::model::{ForceLaw, ParameterSet, Parameters};

    fn system(set: ParameterSet, law: ForceLaw) -> ReducedSystem {
        Parameters::new(set).and_then(|p| ReducedSystem::new(p, 2, law)).expect("a valid device")
    }

    fn figure_9() -> ParameterSet {
        ParameterSet { alpha: 1e-4, beta: 1e-2, omega: 8.0969, ..Default::default() }
    }

    fn read(motion: &mut Ongoing, time: f64) -> [f64; 5] {
        let mut state = [0.0; 5];
        assert_eq!(motion.read(time, usize::MAX, &mut state), Ok(Reach::There), "{time}");
        state
    }

    fn differ(a: &[f64], b: &[f64]) -> f64 {
        // Volts are larger than displacements by two orders.
        a.iter().zip(b).map(|(a, b)| (a - b).abs() / (0.01 + a.abs())).fold(0.0, f64::max)
    }

    #[test]
    fn it_is_the_trajectory_at_the_same_times() {
        for law in [ForceLaw::Quadratic, ForceLaw::Exact] {
            let system = system(figure_9(), law);
            let whole = Trajectory::compute(&system, &[0.0; 5], 60.0, Settings::default()).expect("a run");
            let mut motion = Ongoing::new(&system, &[0.0; 5], 0.0).expect("from rest");
            for k in 0..6000 {
                let time = 0.00997 * k as f64;
                let error = differ(&whole.state_at(time), &read(&mut motion, time));
                assert!(error < 1e-11, "{law:?} at {time}: {error}");
            }
        }
    }

    #[test]
    fn a_motion_taken_up_at_any_phase_is_the_same_motion() {
        let system = system(figure_9(), ForceLaw::Exact);
        let mut whole = Ongoing::new(&system, &[0.0; 5], 0.0).expect("from rest");
        let mut part = Ongoing::new(&system, &[0.0; 5], 0.0).expect("from rest");
        let mut begun = 0.0;
        // Fifty changes of hands at odd times; each may cost what dense output within a step is off by.
        for k in 1..=50 {
            let time = 0.3137 * k as f64;
            let state = read(&mut part, time - begun);
            part = Ongoing::new(&system, &state, TAU * (time / system.parameters.period()).fract())
                .expect("a state of a motion");
            begun = time;
            let error = differ(&read(&mut whole, time), &read(&mut part, 0.0));
            assert!(error < 1e-4, "at {time}: {error}");
        }
    }

    #[test]
    fn an_escape_is_an_end() {
        // Figure 12 leaves over the quadratic law's barrier.
        let set = ParameterSet { alpha: 1e-4, beta: 1e-2, omega: 42.7125, ..Default::default() };
        let mut motion = Ongoing::new(&system(set, ForceLaw::Quadratic), &[0.0; 5], 0.0).expect("from rest");
        let mut state = [0.0; 5];
        let reach = motion.read(100.0, usize::MAX, &mut state).expect("an outcome is no error");
        assert!(matches!(reach, Reach::Ended(Outcome::Escaped { time }) if time < 10.0), "{reach:?}");
        assert_eq!(motion.read(101.0, 10, &mut state), Ok(reach));
    }

    #[test]
    fn a_read_that_needs_more_steps_than_allowed_goes_on_later() {
        let mut motion =
            Ongoing::new(&system(figure_9(), ForceLaw::Quadratic), &[0.0; 5], 0.0).expect("rest");
        let mut state = [0.0; 5];
        assert_eq!(motion.read(5.0, 3, &mut state), Ok(Reach::Later));
        let later = read(&mut motion, 5.0);
        let mut at_once =
            Ongoing::new(&system(figure_9(), ForceLaw::Quadratic), &[0.0; 5], 0.0).expect("rest");
        assert_eq!(later, read(&mut at_once, 5.0));
    }
}
