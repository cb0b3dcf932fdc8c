//! Power against the load: the linear device in closed form, the forced motion and the motion reached, carried from load
//! to load, and the best that each device gives within a window of frequencies.

use serde::{Deserialize, Serialize};

use super::linear::linear_peak;
use super::peak::{Peak, highest};
use super::{Bounds, DesignError, Plant, delivering_branches};
use crate::dynamics::attractors::dielectric::{WithLoss, orbit_with_loss};
use crate::dynamics::attractors::motion::Cell;
use crate::dynamics::{ForcedMotion, Measures, Motion, Orbit, OrbitError};
use crate::model::{Limits, ModelError, Parameter, ReducedSystem, Shaking};
use crate::questions::response::Followed;
use crate::scenario::Scenario;
use crate::theory::{Source, TheoryError};

/// A motion under one load.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct LoadPoint {
    /// Load resistance (ohm).
    pub resistance: f64,
    /// Means and extremes in SI units: V, W, mm.
    #[serde(flatten)]
    pub measures: Measures,
    /// Its class; unstable forced motions have period 1 as well.
    pub motion: Motion,
    /// Whether it attracts.
    pub stable: bool,
}

impl LoadPoint {
    fn new(plant: &Plant, motion: Motion, stable: bool, measures: &Measures) -> Self {
        Self { resistance: plant.resistance(), measures: plant.in_si(measures), motion, stable }
    }
}

/// The linear device of `scenario` at its own frequency: power (W) at each of the `resistances` (ohm), and the best
/// load (ohm) with its power (W), which is the magnitude of the device's own impedance.
///
/// # Errors
/// [`DesignError`].
pub fn linear_loads(
    scenario: &Scenario,
    resistances: &[f64],
) -> Result<(Vec<[f64; 2]>, [f64; 2]), DesignError> {
    let plant = Plant::new(scenario)?;
    let source = Source::new(&plant.without_magnets()?)?;
    let watts = |kappa: f64| plant.units.watts(source.power(kappa, plant.leakage));
    let points = resistances.iter().map(|r| [*r, watts(plant.conductance(*r))]).collect();
    let best = source.best_load(plant.leakage);
    Ok((points, [1.0 / (plant.units.power * best), watts(best)]))
}

/// The forced motion of `scenario` under each of the `resistances` (ohm), each found from the one before; `None` where
/// it is lost.
///
/// # Errors
/// [`DesignError`] when a number is out of range.
pub fn forced_loads(scenario: &Scenario, resistances: &[f64]) -> Result<Vec<Option<LoadPoint>>, DesignError> {
    let plant = Plant::new(scenario)?;
    let mut known: Option<Orbit> = None;
    let mut points = Vec::with_capacity(resistances.len());
    for resistance in resistances {
        let plant = plant.with_resistance(*resistance)?;
        let system = plant.system()?;
        let near = known.as_ref().and_then(|orbit| Orbit::find(&system, Some(&orbit.state), 1).ok());
        known = match near {
            Some(orbit) => Some(orbit),
            None => followed(&system)?,
        };
        let mut point = None;
        if let Some(orbit) = &known {
            let own = orbit_with_loss(&system, plant.along, (&orbit.state, 1)).ok().flatten();
            let orbit = own.as_ref().map_or(orbit, |(_, own)| own);
            let motion = Motion::Periodic { periods: 1 };
            point = Some(LoadPoint::new(&plant, motion, orbit.stable(), &orbit.measures));
        }
        points.push(point);
    }
    Ok(points)
}

/// The forced motion from rest; `None` where it cannot be followed.
fn followed(system: &ReducedSystem) -> Result<Option<Orbit>, DesignError> {
    match ForcedMotion::of(system) {
        Ok(forced) => Ok(forced.orbit),
        Err(error @ OrbitError::Model(_)) => Err(error.into()),
        Err(_) => Ok(None),
    }
}

