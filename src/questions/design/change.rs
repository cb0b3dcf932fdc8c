//! Where a sampled curve changes its motion between two neighbours: found by computing the motion there, not by drawing
//! a line across the jump.

use super::{DesignError, HarvestPoint, Plant};
use crate::dynamics::attractors::motion::Cell;
use crate::dynamics::attractors::sweep::{Dwell, SweepCourse, sweep};
use crate::model::{Parameter, Shaking};
use crate::scenario::Scenario;

/// How closely a change is located, as a part of the frequency.
pub const LOCATED: f64 = 1e-4;
/// Most motions computed between two neighbours: in chaos no distance is small enough.
const MOST_MOTIONS: usize = 96;

/// How the motions of a curve are reached.
#[derive(Debug, Clone, PartialEq, nanoserde::SerBin, nanoserde::DeBin)]
pub enum Way {
    /// From rest at each frequency.
    FromRest,
    /// In a sweep, whose `state` (rest when absent) at the beginning of a part of it is known, and the `values` of omega
    /// that it visits from there on, the last of them before the change.
    Sweep {
        /// State at the beginning, length 2N + 1.
        state: Option<Vec<f64>>,
        /// Values of omega.
        values: Vec<f64>,
        /// How long each is held.
        dwell: Dwell,
    },
}

/// A motion at a frequency.
#[derive(Debug, Clone)]
struct Place {
    omega: f64,
    /// Where the sweep came from.
    from: f64,
    /// `None` where it ended.
    point: Option<HarvestPoint>,
    /// The state to go on from.
    state: Option<Vec<f64>>,
}

impl Place {
    fn power(&self) -> f64 {
        self.point.map_or(0.0, |point| point.measures.power)
    }

    /// Whether more than a `difference` in power (W), or an end, lies between this and another motion.
    fn differs(&self, other: &Self, difference: f64) -> bool {
        let ends = self.point.is_some() != other.point.is_some();
        ends || (self.power() - other.power()).abs() > difference
    }
}

/// The points of a curve between omega = `from` and `to`, two neighbours of it in their order, on the device of
/// `scenario`, the base's motion following `shaking`: as many that the powers of two neighbours differ by at most
/// `difference` (W). Where the
/// motion changes, two points are a jump at one frequency, known within [`LOCATED`]; nothing stands where it ends.
///
/// A sweep is refined by going in smaller steps, in which it may stay on a motion longer.
///
/// # Errors
/// [`DesignError`] when a number is out of range or a motion cannot be followed.
pub fn between(
    scenario: &Scenario,
    shaking: Shaking,
    way: &Way,
    (from, to): (f64, f64),
    difference: f64,
) -> Result<Vec<Option<HarvestPoint>>, DesignError> {
    let plant = Plant::new(scenario)?.shaken(shaking);
    let mut here = first(&plant, way, from)?;
    // What lies ahead, the nearest last.
    let mut ahead = vec![next(&plant, way, &here, to)?];
    let (mut points, mut motions) = (Vec::new(), 0);
    while let Some(there) = ahead.last_mut() {
        let differs = here.differs(there, difference);
        let close = (there.omega - here.omega).abs() <= LOCATED * here.omega;
        // A motion that was reached from farther away, and so from another one, is looked at again from here; the
        // neighbour stays what the curve says.
        let stale = there.from != here.omega && there.omega != to && way != &Way::FromRest;
        if differs && stale && motions < MOST_MOTIONS {
            *there = next(&plant, way, &here, there.omega)?;
            motions += 1;
            continue;
        }
        if differs && !close && motions < MOST_MOTIONS {
            let middle = next(&plant, way, &here, 0.5 * (here.omega + there.omega))?;
            ahead.push(middle);
            motions += 1;
            continue;
        }
        if differs && close {
            let frequency = plant.units.hertz(0.5 * (here.omega + there.omega));
            let jump = |place: &Place| place.point.map(|point| HarvestPoint { frequency, ..point });
            points.extend([jump(&here), jump(&*there)]);
        }
        if let Some(there) = ahead.pop() {
            points.push(there.point);
            here = there;
        }
    }
    // The neighbour itself is known.
    points.pop();
    Ok(points)
}

/// The motion at omega = `from`, the neighbour that is known.
fn first(plant: &Plant, way: &Way, from: f64) -> Result<Place, DesignError> {
    match way {
        Way::FromRest => at_rest(plant, from),
        Way::Sweep { state, values, dwell } => swept(plant, (from, values), state.as_deref(), *dwell),
    }
}

/// The motion at `omega` on the way from the place `before`.
fn next(plant: &Plant, way: &Way, before: &Place, omega: f64) -> Result<Place, DesignError> {
    match way {
        Way::FromRest => at_rest(plant, omega),
        Way::Sweep { dwell, .. } => swept(plant, (before.omega, &[omega]), before.state.as_deref(), *dwell),
    }
}

/// What the start from rest at `omega` (dimensionless) leads to.
///
/// # Errors
/// [`DesignError`] when a number is out of range or the motion cannot be followed.
pub fn from_rest(plant: &Plant, omega: f64) -> Result<Cell, DesignError> {
    let set = plant.along.at(&plant.scenario.parameters, Parameter::Omega, omega);
    let system = plant.scenario.model.system(set)?;
    let rest = vec![0.0; system.dimension()];
    Ok(plant.reach(&system, &rest)?.1.reached.cell())
}

fn at_rest(plant: &Plant, omega: f64) -> Result<Place, DesignError> {
    let cell = from_rest(plant, omega)?;
    let point = cell.lasts().then(|| HarvestPoint::new(plant, omega, &cell.measures));
    Ok(Place { omega, from: omega, point, state: None })
}

fn swept(
    plant: &Plant,
    (from, values): (f64, &[f64]),
    state: Option<&[f64]>,
    dwell: Dwell,
) -> Result<Place, DesignError> {
    let Scenario { parameters, model, .. } = &plant.scenario;
    let rest = vec![0.0; model.system(*parameters)?.dimension()];
    let (set, parameter, along) = (parameters, Parameter::Omega, plant.along);
    let course = SweepCourse { set, model: *model, parameter, along, start: &rest, dwell };
    let (points, state) = sweep(course, values, state)?;
    let last = points.last().filter(|point| !point.ended);
    let point = last.map(|point| HarvestPoint::new(plant, point.value, &point.measures));
    Ok(Place { omega: values.last().copied().unwrap_or(from), from, point, state })
}
