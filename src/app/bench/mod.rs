//! The design bench of the page: the device in view in SI units, its limits, and what the user brought along.
//!
//! `view::design` is what is stored of it, `bench::questions` turns it into questions, `panels::design` asks them
//! and draws, only the page in front. The ten numbers stay what is computed from: editing a dimension goes
//! through `Scenario::set_device`, which refuses what is no device (the reason stands under the sliders), and
//! `bench::device` gives the entered digits back as long as they hold. A question leaves out what plays no role in its
//! answer (the frequency in a curve over frequency, the ceramic in a table of ceramics), so that moving it asks
//! nothing new. A measured file is read by `bench::measured` for at most 6 ms a frame.

pub(super) mod facts;
pub(super) mod measured;
pub(super) mod questions;
pub(super) mod recorded;
pub(super) mod shaking;
pub(super) mod variant;

use std::rc::Rc;

use measured::Measured;
use variant::Variant;

use super::view::View;
use crate::model::{Device, Dimension, ElectricalScaling, Limits, ModelError};
use crate::questions::design::measured::Kind;
use crate::scenario::{ModelChoice, Scenario};
use crate::sentence::Sentence;

/// What the bench keeps beside the view.
pub(super) struct Bench {
    /// Why the last change of the device was not made.
    pub refusal: Option<Sentence>,
    /// Measured data.
    pub measured: Measured,
    /// The recording that shakes the base.
    pub vibration: Measured,
    /// Modes and force law before the present ones.
    pub before: ModelChoice,
    /// Designs kept to compare with.
    pub variants: Rc<Vec<Variant>>,
}

impl Default for Bench {
    fn default() -> Self {
        Self {
            refusal: None,
            measured: Measured::of(Kind::Voltage),
            vibration: Measured::of(Kind::Acceleration),
            before: ModelChoice::default(),
            variants: Rc::default(),
        }
    }
}

impl Bench {
    /// The file in which this quantity is looked for.
    pub(super) fn file_of(&mut self, wanted: Kind) -> &mut Measured {
        if wanted == Kind::Acceleration { &mut self.vibration } else { &mut self.measured }
    }
}

/// Relative difference below which two dimensions are the same but for rounding.
const ROUNDING: f64 = 1e-9;
/// Relative difference from the paper's beam length beyond which a beam is another.
const OWN_LENGTH: f64 = 1e-6;

/// The device of `scenario`: its dimensions digit by digit as they were entered, where they still hold.
///
/// # Errors
/// As [`Scenario::device`].
pub(super) fn device(scenario: &Scenario) -> Result<Device, ModelError> {
    let derived = scenario.device()?;
    let same = |stored: &Device| {
        stored.repelling == derived.repelling
            && Dimension::ALL.iter().all(|dimension| {
                let (a, b) = (stored.get(*dimension), derived.get(*dimension));
                a == b || (a - b).abs() <= ROUNDING * a.abs()
            })
    };
    Ok(scenario.device.filter(same).unwrap_or(derived))
}

/// Whether a device of one's own is scaled as the paper prints it, which counts its watts wrongly.
pub(super) fn printed_for_own(device: &Device, scaling: ElectricalScaling) -> bool {
    let paper = Device::default().beam_length;
    scaling == ElectricalScaling::AsPrinted && (device.beam_length / paper - 1.0).abs() > OWN_LENGTH
}

/// What must be kept: the user's limits, with the voltage that the device's ceramic bears where none is given.
pub(super) fn limits(view: &View) -> Limits {
    chosen_limits(view).completed(&view.scenario.base())
}

/// The user's limits, which leave the voltage open to the ceramic where none is given.
fn chosen_limits(view: &View) -> Limits {
    let chosen = view.design.limits;
    if chosen.validate().is_ok() { chosen } else { Limits::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::session::Session;
    use crate::model::ElectricalScaling;
    use crate::questions::checks::Span;
    use crate::questions::harvest::Harvest;
    use crate::questions::load::BestAt;
    use crate::questions::load::LoadStudy;
    use crate::questions::trust::Entry;
    use crate::scheduler::Asked as _;

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

    struct Asked {
        harvest: (Scenario, Harvest, Span),
        best: Vec<BestAt>,
        trust: Vec<Entry>,
    }

    #[test]
    fn what_plays_no_role_in_a_study_begins_no_other() {
        let session = Session::default();
        let questions = |holds_acceleration: bool, change: &dyn Fn(&mut Device)| {
            let mut view = View::default();
            view.design.holds_acceleration = holds_acceleration;
            let mut entered = view.scenario.device().expect("a device");
            change(&mut entered);
            view.scenario.set_device(entered, ElectricalScaling::AsPrinted).expect("a device");
            view.design.window = Some((2.6, 3.0));
            let (scenario, load) = questions::load(&view);
            let loads = LoadStudy::new(scenario, load).expect("loads");
            Asked {
                harvest: questions::harvest(&view, &session),
                best: questions::best_frequencies(&view, &session, &loads).asked().clone(),
                trust: questions::trust(&view).asked().clone(),
            }
        };
        let before = questions(false, &|_| {});
        let elsewhere = questions(false, &|device| device.frequency = 2.81);
        assert!(before.harvest == elsewhere.harvest && before.best == elsewhere.best);
        let as_hard = questions(true, &|device| {
            let acceleration = device.acceleration();
            device.frequency = 2.81;
            *device = device.with_acceleration(acceleration);
        });
        let held = questions(true, &|_| {});
        assert!(held.harvest == as_hard.harvest && held.best == as_hard.best);
        assert!(held.harvest != before.harvest, "what is held plays a role");
        assert!(before.trust != elsewhere.trust, "the frequency plays a role in the table of trust");
        let loaded = questions(false, &|device| device.resistance *= 1.01);
        assert!(before.harvest != loaded.harvest, "the load plays a role over frequency");
    }
}
