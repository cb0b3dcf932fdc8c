//! Names and symbols of the ten numbers, as plots and choices write them.

use crate::app::text::tr;
use crate::model::Parameter;

/// The parameters that can be swept, with their symbols.
pub(super) const PARAMETERS: [(Parameter, &str); 10] = [
    (Parameter::Omega, "ω"),
    (Parameter::Beta, "β"),
    (Parameter::Alpha, "α"),
    (Parameter::D, "d"),
    (Parameter::C0, "c₀"),
    (Parameter::H, "h"),
    (Parameter::Eta, "η"),
    (Parameter::C, "c"),
    (Parameter::Kappa, "κ"),
    (Parameter::Theta, "θ"),
];
/// The symbol of a parameter, and its name as an axis title.
pub(super) fn title(parameter: Parameter) -> (&'static str, &'static str) {
    let name = match parameter {
        Parameter::Alpha => tr("damping"),
        Parameter::Beta => tr("excitation amplitude"),
        Parameter::Omega => tr("excitation frequency"),
        Parameter::C0 => tr("magnet strength"),
        Parameter::D => tr("gap"),
        Parameter::H => tr("magnet length"),
        Parameter::Eta => tr("tip mass"),
        Parameter::C => tr("capacitance"),
        Parameter::Kappa => tr("load conductance"),
        Parameter::Theta => tr("coupling"),
    };
    let symbol = PARAMETERS.iter().find(|(other, _)| *other == parameter).map_or("", |(_, symbol)| symbol);
    (name, symbol)
}
