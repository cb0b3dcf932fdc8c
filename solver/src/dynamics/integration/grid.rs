//! Where steps begin and end: at fractions of the excitation period, halved and doubled, so that stroboscopic instants
//! stay grid points.

use std::f64::consts::TAU;

use crate::model::ReducedSystem;
use crate::model::base_motion::Signal;

/// Most grid points of a period of which something is kept.
const MOST_KEPT: usize = 1024;
/// Periods for which a step that was too long at a place is not tried there again: motions that repeat ask for the same.
const PATIENCE: u64 = 16;

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
    /// What is known of the grid points of each level.
    known: Vec<Vec<Known>>,
}

/// What is known of a grid point.
#[derive(Debug, Clone, Copy, Default)]
struct Known {
    /// Sine and cosine of the excitation's angle.
    angle: Option<(f64, f64)>,
    /// The period in which a step of this level was last too long here.
    refused: Option<u64>,
}

impl Grid {
    /// Time 0 of `system`, where the excitation has this `phase` (radians).
    pub(super) fn new(system: &ReducedSystem, phase: f64) -> Self {
        Self::of(system.parameters.period(), phase, coarsest_steps(system))
    }

    /// Time 0 of `system` under a signal: its intervals take the place of periods, so that every sample is a grid point.
    pub(super) fn under(system: &ReducedSystem, signal: &Signal) -> Self {
        Self::of(signal.interval(), 0.0, steps_within(signal.interval(), followed(system)))
    }

    fn of(period: f64, phase: f64, coarsest: usize) -> Self {
        Self { period, phase, coarsest, level: 0, periods: 0, index: 0, overtime: 0.0, known: Vec::new() }
    }

    /// Goes back to time 0 with another `phase` (radians) of the excitation there; steps are as long as the last.
    pub(super) fn begin_at(&mut self, phase: f64) {
        (self.phase, self.periods, self.index, self.overtime) = (phase, 0, 0, 0.0);
        self.known.clear();
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

    /// Whole periods done, and which part of the present one.
    pub(super) fn place(&self) -> (usize, f64) {
        (self.periods as usize, self.index as f64 / self.steps_per_period() as f64)
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

    /// Sine and cosine of the excitation's angle, from the grid rather than from the last step, so that it cannot drift.
    pub(super) fn sine_and_cosine(&mut self) -> (f64, f64) {
        let count = self.steps_per_period();
        let angle = self.phase + TAU * self.index as f64 / count as f64;
        let (level, index) = (self.level, self.index);
        match self.known(level, index) {
            Some(known) => *known.angle.get_or_insert_with(|| angle.sin_cos()),
            None => angle.sin_cos(),
        }
    }

    /// What is known of point `index` of a level; `None` where nothing is kept.
    fn known(&mut self, level: usize, index: usize) -> Option<&mut Known> {
        let count = self.coarsest << level;
        if count > MOST_KEPT {
            return None;
        }
        if self.known.len() <= level {
            self.known.resize(level + 1, Vec::new());
        }
        let points = &mut self.known[level];
        if points.is_empty() {
            points.resize(count, Known::default());
        }
        points.get_mut(index)
    }

    /// Goes to the end of a shortened last step, between grid points.
    pub(super) fn leave(&mut self, length: f64) {
        self.overtime = length;
    }

    /// Halves the step, and says whether it could: not the shortest.
    pub(super) fn halve(&mut self) -> bool {
        let (level, index, period) = (self.level, self.index, self.periods);
        if let Some(known) = self.known(level, index) {
            known.refused = Some(period);
        }
        let halves = self.level < DEEPEST_LEVEL;
        if halves {
            self.level += 1;
            self.index *= 2;
        }
        halves
    }

    /// Doubles the step where the grid allows it and that was not too long lately.
    pub(super) fn double(&mut self) {
        if self.level == 0 || !self.index.is_multiple_of(2) {
            return;
        }
        let (level, index, period) = (self.level - 1, self.index / 2, self.periods);
        let refused = self.known(level, index).and_then(|known| known.refused);
        if refused.is_none_or(|refused| period - refused > PATIENCE) {
            (self.level, self.index) = (level, index);
        }
    }
}

/// Steps a period at level 0: one step for about two thirds of a vibration of the faster of the excitation's
/// second harmonic and the second mode, which R follows.
pub(in crate::dynamics) fn coarsest_steps(system: &ReducedSystem) -> usize {
    let fastest = (2.0 * system.parameters.omega).max(followed(system));
    steps_within(system.parameters.period(), fastest)
}

/// Frequency of the fastest mode whose vibration R follows.
fn followed(system: &ReducedSystem) -> f64 {
    let modes = &system.modes;
    modes[modes.len().min(2) - 1].omega
}

/// Steps of a duration in which nothing followed is faster than `fastest`.
fn steps_within(duration: f64, fastest: f64) -> usize {
    ((fastest * duration / 4.0).ceil() as usize).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ModelError, ParameterSet, Parameters, ReducedSystem};

    fn grid() -> Result<Grid, ModelError> {
        let parameters = Parameters::new(ParameterSet { omega: 8.0969, ..Default::default() })?;
        Ok(Grid::new(&ReducedSystem::new(parameters, 2, Default::default())?, 0.3))
    }

    #[test]
    fn kept_sines_are_those_of_the_angle() -> Result<(), ModelError> {
        let mut grid = grid()?;
        grid.halve();
        for place in 0..5 * grid.steps_per_period() {
            let angle = 0.3 + TAU * grid.index() as f64 / grid.steps_per_period() as f64;
            assert_eq!(grid.sine_and_cosine(), angle.sin_cos(), "{place}");
            grid.go_on();
        }
        Ok(())
    }

    #[test]
    fn a_step_that_was_too_long_is_left_alone_at_its_place_for_a_while() -> Result<(), ModelError> {
        let mut grid = grid()?;
        grid.halve();
        let steps = grid.steps_per_period();
        for period in 0..=PATIENCE {
            grid.double();
            assert_eq!((grid.level(), grid.index()), (1, 0), "{period}");
            let mut elsewhere = grid.clone();
            elsewhere.go_on();
            elsewhere.go_on();
            elsewhere.double();
            assert_eq!((elsewhere.level(), elsewhere.index()), (0, 1), "{period}");
            for _ in 0..steps {
                grid.go_on();
            }
        }
        grid.double();
        assert_eq!(grid.level(), 0);
        grid.halve();
        Ok(())
    }
}
