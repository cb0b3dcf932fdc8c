//! Numbers read off a run while it is computed: amplitudes and means of its end, and the voltage's envelope.

use serde::Serialize;

use super::extremes::{Highest, Scalar};
use super::measures::{Measures, Observer};
use super::propagator::Propagator;
use super::step::Step;

/// Amplitudes and means over the last part of a run, the window.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Summary {
    /// Start of the window (dimensionless time).
    pub from: f64,
    /// End of the window (dimensionless time).
    pub to: f64,
    /// Means and extremes in it.
    #[serde(flatten)]
    pub measures: Measures,
    /// Largest |dv/dt| (V per dimensionless time).
    pub dv_dt_peak: f64,
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
    reached: f64,
    v_peak_whole: f64,
    observer: Observer,
    /// Of dv/dt and of -dv/dt.
    rate: [Highest; 2],
    envelope: Envelope,
}

impl Collector {
    /// For a run to `t_end` with the given `window` (start and end, whole excitation periods, so that every step is
    /// either inside or outside), with the envelope in `slices` slices.
    pub fn new(window: (f64, f64), t_end: f64, slices: usize) -> Self {
        Self {
            window,
            reached: window.0,
            v_peak_whole: 0.0,
            observer: Observer::default(),
            rate: Highest::both(Scalar::VoltageRate),
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
        self.rate.iter_mut().for_each(|highest| highest.see(step, &rate));
        self.observer.see(step, &voltage, length);
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

    /// The numbers so far, where `propagator` is that of the run and `kappa` its circuit's conductance; `None` before the
    /// window was reached.
    pub fn summary(&self, propagator: &Propagator, kappa: f64) -> Option<Summary> {
        let measures = self.observer.measures(kappa)?;
        Some(Summary {
            from: self.window.0,
            to: self.reached,
            measures,
            dv_dt_peak: Highest::larger(&self.rate, propagator),
            v_peak_whole: self.v_peak_whole.max(measures.v_peak),
        })
    }

    /// The envelope so far.
    pub fn envelope(&self) -> &Envelope {
        &self.envelope
    }
}
