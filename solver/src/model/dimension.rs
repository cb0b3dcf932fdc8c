//! A harvester in SI units: its dimensions, a row each, with what a user edits and the coordinates of SI charts need.

use super::fact::{Fact, Part, Scale, numbers};
use super::layers::Layers;
use super::materials::Ceramic;
use super::{ModelError, Parameter};

/// Accepted where zero would make no sense, and where it does.
const POSITIVE: (f64, f64) = (1e-15, 1e15);
const NOT_NEGATIVE: (f64, f64) = (0.0, 1e15);

numbers! {
    /// A harvester and its excitation in SI units (Table 1 and section 3.2).
    set Device,
    /// Which dimension of a [`Device`].
    named by Dimension

    FluxDensity flux_density ["T"] = 1.1,
    "Residual flux density of the magnets." {
        symbol: "ρ", name: "Flux density", title: "residual flux density", part: Part::Magnets,
        range: NOT_NEGATIVE, usual: (0.0, 1.5), shown: ("T", 1.0),
    }
    Permeability permeability ["H/m"] = 1.256e-6,
    "Permeability of the air between them." {
        symbol: "μ", name: "Permeability", title: "permeability of air", part: Part::Magnets, order: 1,
        range: POSITIVE, usual: (1.2e-6, 1.3e-6), shown: ("µH/m", 1e6),
    }
    MagnetLength magnet_length ["m"] = 0.002,
    "Length of each magnet." {
        symbol: "H", name: "Length", title: "length of a magnet", part: Part::Magnets,
        range: POSITIVE, usual: (5e-4, 0.02), shown: ("mm", 1e3),
    }
    MagnetRadius magnet_radius ["m"] = 0.004,
    "Radius of each magnet." {
        symbol: "R", name: "Radius", title: "radius of a magnet", part: Part::Magnets,
        range: NOT_NEGATIVE, usual: (5e-4, 0.02), shown: ("mm", 1e3),
    }
    MagnetArea magnet_area ["m^2"] = 5.0265e-5,
    "Common area of the magnets." {
        symbol: "S", name: "Area", title: "common area of the magnets", part: Part::Magnets,
        range: NOT_NEGATIVE, usual: (1e-7, 1.3e-3), scale: Scale::Logarithmic, shown: ("mm²", 1e6),
    }
    + /// Whether the magnets repel (as in the paper) or attract.
      repelling: bool = true;
    MagnetDistance magnet_distance ["m"] = 0.3385,
    "Distance of the magnets before the beam sags." {
        symbol: "D", name: "Distance", title: "distance of the magnets", part: Part::Magnets, order: -1,
        range: POSITIVE, usual: (5e-3, 1.0), scale: Scale::Logarithmic, shown: ("mm", 1e3),
    }
    BeamLength beam_length ["m"] = 0.48,
    "Length of the cantilever." {
        symbol: "L", name: "Length", title: "length of the cantilever", part: Part::Beam,
        range: POSITIVE, usual: (0.02, 1.0), scale: Scale::Logarithmic, shown: ("mm", 1e3),
    }
    BeamMass beam_mass ["kg"] = 2.56e-2,
    "Mass of the cantilever." {
        symbol: "m_b", name: "Mass", title: "mass of the cantilever", part: Part::Beam,
        range: POSITIVE, usual: (1e-4, 1.0), scale: Scale::Logarithmic, shown: ("g", 1e3),
    }
    TipMass tip_mass ["kg"] = 5.12e-4,
    "Mass at the tip, magnet included." {
        symbol: "m_t", name: "Tip mass", title: "mass at the tip", part: Part::Beam,
        range: NOT_NEGATIVE, usual: (0.0, 0.1), scale: Scale::LogarithmicFrom(1e-5), shown: ("g", 1e3),
    }
    YoungsModulus youngs_modulus ["Pa"] = 3.81e10,
    "Young's modulus of the beam." {
        symbol: "E", name: "Modulus", title: "Young's modulus", part: Part::Beam,
        range: POSITIVE, usual: (1e9, 4e11), scale: Scale::Logarithmic, shown: ("GPa", 1e-9),
    }
    SecondMoment second_moment ["m^4"] = 3.6e-13,
    "Second moment of area of its section." {
        symbol: "I", name: "2nd moment", title: "second moment of area", part: Part::Beam,
        range: (1e-24, 1e15), usual: (1e-16, 1e-9), scale: Scale::Logarithmic, shown: ("mm⁴", 1e12),
    }
    Viscosity viscosity ["Pa s"] = 1.7310e7,
    "Kelvin-Voigt viscosity of the beam: its damping." {
        symbol: "Λ", name: "Viscosity", title: "viscosity", part: Part::Beam,
        range: NOT_NEGATIVE, usual: (0.0, 1e8), scale: Scale::LogarithmicFrom(1e4), shown: ("MPa s", 1e-6),
    }
    TipInertia tip_inertia ["kg m^2"] = 0.0,
    "Rotary inertia of the mass at the tip about its own centre." {
        symbol: "J", name: "Tip inertia", title: "rotary inertia of the tip", part: Part::Beam,
        range: NOT_NEGATIVE, usual: (0.0, 1e-3), scale: Scale::LogarithmicFrom(1e-9), shown: ("g cm²", 1e7),
    }
    TipOffset tip_offset ["m"] = 0.0,
    "Distance of its centre from the end of the beam, outwards." {
        symbol: "e", name: "Tip offset", title: "offset of the tip's centre", part: Part::Beam,
        range: (-1e3, 1e3), usual: (-0.02, 0.05), shown: ("mm", 1e3),
    }
    AirDamping air_damping ["1/s"] = 0.0,
    "Damping by the air: its force on a mass over the mass's momentum." {
        symbol: "a_m", name: "Air damping", title: "damping by the air", part: Part::Beam,
        range: NOT_NEGATIVE, usual: (0.0, 100.0), scale: Scale::LogarithmicFrom(1e-2), shown: ("1/s", 1.0),
    }
    Gravity gravity ["m/s^2"]
    // As printed: standard gravity, rounded.
    = 9.8067,
    "Acceleration of gravity, which makes the beam sag." {
        symbol: "g", name: "Gravity", title: "gravity", part: Part::Beam,
        range: NOT_NEGATIVE, usual: (0.0, 25.0), shown: ("m/s²", 1.0),
    }
    Capacitance capacitance ["F"] = 5.9531e-8,
    "Capacitance C_eq of the ceramic." {
        symbol: "C_eq", name: "Capacitance", title: "capacitance", part: Part::Circuit,
        range: POSITIVE, usual: (1e-11, 1e-5), scale: Scale::Logarithmic, shown: ("nF", 1e9),
    }
    /// Infinite, and null in JSON, for an open circuit.
    #[serde(with = "super::open_circuit")]
    Resistance resistance ["ohm"] = 7_631_732.0,
    "Load resistance R_eq." {
        symbol: "R_eq", name: "Load", title: "load resistance", part: Part::Circuit, order: -1,
        range: POSITIVE, usual: (100.0, 1e10), scale: Scale::Logarithmic, shown: ("MΩ", 1e-6),
    }
    Coupling coupling ["N/V or N m/V"] = 1.1906e-5,
    "Electromechanical coupling." {
        symbol: "Θ", name: "Coupling", title: "electromechanical coupling", part: Part::Circuit,
        range: NOT_NEGATIVE, usual: (0.0, 0.01), scale: Scale::LogarithmicFrom(1e-6),
        shown: ("µN/V or µN m/V", 1e6),
    }
    BaseAmplitude base_amplitude ["m"] = 4.8e-4,
    "Amplitude of the base's motion." {
        symbol: "B", name: "Amplitude", title: "excitation amplitude", part: Part::Main, order: 1,
        range: NOT_NEGATIVE, usual: (0.0, 0.02), scale: Scale::LogarithmicFrom(1e-6), shown: ("mm", 1e3),
    }
    Frequency frequency ["Hz"]
    // That of omega = 25 follows from the others.
    = 0.0,
    "Frequency of the base's motion." {
        symbol: "f", name: "Frequency", title: "excitation frequency", part: Part::Main,
        range: POSITIVE, usual: (0.1, 1000.0), scale: Scale::Logarithmic, shown: ("Hz", 1.0),
    }
    // The paper calls it extremely thin and prints none.
    CeramicThickness ceramic_thickness ["m"] = 2e-4,
    "Thickness of the ceramic, which decides what voltage it bears." {
        name: "Thickness", title: "thickness of the ceramic", part: Part::Ceramic,
        range: (1e-9, 1.0), usual: (1e-5, 5e-3), scale: Scale::Logarithmic, shown: ("mm", 1e3),
    }
    // 0 in the paper's model.
    LossTangent loss_tangent [""] = 0.0,
    "Dielectric dissipation factor of the ceramic: a conductance beside the load." {
        symbol: "tan δ", name: "Loss", title: "dielectric loss", part: Part::Ceramic,
        range: (0.0, 1.0), usual: (0.0, 0.1), shown: ("%", 1e2),
    }
    + /// The ceramic, where one is chosen; the paper names none for its device.
      ceramic: Option<Ceramic> = None;
    + /// The layers of the beam, where it is described by them: they decide [`Layers::DECIDED`].
      #[serde(skip_serializing_if = "Option::is_none")]
      layers: Option<Layers> = None;
}

