//! A scenario as a plant that delivers watts: its units, its load, and the dielectric loss beside the load.

use super::DesignError;
use crate::dynamics::attractors::dielectric::{WithLoss, reach_with_loss};
use crate::dynamics::{Effort, IntegrationError, Measures, Reached, reach};
use crate::model::materials::dielectric_conductance;
use crate::model::{Along, ModelError, Parameter, ParameterSet, ReducedSystem, Shaking, Units};
use crate::scenario::Scenario;
use crate::theory::Resonance;
use crate::theory::spectrum::frequencies;

/// A scenario with its SI units and losses.
#[derive(Debug, Clone, PartialEq)]
pub struct Plant {
    /// The scenario whose kappa is the whole conductance: the load and, where the device has a loss tangent, the
    /// dielectric loss beside it, at the scenario's own frequency until the motion's is known.
    pub scenario: Scenario,
    /// Conductance of the load alone (dimensionless).
    pub load: f64,
    /// Conductance of the dielectric loss (dimensionless).
    pub leakage: f64,
    /// SI units.
    pub units: Units,
    /// What of the base's motion stays at other frequencies, and what the dielectric loss does there.
    pub along: Along,
}

impl Plant {
    /// The plant of `scenario`, whose kappa is the load.
    ///
    /// # Errors
    /// [`ModelError`], naming what is out of range.
    pub fn new(scenario: &Scenario) -> Result<Self, ModelError> {
        let ParameterSet { omega, c, kappa, .. } = scenario.parameters;
        let dielectric = dielectric_conductance(scenario.base().loss_tangent, 1.0, c);
        let along = Along { shaking: Shaking::Amplitude, dielectric };
        Self::with(scenario, kappa, dielectric * omega, along)
    }

    /// The same plant with a rule for what of the base's motion stays when the frequency changes.
    #[must_use]
    pub fn shaken(self, shaking: Shaking) -> Self {
        Self { along: Along { shaking, ..self.along }, ..self }
    }

    /// Amplitude beta of the base at `omega` (dimensionless).
    pub fn beta_at(&self, omega: f64) -> f64 {
        self.along.at(&self.scenario.parameters, Parameter::Omega, omega).beta
    }

    fn with(scenario: &Scenario, load: f64, leakage: f64, along: Along) -> Result<Self, ModelError> {
        let mut scenario = scenario.clone();
        scenario.parameters.kappa = load + leakage;
        scenario.validate()?;
        let units = scenario.units();
        Ok(Self { scenario, load, leakage, units, along })
    }

    /// The motion that a start of `system`, one of this plant, leads to as `reach` says, with the dielectric loss at its own
    /// frequency, and the plant with that loss.
    ///
    /// # Errors
    /// As [`reach_with_loss`].
    pub fn with_loss(
        &self,
        system: &ReducedSystem,
        reach: &dyn Fn(&ReducedSystem) -> Result<Reached, IntegrationError>,
    ) -> Result<(Self, WithLoss), DesignError> {
        let found = reach_with_loss(system, self.along, reach)?;
        let kappa = found.system.parameters.kappa;
        Ok((Self::with(&self.scenario, self.load, kappa - self.load, self.along)?, found))
    }

    /// The same for the start in `initial` (length 2N + 1), one sample of many, which is not held against others.
    ///
    /// # Errors
    /// As [`reach_with_loss`].
    pub fn reach(&self, system: &ReducedSystem, initial: &[f64]) -> Result<(Self, WithLoss), DesignError> {
        self.with_loss(system, &|system| reach(system, initial, Effort::cell()))
    }

    /// The same plant with the dielectric loss of the voltage that grows where the tongue of `resonance` opens: at half the
    /// tongue's frequency, whatever the frequency of the scenario. Of a combination that is the mean of its two lines.
    ///
    /// # Errors
    /// [`DesignError`] where the frequencies of the device cannot be computed.
    pub fn in_tongue(&self, resonance: Resonance) -> Result<Self, DesignError> {
        if self.along.dielectric == 0.0 {
            return Ok(self.clone());
        }
        let lossless = Self::with(&self.scenario, self.load, 0.0, self.along)?;
        let frequencies = frequencies(&lossless.system()?)?;
        let (i, j) = resonance.pair();
        let (Some(a), Some(b)) = (frequencies.get(i), frequencies.get(j)) else { return Ok(self.clone()) };
        Ok(Self::with(&self.scenario, self.load, self.along.dielectric * 0.5 * (a + b), self.along)?)
    }

    /// The same plant with a load of `resistance` (ohm).
    ///
    /// # Errors
    /// [`ModelError`] when the conductance is out of range.
    pub fn with_resistance(&self, resistance: f64) -> Result<Self, ModelError> {
        Self::with(&self.scenario, self.conductance(resistance), self.leakage, self.along)
    }

    /// Dimensionless conductance of a resistance (ohm), and the other way round: (1 ohm)^-1 of the one is the other.
    pub fn conductance(&self, resistance: f64) -> f64 {
        1.0 / (self.units.power * resistance)
    }

    /// Resistance of the load (ohm), infinite without one.
    pub fn resistance(&self) -> f64 {
        1.0 / (self.units.power * self.load)
    }

    /// The system that is computed.
    ///
    /// # Errors
    /// As [`ReducedSystem::new`].
    pub fn system(&self) -> Result<ReducedSystem, ModelError> {
        self.scenario.model.system(self.scenario.parameters)
    }

    /// The linear device that it is compared with: the same one without its magnets (c0 = 0).
    ///
    /// # Errors
    /// As [`ReducedSystem::new`].
    pub fn without_magnets(&self) -> Result<ReducedSystem, ModelError> {
        let set = ParameterSet { c0: 0.0, ..self.scenario.parameters };
        self.scenario.model.system(set)
    }

    /// Mean power in the load (W), V^2/R_eq, at a root mean square voltage (V).
    pub fn watts(&self, v_rms: f64) -> f64 {
        self.units.watts(self.load * v_rms * v_rms)
    }

    /// The numbers of a motion in SI units: its power in the load (W), its tip in mm.
    pub fn in_si(&self, measures: &Measures) -> Measures {
        let (low, high) = measures.tip;
        let tip = (self.units.millimetres(low), self.units.millimetres(high));
        Measures { power: self.watts(measures.v_rms), tip, ..*measures }
    }

    /// Distance s0 of the magnets at rest (beam lengths); `None` without magnets, which cannot touch.
    pub fn gap(system: &ReducedSystem) -> Option<f64> {
        (system.parameters.c0 != 0.0).then_some(system.equilibrium.gap)
    }
}
