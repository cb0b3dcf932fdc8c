//! What of the base's motion stays when its frequency changes.

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

impl Shaking {
    /// `set` with `parameter` at `value`, shaken as before.
    pub fn at(self, set: &ParameterSet, parameter: Parameter, value: f64) -> ParameterSet {
        let mut moved = *set;
        *moved.get_mut(parameter) = value;
        if self == Self::Acceleration && parameter == Parameter::Omega {
            moved.beta = set.beta * (set.omega / value).powi(2);
        }
        moved
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_acceleration_stays_where_it_is_held() {
        let set = ParameterSet { omega: 8.0, beta: 0.01, ..Default::default() };
        let force = |set: ParameterSet| set.beta * set.omega * set.omega;
        let there = Shaking::Acceleration.at(&set, Parameter::Omega, 4.0);
        assert!(there.omega == 4.0 && (force(there) / force(set) - 1.0).abs() < 1e-15);
        assert_eq!(Shaking::Amplitude.at(&set, Parameter::Omega, 4.0).beta, 0.01);
        assert_eq!(Shaking::Acceleration.at(&set, Parameter::Alpha, 0.02).beta, 0.01);
    }
}
