//! Numbers read off a run while it is computed: amplitudes and means of its end, and the voltage's envelope.

use serde::Serialize;

use super::extremes::{Highest, Scalar};
use super::propagator::Propagator;
use super::rule::NODES;
use super::step::Step;
use crate::model::quadrature::gauss_legendre;

/// Amplitudes and means over the last part of a run, the window.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Summary {
    /// Start of the window (dimensionless time).
    pub from: f64,
    /// End of the window (dimensionless time).
    pub to: f64,
    /// Root mean square of the voltage (V).
    pub v_rms: f64,
    /// Largest |v| (V).
    pub v_peak: f64,
    /// Largest |dv/dt| (V per dimensionless time).
    pub dv_dt_peak: f64,
    /// Lowest tip displacement from equilibrium, towards the fixed magnet, in beam lengths.
    pub tip_min: f64,
    /// Highest tip displacement, in beam lengths.
    pub tip_max: f64,
    /// Largest |slope| at the tip from equilibrium (rad).
    pub slope: f64,
    /// Largest |v| of the whole run (V); before the window it is read at the nodes of the steps, which may miss some
    /// per cent of a lonely peak.
    pub v_peak_whole: f64,
}

/// Lowest and highest voltage in equal slices of the run.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Envelope {
    /// Width of a slice (dimensionless time).
    pub width: f64,
    /// (lowest, highest) v of each slice begun so far (V); empty slices hold NaN and are not drawn.
    pub slices: Vec<(f64, f64)>,
}

/// Collects [`Summary`] and [`Envelope`] step by step.
#[derive(Debug, Clone)]
pub struct Collector {
    /// Start and end of the window.
    window: (f64, f64),
    weights: Vec<f64>,
    integral: f64,
    duration: f64,
    reached: f64,
    v_peak_whole: f64,
    /// Of v and of -v, of dv/dt and of -dv/dt, of s and of -s, of the slope and of its negative.
    voltage: [Highest; 2],
    rate: [Highest; 2],
    tip: [Highest; 2],
    slope: [Highest; 2],
    envelope: Envelope,
}

impl Collector {
    /// For a run to `t_end` with the given `window` (start and end, whole excitation periods, so that every step is
    /// either inside or outside), with the envelope in `slices` slices.
    pub fn new(window: (f64, f64), t_end: f64, slices: usize) -> Self {
        let both = |scalar| [1.0, -1.0].map(|sign| Highest::new(scalar, sign));
        Self {
            window,
            weights: gauss_legendre(NODES).1,
            integral: 0.0,
            duration: 0.0,
            reached: window.0,
            v_peak_whole: 0.0,
            voltage: both(Scalar::Voltage),
            rate: both(Scalar::VoltageRate),
            tip: both(Scalar::Tip),
            slope: both(Scalar::TipSlope),
            envelope: Envelope { width: t_end / slices as f64, slices: Vec::with_capacity(slices) },
        }
    }

    /// Takes a step into account.
    pub fn record(&mut self, step: &Step<'_>) {
        let voltage = step.tables.voltage.at_nodes(step.start, step.rest);
        let first = step.start[step.start.len() - 3];
        let (low, high) = voltage.iter().fold((first, first), |(low, high), v| (low.min(*v), high.max(*v)));
        self.widen_envelope(step.time, low, high);
        self.v_peak_whole = self.v_peak_whole.max(high.max(-low));
        // The borders are on the grid of steps, up to rounding.
        let length = step.tables.step;
        let inside = self.window.0 - 1e-6 * length..self.window.1 - 1e-6 * length;
        if !inside.contains(&step.time) {
            return;
        }
        let rate = step.tables.voltage_rate.at_nodes(step.start, step.rest);
        let slope = step.tables.tip_slope.at_nodes(step.start, step.rest);
        for (highest, values) in [
            (&mut self.voltage, &voltage),
            (&mut self.rate, &rate),
            (&mut self.tip, step.tip),
            (&mut self.slope, &slope),
        ] {
            for highest in highest {
                highest.see(step, values);
            }
        }
        // The nodes are Gauss nodes, so the mean square comes with their weights.
        let square: f64 = self.weights.iter().zip(&voltage).map(|(w, v)| w * v * v).sum();
        self.integral += square * length;
        self.duration += length;
        self.reached = step.time + length;
    }

    fn widen_envelope(&mut self, time: f64, low: f64, high: f64) {
        let slice = (time / self.envelope.width) as usize;
        let slices = &mut self.envelope.slices;
        if slice >= slices.len() {
            slices.resize(slice + 1, (f64::NAN, f64::NAN));
        }
        // min and max return the number when the other is NaN.
        slices[slice] = (slices[slice].0.min(low), slices[slice].1.max(high));
    }

    /// The numbers so far, where `propagator` is that of the run; `None` before the window was reached.
    pub fn summary(&self, propagator: &Propagator) -> Option<Summary> {
        let largest = |both| Highest::larger(both, propagator);
        (self.duration > 0.0).then(|| {
            let v_peak = largest(&self.voltage);
            Summary {
                from: self.window.0,
                to: self.reached,
                v_rms: (self.integral / self.duration).sqrt(),
                v_peak,
                dv_dt_peak: largest(&self.rate),
                tip_min: -self.tip[1].value(propagator),
                tip_max: self.tip[0].value(propagator),
                slope: largest(&self.slope),
                v_peak_whole: self.v_peak_whole.max(v_peak),
            }
        })
    }

    /// The envelope so far.
    pub fn envelope(&self) -> &Envelope {
        &self.envelope
    }
}
