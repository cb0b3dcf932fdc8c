//! Means of a motion over whole excitation periods, with steps of any length, and its extremes. Means are weighted
//! Birkhoff averages, so that on a torus they converge faster than any power of the record.

use super::rotation::weighted_average;
use crate::dynamics::integration::measures::Observer;
use crate::dynamics::integration::{Measures, Step};

/// Collects them from the first stroboscopic instant on.
#[derive(Default)]
pub(super) struct Meter {
    observer: Observer,
    /// Integral of v^2 over the present period, and its part that is done.
    square: f64,
    duration: f64,
    /// Mean square of the voltage in each period done (V^2).
    squares: Vec<f64>,
    begun: bool,
}

impl Meter {
    pub(super) fn record(&mut self, step: &Step<'_>) {
        if step.index == 0 {
            if self.begun {
                self.squares.push(self.square / self.duration);
            }
            (self.square, self.duration) = (0.0, 0.0);
            self.begun = true;
        }
        if !self.begun {
            return;
        }
        self.square += self.observer.record(step, step.tables.step) * step.tables.step;
        self.duration += step.tables.step;
    }

    pub(super) fn measures(&self, kappa: f64) -> Option<Measures> {
        let seen = self.observer.measures(kappa).filter(|_| !self.squares.is_empty())?;
        Some(seen.with_mean_square(weighted_average(&self.squares), kappa))
    }

    /// Mean square of the voltage in each whole period so far (V^2).
    pub(super) fn squares(&self) -> &[f64] {
        &self.squares
    }
}
