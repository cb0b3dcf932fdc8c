//! Trust requests: one quantity over numbers of modes and force laws, and the force law's error at the present amplitude.

use serde::{Deserialize, Serialize};

use crate::jobs::RequestError;
use crate::jobs::budget::Budget;
use crate::jobs::design::Plant;
use crate::jobs::design::harvest::lasting;
use crate::jobs::design::trust::{LAWS, LawError, Quantity, TrustEntry, law_error};
use crate::jobs::study::complete_within;
use crate::jobs::study::table::Table;
use crate::model::ForceLaw;
use crate::scenario::Scenario;

/// How far the model is to be trusted.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TrustTask {
    /// What is compared.
    pub quantity: Quantity,
}

impl Default for TrustTask {
    fn default() -> Self {
        Self { quantity: Quantity::Power }
    }
}

/// How far the model is to be trusted.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TrustAnswer {
    /// One a number of modes and law; null where it cannot be computed.
    pub entries: Vec<Option<TrustEntry>>,
    /// The laws' errors where the motion reached comes closest to the magnet and where it is farthest; empty when it
    /// ended.
    pub law_errors: Vec<LawErrors>,
}

/// How far a law is off.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LawErrors {
    /// The law.
    pub law: ForceLaw,
    /// At the closest approach.
    pub closest: LawError,
    /// At the farthest.
    pub farthest: LawError,
}

impl TrustTask {
    pub(super) fn answer(
        &self,
        scenario: &Scenario,
        budget: &Budget<'_>,
    ) -> Result<TrustAnswer, RequestError> {
        let plant = Plant::new(scenario)?;
        let (system, initial) = plant.scenario.validate()?;
        let reached = lasting(&plant, &system, &initial)?;
        let errors = |tip: (f64, f64)| {
            LAWS.map(|law| LawErrors {
                law,
                closest: law_error(&system, law, tip.0),
                farthest: law_error(&system, law, tip.1),
            })
        };
        let mut table = Table::trust(scenario, self.quantity);
        complete_within(&mut table, budget);
        let entries = table.trust_entries().map(|entry| entry?.ok().cloned()).collect();
        let law_errors = reached.harvest.map_or_else(Vec::new, |found| errors(found.demand.tip).to_vec());
        Ok(TrustAnswer { entries, law_errors })
    }
}