impl Default for Device {
    /// Table 1 and section 3.2, excited as in Figure 3.
    fn default() -> Self {
        Self { frequency: 25.0 / (std::f64::consts::TAU * Self::PRINTED.time_unit()), ..Self::PRINTED }
    }
}

impl Dimension {
    /// Checks a value.
    ///
    /// # Errors
    /// [`ModelError::OutOfRange`] or [`ModelError::NotFinite`], naming the field and its range.
    pub fn check(self, value: f64) -> Result<f64, ModelError> {
        if self == Self::Resistance && value == f64::INFINITY {
            return Ok(value);
        }
        let Fact { field, suffix, range, .. } = *self.fact();
        ModelError::check(field, value, range, suffix)
    }

    /// The one of the dimensionless numbers that decides this dimension of a device, the others given (Eq. 8); `None` where they
    /// leave it open (see [`Device::from_parameters`]).
    pub const fn decided_by(self) -> Option<Parameter> {
        match self {
            Self::Viscosity => Some(Parameter::Alpha),
            Self::BaseAmplitude => Some(Parameter::Beta),
            Self::Frequency => Some(Parameter::Omega),
            Self::FluxDensity => Some(Parameter::C0),
            Self::MagnetDistance => Some(Parameter::D),
            Self::MagnetLength => Some(Parameter::H),
            Self::TipMass => Some(Parameter::Eta),
            Self::TipInertia => Some(Parameter::J),
            Self::TipOffset => Some(Parameter::E),
            Self::AirDamping => Some(Parameter::Air),
            Self::Capacitance => Some(Parameter::C),
            Self::Resistance => Some(Parameter::Kappa),
            Self::Coupling => Some(Parameter::Theta),
            _ => None,
        }
    }
}
