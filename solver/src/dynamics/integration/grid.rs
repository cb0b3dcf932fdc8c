//! Where steps begin and end: at fractions of the excitation period, halved and doubled, so that stroboscopic instants
//! stay grid points.

use std::f64::consts::TAU;

use crate::model::ReducedSystem;

/// Largest number of halvings of the longest step.
pub(super) const DEEPEST_LEVEL: usize = 20;

/// The present place on the grid.
#[derive(Debug, Clone)]
pub(super) struct Grid {
    period: f64,
    /// Of the excitation at time 0 (radians).
    phase: f64,
    /// Steps a period at level 0.
    coarsest: usize,
    level: usize,
    /// Whole periods done, and steps of the present level done in the current one.
    periods: u64,
    index: usize,
    /// Time since the last grid point, once the run's shortened last step is done.
    overtime: f64,
}

impl Grid {
    /// Time 0 of `system`, where the excitation has this `phase` (radians).
    pub(super) fn new(system: &ReducedSystem, phase: f64) -> Self {
        let (period, coarsest) = (system.parameters.period(), coarsest_steps(system));
        Self { period, phase, coarsest, level: 0, periods: 0, index: 0, overtime: 0.0 }
    }

    /// Present time (dimensionless).
    pub(super) fn time(&self) -> f64 {
        let whole = self.periods as f64 + self.index as f64 / self.steps_per_period() as f64;
        whole * self.period + self.overtime
    }

    /// The excitation's period (dimensionless).
    pub(super) fn period(&self) -> f64 {
        self.period
    }

    /// How often the longest step is halved.
    pub(super) fn level(&self) -> usize {
        self.level
    }

    /// Steps of the present length done in the present period.
    pub(super) fn index(&self) -> usize {
        self.index
    }

    /// Length of the present step (dimensionless).
    pub(super) fn step_length(&self) -> f64 {
        self.period / self.steps_per_period() as f64
    }

    /// Length of the longest one.
    pub(super) fn longest_step(&self) -> f64 {
        self.period / self.coarsest as f64
    }

    /// How many of the longest steps the whole periods done hold.
    pub(super) fn longest_steps_done(&self) -> u64 {
        self.coarsest as u64 * self.periods
    }

    fn steps_per_period(&self) -> usize {
        self.coarsest << self.level
    }

    /// Goes to the end of the present step.
    pub(super) fn go_on(&mut self) {
        self.index += 1;
        if self.index == self.steps_per_period() {
            self.index = 0;
            self.periods += 1;
        }
    }

    /// The excitation's angle (radians), from the grid rather than from the last step, so that it cannot drift.
    pub(super) fn angle(&self) -> f64 {
        self.phase + TAU * self.index as f64 / self.steps_per_period() as f64
    }

    /// Goes to the end of a shortened last step, between grid points.
    pub(super) fn leave(&mut self, length: f64) {
        self.overtime = length;
    }

    /// Halves the step, and says whether it could: not the shortest.
    pub(super) fn halve(&mut self) -> bool {
        let halves = self.level < DEEPEST_LEVEL;
        if halves {
            self.level += 1;
            self.index *= 2;
        }
        halves
    }

    /// Doubles the step where the grid allows it.
    pub(super) fn double(&mut self) {
        if self.level > 0 && self.index.is_multiple_of(2) {
            self.level -= 1;
            self.index /= 2;
        }
    }
}

/// Steps a period at level 0: one step for about two thirds of a vibration of the faster of the excitation's
/// second harmonic and the second mode, which R follows.
pub(in crate::dynamics) fn coarsest_steps(system: &ReducedSystem) -> usize {
    let modes = &system.modes;
    let fastest = (2.0 * system.parameters.omega).max(modes[modes.len().min(2) - 1].omega);
    ((fastest * system.parameters.period() / 4.0).ceil() as usize).max(1)
}
