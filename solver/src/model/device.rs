//! A harvester in SI units, and its dimensionless numbers.

use std::f64::consts::{PI, TAU};

use serde::{Deserialize, Serialize};

use super::materials::Ceramic;
use super::{Dimension, ModelError, ParameterSet};

/// How the circuit's numbers are made dimensionless.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin,
)]
#[serde(rename_all = "snake_case")]
pub enum ElectricalScaling {
    /// As the paper's Eq. (8) prints it, with L^2; gives the paper's numbers from the paper's device.
    #[default]
    AsPrinted,
    /// With one factor L less, as a moment Theta V with Theta in N m/V demands; right for a device of one's own.
    Consistent,
}

impl ElectricalScaling {
    /// Both.
    pub const ALL: [Self; 2] = [Self::AsPrinted, Self::Consistent];

    /// The factor between a circuit's number and its dimensionless one, L^2/(E I) or L/(E I), for a beam of `length`
    /// (m) and bending stiffness `stiffness` (N m^2).
    pub(super) fn factor(self, length: f64, stiffness: f64) -> f64 {
        match self {
            Self::AsPrinted => length * length / stiffness,
            Self::Consistent => length / stiffness,
        }
    }
}

/// A harvester and its excitation in SI units (Table 1 and section 3.2).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
#[serde(default, deny_unknown_fields)]
pub struct Device {
    /// Residual flux density rho (T).
    pub flux_density: f64,
    /// Permeability of air mu (H/m).
    pub permeability: f64,
    /// Length H of each cylindrical magnet (m).
    pub magnet_length: f64,
    /// Radius R of each cylindrical magnet (m).
    pub magnet_radius: f64,
    /// Common area S of the magnets (m^2).
    pub magnet_area: f64,
    /// Whether the magnets repel (as in the paper) or attract.
    pub repelling: bool,
    /// Distance D of the magnets before the beam sags (m).
    pub magnet_distance: f64,
    /// Length L of the cantilever (m).
    pub beam_length: f64,
    /// Mass m_b of the cantilever (kg).
    pub beam_mass: f64,
    /// Mass m_t at the tip, magnet included (kg).
    pub tip_mass: f64,
    /// Young's modulus E (Pa).
    pub youngs_modulus: f64,
    /// Second moment of area I (m^4).
    pub second_moment: f64,
    /// Kelvin-Voigt viscosity Lambda (Pa s).
    pub viscosity: f64,
    /// Acceleration of gravity g (m/s^2).
    pub gravity: f64,
    /// Capacitance C_eq (F).
    pub capacitance: f64,
    /// Load resistance R_eq (ohm); infinite, and null in JSON, for an open circuit.
    #[serde(with = "super::open_circuit")]
    pub resistance: f64,
    /// Electromechanical coupling Theta (N/V as printed, N m/V consistently).
    pub coupling: f64,
    /// Amplitude B of the base motion (m).
    pub base_amplitude: f64,
    /// Frequency Omega/(2 pi) of the base motion (Hz).
    pub frequency: f64,
    /// Thickness of the ceramic layer (m), which decides what voltage it bears. The paper calls it extremely thin and
    /// prints none.
    pub ceramic_thickness: f64,
    /// Dielectric dissipation factor tan delta of the ceramic (dimensionless); 0 in the paper's model.
    pub loss_tangent: f64,
    /// The ceramic, where one is chosen; the paper names none for its device.
    pub ceramic: Option<Ceramic>,
}

impl Default for Device {
    /// Table 1 and section 3.2, excited as in Figure 3.
    fn default() -> Self {
        let mut device = Self {
            flux_density: 1.1,
            permeability: 1.256e-6,
            magnet_length: 0.002,
            magnet_radius: 0.004,
            magnet_area: 5.0265e-5,
            repelling: true,
            magnet_distance: 0.3385,
            beam_length: 0.48,
            beam_mass: 2.56e-2,
            tip_mass: 5.12e-4,
            youngs_modulus: 3.81e10,
            second_moment: 3.6e-13,
            viscosity: 1.7310e7,
            // As printed: standard gravity, rounded.
            gravity: 9.8067,
            capacitance: 5.9531e-8,
            resistance: 7_631_732.0,
            coupling: 1.1906e-5,
            base_amplitude: 4.8e-4,
            frequency: 0.0,
            ceramic_thickness: 2e-4,
            loss_tangent: 0.0,
            ceramic: None,
        };
        device.frequency = 25.0 / (TAU * device.time_unit());
        device
    }
}

impl Device {
    /// sqrt(m_b L^3 / (E I)), the model's unit of time (s).
    pub fn time_unit(&self) -> f64 {
        (self.beam_mass * self.beam_length.powi(3) / self.bending_stiffness()).sqrt()
    }

    /// E I (N m^2).
    pub fn bending_stiffness(&self) -> f64 {
        self.youngs_modulus * self.second_moment
    }

    /// Eq. (1), section 2.1: force between the magnets at distance `distance` (m), in newtons, positive when they
    /// repel.
    #[doc(alias = "eq-1")]
    pub fn magnet_force(&self, distance: f64) -> f64 {
        let h = self.magnet_length;
        let shape = distance.powi(-2) + (distance + 2.0 * h).powi(-2) - 2.0 * (distance + h).powi(-2);
        self.magnet_strength() * shape
    }

