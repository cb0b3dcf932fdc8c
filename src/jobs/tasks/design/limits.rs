//! Limits requests: what the motion reached asks of the device, against what it bears.

use serde::{Deserialize, Serialize};

use crate::jobs::RequestError;
use crate::jobs::design::Plant;
use crate::jobs::design::harvest::lasting;
use crate::model::limits::{Check, Demand, Standing};
use crate::model::{Limits, ModelError};
use crate::scenario::Scenario;

/// Chosen limits; those not given are the device's own.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ChosenLimits {
    /// Lower and upper end of the largest voltage (V).
    pub voltage: Option<(f64, f64)>,
    /// Part of the gap that the tip may close.
    pub gap: Option<f64>,
    /// Largest tip displacement, in beam lengths.
    pub deflection: Option<f64>,
    /// Largest slope at the tip (rad).
    pub slope: Option<f64>,
}

/// The limits checked.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LimitsAnswer {
    /// The motion reached.
    pub motion: String,
    /// What it asks of the device; null when it ended.
    pub demand: Option<Demand>,
    /// Every limit that applies, the sag under gravity last.
    pub checks: Vec<Check>,
    /// Whether the motion lasts and keeps all of them.
    pub safe: bool,
}

impl ChosenLimits {
    /// The limits for the device of `scenario`.
    ///
    /// # Errors
    /// As [`Limits::validate`].
    pub(super) fn complete(&self, scenario: &Scenario) -> Result<Limits, ModelError> {
        let own = Limits::of(&scenario.base());
        let limits = Limits {
            voltage: self.voltage.or(own.voltage),
            gap: self.gap.unwrap_or(own.gap),
            deflection: self.deflection.unwrap_or(own.deflection),
            slope: self.slope.unwrap_or(own.slope),
        };
        limits.validate().map(|()| limits)
    }

    pub(super) fn answer(&self, scenario: &Scenario) -> Result<LimitsAnswer, RequestError> {
        let limits = self.complete(scenario)?;
        let plant = Plant::new(scenario)?;
        let (system, initial) = plant.scenario.validate()?;
        let reached = lasting(&plant, &system, &initial)?;
        let demand = reached.harvest.map(|harvest| harvest.demand);
        let mut checks = demand.map_or_else(Vec::new, |demand| limits.checks(&demand, Plant::gap(&system)));
        checks.push(limits.sag(&scenario.device()?));
        let kept = checks.iter().all(|check| check.standing == Standing::Within);
        let motion = super::super::class(reached.motion);
        Ok(LimitsAnswer { motion, safe: demand.is_some() && kept, demand, checks })
    }
}
