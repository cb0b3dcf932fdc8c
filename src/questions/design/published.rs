//! Devices that others published, with what they printed of them, so that everybody can see how far this program is
//! right about them.

use serde::Serialize;

use super::harvest::Harvest;
use super::linear::linear_balance;
use super::{DesignError, Plant};
use crate::model::layers::{Arrangement, Plate, Sheet};
use crate::model::{
    Device, ElectricalScaling, ForceLaw, Layers, ModelChoice, ModelError, ParameterSet, Units,
};
use crate::scenario::Scenario;
use crate::theory::spectrum::eigenvalues;

/// A published device.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Published {
    /// What it is called here.
    pub name: &'static str,
    /// Where it was published.
    pub source: &'static str,
    /// How its circuit is scaled.
    pub scaling: ElectricalScaling,
    /// Its layers and length (m), where it is described by them; the paper's device otherwise.
    layered: Option<(Layers, f64)>,
    /// Mass at its tip (kg).
    tip_mass: f64,
    /// Damping ratios of its first modes; where none were printed the device's own damping.
    ratios: &'static [f64],
    /// Where it is looked at: frequency (Hz) and load (ohm).
    at: (f64, f64),
    /// What was printed of it.
    pub printed: &'static [Printed],
}

/// A printed number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Printed {
    /// What it is a number of.
    pub what: What,
    /// The number: Hz, W/g^2 or dimensionless.
    pub value: f64,
    /// Whether it was measured.
    pub origin: Origin,
}

/// What a printed number is of; all of the device without magnets but the paper's.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum What {
    /// First resonance with the terminals connected (Hz).
    ShortCircuit,
    /// First resonance with them open (Hz).
    OpenCircuit,
    /// Mean power over the square of the base's peak acceleration (W/g^2) at a frequency (Hz) into a load (ohm).
    PowerPerG2(f64, f64),
    /// Natural frequency omega_n (dimensionless) of a mode, counted from 1.
    Omega(usize),
}

/// How a printed number was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Origin {
    /// On the device itself.
    Measured,
    /// By the publication's model.
    Computed,
    /// By the publication's closed form with five modes, evaluated by `tests/reference/unimorph.py`.
    ClosedForm,
}

/// Modes that the numbers here are computed with, none standing for those left out, as in the closed forms.
const MODES: usize = 5;
/// Excitation (g) of the devices without magnets; of linear devices the numbers do not depend on it.
const ACCELERATION: f64 = 0.1;

/// d31 and modulus of the ceramic of both of Erturk and Inman's devices.
const PZT_5A: Plate =
    Plate { thickness: 0.0, youngs_modulus: 66e9, density: 7800.0, d31: -190e-12, permittivity: 0.0 };

/// The unimorph of the case study in section 4 of the publication.
pub const UNIMORPH: Published = Published {
    name: "Unimorph, Erturk & Inman 2008",
    source: "A. Erturk and D. J. Inman, J. Vib. Acoust. 130, 041002 (2008)",
    scaling: Layers::SCALING,
    layered: Some((
        Layers {
            arrangement: Arrangement::Unimorph,
            width: 20e-3,
            substrate: Sheet { thickness: 0.5e-3, youngs_modulus: 100e9, density: 7165.0 },
            ceramic: Plate { thickness: 0.4e-3, permittivity: 15.93e-9, ..PZT_5A },
            epoxy: None,
        },
        0.1,
    )),
    tip_mass: 0.0,
    ratios: &[0.01],
    at: (47.8, 17.38e3),
    printed: &[
        Printed { what: What::ShortCircuit, value: 47.8, origin: Origin::Computed },
        Printed { what: What::OpenCircuit, value: 48.8, origin: Origin::Computed },
        Printed { what: What::PowerPerG2(47.8, 17.38e3), value: 15.538e-3, origin: Origin::ClosedForm },
        Printed { what: What::PowerPerG2(48.8, 91.2e3), value: 15.635e-3, origin: Origin::ClosedForm },
    ],
};

