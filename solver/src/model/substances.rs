//! What layers are made of: a small table of metals, glue and piezoelectric materials, each with its source.

use serde::Serialize;

/// Permittivity of vacuum (F/m), CODATA 2018 to six digits.
const VACUUM_PERMITTIVITY: f64 = 8.854_19e-12;

/// A material for a layer, with values typical of it; a sheet at hand may differ by some per cent.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Substance {
    /// Its name in requests and on the page.
    pub name: &'static str,
    /// Young's modulus along the beam (Pa), of a piezoelectric material at constant field.
    pub youngs_modulus: f64,
    /// Density (kg/m^3).
    pub density: f64,
    /// What makes it piezoelectric, where it is.
    pub piezoelectric: Option<Piezoelectric>,
    /// Where the values are printed.
    pub source: &'static str,
}

/// What a piezoelectric material has beside modulus and density.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Piezoelectric {
    /// Piezoelectric constant d31 (m/V).
    pub d31: f64,
    /// Permittivity eps33 at constant stress (F/m), as data sheets print it.
    pub free_permittivity: f64,
}

impl Piezoelectric {
    /// Permittivity eps33 at constant strain (F/m) of a thin layer with modulus `youngs_modulus` (Pa) that is free to
    /// contract across the beam: epsS = epsT - d31^2 E (Erturk & Inman, J. Vib. Acoust. 130, 041002, 2008).
    pub fn clamped_permittivity(&self, youngs_modulus: f64) -> f64 {
        clamped_permittivity(self.free_permittivity, self.d31, youngs_modulus)
    }
}

/// Permittivity at constant strain (F/m) from that at constant stress; see [`Piezoelectric::clamped_permittivity`].
pub fn clamped_permittivity(free_permittivity: f64, d31: f64, youngs_modulus: f64) -> f64 {
    free_permittivity - d31 * d31 * youngs_modulus
}

/// GPa and kg/m^3.
const fn elastic(name: &'static str, modulus: f64, density: f64, source: &'static str) -> Substance {
    Substance { name, youngs_modulus: modulus * 1e9, density, piezoelectric: None, source }
}

/// GPa, kg/m^3, pm/V and the relative permittivity at constant stress.
const fn piezoelectric(
    name: &'static str,
    (modulus, density): (f64, f64),
    d31: f64,
    relative: f64,
    source: &'static str,
) -> Substance {
    let free_permittivity = relative * VACUUM_PERMITTIVITY;
    let piezoelectric = Some(Piezoelectric { d31: d31 * 1e-12, free_permittivity });
    Substance { piezoelectric, ..elastic(name, modulus, density, source) }
}

/// Of the brass-reinforced bimorph of Erturk & Inman.
const BIMORPH: &str = "Erturk & Inman, Smart Mater. Struct. 18, 025009 (2009)";
const METALS: &str = "ASM Handbook 2 (1990), typical values";
/// Compliances s11 at constant field, densities, d31 and permittivities.
const MORGAN: &str = "Morgan Electro Ceramics, Technical Publication TP-226";
/// The maker's table; of two values for one ceramic the first.
const APC: &str = "APC International, Physical and piezoelectric properties of APC materials";

/// The table: metals and glue first. Of the ceramics of Table 2 those are here whose d31 the maker prints.
pub const SUBSTANCES: [Substance; 15] = [
    elastic("brass", 105.0, 9000.0, BIMORPH),
    elastic("steel", 200.0, 7850.0, METALS),
    elastic("aluminium", 69.0, 2700.0, METALS),
    elastic("epoxy", 3.0, 1150.0, "typical of unfilled epoxy glue; a data sheet gives that of a product"),
    piezoelectric("PZT-5A", (61.0, 7750.0), -171.0, 1700.0, MORGAN),
    piezoelectric("PZT-5H", (60.6, 7500.0), -274.0, 3400.0, MORGAN),
    piezoelectric("PZT-8", (87.0, 7600.0), -97.0, 1000.0, MORGAN),
    piezoelectric("PSI-5A4E", (66.0, 7800.0), -190.0, 1800.0, "Piezo Systems Inc., catalogue: PZT-5A sheets"),
    piezoelectric(
        "PVDF",
        (3.0, 1780.0),
        23.0,
        12.0,
        "Measurement Specialties, Piezo Film Sensors Technical Manual",
    ),
    piezoelectric("APC 840", (80.0, 7600.0), -125.0, 1275.0, APC),
    piezoelectric("APC 841", (76.0, 7600.0), -109.0, 1375.0, APC),
    piezoelectric("APC 850", (63.0, 7600.0), -175.0, 1900.0, APC),
    piezoelectric("APC 854", (60.0, 7600.0), -260.0, 2750.0, APC),
    piezoelectric("APC 855", (59.0, 7600.0), -276.0, 3300.0, APC),
    piezoelectric("APC 880", (90.0, 7600.0), -95.0, 1050.0, APC),
];

impl Substance {
    /// The one of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        SUBSTANCES.iter().find(|substance| substance.name == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_coupling_factors_that_the_makers_print_follow_from_the_table() {
        // k31 of TP-226 and of APC's table: d31 sqrt(E / epsT). APC prints 0.33 for 841, which its own d31 contradicts.
        for (name, printed) in [
            ("PZT-5A", 0.344),
            ("PZT-5H", 0.388),
            ("PZT-8", 0.30),
            ("APC 840", 0.35),
            ("APC 850", 0.36),
            ("APC 855", 0.40),
            ("APC 880", 0.30),
        ] {
            let substance = Substance::named(name).expect("in the table");
            let piezoelectric = substance.piezoelectric.expect("it is");
            let k31 =
                piezoelectric.d31.abs() * (substance.youngs_modulus / piezoelectric.free_permittivity).sqrt();
            assert!((k31 / printed - 1.0).abs() < 0.06, "{name}: {k31} {printed}");
            // What is clamped stores less: epsS = epsT (1 - k31^2).
            let clamped = piezoelectric.clamped_permittivity(substance.youngs_modulus);
            let expected = piezoelectric.free_permittivity * (1.0 - k31 * k31);
            assert!((clamped / expected - 1.0).abs() < 1e-12);
        }
    }
}
