//! Damping as it is measured: a ratio, or a quality factor, of each mode.
//!
//! The material takes alpha (omega_n^2 - c_1/eta_2n) of a mode's velocity and the air a_m, so that a mode alone has the
//! damping ratio zeta_n = [alpha (omega_n^2 - c_1/eta_2n) + a_m]/(2 omega_n) (Eq. 32, with the air's part): two measured
//! ratios decide both (Erturk & Inman, J. Vib. Acoust. 130, 041002, 2008, for the beam without magnets).

use super::{ModeSet, ModelError, ReducedSystem};

/// Ratios of a mode that still turns.
const RATIO: (f64, f64) = (0.0, 1.0);
/// Of a part of the damping that ought to be zero, what rounding leaves.
const ROUNDING: f64 = 1e-12;

/// The two parts of the damping, dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Damping {
    /// Of the beam's material, alpha.
    pub alpha: f64,
    /// Of the air, a_m.
    pub air: f64,
}

/// omega_n and the stiffness omega_n^2 - c_1/eta_2n that bends the beam, a pair a mode (dimensionless).
fn stiffness(modes: &ModeSet, c1: f64) -> Vec<[f64; 2]> {
    modes.iter().map(|mode| [mode.omega, mode.omega * mode.omega - c1 / mode.eta2]).collect()
}

impl ReducedSystem {
    /// The damping ratios zeta_n of its modes, each taken alone (dimensionless): what neighbours and the circuit take from
    /// it is left out.
    pub fn damping_ratios(&self) -> Vec<f64> {
        let p = &self.parameters;
        let ratio = |[omega, bending]: [f64; 2]| (p.alpha * bending + p.air) / (2.0 * omega);
        stiffness(&self.modes, self.c1).into_iter().map(ratio).collect()
    }

    /// The damping that gives its first modes these ratios: with one of them the material takes it all, two decide both
    /// parts.
    ///
    /// # Errors
    /// [`ModelError::Count`] unless there are one or two and as many modes, [`ModelError::OutOfRange`] when one is not
    /// between 0 and 1, [`ModelError::DampingRatio`] when the second is not possible beside the first.
    pub fn damping_of(&self, ratios: &[f64]) -> Result<Damping, ModelError> {
        const FIELD: &str = "damping_ratio";
        let maximum = self.modes.len().min(2);
        if !(1..=maximum).contains(&ratios.len()) {
            return Err(ModelError::Count { field: FIELD, value: ratios.len(), minimum: 1, maximum });
        }
        for (i, ratio) in ratios.iter().enumerate() {
            ModelError::check(&format!("{FIELD}[{i}]"), *ratio, RATIO, "")?;
        }
        let stiffness = stiffness(&self.modes, self.c1);
        let [omega, bending] = stiffness[0];
        let first = 2.0 * ratios[0] * omega;
        let Some(ratio) = ratios.get(1) else { return Ok(Damping { alpha: first / bending, air: 0.0 }) };
        let [higher, stiffer] = stiffness[1];
        let second = 2.0 * ratio * higher;
        let alpha = (second - first) / (stiffer - bending);
        let air = (first * stiffer - second * bending) / (stiffer - bending);
        let none = |part: f64, whole: f64| if part.abs() <= ROUNDING * whole { 0.0 } else { part };
        let (alpha, air) = (none(alpha, second / stiffer), none(air, first));
        if alpha < 0.0 || air < 0.0 {
            let (minimum, maximum) = (first / (2.0 * higher), first * stiffer / (2.0 * higher * bending));
            return Err(ModelError::DampingRatio { ratio: *ratio, first: ratios[0], minimum, maximum });
        }
        Ok(Damping { alpha, air })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ForceLaw, ParameterSet, Parameters};

    fn system(set: ParameterSet) -> Result<ReducedSystem, ModelError> {
        ReducedSystem::new(Parameters::new(set)?, 3, ForceLaw::Quadratic)
    }

    #[test]
    fn two_ratios_in_are_two_ratios_out_and_those_of_the_eigenvalues() -> Result<(), ModelError> {
        let uncoupled = ParameterSet { theta: 0.0, eta: 0.3, j: 0.02, e: 0.05, ..Default::default() };
        // Repelling magnets, none, attracting ones.
        for c0 in [0.5084, 0.0, -0.02] {
            let set = ParameterSet { c0, ..uncoupled };
            for ratios in [[0.01, 0.012], [0.027, 0.02], [1e-4, 2e-4]] {
                let Damping { alpha, air } = system(set)?.damping_of(&ratios)?;
                let found = system(ParameterSet { alpha, air, ..set })?;
                for (out, ratio) in found.damping_ratios().into_iter().zip(ratios) {
                    assert!((out / ratio - 1.0).abs() < 1e-10, "{c0} {ratios:?}: {out}");
                }
                if c0 == 0.0 {
                    // Without a magnet the modes are not coupled: an eigenvalue is -zeta omega + i ...
                    let eigenvalues = found.jacobian(0.0).complex_eigenvalues();
                    for ratio in ratios {
                        let nearest = eigenvalues
                            .iter()
                            .map(|value| (-value.re / value.norm() / ratio - 1.0).abs())
                            .fold(f64::INFINITY, f64::min);
                        assert!(nearest < 1e-8, "{ratios:?}: {nearest}");
                    }
                }
            }
        }
        Ok(())
    }

    #[test]
    fn one_ratio_is_the_materials_and_the_ends_of_the_possible_are_one_part_alone() -> Result<(), ModelError>
    {
        let plain = system(ParameterSet::default())?;
        let Damping { alpha, air } = plain.damping_of(&[0.01])?;
        let material = system(ParameterSet { alpha, ..Default::default() })?.damping_ratios();
        assert!((material[0] / 0.01 - 1.0).abs() < 1e-12 && air == 0.0);
        let found = plain.damping_of(&material[..2])?;
        assert!((found.alpha / alpha - 1.0).abs() < 1e-12 && found.air == 0.0, "{found:?}");
        let breeze = system(ParameterSet { alpha: 0.0, air: 0.08, ..Default::default() })?.damping_ratios();
        let found = plain.damping_of(&breeze[..2])?;
        assert!((found.air / 0.08 - 1.0).abs() < 1e-12 && found.alpha == 0.0, "{found:?}");
        let wrong = |ratios: &[f64]| plain.damping_of(ratios).map_err(|error| error.to_string()).err();
        let message = wrong(&[0.01, 0.9]).unwrap_or_default();
        assert!(
            message.starts_with("a damping ratio of 0.9 in mode 2 is not possible beside 0.01 in mode 1"),
            "{message}"
        );
        assert!(wrong(&[0.01, 1e-4]).is_some() && wrong(&[-0.1]).is_some() && wrong(&[]).is_some());
        assert_eq!(
            wrong(&[1.5]).as_deref(),
            Some("damping_ratio[0] = 1.5 is out of range: allowed are 0 to 1")
        );
        Ok(())
    }
}
