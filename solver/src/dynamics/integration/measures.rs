//! The numbers of a motion, and the one observer that reads them step by step.

use serde::{Deserialize, Serialize};

use super::extremes::{Highest, Scalar};
use super::propagator::Propagator;
use super::rule::{NODES, NodeValues};
use super::step::Step;
use crate::model::Demand;
use crate::model::quadrature::gauss_legendre;

/// Means and extremes of a motion, dimensionless unless a holder says that they count in SI units.
#[derive(
    Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin,
)]
pub struct Measures {
    /// Root mean square of the voltage (V).
    pub v_rms: f64,
    /// Largest |v| (V).
    pub v_peak: f64,
    /// Mean electrical power kappa v^2 in the load (dimensionless; in SI units W).
    pub power: f64,
    /// Lowest tip displacement from equilibrium, towards the fixed magnet, and highest one, in beam lengths (in SI units
    /// mm).
    pub tip: (f64, f64),
    /// Largest |slope| at the tip from equilibrium (rad).
    pub slope: f64,
}

impl Measures {
    /// With a mean square of the voltage (V^2) in a circuit of conductance `kappa`.
    #[must_use]
    pub fn with_mean_square(self, square: f64, kappa: f64) -> Self {
        Self { v_rms: square.sqrt(), power: kappa * square, ..self }
    }

    /// What the motion asks of the device.
    pub fn demand(&self) -> Demand {
        Demand { v_peak: self.v_peak, tip: self.tip, slope: Some(self.slope) }
    }
}

/// Reads a motion step by step.
#[derive(Debug, Clone)]
pub(in crate::dynamics) struct Observer {
    weights: Vec<f64>,
    /// Integral of v^2, and of 1.
    square: f64,
    duration: f64,
    /// Of each scalar and of its negative.
    voltage: [Highest; 2],
    tip: [Highest; 2],
    slope: [Highest; 2],
    /// From the first step.
    propagator: Option<Propagator>,
}

impl Default for Observer {
    fn default() -> Self {
        Self {
            weights: gauss_legendre(NODES).1,
            square: 0.0,
            duration: 0.0,
            voltage: Highest::both(Scalar::Voltage),
            tip: Highest::both(Scalar::Tip),
            slope: Highest::both(Scalar::TipSlope),
            propagator: None,
        }
    }
}

impl Observer {
    /// Takes a step into account that lasts so long, in any unit; returns the mean of v^2 in it (V^2).
    pub(in crate::dynamics) fn record(&mut self, step: &Step<'_>, length: f64) -> f64 {
        self.see(step, &step.tables.voltage.at_nodes(step.start, step.rest), length)
    }

    /// The same of a step at whose nodes the voltages are known.
    pub(in crate::dynamics) fn see(&mut self, step: &Step<'_>, voltage: &NodeValues, length: f64) -> f64 {
        let slope = step.tables.tip_slope.at_nodes(step.start, step.rest);
        for (both, values) in
            [(&mut self.voltage, voltage), (&mut self.tip, step.tip), (&mut self.slope, &slope)]
        {
            both.iter_mut().for_each(|highest| highest.see(step, values));
        }
        self.propagator.get_or_insert_with(|| step.propagator.clone());
        // The nodes are Gauss nodes, so the mean square comes with their weights.
        let mean = self.weights.iter().zip(voltage).map(|(w, v)| w * v * v).sum::<f64>();
        self.square += mean * length;
        self.duration += length;
        mean
    }

    /// What was seen so far of a motion in a circuit of conductance `kappa`; `None` before the first step.
    pub(in crate::dynamics) fn measures(&self, kappa: f64) -> Option<Measures> {
        let propagator = self.propagator.as_ref()?;
        let largest = |both| Highest::larger(both, propagator);
        let [high, low] = self.tip.each_ref().map(|highest| highest.value(propagator));
        let (v_peak, slope) = (largest(&self.voltage), largest(&self.slope));
        let extremes = Measures { v_peak, tip: (-low, high), slope, ..Measures::default() };
        Some(extremes.with_mean_square(self.square / self.duration, kappa))
    }
}
