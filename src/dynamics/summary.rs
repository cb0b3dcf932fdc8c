//! Numbers read off a run while it is computed: amplitudes and means of its end, and the voltage's envelope.

use serde::Serialize;

use super::collocation::Step;
use super::tables::NODES;
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
    /// Largest |v| at the nodes of the steps (V).
    pub v_peak: f64,
    /// Largest |dv/dt| there (V per dimensionless time).
    pub dv_dt_peak: f64,
    /// Lowest tip displacement from equilibrium, towards the fixed magnet, in beam lengths.
    pub tip_min: f64,
    /// Highest tip displacement, in beam lengths.
    pub tip_max: f64,
    /// Largest |v| of the whole run (V).
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
    window: f64,
    weights: Vec<f64>,
    integral: f64,
    duration: f64,
    summary: Summary,
    envelope: Envelope,
}

impl Collector {
    /// For a run to `t_end` whose window starts at `window`, with the envelope in `slices` slices.
    pub fn new(window: f64, t_end: f64, slices: usize) -> Self {
        Self {
            window,
            weights: gauss_legendre(NODES).1,
            integral: 0.0,
            duration: 0.0,
            summary: Summary {
                from: window,
                to: window,
                v_rms: 0.0,
                v_peak: 0.0,
                dv_dt_peak: 0.0,
                tip_min: f64::INFINITY,
                tip_max: f64::NEG_INFINITY,
                v_peak_whole: 0.0,
            },
            envelope: Envelope { width: t_end / slices as f64, slices: Vec::with_capacity(slices) },
        }
    }

    /// Takes a step into account.
    pub fn record(&mut self, step: &Step<'_>) {
        let voltage = step.tables.voltage.at_nodes(step.start, step.rest);
        let first = step.start[step.start.len() - 3];
        let (low, high) = voltage.iter().fold((first, first), |(low, high), v| (low.min(*v), high.max(*v)));
        self.widen_envelope(step.time, low, high);
        let summary = &mut self.summary;
        summary.v_peak_whole = summary.v_peak_whole.max(high.max(-low));
        // A step on the border belongs to the window when it begins in it, up to rounding.
        if step.time < self.window - 1e-9 * step.tables.step {
            return;
        }
        let rate = step.tables.voltage_rate.at_nodes(step.start, step.rest);
        summary.v_peak = summary.v_peak.max(high.max(-low));
        summary.dv_dt_peak = rate.iter().fold(summary.dv_dt_peak, |most, rate| most.max(rate.abs()));
        summary.tip_min = step.tip.iter().copied().fold(summary.tip_min, f64::min);
        summary.tip_max = step.tip.iter().copied().fold(summary.tip_max, f64::max);
        // The nodes are Gauss nodes, so the mean square comes with their weights.
        let square: f64 = self.weights.iter().zip(&voltage).map(|(w, v)| w * v * v).sum();
        self.integral += square * step.tables.step;
        self.duration += step.tables.step;
        summary.to = step.time + step.tables.step;
        summary.v_rms = (self.integral / self.duration).sqrt();
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

    /// The numbers so far; `None` before the window was reached.
    pub fn summary(&self) -> Option<Summary> {
        (self.duration > 0.0).then_some(self.summary)
    }

    /// The envelope so far.
    pub fn envelope(&self) -> &Envelope {
        &self.envelope
    }
}
