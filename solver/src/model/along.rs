//! What else changes of a device when one of its numbers is moved.

use serde::{Deserialize, Serialize};

use super::{Parameter, ParameterSet};

/// How the base is shaken while a number of the device changes.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin,
)]
#[serde(rename_all = "lowercase")]
pub enum Shaking {
    /// With the same amplitude, beta.
    #[default]
    Amplitude,
    /// With the same amplitude of acceleration, beta omega^2.
    Acceleration,
}

/// What follows the frequency when omega is moved.
#[derive(Debug, Clone, Copy, PartialEq, Default, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Along {
    /// What of the base's motion stays.
    pub shaking: Shaking,
    /// Conductance over omega of the dielectric (dimensionless), which kappa contains at its own omega: tan delta c.
    pub dielectric: f64,
}

impl From<Shaking> for Along {
    fn from(shaking: Shaking) -> Self {
        Self { shaking, dielectric: 0.0 }
    }
}

impl Along {
    /// `set` with `parameter` at `value`, and with what follows it.
    pub fn at(self, set: &ParameterSet, parameter: Parameter, value: f64) -> ParameterSet {
        let mut moved = *set;
        *moved.get_mut(parameter) = value;
        if parameter == Parameter::Omega {
            if self.shaking == Shaking::Acceleration {
                moved.beta = set.beta * (set.omega / value).powi(2);
            }
            moved.kappa = self.with_line_at(set, value).kappa;
        }
        moved
    }

    /// `set`, whose kappa contains the dielectric's conductance at its own omega, with that of a motion whose voltage has its
    /// largest line at `line` (dimensionless).
    pub fn with_line_at(self, set: &ParameterSet, line: f64) -> ParameterSet {
        // Rounding takes no conductance below the dielectric's own.
        let load = (set.kappa - self.dielectric * set.omega).max(0.0);
        let kappa = if self.dielectric > 0.0 { load + self.dielectric * line } else { set.kappa };
        ParameterSet { kappa, ..*set }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set() -> ParameterSet {
        ParameterSet { omega: 8.0, beta: 0.01, kappa: 0.6, ..Default::default() }
    }

    #[test]
    fn the_acceleration_stays_where_it_is_held() {
        let force = |set: ParameterSet| set.beta * set.omega * set.omega;
        let there = Along::from(Shaking::Acceleration).at(&set(), Parameter::Omega, 4.0);
        assert!(there.omega == 4.0 && (force(there) / force(set()) - 1.0).abs() < 1e-15);
        let amplitude = Along::from(Shaking::Amplitude);
        assert_eq!(amplitude.at(&set(), Parameter::Omega, 4.0), ParameterSet { omega: 4.0, ..set() });
        assert_eq!(Along::from(Shaking::Acceleration).at(&set(), Parameter::Alpha, 0.02).beta, 0.01);
    }

    #[test]
    fn the_dielectric_s_conductance_follows_the_frequency_and_the_load_s_stays() {
        let along = Along { dielectric: 0.05, ..Along::default() };
        // 0.2 is the load, 0.4 the dielectric at omega 8.
        assert!((along.at(&set(), Parameter::Omega, 4.0).kappa - 0.4).abs() < 1e-15);
        assert!((along.with_line_at(&set(), 16.0).kappa - 1.0).abs() < 1e-15);
        assert_eq!(along.at(&set(), Parameter::C, 3.0).kappa, set().kappa);
    }
}
