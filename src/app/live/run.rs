//! The motion that goes on while its numbers change.

use std::f64::consts::TAU;

use crate::dynamics::{IntegrationError, Ongoing, Outcome, Reach};
use crate::model::ReducedSystem;
use crate::scenario::fit_state;

/// Steps between looks at the clock.
const STEPS: usize = 64;

/// A motion by its state and by the excitation periods done, `turns`, which are counted on when the frequency changes: the
/// excitation's phase is 2 pi `turns`.
pub(super) struct LiveRun {
    system: ReducedSystem,
    motion: Ongoing,
    /// Turns and time (dimensionless) at which the present motion began.
    begun: (f64, f64),
    turns: f64,
    state: Vec<f64>,
}

/// What a run shows at an instant: v (V), dv/dt (V), tip displacement s (beam lengths), ds/dt; time is dimensionless.
pub(super) type Reading = [f64; 4];

impl LiveRun {
    /// A motion of `system` from `state` (length 2N + 1) after so many turns, at that time.
    ///
    /// # Errors
    /// [`IntegrationError`] when `state` is none of this system.
    pub(super) fn begin(
        system: ReducedSystem,
        state: Vec<f64>,
        turns: f64,
        time: f64,
    ) -> Result<Self, IntegrationError> {
        let motion = Ongoing::new(&system, &state, TAU * turns.fract())?;
        Ok(Self { system, motion, begun: (turns, time), turns, state })
    }

    pub(super) fn system(&self) -> &ReducedSystem {
        &self.system
    }

    /// Excitation periods done.
    pub(super) fn turns(&self) -> f64 {
        self.turns
    }

    /// Time since the start (dimensionless).
    pub(super) fn time(&self) -> f64 {
        self.begun.1 + (self.turns - self.begun.0) * self.system.parameters.period()
    }

    /// Present state, length 2N + 1.
    pub(super) fn state(&self) -> &[f64] {
        &self.state
    }

    /// What it shows now.
    pub(super) fn reading(&self) -> Reading {
        let (system, state) = (&self.system, &self.state[..]);
        [
            state[state.len() - 1],
            system.voltage_rate(state),
            system.tip_displacement(state),
            system.tip_velocity(state),
        ]
    }

    /// Goes on to `turns`, which must not be before the present ones, or a part of the way.
    ///
    /// # Errors
    /// [`IntegrationError`] when the motion cannot be resolved.
    pub(super) fn go_to(&mut self, turns: f64) -> Result<Reach, IntegrationError> {
        let time = (turns - self.begun.0) * self.system.parameters.period();
        let reach = self.motion.read(time, STEPS, &mut self.state)?;
        if reach == Reach::There {
            self.turns = turns;
        }
        let since = self.begun.1;
        Ok(match reach {
            Reach::Ended(Outcome::Escaped { time }) => Reach::Ended(Outcome::Escaped { time: since + time }),
            Reach::Ended(Outcome::Contact { time }) => Reach::Ended(Outcome::Contact { time: since + time }),
            other => other,
        })
    }

    /// Goes on as `system` from the present state and phase. Modes that it has not lose their part of the motion, new ones
    /// begin at rest.
    ///
    /// # Errors
    /// As [`Self::begin`]; nothing is changed then.
    pub(super) fn adopt(&mut self, system: ReducedSystem) -> Result<(), IntegrationError> {
        let state = fit_state(&self.state, system.modes.len());
        *self = Self::begin(system, state, self.turns, self.time())?;
        Ok(())
    }

    /// Adds `velocity` (beam lengths per dimensionless time) to mode 1, and so to the tip.
    ///
    /// # Errors
    /// As [`Self::begin`]; nothing is changed then.
    pub(super) fn kick(&mut self, velocity: f64) -> Result<(), IntegrationError> {
        let mut state = self.state.clone();
        state[self.system.modes.len()] += velocity;
        *self = Self::begin(self.system.clone(), state, self.turns, self.time())?;
        Ok(())
    }
}
