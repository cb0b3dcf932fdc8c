//! The dimensionless numbers of the model, a row each, and the one place where raw input becomes valid.

use std::ops::Deref;

use super::ModelError;
use super::fact::{Fact, Part, Scale, numbers};

numbers! {
    /// The dimensionless numbers as typed, loaded or dragged: not yet checked. Missing fields of a file or a request take
    /// the paper's values.
    set ParameterSet,
    /// Which of the dimensionless numbers.
    named by Parameter

    Alpha alpha [""] = 1e-3,
    "Kelvin-Voigt damping of the beam's material: the higher a mode, the more it takes." {
        symbol: "α", name: "Damping", title: "damping", part: Part::Main,
        range: (0.0, 0.1), scale: Scale::LogarithmicFrom(1e-6),
    }
    Beta beta [""] = 1e-3,
    "Amplitude of the base's motion, in beam lengths." {
        symbol: "β", name: "Excitation", title: "excitation amplitude", part: Part::Main,
        range: (0.0, 0.2), scale: Scale::LogarithmicFrom(1e-5),
    }
    Omega omega [""] = 25.0,
    "Angular frequency of the base's motion, in units of √(EI / m_b L³)." {
        symbol: "ω", name: "Frequency", title: "excitation frequency", part: Part::Main,
        range: (0.1, 500.0), usual: (0.5, 50.0),
    }
    C0 c0 [""] = 0.5084,
    "Magnet strength: positive repels, negative attracts, 0 is no magnet." {
        symbol: "c₀", name: "Strength", title: "magnet strength", part: Part::Magnets,
        range: (-10.0, 10.0),
    }
    D d [""] = 0.15,
    "Distance of the magnets with the beam sagged but unbent by them, in beam lengths." {
        symbol: "d", name: "Gap", title: "gap", part: Part::Magnets,
        // Magnets far away, as on a short beam, are merely weak.
        range: (0.01, 100.0), usual: (0.01, 2.0), scale: Scale::Logarithmic,
    }
    H h [""] = 0.004167,
    "Length of each magnet, in beam lengths." {
        symbol: "h", name: "Length", title: "magnet length", part: Part::Magnets,
        range: (1e-5, 1.0), scale: Scale::Logarithmic,
    }
    Eta eta [""] = 0.02,
    "Mass at the tip over the mass of the beam." {
        symbol: "η", name: "Tip mass", title: "tip mass", part: Part::Beam,
        range: (0.0, 100.0), scale: Scale::LogarithmicFrom(1e-3),
    }
    J j [""] = 0.0,
    "Rotary inertia of the tip about its own centre, over that of the beam's mass at its length." {
        symbol: "j", name: "Tip inertia", title: "rotary inertia of the tip", part: Part::Beam,
        range: (0.0, 100.0), scale: Scale::LogarithmicFrom(1e-6),
    }
    E e [""] = 0.0,
    "Distance of the tip's centre from the beam's end, outwards, in beam lengths." {
        symbol: "e", name: "Tip offset", title: "offset of the tip's centre", part: Part::Beam,
        range: (-1.0, 10.0), usual: (-0.2, 0.5),
    }
    Air air [""] = 0.0,
    "Damping by the air, in proportion to mass: the lower a mode, the more it takes." {
        symbol: "a_m", name: "Air damping", title: "damping by the air", part: Part::Beam,
        range: (0.0, 10.0), scale: Scale::LogarithmicFrom(1e-4),
    }
    C c ["per V^2"] = 1e-6,
    "Capacitance of the ceramic, times one volt squared." {
        symbol: "c", name: "Capacitance", title: "capacitance", part: Part::Circuit, shown: ("V⁻²", 1.0),
        range: (1e-9, 1e-2), scale: Scale::Logarithmic,
    }
    Kappa kappa ["per V^2"] = 1e-6,
    "Conductance of the load, times one volt squared: large κ is a small resistance." {
        symbol: "κ", name: "Load", title: "load conductance", part: Part::Circuit, shown: ("V⁻²", 1.0),
        range: (0.0, 1e-2), scale: Scale::LogarithmicFrom(1e-9),
    }
    Theta theta ["per V"] = 2e-4,
    "Electromechanical coupling: bending moment of one volt." {
        symbol: "θ", name: "Coupling", title: "coupling", part: Part::Circuit, shown: ("V⁻¹", 1.0),
        range: (0.0, 1e-2), scale: Scale::LogarithmicFrom(1e-6),
    }
}

