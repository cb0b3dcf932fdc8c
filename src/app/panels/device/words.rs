//! How the dimensions of a device are called, written and shown.

use crate::app::text::tr;
use crate::model::{Dimension, ElectricalScaling};

/// Name, symbol, unit with its factor, what it is.
type Words = (&'static str, &'static str, &'static str, f64, &'static str);

/// The words of a dimension; the coupling's unit depends on the scaling.
pub(in crate::app) fn words(dimension: Dimension, scaling: ElectricalScaling) -> Words {
    match dimension {
        Dimension::FluxDensity => {
            (tr("Flux density"), "ρ", "T", 1.0, tr("Residual flux density of the magnets."))
        }
        Dimension::Permeability => {
            (tr("Permeability"), "μ", "µH/m", 1e6, tr("Permeability of the air between them."))
        }
        Dimension::MagnetLength => (tr("Length"), "H", "mm", 1e3, tr("Length of each magnet.")),
        Dimension::MagnetRadius => (tr("Radius"), "R", "mm", 1e3, tr("Radius of each magnet.")),
        Dimension::MagnetArea => (tr("Area"), "S", "mm²", 1e6, tr("Common area of the magnets.")),
        Dimension::MagnetDistance => {
            (tr("Distance"), "D", "mm", 1e3, tr("Distance of the magnets before the beam sags."))
        }
        Dimension::BeamLength => (tr("Length"), "L", "mm", 1e3, tr("Length of the cantilever.")),
        Dimension::BeamMass => (tr("Mass"), "m", "g", 1e3, tr("Mass of the cantilever.")),
        Dimension::TipMass => (tr("Tip mass"), "", "g", 1e3, tr("Mass at the tip, magnet included.")),
        Dimension::YoungsModulus => (tr("Modulus"), "E", "GPa", 1e-9, tr("Young's modulus of the beam.")),
        Dimension::SecondMoment => {
            (tr("2nd moment"), "I", "mm⁴", 1e12, tr("Second moment of area of its section."))
        }
        Dimension::Viscosity => {
            (tr("Viscosity"), "Λ", "MPa s", 1e-6, tr("Kelvin-Voigt viscosity of the beam: its damping."))
        }
        Dimension::Gravity => {
            (tr("Gravity"), "g", "m/s²", 1.0, tr("Acceleration of gravity, which makes the beam sag."))
        }
        Dimension::Capacitance => (tr("Capacity"), "C", "nF", 1e9, tr("Capacitance C_eq of the ceramic.")),
        Dimension::Resistance => (tr("Load"), "R", "MΩ", 1e-6, tr("Load resistance R_eq.")),
        Dimension::Coupling => {
            let unit = match scaling {
                ElectricalScaling::AsPrinted => "µN/V",
                ElectricalScaling::Consistent => "µN m/V",
            };
            (tr("Coupling"), "Θ", unit, 1e6, tr("Electromechanical coupling."))
        }
        Dimension::BaseAmplitude => (tr("Amplitude"), "B", "mm", 1e3, tr("Amplitude of the base's motion.")),
        Dimension::Frequency => (tr("Frequency"), "f", "Hz", 1.0, tr("Frequency of the base's motion.")),
        Dimension::CeramicThickness => (
            tr("Thickness"),
            "",
            "mm",
            1e3,
            tr("Thickness of the ceramic, which decides what voltage it bears."),
        ),
        Dimension::LossTangent => (
            tr("Loss"),
            "tan δ",
            "%",
            1e2,
            tr("Dielectric dissipation factor of the ceramic: a conductance beside the load."),
        ),
    }
}
