//! The design bench of the page: the device in view in SI units, its limits, and what the user brought along.

pub(super) mod measured;
pub(super) mod questions;

use measured::Measured;

use super::view::View;
use crate::jobs::design::Operating;
use crate::jobs::study::harvest::HarvestStudy;
use crate::model::{Device, Dimension, Limits, ModelError};
use crate::scenario::{ModelChoice, Scenario};

/// What the bench keeps beside the view.
#[derive(Default)]
pub(super) struct Bench {
    /// Why the last change of the device was not made.
    pub refusal: Option<String>,
    /// Measured data.
    pub measured: Measured,
    /// Modes and force law before the present ones.
    pub before: ModelChoice,
    /// Curves and numbers kept to compare with.
    pub pinned: Option<Box<Pinned>>,
}

/// A device that was pinned.
pub(super) struct Pinned {
    /// What it delivers over frequency, if that was known.
    pub harvest: Option<HarvestStudy>,
    /// What it delivers as it was.
    pub operating: Option<Operating>,
}

/// Relative difference below which two dimensions are the same but for rounding.
const ROUNDING: f64 = 1e-9;

/// The device of `scenario`: its dimensions digit by digit as they were entered, where they still hold.
///
/// # Errors
/// As [`Scenario::device`].
pub(super) fn device(scenario: &Scenario) -> Result<Device, ModelError> {
    let derived = scenario.device()?;
    let same = |stored: &Device| {
        stored.repelling == derived.repelling
            && Dimension::ALL.iter().all(|dimension| {
                let (a, b) = (dimension.get(stored), dimension.get(&derived));
                a == b || (a - b).abs() <= ROUNDING * a.abs()
            })
    };
    Ok(scenario.device.filter(same).unwrap_or(derived))
}

/// What must be kept: the user's limits, with the voltage that the device's ceramic bears where none is given.
pub(super) fn limits(view: &View) -> Limits {
    let chosen = view.design.limits;
    let chosen = if chosen.validate().is_ok() { chosen } else { Limits::default() };
    Limits { voltage: chosen.voltage.or(Limits::of(&view.scenario.base()).voltage), ..chosen }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ElectricalScaling;

    #[test]
    fn a_device_keeps_its_digits_until_a_number_moves_it() {
        let mut scenario = Scenario::default();
        let entered = Device { beam_length: 0.45, resistance: 1_234_560.0, ..Device::default() };
        scenario.set_device(entered, ElectricalScaling::Consistent).expect("a device");
        assert_eq!(device(&scenario), Ok(entered));
        scenario.parameters.kappa *= 2.0;
        let moved = device(&scenario).expect("a device");
        assert!((moved.resistance / 617_280.0 - 1.0).abs() < 1e-9 && moved.beam_length == 0.45);
    }
}
