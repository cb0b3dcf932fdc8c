//! From the dimensionless numbers back to a device in SI units, and its excitation as an acceleration.

use std::f64::consts::{PI, TAU};

use super::units::STANDARD_GRAVITY;
use super::{Device, Dimension, ElectricalScaling, ModelError, ParameterSet};

impl Device {
    /// Eq. (8), section 2.1, solved for the device: the one that has the numbers of `set` and agrees with `base` in all
    /// that they leave open.
    ///
    /// Kept are L, E, I, m_b, radius and area of the magnets, mu, g and the ceramic; solved for are Lambda, B, Omega,
    /// H, rho, D, m_t, J, e, a_m, C_eq, R_eq and Theta. The sign of c0 says whether the magnets repel; without magnets rho is 0
    /// and `base` keeps its word. No load (kappa = 0) is an infinite resistance. Layers stay where they still give what
    /// the device has.
    ///
    /// # Errors
    /// [`ModelError::OutOfRange`] or [`ModelError::NotFinite`] when a dimension comes out that is none, such as a flux
    /// density of magnets without area.
    pub fn from_parameters(
        base: &Self,
        set: &ParameterSet,
        scaling: ElectricalScaling,
    ) -> Result<Self, ModelError> {
        let (length, stiffness, time) = (base.beam_length, base.bending_stiffness(), base.time_unit());
        let electrical = scaling.factor(length, stiffness);
        let magnet_length = set.h * length;
        let reach = base.magnet_area * (base.magnet_radius + magnet_length) / magnet_length;
        let strength = (set.c0.abs() * stiffness * PI * base.permeability).sqrt();
        let mut device = Self {
            magnet_length,
            flux_density: if set.c0 == 0.0 { 0.0 } else { strength / reach },
            repelling: if set.c0 == 0.0 { base.repelling } else { set.c0 > 0.0 },
            tip_mass: set.eta * base.beam_mass,
            tip_inertia: set.j * base.beam_mass * length * length,
            tip_offset: set.e * length,
            air_damping: set.air / time,
            viscosity: set.alpha
                * length
                * (base.youngs_modulus * length * base.beam_mass / base.second_moment).sqrt(),
            capacitance: set.c / electrical,
            resistance: electrical * time / set.kappa,
            coupling: set.theta / electrical,
            base_amplitude: set.beta * length,
            frequency: set.omega / (TAU * time),
            ..*base
        };
        device.magnet_distance = set.d * length + device.sag();
        device.check()?;
        Ok(device.with_layers_that_hold())
    }

    /// What [`Self::from_parameters`] keeps of this device; all that it solves for is as in Table 1.
    #[must_use]
    pub fn left_open(&self) -> Self {
        let mut left = *self;
        for dimension in Dimension::ALL.into_iter().filter(|dimension| dimension.decided_by().is_some()) {
            *left.get_mut(dimension) = Self::default().get(dimension);
        }
        left
    }

    /// Peak of the base's acceleration, B Omega^2, in g.
    pub fn acceleration(&self) -> f64 {
        self.base_amplitude * (TAU * self.frequency).powi(2) / STANDARD_GRAVITY
    }

    /// The same device shaken with this peak of acceleration (g) at its own frequency.
    #[must_use]
    pub fn with_acceleration(&self, acceleration: f64) -> Self {
        let base_amplitude = acceleration * STANDARD_GRAVITY / (TAU * self.frequency).powi(2);
        Self { base_amplitude, ..*self }
    }

    /// What the magnets do.
    pub fn magnets(&self) -> Magnets {
        match (self.flux_density * self.magnet_area == 0.0, self.repelling) {
            (true, _) => Magnets::Absent,
            (false, true) => Magnets::Repelling,
            (false, false) => Magnets::Attracting,
        }
    }

    /// The same device with its magnets repelling, attracting or absent. Where they were absent they come back with
    /// the flux density of `base`.
    #[must_use]
    pub fn with_magnets(&self, magnets: Magnets, base: &Self) -> Self {
        let flux_density = match magnets {
            Magnets::Absent => 0.0,
            _ if self.flux_density == 0.0 => base.flux_density,
            _ => self.flux_density,
        };
        let repelling =
            if magnets == Magnets::Absent { self.repelling } else { magnets == Magnets::Repelling };
        Self { flux_density, repelling, ..*self }
    }
}