impl Default for ParameterSet {
    /// The paper's working set (section 3.2), with its stable excitation omega = 25.
    fn default() -> Self {
        Self::PRINTED
    }
}

/// Smaller numbers (dimensionless) count as zero. A motion scaled by it still has a square that keeps all its digits, and
/// is a hundred orders of magnitude below what rounding leaves of one of the size of the gap.
pub const NEGLIGIBLE: f64 = 1e-120;

/// Dimensionless numbers that are finite and in range. The fields are read through [`Deref`]; there is no way
/// to change one without passing [`Parameters::new`] again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameters(ParameterSet);

impl Parameters {
    /// Checks every number against its range. One too small to matter counts as zero: it would only make others so small
    /// that they lose their digits.
    ///
    /// # Errors
    /// [`ModelError::NotFinite`] or [`ModelError::OutOfRange`] for the first number that fails.
    pub fn new(mut set: ParameterSet) -> Result<Self, ModelError> {
        for parameter in Parameter::ALL {
            let value = set.get_mut(parameter);
            if value.abs() < NEGLIGIBLE {
                *value = 0.0;
            }
            ModelError::check(parameter.field(), set.get(parameter), parameter.range(), "")?;
        }
        Ok(Self(set))
    }

    /// Excitation period 2 pi / omega (dimensionless).
    pub fn period(&self) -> f64 {
        std::f64::consts::TAU / self.omega
    }
}

impl Deref for Parameters {
    type Target = ParameterSet;

    fn deref(&self) -> &ParameterSet {
        &self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_papers_set_is_valid() {
        assert!(Parameters::new(ParameterSet::default()).is_ok());
    }

    #[test]
    fn an_error_names_field_value_and_range() {
        let message = Parameters::new(ParameterSet { beta: 3.0, ..Default::default() })
            .expect_err("beta is far out of range")
            .to_string();
        assert_eq!(message, "beta = 3 is out of range: allowed are 0 to 0.2");
        let message = Parameters::new(ParameterSet { omega: f64::NAN, ..Default::default() })
            .expect_err("not a number")
            .to_string();
        assert_eq!(message, "omega is not a finite number: allowed are 0.1 to 500");
    }

    #[test]
    fn numbers_too_small_to_matter_are_zero() {
        let set =
            ParameterSet { beta: 5e-324, alpha: 1e-130, c0: -1e-200, theta: 1e-110, ..Default::default() };
        let valid = Parameters::new(set).expect("in range");
        assert_eq!((valid.beta, valid.alpha, valid.c0, valid.theta), (0.0, 0.0, 0.0, 1e-110));
        // Where zero is not allowed, neither is less than the smallest value.
        assert!(Parameters::new(ParameterSet { c: 1e-200, ..Default::default() }).is_err());
    }

    #[test]
    fn every_number_is_read_and_written_in_its_own_place() {
        for parameter in Parameter::ALL {
            let mut set = ParameterSet::default();
            *set.get_mut(parameter) = 0.0123;
            assert_eq!(set.get(parameter), 0.0123);
            let changed = Parameter::ALL
                .iter()
                .filter(|other| set.get(**other) != ParameterSet::default().get(**other))
                .count();
            assert_eq!(changed, 1);
            assert_eq!(serde_json::to_value(parameter).expect("a name"), parameter.field());
        }
    }
}
