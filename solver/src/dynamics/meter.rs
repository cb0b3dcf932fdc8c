//! Means of a motion over whole excitation periods, with steps of any length, and the tip's extremes.

use super::collocation::Step;
use super::orbit::{Measures, Observer};
use super::tables::NODES;
use crate::model::quadrature::gauss_legendre;

/// Collects them from the first stroboscopic instant on.
pub(super) struct Meter {
    weights: Vec<f64>,
    observer: Observer,
    square: f64,
    duration: f64,
    /// Square and duration at the last stroboscopic instant.
    whole: (f64, f64),
    begun: bool,
}

impl Default for Meter {
    fn default() -> Self {
        Self {
            weights: gauss_legendre(NODES).1,
            observer: Observer::default(),
            square: 0.0,
            duration: 0.0,
            whole: (0.0, 0.0),
            begun: false,
        }
    }
}

impl Meter {
    pub(super) fn record(&mut self, step: &Step<'_>) {
        if step.index == 0 {
            self.whole = (self.square, self.duration);
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
        let (square, duration) = self.whole;
        let mean = square / duration;
        (duration > 0.0).then(|| Measures {
            v_rms: mean.sqrt(),
            power: kappa * mean,
            ..self.observer.measures(kappa)
        })
    }
}