/// What a pair of magnets does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Magnets {
    /// It repels, as in the paper.
    Repelling,
    /// It attracts.
    Attracting,
    /// There is none.
    Absent,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Parameter;

    #[test]
    fn numbers_to_a_device_and_back_are_the_numbers() -> Result<(), ModelError> {
        let base = Device { beam_length: 0.1, second_moment: 7e-14, gravity: 3.7, ..Default::default() };
        for scaling in ElectricalScaling::ALL {
            for (c0, kappa, alpha) in [(0.5084, 1e-6, 1e-3), (-0.02, 3e-5, 0.0), (0.0, 0.0, 0.02)] {
                let set = ParameterSet { c0, kappa, alpha, d: 0.31, omega: 8.1, ..Default::default() };
                let device = Device::from_parameters(&base, &set, scaling)?;
                let back = device.dimensionless(scaling)?;
                for parameter in Parameter::ALL {
                    let (a, b) = (set.get(parameter), back.get(parameter));
                    assert!((a - b).abs() <= 1e-12 * a.abs(), "{parameter:?}: {a} {b}");
                }
            }
        }
        Ok(())
    }

    #[test]
    fn a_device_to_numbers_and_back_is_the_device_whatever_the_base() -> Result<(), ModelError> {
        // The base's own values of what is solved for play no role.
        let base = Device { frequency: 1.0, resistance: 5.0, flux_density: 0.1, ..Default::default() };
        for scaling in ElectricalScaling::ALL {
            for resistance in [7_631_732.0, 1e3, f64::INFINITY] {
                for repelling in [true, false] {
                    let device = Device { resistance, repelling, tip_mass: 0.0, ..Default::default() };
                    let back = Device::from_parameters(&base, &device.dimensionless(scaling)?, scaling)?;
                    for dimension in Dimension::ALL {
                        let (a, b) = (device.get(dimension), back.get(dimension));
                        assert!(a == b || (a - b).abs() <= 1e-12 * a.abs(), "{dimension:?}: {a} {b}");
                    }
                    assert_eq!(back.repelling, repelling);
                }
            }
        }
        Ok(())
    }

    #[test]
    fn the_excitation_is_an_amplitude_or_an_acceleration() {
        let device = Device::default();
        // 0.48 mm at 25/0.4543265 s = 55.0264 rad/s: 1.4534 m/s^2.
        assert!((device.acceleration() - 1.4534 / 9.80665).abs() < 1e-5, "{}", device.acceleration());
        let shaken = device.with_acceleration(0.5);
        assert!((shaken.acceleration() / 0.5 - 1.0).abs() < 1e-14);
        assert_eq!(shaken.frequency, device.frequency);
    }

    #[test]
    fn magnets_repel_attract_or_are_absent() -> Result<(), ModelError> {
        let base = Device::default();
        let absent = base.with_magnets(Magnets::Absent, &base);
        assert_eq!(absent.dimensionless(ElectricalScaling::AsPrinted)?.c0, 0.0);
        for magnets in [Magnets::Repelling, Magnets::Attracting] {
            let device = absent.with_magnets(magnets, &base);
            assert_eq!(device.magnets(), magnets);
            let c0 = device.dimensionless(ElectricalScaling::AsPrinted)?.c0;
            assert!((c0.abs() - 0.50838).abs() < 1e-5 && (c0 > 0.0) == (magnets == Magnets::Repelling));
        }
        Ok(())
    }

    #[test]
    fn an_open_circuit_survives_json_and_magnets_without_area_are_named() -> Result<(), serde_json::Error> {
        let device = Device { resistance: f64::INFINITY, ..Default::default() };
        let text = serde_json::to_string(&device)?;
        assert!(text.contains("\"resistance\":null"), "{text}");
        assert_eq!(serde_json::from_str::<Device>(&text)?, device);
        let flat = Device { magnet_area: 0.0, ..Default::default() };
        let found = Device::from_parameters(&flat, &ParameterSet::default(), ElectricalScaling::AsPrinted);
        let message = found.map_err(|error| error.to_string()).err().unwrap_or_default();
        assert!(message.starts_with("flux_density is not a finite number"), "{message}");
        Ok(())
    }
}
