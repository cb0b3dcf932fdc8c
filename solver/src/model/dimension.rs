//! The dimensions of a device by name: what a user edits, with unit and range, and the coordinates of SI charts.

use serde::{Deserialize, Serialize};

use super::{ModelError, Parameter};

/// Which dimension of a [`super::Device`].
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin,
)]
#[serde(rename_all = "snake_case")]
pub enum Dimension {
    /// Residual flux density rho.
    FluxDensity,
    /// Permeability mu.
    Permeability,
    /// Length H of each magnet.
    MagnetLength,
    /// Radius R of each magnet.
    MagnetRadius,
    /// Common area S of the magnets.
    MagnetArea,
    /// Distance D of the magnets before the beam sags.
    MagnetDistance,
    /// Length L of the beam.
    BeamLength,
    /// Mass m_b of the beam.
    BeamMass,
    /// Mass m_t at the tip.
    TipMass,
    /// Young's modulus E.
    YoungsModulus,
    /// Second moment of area I.
    SecondMoment,
    /// Kelvin-Voigt viscosity Lambda.
    Viscosity,
    /// Acceleration of gravity g.
    Gravity,
    /// Capacitance C_eq.
    Capacitance,
    /// Load resistance R_eq.
    Resistance,
    /// Electromechanical coupling Theta.
    Coupling,
    /// Amplitude B of the base motion.
    BaseAmplitude,
    /// Frequency of the base motion.
    Frequency,
    /// Thickness of the ceramic layer.
    CeramicThickness,
    /// Dielectric dissipation factor of the ceramic.
    LossTangent,
}

/// What is fixed about a dimension.
struct Entry {
    field: &'static str,
    /// With a leading blank, empty when dimensionless.
    unit: &'static str,
    accepted: (f64, f64),
    usual: (f64, f64),
    logarithmic: bool,
}

const fn entry(
    field: &'static str,
    unit: &'static str,
    accepted: (f64, f64),
    usual: (f64, f64),
    logarithmic: bool,
) -> Entry {
    Entry { field, unit, accepted, usual, logarithmic }
}

/// Accepted where zero would make no sense, and where it does.
const POSITIVE: (f64, f64) = (1e-15, 1e15);
const NOT_NEGATIVE: (f64, f64) = (0.0, 1e15);

impl Dimension {
    /// All of them, in the order of [`super::Device`].
    pub const ALL: [Self; 20] = [
        Self::FluxDensity,
        Self::Permeability,
        Self::MagnetLength,
        Self::MagnetRadius,
        Self::MagnetArea,
        Self::MagnetDistance,
        Self::BeamLength,
        Self::BeamMass,
        Self::TipMass,
        Self::YoungsModulus,
        Self::SecondMoment,
        Self::Viscosity,
        Self::Gravity,
        Self::Capacitance,
        Self::Resistance,
        Self::Coupling,
        Self::BaseAmplitude,
        Self::Frequency,
        Self::CeramicThickness,
        Self::LossTangent,
    ];

    const fn entry(self) -> Entry {
        match self {
            Self::FluxDensity => entry("flux_density", " T", NOT_NEGATIVE, (0.0, 1.5), false),
            Self::Permeability => entry("permeability", " H/m", POSITIVE, (1.2e-06, 1.3e-06), false),
            Self::MagnetLength => entry("magnet_length", " m", POSITIVE, (0.0005, 0.02), false),
            Self::MagnetRadius => entry("magnet_radius", " m", NOT_NEGATIVE, (0.0005, 0.02), false),
            Self::MagnetArea => entry("magnet_area", " m^2", NOT_NEGATIVE, (1e-07, 0.0013), true),
            Self::MagnetDistance => entry("magnet_distance", " m", POSITIVE, (0.005, 1.0), true),
            Self::BeamLength => entry("beam_length", " m", POSITIVE, (0.02, 1.0), true),
            Self::BeamMass => entry("beam_mass", " kg", POSITIVE, (0.0001, 1.0), true),
            Self::TipMass => entry("tip_mass", " kg", NOT_NEGATIVE, (0.0, 0.1), false),
            Self::YoungsModulus => {
                entry("youngs_modulus", " Pa", POSITIVE, (1000000000.0, 400000000000.0), true)
            }
            Self::SecondMoment => {
                entry("second_moment", " m^4", (1e-24, 1000000000000000.0), (1e-16, 1e-09), true)
            }
            Self::Viscosity => entry("viscosity", " Pa s", NOT_NEGATIVE, (0.0, 100000000.0), false),
            Self::Gravity => entry("gravity", " m/s^2", NOT_NEGATIVE, (0.0, 25.0), false),
            Self::Capacitance => entry("capacitance", " F", POSITIVE, (1e-11, 1e-05), true),
            Self::Resistance => entry("resistance", " ohm", POSITIVE, (100.0, 10000000000.0), true),
            Self::Coupling => entry("coupling", " N/V or N m/V", NOT_NEGATIVE, (0.0, 0.01), false),
            Self::BaseAmplitude => entry("base_amplitude", " m", NOT_NEGATIVE, (0.0, 0.02), false),
            Self::Frequency => entry("frequency", " Hz", POSITIVE, (0.1, 1000.0), true),
            Self::CeramicThickness => entry("ceramic_thickness", " m", (1e-09, 1.0), (1e-05, 0.005), true),
            Self::LossTangent => entry("loss_tangent", "", (0.0, 1.0), (0.0, 0.1), false),
        }
    }

    /// Name of the field in requests, files and error messages.
    pub const fn field(self) -> &'static str {
        self.entry().field
    }

    /// Its SI unit; empty when dimensionless.
    pub fn unit(self) -> &'static str {
        self.entry().unit.trim_start()
    }

    /// Smallest and largest value a slider should offer, in the field's unit. Wider values are accepted.
    pub const fn usual(self) -> (f64, f64) {
        self.entry().usual
    }

    /// Whether a slider over [`Self::usual`] should be logarithmic.
    pub const fn logarithmic(self) -> bool {
        self.entry().logarithmic
    }

    /// Smallest and largest accepted value, in the field's unit: anything that has the right sign and can be computed.
    pub const fn accepted(self) -> (f64, f64) {
        self.entry().accepted
    }

    /// Checks a value.
    ///
    /// # Errors
    /// [`ModelError::OutOfRange`] or [`ModelError::NotFinite`], naming the field and its range.
    pub fn check(self, value: f64) -> Result<f64, ModelError> {
        if self == Self::Resistance && value == f64::INFINITY {
            return Ok(value);
        }
        let Entry { field, unit, accepted, .. } = self.entry();
        ModelError::check(field, value, accepted, unit)
    }

    /// The one of the ten numbers that decides this dimension of a device, the others given (Eq. 8); `None` where they
    /// leave it open (see [`super::Device::from_parameters`]).
    pub const fn decided_by(self) -> Option<Parameter> {
        match self {
            Self::Viscosity => Some(Parameter::Alpha),
            Self::BaseAmplitude => Some(Parameter::Beta),
            Self::Frequency => Some(Parameter::Omega),
            Self::FluxDensity => Some(Parameter::C0),
            Self::MagnetDistance => Some(Parameter::D),
            Self::MagnetLength => Some(Parameter::H),
            Self::TipMass => Some(Parameter::Eta),
            Self::Capacitance => Some(Parameter::C),
            Self::Resistance => Some(Parameter::Kappa),
            Self::Coupling => Some(Parameter::Theta),
            _ => None,
        }
    }

    /// The dimension of this field name.
    pub fn named(field: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|dimension| dimension.field() == field)
    }
}
