//! Table 2 and the field limits of section 5.4: the piezoelectric ceramics of APC International.

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
    /// Published range of the largest alternating field (V per mil of thickness), where section 5.4 gives one.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hard_ceramics_the_paper_prefers_are_those_of_quality_factor_1000_and_more() {
        let hard: Vec<_> = TABLE_2.iter().filter(|m| m.quality_factor >= 1000.0).map(|m| m.name).collect();
        assert_eq!(hard, ["APC 841", "APC 844", "APC 880/881"]);
    }
}
