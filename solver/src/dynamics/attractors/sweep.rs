//! Sweeps: the motion at one value of a parameter after another, the state carried over from each to the next.
//!
//! A value is held until its motion has settled, by the same evidence as everywhere ([`super::settle`]), and for a
//! given number of excitation periods at least. The state in which it has settled, taken at a stroboscopic instant, is where
//! the next value starts, in the same phase of the excitation: q, dq/dt and v are carried over as they are, also when a
//! change of structure changes the modes a little. After an escape or a contact there is nothing to carry, and the next
//! value starts from the sweep's own start.

use serde::{Deserialize, Serialize};

use super::dielectric::{WithLoss, reach_with_loss};
use super::effort::Effort;
use super::motion::{Cell, Motion};
use super::settle::reach;
use crate::dynamics::integration::{Collocation, Measures, RunError, Settings};
use crate::model::{Along, ModelChoice, ModelError, Parameter, ParameterSet, ReducedSystem};

/// How long each value is held, in excitation periods.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Dwell {
    /// Periods thrown away first, at least: as many more as the motion takes to settle.
    pub discarded: usize,
    /// Stroboscopic points kept, one a period.
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
    /// The motion reached; undecided where it has not settled.
    pub motion: Motion,
    /// v at the stroboscopic instants kept (V), in their order.
    pub strobe: Vec<f64>,
    /// Means and extremes: of the periodic motion itself where there is one.
    #[serde(flatten)]
    pub measures: Measures,
    /// Excitation periods after which it repeats; `None` when it does not, or has not settled.
    pub period: Option<usize>,
    /// Whether the motion escaped or touched, or there is no such device; the other numbers are then zero.
    pub ended: bool,
    /// Whether this value started from the sweep's start instead of the state before.
    pub restarted: bool,
}

/// What is swept, and how.
#[derive(Debug, Clone, Copy)]
pub struct SweepCourse<'a> {
    /// Everything that does not change.
    pub set: &'a ParameterSet,
    /// Modes and force law.
    pub model: ModelChoice,
    /// What changes.
    pub parameter: Parameter,
    /// What follows the frequency meanwhile.
    pub along: Along,
    /// Where a value starts that no motion is carried over to (length 2N + 1).
    pub start: &'a [f64],
    /// How long each value is held.
    pub dwell: Dwell,
}

/// Visits `values` in their order along `course`, the first one from `state` (length 2N + 1) if there is one. Returns the
/// points, and the state in which the last one settled unless its motion ended.
///
/// # Errors
/// [`RunError`] when a value is out of range or its motion cannot be resolved.
pub fn sweep(
    course: SweepCourse<'_>,
    values: &[f64],
    state: Option<&[f64]>,
) -> Result<(Vec<SweepPoint>, Option<Vec<f64>>), RunError> {
    let SweepCourse { set, model, parameter, along, start, dwell } = course;
    let mut carried = state.map(<[f64]>::to_vec);
    let mut points = Vec::with_capacity(values.len());
    for value in values {
        let set = along.at(set, parameter, *value);
        let restarted = carried.is_none();
        let from = carried.as_ref().map_or(start, Vec::as_slice);
        let held = match model.system(set) {
            Ok(system) => hold(&system, along, from, dwell)?,
            // A value out of its own range is a wrong question; a device that cannot be is a gap.
            Err(reason @ (ModelError::OutOfRange { .. } | ModelError::NotFinite { .. })) => {
                return Err(reason.into());
            }
            Err(_) => Held::of(Cell::new(Motion::Escape { time: 0.0 }, None)),
        };
        points.push(SweepPoint { value: *value, restarted, ..held.point });
        carried = held.end;
    }
    Ok((points, carried))
}

/// One value held.
struct Held {
    point: SweepPoint,
    end: Option<Vec<f64>>,
}

impl Held {
    /// What a motion's numbers say; one that has ended stands for a device that cannot be as well.
    fn of(cell: Cell) -> Self {
        let Cell { motion, measures } = cell;
        let point = SweepPoint {
            value: 0.0,
            motion,
            strobe: Vec::new(),
            measures,
            period: match motion {
                Motion::Periodic { periods } => Some(periods),
                _ => None,
            },
            ended: !cell.lasts(),
            restarted: false,
        };
        Self { point, end: None }
    }
}

/// Holds `system` from the state `from` until its motion has settled, and for as long as `dwell` says.
fn hold(system: &ReducedSystem, along: Along, from: &[f64], dwell: Dwell) -> Result<Held, RunError> {
    let effort = Effort { least: dwell.discarded, ..Effort::cell() };
    let WithLoss { system, reached, .. } =
        reach_with_loss(system, along, &|system| reach(system, from, effort))?;
    let mut held = Held::of(reached.cell());
    if held.point.ended {
        return Ok(held);
    }
    let last = system.dimension() - 1;
    let voltages = reached.states.iter().map(|state| state[last]);
    if reached.orbit.is_some() {
        held.point.strobe = voltages.cycle().take(dwell.kept).collect();
        held.end = reached.states.into_iter().next();
        return Ok(held);
    }
    let mut integrator = Collocation::new(&system, &reached.state, Settings::default())?;
    let end = dwell.kept as f64 * system.parameters.period();
    let strobe = &mut held.point.strobe;
    while integrator
        .advance(end, usize::MAX, &mut |step| {
            if step.index == 0 && strobe.len() < dwell.kept {
                strobe.push(step.start[last]);
            }
        })?
        .is_none()
    {}
    held.end = Some(integrator.state().to_vec());
    Ok(held)
}
