//! The motion that goes on while its numbers change.

use std::f64::consts::TAU;
use std::sync::Arc;

use crate::app::bench::shaking::first;
use crate::dynamics::{IntegrationError, Ongoing, Reach};
use crate::model::ReducedSystem;
use crate::model::base_motion::Signal;
use crate::scenario::fit_state;

/// Steps between looks at the clock.
const STEPS: usize = 64;

/// What shakes the base.
#[derive(Debug, Clone)]
pub(super) enum Drive {
    /// The sine of the system.
    Sine,
    /// A signal (dimensionless) from this sample on; it begins anew where it ends.
    Signal(Arc<Signal>, usize),
}

/// A motion by its state and by the periods done, `turns`, which are counted on when the frequency changes: the excitation's
/// phase is 2 pi `turns`. Where no sine shakes the base, periods are those of the first natural frequency.
pub(super) struct LiveRun {
    system: ReducedSystem,
    drive: Drive,
    motion: Ongoing,
    /// Turns and time (dimensionless) at which the present motion began.
    begun: (f64, f64),
    turns: f64,
    state: Vec<f64>,
}

/// What a run shows at an instant: v (V), dv/dt (V), tip displacement s (beam lengths), ds/dt; time is dimensionless.
pub(super) type Reading = [f64; 4];

/// The period (dimensionless) by which a run counts.
fn period(system: &ReducedSystem, drive: &Drive) -> f64 {
    match drive {
        Drive::Sine => system.parameters.period(),
        Drive::Signal(..) => TAU / first(system),
    }
}

impl LiveRun {
    /// A motion of `system` from `state` (length 2N + 1) after so many turns, at that time.
    ///
    /// # Errors
    /// [`IntegrationError`] when `state` is none of this system.
    pub(super) fn begin(
        system: ReducedSystem,
        drive: Drive,
        state: Vec<f64>,
        turns: f64,
        time: f64,
    ) -> Result<Self, IntegrationError> {
        let motion = match &drive {
            Drive::Sine => Ongoing::new(&system, &state, TAU * turns.fract())?,
            Drive::Signal(signal, first) => Ongoing::under(&system, (signal.clone(), *first), &state)?,
        };
        Ok(Self { system, drive, motion, begun: (turns, time), turns, state })
    }

    /// The period (dimensionless) by which it counts.
    pub(super) fn period(&self) -> f64 {
        period(&self.system, &self.drive)
    }

    /// The signal that shakes it, and the time (dimensionless) reached in it.
    pub(super) fn signal(&self) -> Option<(&Arc<Signal>, f64)> {
        let Drive::Signal(signal, first) = &self.drive else { return None };
        let since = (self.turns - self.begun.0) * self.period();
        Some((signal, *first as f64 * signal.interval() + since))
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
        self.begun.1 + (self.turns - self.begun.0) * self.period()
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
        loop {
            let time = (turns - self.begun.0) * self.period();
            let end = match &self.drive {
                Drive::Sine => f64::INFINITY,
                Drive::Signal(signal, first) => signal.duration() - *first as f64 * signal.interval(),
            };
            let reach = self.motion.read(time.min(end), STEPS, &mut self.state)?;
            if reach != Reach::There {
                let since = self.begun.1;
                return Ok(match reach {
                    Reach::Ended(outcome) => Reach::Ended(outcome.retimed(|time| since + time)),
                    other => other,
                });
            }
            if time <= end {
                self.turns = turns;
                return Ok(Reach::There);
            }
            self.turns = self.begun.0 + end / self.period();
            self.again(0)?;
        }
    }

    /// Begins another motion where this one stands, at a sample of its signal.
    fn again(&mut self, sample: usize) -> Result<(), IntegrationError> {
        let Drive::Signal(signal, _) = &self.drive else { return Ok(()) };
        let drive = Drive::Signal(signal.clone(), sample);
        *self = Self::begin(self.system.clone(), drive, self.state.clone(), self.turns, self.time())?;
        Ok(())
    }

    /// What drives a motion that begins where this one stands: under a signal it goes on to the next sample first, as only
    /// there a motion begins.
    fn driven_on(&mut self) -> Result<Drive, IntegrationError> {
        let Some((signal, place)) = self.signal() else { return Ok(Drive::Sine) };
        let (signal, interval) = (signal.clone(), signal.interval());
        let next = (place / interval - 1e-6).ceil().max(0.0);
        let turns = self.turns + ((next * interval - place) / self.period()).max(0.0);
        while self.go_to(turns)? == Reach::Later {}
        let next = next as usize;
        Ok(Drive::Signal(signal.clone(), if next + 1 < signal.samples().len() { next } else { 0 }))
    }

    /// Goes on as `system` from the present state and phase, under another signal where there is one. Modes that it has not lose
    /// their part of the motion, new ones begin at rest.
    ///
    /// # Errors
    /// As [`Self::begin`]; nothing is changed then.
    pub(super) fn adopt(
        &mut self,
        system: ReducedSystem,
        other: Option<Arc<Signal>>,
    ) -> Result<(), IntegrationError> {
        let drive = match (self.driven_on()?, other) {
            // A signal that only differs in its level goes on where it was.
            (Drive::Signal(signal, at), Some(other)) if other.samples().len() == signal.samples().len() => {
                Drive::Signal(other, at)
            }
            (_, Some(other)) => Drive::Signal(other, 0),
            (drive, None) => drive,
        };
        let state = fit_state(&self.state, system.modes.len());
        *self = Self::begin(system, drive, state, self.turns, self.time())?;
        Ok(())
    }

    /// Adds `velocity` (beam lengths per dimensionless time) to mode 1, and so to the tip.
    ///
    /// # Errors
    /// As [`Self::begin`]; nothing is changed then.
    pub(super) fn kick(&mut self, velocity: f64) -> Result<(), IntegrationError> {
        let drive = self.driven_on()?;
        let mut state = self.state.clone();
        state[self.system.modes.len()] += velocity;
        *self = Self::begin(self.system.clone(), drive, state, self.turns, self.time())?;
        Ok(())
    }
}
