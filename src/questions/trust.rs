//! How far the model is to be trusted: one quantity over numbers of modes and force laws, and the force law's error at the
//! present amplitude.

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

use super::design::Plant;
use super::design::harvest::lasting;
use super::design::published::{Printed, Published};
use super::design::trust::{
    LAWS, LawError, MomentError, Quantity, TrustEntry, law_error, moment_errors, places, trust_entry,
};
use super::error::RequestError;
use super::question::Question;
use crate::model::{ForceLaw, MAX_MODES};
use crate::scenario::Scenario;
use crate::scheduler::{Budget, Failure, Piece, Table, complete_within};

/// How far the model is to be trusted.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Trust {
    /// What is compared.
    pub quantity: Quantity,
}

impl Default for Trust {
    fn default() -> Self {
        Self { quantity: Quantity::Power }
    }
}

/// How far the model is to be trusted.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TrustAnswer {
    /// One a number of modes and law.
    pub entries: Vec<TrustRow>,
    /// How far the modes left out are missed in the circuit, one a number of modes; empty where the linear device has no
    /// steady state.
    pub moment_errors: Vec<MomentError>,
    /// The laws' errors where the motion reached comes closest to the magnet and where it is farthest; empty when it
    /// ended.
    pub law_errors: Vec<LawErrors>,
    /// Published devices, which have nothing to do with the one asked about: what was printed of them and what is computed.
    pub published: Vec<PublishedRow>,
}

/// A printed number of a published device.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PublishedRow {
    /// What the device is called.
    pub device: &'static str,
    /// Where it was published.
    pub source: &'static str,
    /// What was printed.
    #[serde(flatten)]
    pub printed: Printed,
    /// The same computed here; null where it has no answer.
    pub computed: Option<f64>,
}

/// The printed numbers of all published devices.
fn published() -> Vec<PublishedRow> {
    let rows = |device: Published| {
        device.printed.iter().map(move |printed| {
            let computed = device.computed(printed.what).ok();
            PublishedRow { device: device.name, source: device.source, printed: *printed, computed }
        })
    };
    Published::ALL.into_iter().flat_map(rows).collect()
}

/// An entry, or why there is none.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TrustRow {
    /// Number of modes, law, value and motion.
    #[serde(flatten)]
    pub entry: TrustEntry,
    /// Why the value is null; absent where it is not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

impl TrustRow {
    fn new((modes, law): (usize, ForceLaw), found: Option<Result<&TrustEntry, &Failure>>) -> Self {
        let nothing = TrustEntry { modes, law, value: None, motion: None };
        let (entry, reason) = match found {
            Some(Ok(entry)) => (entry.clone(), reason(entry)),
            Some(Err(failure)) => (nothing, Some(failure.to_string())),
            None => (nothing, Some("it was not computed".to_owned())),
        };
        Self { entry, reason }
    }
}

/// Why an entry has no value.
fn reason(entry: &TrustEntry) -> Option<String> {
    match (entry.value, entry.motion) {
        (Some(_), _) => None,
        (None, Some(motion)) => Some(motion.to_string()),
        (None, None) => Some("the resonance has no tongue within the window".to_owned()),
    }
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

impl Question for Trust {
    const TASK: &'static str = "trust";
    const TAKES: &'static [&'static str] = &["initial", "t_end"];
    const COUNTS_LOSS: bool = true;
    type Answer = TrustAnswer;

    fn answer(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<TrustAnswer, RequestError> {
        scenario.validate()?;
        let plant = Plant::new(&scenario)?;
        let (system, initial) = plant.scenario.validate()?;
        let reached = lasting(&plant, &system, &initial)?;
        let errors = |tip: (f64, f64)| {
            LAWS.map(|law| LawErrors {
                law,
                closest: law_error(&system, law, tip.0),
                farthest: law_error(&system, law, tip.1),
            })
        };
        let mut table = self.table(&scenario);
        complete_within(&mut table, budget);
        let entries = places().zip(table.found()).map(|(place, found)| TrustRow::new(place, found)).collect();
        let moment = (1..=MAX_MODES).map(|modes| moment_errors(&scenario, modes));
        let moment_errors = moment.collect::<Result<_, _>>().unwrap_or_default();
        let law_errors = reached.harvest.map_or_else(Vec::new, |found| errors(found.demand.tip).to_vec());
        Ok(TrustAnswer { entries, moment_errors, law_errors, published: published() })
    }
}

impl Trust {
    /// The table for the device and the start of `scenario`: 1 to 8 modes, each under the four laws of [`LAWS`].
    pub fn table(&self, scenario: &Scenario) -> Table<Entry> {
        let quantity = self.quantity;
        let piece = |(modes, law)| Entry { scenario: scenario.clone(), modes, law, quantity };
        Table::new(places().map(piece).collect())
    }
}

/// An entry of the table.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Entry {
    /// The device.
    pub scenario: Scenario,
    /// Number of modes.
    pub modes: usize,
    /// Force law.
    pub law: ForceLaw,
    /// What is compared.
    pub quantity: Quantity,
}

impl Piece for Entry {
    const NAME: &'static str = "trust";
    type Found = TrustEntry;

    fn carry_out(&self) -> Result<TrustEntry, Failure> {
        Ok(trust_entry(&self.scenario, self.modes, self.law, self.quantity)?)
    }
}
