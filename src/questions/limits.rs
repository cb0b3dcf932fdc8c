//! What the motion reached asks of the device, against what it bears.

use serde::Serialize;

use super::checks::class;
use super::design::Plant;
use super::design::harvest::lasting;
use super::error::RequestError;
use super::question::Question;
pub use crate::model::Limits;
use crate::model::limits::{Assessment, Check, Demand, sag};
use crate::scenario::Scenario;
use crate::scheduler::Budget;

/// The limits checked.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LimitsAnswer {
    /// The motion reached.
    pub motion: String,
    /// What it asks of the device; null when it ended.
    pub demand: Option<Demand>,
    /// Every limit that applies.
    pub checks: Vec<Check>,
    /// What can be said of all together.
    pub assessment: Assessment,
    /// Whether that is `within_limits`: every limit is known and kept, and the model is valid.
    pub safe: bool,
    /// What of the voltage is held against its limit: always its largest value.
    pub voltage_compared: &'static str,
    /// The sag under gravity, which the model counts as small.
    pub sag: Check,
}

/// The limits that the motion reached from the scenario's start is held against; the voltage by the ceramic where none is
/// given.
impl Question for Limits {
    const TASK: &'static str = "limits";
    const TAKES: &'static [&'static str] = &["initial", "t_end"];
    const COUNTS_LOSS: bool = true;
    type Answer = LimitsAnswer;

    fn answer(&self, scenario: Scenario, _: &Budget<'_>) -> Result<LimitsAnswer, RequestError> {
        scenario.validate()?;
        let limits = self.completed(&scenario.base());
        limits.validate()?;
        let plant = Plant::new(&scenario)?;
        let (system, initial) = plant.scenario.validate()?;
        let reached = lasting(&plant, &system, &initial)?;
        let demand = reached.harvest.map(|harvest| harvest.demand);
        let checks = demand.map_or_else(Vec::new, |demand| limits.checks(&demand, Plant::gap(&system)));
        let motion = class(reached.motion);
        let sag = sag(&scenario.device()?);
        let assessment = Assessment::of(&checks, &limits, &sag);
        let safe = assessment == Assessment::WithinLimits;
        Ok(LimitsAnswer { motion, demand, checks, assessment, safe, voltage_compared: "v_peak", sag })
    }
}