    /// The factor before the bracket of Eq. (1) (N m^2), negative for attracting magnets.
    fn magnet_strength(&self) -> f64 {
        let (h, r) = (self.magnet_length, self.magnet_radius);
        let strength =
            (self.flux_density * self.magnet_area * (r + h) / h).powi(2) / (PI * self.permeability);
        if self.repelling { strength } else { -strength }
    }

    /// The load resistance (ohm) that has the dimensionless conductance `kappa` in the printed scaling of Eq. (8);
    /// `None` for an open circuit.
    pub fn resistance_of(&self, kappa: f64) -> Option<f64> {
        let resistance = self.beam_length.powi(2) * self.time_unit() / (self.bending_stiffness() * kappa);
        (kappa > 0.0).then_some(resistance)
    }

    /// Sag of the tip under gravity, (m_b/8 + m_t/3) g L^3/(E I) (m).
    pub fn sag(&self) -> f64 {
        (self.beam_mass / 8.0 + self.tip_mass / 3.0) * self.gravity * self.beam_length.powi(3)
            / self.bending_stiffness()
    }

    /// Eq. (8), section 2.1: the ten dimensionless numbers, not yet checked against their ranges.
    ///
    /// # Errors
    /// [`ModelError::OutOfRange`] or [`ModelError::NotFinite`] when a dimension is not positive,
    /// [`ModelError::GapClosed`] when the sag closes the gap.
    #[doc(alias = "eq-8")]
    pub fn dimensionless(&self, scaling: ElectricalScaling) -> Result<ParameterSet, ModelError> {
        self.check()?;
        let (length, stiffness, time) = (self.beam_length, self.bending_stiffness(), self.time_unit());
        if self.sag() >= self.magnet_distance {
            return Err(ModelError::GapClosed { sag: self.sag(), distance: self.magnet_distance });
        }
        let electrical = scaling.factor(length, stiffness);
        Ok(ParameterSet {
            alpha: self.viscosity / length
                * (self.second_moment / (self.youngs_modulus * length * self.beam_mass)).sqrt(),
            beta: self.base_amplitude / length,
            omega: TAU * self.frequency * time,
            c0: self.magnet_strength() / stiffness,
            d: (self.magnet_distance - self.sag()) / length,
            h: self.magnet_length / length,
            eta: self.tip_mass / self.beam_mass,
            c: electrical * self.capacitance,
            kappa: electrical * time / self.resistance,
            theta: electrical * self.coupling,
        })
    }

    /// Checks every dimension against the range in which it makes sense.
    ///
    /// # Errors
    /// [`ModelError::OutOfRange`] or [`ModelError::NotFinite`] for the first that fails.
    pub fn check(&self) -> Result<(), ModelError> {
        for dimension in Dimension::ALL {
            dimension.check(self.get(dimension))?;
        }
        Ok(())
    }

    /// The value of a dimension, in its field's unit.
    pub const fn get(&self, dimension: Dimension) -> f64 {
        match dimension {
            Dimension::FluxDensity => self.flux_density,
            Dimension::Permeability => self.permeability,
            Dimension::MagnetLength => self.magnet_length,
            Dimension::MagnetRadius => self.magnet_radius,
            Dimension::MagnetArea => self.magnet_area,
            Dimension::MagnetDistance => self.magnet_distance,
            Dimension::BeamLength => self.beam_length,
            Dimension::BeamMass => self.beam_mass,
            Dimension::TipMass => self.tip_mass,
            Dimension::YoungsModulus => self.youngs_modulus,
            Dimension::SecondMoment => self.second_moment,
            Dimension::Viscosity => self.viscosity,
            Dimension::Gravity => self.gravity,
            Dimension::Capacitance => self.capacitance,
            Dimension::Resistance => self.resistance,
            Dimension::Coupling => self.coupling,
            Dimension::BaseAmplitude => self.base_amplitude,
            Dimension::Frequency => self.frequency,
            Dimension::CeramicThickness => self.ceramic_thickness,
            Dimension::LossTangent => self.loss_tangent,
        }
    }

    /// The place of a dimension, to write to.
    pub const fn get_mut(&mut self, dimension: Dimension) -> &mut f64 {
        match dimension {
            Dimension::FluxDensity => &mut self.flux_density,
            Dimension::Permeability => &mut self.permeability,
            Dimension::MagnetLength => &mut self.magnet_length,
            Dimension::MagnetRadius => &mut self.magnet_radius,
            Dimension::MagnetArea => &mut self.magnet_area,
            Dimension::MagnetDistance => &mut self.magnet_distance,
            Dimension::BeamLength => &mut self.beam_length,
            Dimension::BeamMass => &mut self.beam_mass,
            Dimension::TipMass => &mut self.tip_mass,
            Dimension::YoungsModulus => &mut self.youngs_modulus,
            Dimension::SecondMoment => &mut self.second_moment,
            Dimension::Viscosity => &mut self.viscosity,
            Dimension::Gravity => &mut self.gravity,
            Dimension::Capacitance => &mut self.capacitance,
            Dimension::Resistance => &mut self.resistance,
            Dimension::Coupling => &mut self.coupling,
            Dimension::BaseAmplitude => &mut self.base_amplitude,
            Dimension::Frequency => &mut self.frequency,
            Dimension::CeramicThickness => &mut self.ceramic_thickness,
            Dimension::LossTangent => &mut self.loss_tangent,
        }
    }
}
