//! Table 2 and the field limits of section 5.4: the piezoelectric ceramics of APC International.

use serde::{Deserialize, Serialize};

use super::ReducedSystem;

/// One mil, a thousandth of an inch (m), the unit of thickness in the published field limits.
pub const METRES_PER_MIL: f64 = 2.54e-5;

/// A ceramic of Table 2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Trade name.
    pub name: &'static str,
    /// Mechanical quality factor (dimensionless).
    pub quality_factor: f64,
    /// Dielectric dissipation factor (dimensionless); see [`Material::dissipation_is_bound`].
    pub dissipation_factor: f64,
    /// Whether the dissipation factor is printed as an upper bound ("< 2 %").
    pub dissipation_is_bound: bool,
    /// Published range of the largest alternating field (V per mil of thickness), where section 5.4 gives one; read as a
    /// peak.
    pub field_limit: Option<(f64, f64)>,
}

const fn material(name: &'static str, quality_factor: f64, dissipation_factor: f64, bound: bool) -> Material {
    Material { name, quality_factor, dissipation_factor, dissipation_is_bound: bound, field_limit: None }
}

impl Material {
    const fn limited_to(mut self, low: f64, high: f64) -> Self {
        self.field_limit = Some((low, high));
        self
    }
}

/// Table 2, with the field limits of section 5.4 beside it (none is printed for APC 860).
pub const TABLE_2: [Material; 9] = [
    material("APC 840", 500.0, 0.006, false).limited_to(9.0, 11.0),
    material("APC 841", 1400.0, 0.004, false).limited_to(9.0, 11.0),
    material("APC 842", 600.0, 0.0045, false).limited_to(9.0, 11.0),
    material("APC 844", 1500.0, 0.004, false).limited_to(9.0, 11.0),
    material("APC 850/851", 80.0, 0.02, true).limited_to(5.0, 7.0),
    material("APC 854", 70.0, 0.02, true).limited_to(5.0, 7.0),
    material("APC 855", 65.0, 0.025, true).limited_to(5.0, 7.0),
    material("APC 860", 50.0, 0.02, true),
    material("APC 880/881", 1000.0, 0.004, false).limited_to(9.0, 11.0),
];

/// A row of Table 2, as it is stored and asked for.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin,
)]
#[serde(rename_all = "snake_case")]
pub enum Ceramic {
    /// APC 840.
    Apc840,
    /// APC 841.
    Apc841,
    /// APC 842.
    Apc842,
    /// APC 844.
    Apc844,
    /// APC 850 and 851.
    Apc850,
    /// APC 854.
    Apc854,
    /// APC 855.
    Apc855,
    /// APC 860.
    Apc860,
    /// APC 880 and 881.
    Apc880,
}

impl Ceramic {
    /// The rows of Table 2 in their order; two of them are two ceramics each.
    pub const ALL: [Self; 9] = [
        Self::Apc840,
        Self::Apc841,
        Self::Apc842,
        Self::Apc844,
        Self::Apc850,
        Self::Apc854,
        Self::Apc855,
        Self::Apc860,
        Self::Apc880,
    ];

    /// Its row.
    pub const fn material(self) -> &'static Material {
        &TABLE_2[self as usize]
    }

    /// The damping alpha that gives the mode `mode` (from 0) of `system` the mechanical quality factor of the ceramic;
    /// `None` without such a mode.
    ///
    /// A mode alone loses the part 1/Q of its energy in a radian: with the modal Kelvin-Voigt damping of Eq. (32),
    /// 1/Q = alpha (omega_n^2 - c_1 / eta_2n) / omega_n. Higher modes are then damped more, as Kelvin-Voigt damping
    /// grows with frequency. The whole beam is given the ceramic's quality factor.
    pub fn damping(self, system: &ReducedSystem, mode: usize) -> Option<f64> {
        let mode = system.modes.iter().nth(mode)?;
        let stiffness = mode.omega * mode.omega - system.c1 / mode.eta2;
        Some(mode.omega / (self.material().quality_factor * stiffness))
    }
}

/// The conductance (dimensionless) of a dielectric with the dissipation factor `loss_tangent` at `omega`, beside the
/// load: tan delta = G / (omega C).
pub fn dielectric_conductance(loss_tangent: f64, omega: f64, c: f64) -> f64 {
    loss_tangent * omega * c
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ForceLaw, ParameterSet, Parameters};

    #[test]
    fn the_hard_ceramics_the_paper_prefers_are_those_of_quality_factor_1000_and_more() {
        let hard: Vec<_> = TABLE_2.iter().filter(|m| m.quality_factor >= 1000.0).map(|m| m.name).collect();
        assert_eq!(hard, ["APC 841", "APC 844", "APC 880/881"]);
    }

    #[test]
    fn the_damping_of_a_ceramic_gives_the_mode_its_quality_factor() {
        let system = |alpha| {
            let set = ParameterSet { alpha, theta: 0.0, ..Default::default() };
            let parameters = Parameters::new(set).expect("in range");
            ReducedSystem::new(parameters, 1, ForceLaw::Quadratic).expect("a device")
        };
        for ceramic in Ceramic::ALL {
            let quality = ceramic.material().quality_factor;
            let alpha = ceramic.damping(&system(0.0), 0).expect("one mode");
            let rates = system(alpha).jacobian(0.0).complex_eigenvalues();
            let mode = rates.iter().find(|value| value.im > 0.0).expect("it oscillates");
            // Of the decay e^(-r t): Q = omega_n / (2 r).
            assert!((mode.norm() / (-2.0 * mode.re) / quality - 1.0).abs() < 1e-9, "{ceramic:?}");
        }
        assert_eq!(Ceramic::Apc880.material().name, "APC 880/881");
        assert_eq!(Ceramic::Apc841.damping(&system(0.0), 1), None);
    }
}
