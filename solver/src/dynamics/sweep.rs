//! Sweeps: the motion at one value of a parameter after another, the state carried over from each to the next.
//!
//! A value is held for a number of excitation periods that are thrown away and a number that are kept. The state at
//! the end, taken at a stroboscopic instant, is where the next value starts, in the same phase of the excitation: q,
//! dq/dt and v are carried over as they are, also when a change of structure changes the modes a little. After an
//! escape or a contact there is nothing to carry, and the next value starts from the sweep's own start. A value that
//! starts so has no settled neighbour: it is given [`SETTLING`] times as long before its motion counts.

use serde::{Deserialize, Serialize};

use super::poincare::{PhasePoint, recurrence};
use super::summary::Collector;
use super::{Collocation, IntegrationError, Outcome, Settings};
use crate::model::{ModelChoice, ModelError, Parameter, ParameterSet, ReducedSystem, Shaking};

/// How many times longer the transient of a value that starts from the sweep's own start may take.
pub const SETTLING: usize = 5;

/// How long each value is held, in excitation periods.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Dwell {
    /// Periods thrown away first, for the transient.
    pub discarded: usize,
    /// Periods kept: stroboscopic points, means and extremes are of these.
    pub kept: usize,
}

impl Default for Dwell {
    fn default() -> Self {
        Self { discarded: 200, kept: 64 }
    }
}

impl Dwell {
    /// Allowed numbers of periods thrown away.
    pub const DISCARDED: (usize, usize) = (0, 5000);
    /// Allowed numbers of periods kept.
    pub const KEPT: (usize, usize) = (1, 1000);

    /// Checks both numbers.
    ///
    /// # Errors
    /// [`ModelError`] naming the one out of range.
    pub fn validate(&self) -> Result<(), ModelError> {
        for (field, value, (minimum, maximum)) in
            [("discarded", self.discarded, Self::DISCARDED), ("kept", self.kept, Self::KEPT)]
        {
            if !(minimum..=maximum).contains(&value) {
                return Err(ModelError::Count { field, value, minimum, maximum });
            }
        }
        Ok(())
    }
}

/// The motion at one value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct SweepPoint {
    /// The parameter's value.
    pub value: f64,
    /// v at the stroboscopic instants kept (V), in their order.
    pub strobe: Vec<f64>,
    /// Root mean square of the voltage over the periods kept (V).
    pub v_rms: f64,
    /// Largest |v| there (V).
    pub v_peak: f64,
    /// Mean electrical power kappa v^2 there (dimensionless).
    pub power: f64,
    /// Lowest and highest tip displacement there, in beam lengths.
    pub tip: (f64, f64),
    /// Largest |slope| at the tip there (rad).
    pub slope: f64,
    /// Excitation periods after which the stroboscopic points repeat; `None` when they do not, or are too few.
    pub period: Option<usize>,
    /// Whether the motion escaped or touched, or there is no such device; the other numbers are then zero.
    pub ended: bool,
    /// Whether this value started from the sweep's start instead of the state before.
    pub restarted: bool,
}

/// Visits `values` of `parameter` in their order, everything else being as in `set` and `model`, the base shaken so, from `state` (length
/// 2N + 1), or from `start` (of that length) where no motion is carried over. Returns the points and the state in which the last one ended, unless that ended early.
///
/// # Errors
/// [`SweepError`] when a value is out of range or its motion cannot be resolved.
pub fn sweep(
    set: &ParameterSet,
    model: ModelChoice,
    start: &[f64],
    (parameter, shaking): (Parameter, Shaking),
    values: &[f64],
    state: Option<&[f64]>,
    dwell: Dwell,
) -> Result<(Vec<SweepPoint>, Option<Vec<f64>>), SweepError> {
    let mut carried = state.map(<[f64]>::to_vec);
    let mut points = Vec::with_capacity(values.len());
    for value in values {
        let set = shaking.at(set, parameter, *value);
        let restarted = carried.is_none();
        let from = carried.as_ref().map_or(start, Vec::as_slice);
        let held = match model.system(set) {
            Ok(system) => {
                let longer = Dwell { discarded: SETTLING * dwell.discarded, ..dwell };
                hold(&system, from, if restarted { longer } else { dwell })?
            }
            // A value out of its own range is a wrong question; a device that cannot be is a gap.
            Err(reason @ (ModelError::OutOfRange { .. } | ModelError::NotFinite { .. })) => {
                return Err(reason.into());
            }
            Err(_) => Held::nothing(),
        };
        points.push(SweepPoint { value: *value, restarted, ..held.point });
        carried = held.end;
    }
    Ok((points, carried))
}

/// Why a sweep has no answer.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SweepError {
    /// A value is out of range.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A motion cannot be integrated.
    #[error(transparent)]
    Integration(#[from] IntegrationError),
}

/// One value held.
struct Held {
    point: SweepPoint,
    end: Option<Vec<f64>>,
}

impl Held {
    /// What there is of a device that cannot be: pulled in or buckled by its magnets.
    fn nothing() -> Self {
        let point = SweepPoint {
            value: 0.0,
            strobe: Vec::new(),
            v_rms: 0.0,
            v_peak: 0.0,
            power: 0.0,
            tip: (0.0, 0.0),
            slope: 0.0,
            period: None,
            ended: true,
            restarted: false,
        };
        Self { point, end: None }
    }
}

/// Holds `system` from the state `from` for as long as `dwell` says.
fn hold(system: &ReducedSystem, from: &[f64], dwell: Dwell) -> Result<Held, IntegrationError> {
    let period = system.parameters.period();
    let (begin, end) = (dwell.discarded as f64 * period, (dwell.discarded + dwell.kept) as f64 * period);
    let mut integrator = Collocation::new(system, from, Settings::default())?;
    let mut collector = Collector::new((begin, end), end, 1);
    let mut strobe: Vec<PhasePoint> = Vec::with_capacity(dwell.kept);
    let last = system.dimension() - 1;
    let outcome = loop {
        let outcome = integrator.advance(end, usize::MAX, &mut |step| {
            if step.index == 0 && step.time > begin - 0.5 * period {
                let state = &step.start[..=last];
                strobe.push(PhasePoint { v: state[last], dv_dt: system.voltage_rate(state) });
            }
            collector.record(step);
        })?;
        if let Some(outcome) = outcome {
            break outcome;
        }
    };
    let completed = outcome == Outcome::Completed;
    let summary = collector.summary(integrator.propagator()).filter(|_| completed);
    let repeats = summary.and_then(|summary| recurrence(&strobe, summary.v_peak, summary.dv_dt_peak));
    let v_rms = summary.map_or(0.0, |summary| summary.v_rms);
    let point = SweepPoint {
        value: 0.0,
        strobe: if completed { strobe.iter().map(|point| point.v).collect() } else { Vec::new() },
        v_rms,
        v_peak: summary.map_or(0.0, |summary| summary.v_peak),
        power: system.parameters.kappa * v_rms * v_rms,
        tip: summary.map_or((0.0, 0.0), |summary| (summary.tip_min, summary.tip_max)),
        slope: summary.map_or(0.0, |summary| summary.slope),
        period: repeats.and_then(|found| found.period),
        ended: !completed,
        restarted: false,
    };
    Ok(Held { point, end: completed.then(|| integrator.state().to_vec()) })
}
