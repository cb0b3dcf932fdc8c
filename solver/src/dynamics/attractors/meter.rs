//! Means of a motion over whole excitation periods, with steps of any length, and its extremes. Means are weighted
//! Birkhoff averages, so that on a torus they converge faster than any power of the record.

use super::rotation::weighted_average;
use crate::dynamics::integration::{NODES, Step};
use crate::dynamics::orbits::Measures;
use crate::dynamics::orbits::orbit::Observer;
use crate::model::quadrature::gauss_legendre;

/// Collects them from the first stroboscopic instant on.
pub(super) struct Meter {
    weights: Vec<f64>,
    observer: Observer,
    /// Integral of v^2 over the present period, and its part that is done.
    square: f64,
    duration: f64,
    /// Mean square of the voltage in each period done (V^2).
    squares: Vec<f64>,
    begun: bool,
}

impl Default for Meter {
    fn default() -> Self {
        Self {
            weights: gauss_legendre(NODES).1,
            observer: Observer::default(),
            square: 0.0,
            duration: 0.0,
            squares: Vec::new(),
            begun: false,
        }
    }
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
        self.observer.record(step);
        let voltage = step.tables.voltage.at_nodes(step.start, step.rest);
        let mean: f64 = self.weights.iter().zip(&voltage).map(|(w, v)| w * v * v).sum();
        self.square += mean * step.tables.step;
        self.duration += step.tables.step;
    }

    pub(super) fn measures(&self, kappa: f64) -> Option<Measures> {
        let mean = weighted_average(&self.squares);
        (!self.squares.is_empty()).then(|| Measures {
            v_rms: mean.sqrt(),
            power: kappa * mean,
            ..self.observer.measures(kappa)
        })
    }

    /// Mean square of the voltage in each whole period so far (V^2).
    pub(super) fn squares(&self) -> &[f64] {
        &self.squares
    }
}
