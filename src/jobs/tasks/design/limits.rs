//! Limits requests: what the motion reached asks of the device, against what it bears.

use serde::Serialize;

use crate::jobs::RequestError;
use crate::jobs::design::Plant;
use crate::jobs::design::harvest::lasting;
use crate::model::Limits;
use crate::model::limits::{Check, Demand, Standing, sag};
use crate::scenario::Scenario;

/// The limits checked.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LimitsAnswer {
    /// The motion reached.
    pub motion: String,
    /// What it asks of the device; null when it ended.
    pub demand: Option<Demand>,
    /// Every limit that applies.
    pub checks: Vec<Check>,
    /// Whether the motion lasts and keeps all of them.
    pub safe: bool,
    /// The sag under gravity, which the model counts as small.
    pub sag: Check,
}

impl LimitsAnswer {
    /// Holds the motion reached from the start of `scenario` against `limits`.
    pub(super) fn new(limits: Limits, scenario: &Scenario) -> Result<Self, RequestError> {
        let limits = limits.completed(&scenario.base());
        limits.validate()?;
        let plant = Plant::new(scenario)?;
        let (system, initial) = plant.scenario.validate()?;
        let reached = lasting(&plant, &system, &initial)?;
        let demand = reached.harvest.map(|harvest| harvest.demand);
        let checks = demand.map_or_else(Vec::new, |demand| limits.checks(&demand, Plant::gap(&system)));
        let kept = checks.iter().all(|check| check.standing == Standing::Within);
        let motion = super::super::class(reached.motion);
        let sag = sag(&scenario.device()?);
        Ok(Self { motion, safe: demand.is_some() && kept, demand, checks, sag })
    }
}
