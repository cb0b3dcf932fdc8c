//! Direct current: what a device puts into a store held at a voltage, through a full-wave rectifier.

use serde::{Deserialize, Serialize};

use super::linear::highest_place;
use super::{DesignError, Plant};
use crate::dynamics::Measures;
use crate::dynamics::attractors::rectified::{Steady, settle_rectified};
use crate::scenario::Scenario;

/// Golden sections that locate the best voltage.
const SECTIONS: usize = 14;

/// What goes into the store at one voltage of it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct RectifiedPoint {
    /// Voltage of the store (V).
    pub voltage: f64,
    /// What the start leads to.
    pub steady: Steady,
    /// The rest; `None` where it is undecided or ended.
    pub delivered: Option<Delivered>,
}

/// A steady motion with a rectifier.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Delivered {
    /// Mean current into the store (A).
    pub current: f64,
    /// Means and extremes in SI units: V, mm; `power` is that into the store (W).
    #[serde(flatten)]
    pub measures: Measures,
    /// Mean power that the shaken base puts in (W).
    pub input: f64,
    /// Mean power lost in damping (W).
    pub viscous: f64,
    /// Mean power lost in the dielectric, at the excitation's frequency (W).
    pub dielectric: f64,
    /// Mean power lost in the diodes (W).
    pub diodes: f64,
    /// power / input (dimensionless); `None` without input.
    pub efficiency: Option<f64>,
    /// |input - power - losses - energy stored| over the largest of them: what the computation has lost.
    pub defect: f64,
}

/// The plant of `scenario` with nothing at its electrodes but its dielectric loss, taken at the excitation's frequency.
///
/// # Errors
/// [`DesignError`].
fn unloaded(scenario: &Scenario) -> Result<Plant, DesignError> {
    let mut scenario = scenario.clone();
    scenario.parameters.kappa = 0.0;
    Ok(Plant::new(&scenario)?)
}

impl RectifiedPoint {
    /// The device of `scenario` from its start with a store at `voltage` > 0 (V) behind a bridge, two of whose diodes
    /// drop `drop` (V) each. The scenario's load is taken away.
    ///
    /// # Errors
    /// [`DesignError`].
    pub fn of(scenario: &Scenario, voltage: f64, drop: f64) -> Result<Self, DesignError> {
        let plant = unloaded(scenario)?;
        let (system, initial) = plant.scenario.validate()?;
        let threshold = voltage + 2.0 * drop;
        let (steady, balance, _) = settle_rectified(&system, threshold, &initial)?;
        let delivered = balance.map(|balance| {
            let units = &plant.units;
            let (low, high) = balance.measures.tip;
            let tip = (units.millimetres(low), units.millimetres(high));
            let power = units.watts(voltage * balance.current);
            Delivered {
                current: units.watts(balance.current),
                measures: Measures { power, tip, ..balance.measures },
                input: units.watts(balance.input),
                viscous: units.watts(balance.viscous),
                dielectric: units.watts(balance.dielectric),
                diodes: units.watts(2.0 * drop * balance.current),
                efficiency: (balance.input > 0.0).then(|| voltage * balance.current / balance.input),
                defect: balance.defect(),
            }
        });
        Ok(Self { voltage, steady, delivered })
    }

    /// Power into the store (W); 0 where nothing is known of it.
    pub fn power(&self) -> f64 {
        self.delivered.map_or(0.0, |delivered| delivered.measures.power)
    }
}

/// Largest voltage (V) of the motion that the start of `scenario` leads to with open electrodes: what a store must stay
/// below, two diodes' drops included; `None` where that motion ends.
///
/// # Errors
/// [`DesignError`].
pub fn open_circuit(scenario: &Scenario) -> Result<Option<f64>, DesignError> {
    let plant = unloaded(scenario)?;
    let (system, initial) = plant.scenario.validate()?;
    let (_, found) = plant.reach(&system, &initial)?;
    let cell = found.reached.cell();
    Ok(cell.lasts().then_some(cell.measures.v_peak))
}

/// The best voltage of the store between two (V) that have one peak of power between them.
///
/// # Errors
/// [`DesignError`].
pub fn best_between(
    scenario: &Scenario,
    (low, high): (f64, f64),
    drop: f64,
) -> Result<RectifiedPoint, DesignError> {
    let mut failed = None;
    let power = |voltage: f64| match RectifiedPoint::of(scenario, voltage, drop) {
        Ok(point) => point.power(),
        Err(error) => {
            failed.get_or_insert(error);
            0.0
        }
    };
    let best = highest_place(power, (low, high), SECTIONS);
    match failed {
        Some(error) => Err(error),
        None => RectifiedPoint::of(scenario, best, drop),
    }
}
