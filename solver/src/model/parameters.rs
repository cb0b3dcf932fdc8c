//! The ten dimensionless numbers of the model, their ranges, and the one place where raw input becomes valid.

use std::ops::Deref;

use serde::{Deserialize, Serialize};

use super::ModelError;

/// The ten dimensionless numbers as typed, loaded or dragged: not yet checked. Missing fields of a file or a
/// request take the paper's values.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
#[serde(default, deny_unknown_fields)]
pub struct ParameterSet {
    /// Kelvin-Voigt damping (dimensionless).
    pub alpha: f64,
    /// Excitation amplitude B/L (dimensionless).
    pub beta: f64,
    /// Excitation angular frequency (dimensionless).
    pub omega: f64,
    /// Magnet strength (dimensionless); negative when the magnets attract, 0 without magnets.
    pub c0: f64,
    /// Gap between the magnets after the sag under gravity, in beam lengths.
    pub d: f64,
    /// Length of a magnet, in beam lengths.
    pub h: f64,
    /// Tip mass over beam mass (dimensionless).
    pub eta: f64,
    /// Capacitance (dimensionless, per volt squared).
    pub c: f64,
    /// Load conductance (dimensionless, per volt squared).
    pub kappa: f64,
    /// Electromechanical coupling (dimensionless, per volt).
    pub theta: f64,
}

impl Default for ParameterSet {
    /// The paper's working set (section 3.2), with its stable excitation omega = 25.
    fn default() -> Self {
        Self {
            alpha: 1e-3,
            beta: 1e-3,
            omega: 25.0,
            c0: 0.5084,
            d: 0.15,
            h: 0.004167,
            eta: 0.02,
            c: 1e-6,
            kappa: 1e-6,
            theta: 2e-4,
        }
    }
}

/// Which of the ten numbers.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin,
)]
#[serde(rename_all = "lowercase")]
pub enum Parameter {
    /// Damping.
    Alpha,
    /// Excitation amplitude.
    Beta,
    /// Excitation frequency.
    Omega,
    /// Magnet strength.
    C0,
    /// Gap.
    D,
    /// Magnet length.
    H,
    /// Tip mass ratio.
    Eta,
    /// Capacitance.
    C,
    /// Load conductance.
    Kappa,
    /// Coupling.
    Theta,
}

impl Parameter {
    /// All ten, in the order of [`ParameterSet`].
    pub const ALL: [Self; 10] = [
        Self::Alpha,
        Self::Beta,
        Self::Omega,
        Self::C0,
        Self::D,
        Self::H,
        Self::Eta,
        Self::C,
        Self::Kappa,
        Self::Theta,
    ];

    /// Name of the field in requests, files and error messages.
    pub const fn field(self) -> &'static str {
        match self {
            Self::Alpha => "alpha",
            Self::Beta => "beta",
            Self::Omega => "omega",
            Self::C0 => "c0",
            Self::D => "d",
            Self::H => "h",
            Self::Eta => "eta",
            Self::C => "c",
            Self::Kappa => "kappa",
            Self::Theta => "theta",
        }
    }

    /// Smallest and largest accepted value (dimensionless).
    pub const fn range(self) -> (f64, f64) {
        match self {
            Self::Alpha => (0.0, 0.1),
            Self::Beta => (0.0, 0.2),
            Self::Omega => (0.1, 500.0),
            Self::C0 => (-10.0, 10.0),
            // Magnets far away, as on a short beam, are merely weak.
            Self::D => (0.01, 100.0),
            Self::H => (1e-5, 1.0),
            Self::Eta => (0.0, 100.0),
            Self::C => (1e-9, 1e-2),
            Self::Kappa => (0.0, 1e-2),
            Self::Theta => (0.0, 1e-2),
        }
    }

    /// Smallest and largest value a slider should offer (dimensionless). Wider values may be accepted.
    pub const fn usual(self) -> (f64, f64) {
        match self {
            Self::D => (0.01, 2.0),
            _ => self.range(),
        }
    }

    /// The value of this number in `set`.
    pub const fn get(self, set: &ParameterSet) -> f64 {
        match self {
            Self::Alpha => set.alpha,
            Self::Beta => set.beta,
            Self::Omega => set.omega,
            Self::C0 => set.c0,
            Self::D => set.d,
            Self::H => set.h,
            Self::Eta => set.eta,
            Self::C => set.c,
            Self::Kappa => set.kappa,
            Self::Theta => set.theta,
        }
    }

    /// The place of this number in `set`, to write to.
    pub const fn get_mut(self, set: &mut ParameterSet) -> &mut f64 {
        match self {
            Self::Alpha => &mut set.alpha,
            Self::Beta => &mut set.beta,
            Self::Omega => &mut set.omega,
            Self::C0 => &mut set.c0,
            Self::D => &mut set.d,
            Self::H => &mut set.h,
            Self::Eta => &mut set.eta,
            Self::C => &mut set.c,
            Self::Kappa => &mut set.kappa,
            Self::Theta => &mut set.theta,
        }
    }
}

/// Smaller numbers (dimensionless) count as zero. A motion scaled by it still has a square that keeps all its digits, and
/// is a hundred orders of magnitude below what rounding leaves of one of the size of the gap.
pub const NEGLIGIBLE: f64 = 1e-120;

/// Ten dimensionless numbers that are finite and in range. The fields are read through [`Deref`]; there is no way
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
            let value = parameter.get_mut(&mut set);
            if value.abs() < NEGLIGIBLE {
                *value = 0.0;
            }
            ModelError::check(parameter.field(), parameter.get(&set), parameter.range(), "")?;
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
            *parameter.get_mut(&mut set) = 0.0123;
            assert_eq!(parameter.get(&set), 0.0123);
            let changed = Parameter::ALL
                .iter()
                .filter(|other| other.get(&set) != other.get(&ParameterSet::default()))
                .count();
            assert_eq!(changed, 1);
        }
    }
}
