//! A harvester in SI units, and its dimensionless numbers.

use std::f64::consts::{PI, TAU};

use serde::{Deserialize, Serialize};

use super::{Device, Dimension, ModelError, ParameterSet};

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

    /// Of a unit that depends on the scaling, `as printed or consistent`, the one that holds.
    pub fn unit(self, unit: &'static str) -> &'static str {
        match (unit.split_once(" or "), self) {
            (None, _) => unit,
            (Some((printed, _)), Self::AsPrinted) => printed,
            (Some((_, consistent)), Self::Consistent) => consistent,
        }
    }

    /// The factor between a circuit's number and its dimensionless one, L^2/(E I) or L/(E I), for a beam of `length`
    /// (m) and bending stiffness `stiffness` (N m^2).
    pub(super) fn factor(self, length: f64, stiffness: f64) -> f64 {
        match self {
            Self::AsPrinted => length * length / stiffness,
            Self::Consistent => length / stiffness,
        }
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

    /// Sag of the beam's end under gravity, (m_b/8 + m_t/3 + m_t e/(2 L)) g L^3/(E I) (m).
    pub fn sag(&self) -> f64 {
        let lever = self.tip_offset / (2.0 * self.beam_length);
        (self.beam_mass / 8.0 + self.tip_mass / 3.0 + self.tip_mass * lever)
            * self.gravity
            * self.beam_length.powi(3)
            / self.bending_stiffness()
    }

    /// Eq. (8), section 2.1: the dimensionless numbers, not yet checked against their ranges.
    ///
    /// # Errors
    /// As [`Self::renumbered`].
    pub fn dimensionless(&self, scaling: ElectricalScaling) -> Result<ParameterSet, ModelError> {
        self.renumbered(ParameterSet::default(), scaling)
    }

    /// Eq. (8), section 2.1: `set` with the numbers of this device, not yet checked against their ranges. What no
    /// dimension decides is kept.
    ///
    /// # Errors
    /// [`ModelError::OutOfRange`] or [`ModelError::NotFinite`] when a dimension is not positive,
    /// [`ModelError::GapClosed`] when the sag closes the gap.
    #[doc(alias = "eq-8")]
    pub fn renumbered(
        &self,
        mut set: ParameterSet,
        scaling: ElectricalScaling,
    ) -> Result<ParameterSet, ModelError> {
        self.check()?;
        let (length, stiffness, time) = (self.beam_length, self.bending_stiffness(), self.time_unit());
        if self.sag() >= self.magnet_distance {
            return Err(ModelError::GapClosed { sag: self.sag(), distance: self.magnet_distance });
        }
        let electrical = scaling.factor(length, stiffness);
        set.alpha = self.viscosity / length
            * (self.second_moment / (self.youngs_modulus * length * self.beam_mass)).sqrt();
        set.beta = self.base_amplitude / length;
        set.omega = TAU * self.frequency * time;
        set.c0 = self.magnet_strength() / stiffness;
        set.d = (self.magnet_distance - self.sag()) / length;
        set.h = self.magnet_length / length;
        set.eta = self.tip_mass / self.beam_mass;
        set.j = self.tip_inertia / (self.beam_mass * length * length);
        set.e = self.tip_offset / length;
        set.air = self.air_damping * time;
        set.c = electrical * self.capacitance;
        set.kappa = electrical * time / self.resistance;
        set.theta = electrical * self.coupling;
        Ok(set)
    }

    /// Checks every dimension against the range in which it makes sense.
    ///
    /// # Errors
    /// [`ModelError::OutOfRange`] or [`ModelError::NotFinite`] for the first that fails.
    pub fn check(&self) -> Result<(), ModelError> {
        // They decide dimensions, whose faults would be theirs.
        self.layers.map_or(Ok(()), |layers| layers.check())?;
        for dimension in Dimension::ALL {
            dimension.check(self.get(dimension))?;
        }
        Ok(())
    }
}