/// The bimorph on which the publication measured.
pub const BIMORPH: Published = Published {
    name: "Bimorph T226-A4, Erturk & Inman 2009",
    source: "A. Erturk and D. J. Inman, Smart Mater. Struct. 18, 025009 (2009)",
    scaling: Layers::SCALING,
    layered: Some((
        Layers {
            arrangement: Arrangement::Series,
            width: 31.8e-3,
            substrate: Sheet { thickness: 0.14e-3, youngs_modulus: 105e9, density: 9000.0 },
            ceramic: Plate { thickness: 0.26e-3, permittivity: 13.28e-9, ..PZT_5A },
            epoxy: None,
        },
        50.8e-3,
    )),
    tip_mass: 12e-3,
    ratios: &[0.027],
    at: (46.1, 35e3),
    printed: &[
        Printed { what: What::ShortCircuit, value: 45.6, origin: Origin::Measured },
        Printed { what: What::OpenCircuit, value: 48.4, origin: Origin::Measured },
    ],
};

/// The paper's device, Table 1.
pub const PAPER: Published = Published {
    name: "Table 1: the paper's device",
    source: "G. Zhang and B. Zhang, Materials 13(15), 3389 (2020)",
    scaling: ElectricalScaling::AsPrinted,
    layered: None,
    tip_mass: 0.0,
    ratios: &[],
    at: (0.0, 0.0),
    printed: &[
        Printed { what: What::Omega(1), value: 4.048, origin: Origin::Computed },
        Printed { what: What::Omega(2), value: 21.356, origin: Origin::Computed },
    ],
};

impl Published {
    /// All of them.
    pub const ALL: [Self; 3] = [PAPER, UNIMORPH, BIMORPH];

    /// The device in SI units, its damping apart.
    pub fn device(&self) -> Device {
        let Some((layers, beam_length)) = self.layered else { return Device::default() };
        let (frequency, resistance) = self.at;
        let linear = Device { flux_density: 0.0, viscosity: 0.0, ..Device::default() };
        Device { beam_length, tip_mass: self.tip_mass, frequency, resistance, ..linear }
            .with_layers(layers)
            .with_acceleration(ACCELERATION)
    }

    /// Makes the device `scenario`'s, with its damping.
    ///
    /// # Errors
    /// [`ModelError`] where the scenario's model has no such device.
    pub fn put_into(&self, scenario: &mut Scenario) -> Result<(), ModelError> {
        scenario.set_device(self.device(), self.scaling)?;
        if self.ratios.is_empty() { Ok(()) } else { scenario.damp(self.ratios) }
    }

    /// What this program computes for a printed number.
    ///
    /// # Errors
    /// [`DesignError`].
    pub fn computed(&self, what: What) -> Result<f64, DesignError> {
        let model = ModelChoice { modes: MODES, force: ForceLaw::Exact, residual_moment: false };
        let mut scenario = Scenario { model, ..Scenario::default() };
        self.put_into(&mut scenario)?;
        let (system, _) = scenario.validate()?;
        let units: Units = scenario.units();
        match what {
            What::Omega(mode) => Ok(system.modes[mode - 1].omega),
            What::ShortCircuit => Ok(units.hertz(system.modes[0].omega)),
            What::OpenCircuit => {
                let open = ParameterSet { kappa: 0.0, ..scenario.parameters };
                let found = eigenvalues(&scenario.model.system(open)?)?;
                let first = found.into_iter().find(|value| value.im > 0.0);
                Ok(first.map_or(f64::NAN, |value| units.hertz(value.norm())))
            }
            What::PowerPerG2(frequency, resistance) => {
                let device = Device { frequency, resistance, ..scenario.device()? };
                scenario.set_device(device.with_acceleration(ACCELERATION), self.scaling)?;
                let plant = Plant::new(&scenario)?;
                let bare = plant.without_magnets()?;
                let harvest = Harvest::new(&plant, &bare, &linear_balance(&bare)?);
                Ok(harvest.power_per_g2.unwrap_or(f64::NAN))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_printed_is_met() {
        for published in Published::ALL {
            for Printed { what, value, origin } in published.printed {
                let found = published.computed(*what).expect("a device");
                // Printed to three digits, or measured.
                let tolerance = match origin {
                    Origin::Measured => 0.02,
                    Origin::Computed => 5e-4,
                    Origin::ClosedForm => 1e-4,
                };
                assert!((found / value - 1.0).abs() < tolerance, "{}: {what:?} {found}", published.name);
            }
        }
    }
}