/// The motions reached under the `resistances` (ohm) one after the other, the last state carried over; the first
/// starts from `state`, or from the scenario's own start, as does one after a motion that ended. Also the state to go on
/// from.
///
/// So a doubled motion is followed as long as it attracts.
///
/// # Errors
/// [`DesignError`].
pub fn reached_loads(
    scenario: &Scenario,
    resistances: &[f64],
    state: Option<&[f64]>,
) -> Result<(Vec<LoadPoint>, Option<Vec<f64>>), DesignError> {
    let plant = Plant::new(scenario)?;
    let (_, start) = plant.scenario.validate()?;
    let mut carried = state.map(<[f64]>::to_vec);
    let mut points = Vec::with_capacity(resistances.len());
    for resistance in resistances {
        let plant = plant.with_resistance(*resistance)?;
        let system = plant.system()?;
        let from = carried.as_ref().unwrap_or(&start);
        let (plant, WithLoss { reached, .. }) = plant.reach(&system, from)?;
        let Cell { motion, measures } = reached.cell();
        let point = LoadPoint::new(&plant, motion, reached.cell().lasts(), &measures);
        let orbit = reached.orbit.map(|orbit| orbit.state);
        carried = point.stable.then(|| orbit.unwrap_or(reached.state));
        points.push(point);
    }
    Ok((points, carried))
}

/// The best frequency under a load.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct BestFrequency {
    /// Load resistance (ohm).
    pub resistance: f64,
    /// Frequency (Hz) and power (W) of the linear device.
    pub linear: [f64; 2],
    /// Of the stable periodic motions; `None` when there is none.
    pub stable: Option<Peak>,
    /// Of those that keep the limits.
    pub within_limits: Option<Peak>,
    /// Whether branches were left out, or not followed to their ends, because it would take too long: there may be a
    /// better one.
    pub cut: bool,
}

/// The best frequency for a load of `resistance` (ohm) with omega in `window` (dimensionless), the base's motion
/// following `shaking`: of the linear device, and of the stable periodic motions on the forced branch and its doubled ones, all of them and those within `limits`.
///
/// # Errors
/// [`DesignError`].
pub fn best_frequency(
    scenario: &Scenario,
    resistance: f64,
    (window, shaking): ((f64, f64), Shaking),
    limits: Limits,
) -> Result<BestFrequency, DesignError> {
    crate::questions::response::check_range(Parameter::Omega, window)?;
    let plant = Plant::new(scenario)?.shaken(shaking).with_resistance(resistance)?;
    let bounds = Bounds::new(&plant, limits)?;
    let (omega, power) = linear_peak(&plant, window)?;
    if !power.is_finite() {
        return Err(TheoryError::Undamped { omega }.into());
    }
    // Without any branch the device still has its linear one.
    let branches = match delivering_branches(&plant, window) {
        Err(error @ OrbitError::Model(ModelError::OutOfRange { .. } | ModelError::NotFinite { .. })) => {
            return Err(error.into());
        }
        branches => branches.unwrap_or_default(),
    };
    Ok(BestFrequency {
        resistance,
        linear: [plant.units.hertz(omega), power],
        stable: highest(&plant, &branches, None),
        within_limits: highest(&plant, &branches, Some(&bounds)),
        cut: branches.iter().any(Followed::is_cut),
    })
}

/// Resistances (ohm) spread evenly over the decades from `low` to `high`, the ends included.
pub fn decades(low: f64, high: f64, per_decade: usize) -> Vec<f64> {
    let count = ((high / low).log10() * per_decade as f64).round().max(1.0) as usize;
    (0..=count).map(|i| low * (high / low).powf(i as f64 / count as f64)).collect()
}

/// The highest of `points`, for a mark; `None` when all are missing.
pub fn best(points: impl IntoIterator<Item = LoadPoint>) -> Option<LoadPoint> {
    points
        .into_iter()
        .filter(|point| point.stable)
        .max_by(|a, b| a.measures.power.total_cmp(&b.measures.power))
}
