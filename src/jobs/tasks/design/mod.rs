//! The requests of the design bench: they share the device, its model, start and duration.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::Answer;
use super::device::Described;
use crate::jobs::RequestError;
use crate::jobs::budget::Budget;
use crate::jobs::request::read;
use crate::model::{Limits, ModelError};
use crate::scenario::{ModelChoice, Scenario};

mod find;
mod harvest;
mod limits;
mod load;
mod map;
mod materials;
mod trust;

pub use find::{FindAnswer, FindTask};
pub use harvest::{HarvestAnswer, HarvestTask};
pub use limits::LimitsAnswer;
pub use load::{LoadAnswer, LoadTask};
pub use map::{MapAnswer, MapTask};
pub use materials::{MaterialsAnswer, MaterialsTask};
pub use trust::{TrustAnswer, TrustTask};

/// What a request of the bench is about: a device with its model, start and duration.
#[derive(Debug, Clone, PartialEq)]
pub struct Subject {
    /// The device.
    pub device: Described,
    /// How it is looked at.
    pub view: Looked,
}

/// Model, start and duration of a request of the bench.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Looked {
    /// Modes and force law.
    pub model: ModelChoice,
    /// State at time 0, length 2N + 1; rest when absent.
    pub initial: Option<Vec<f64>>,
    /// Allowed, and without effect: a start is followed until its motion is known.
    pub t_end: f64,
}

impl Default for Looked {
    fn default() -> Self {
        let Scenario { model, t_end, .. } = Scenario::default();
        Self { model, initial: None, t_end }
    }
}

/// Names of the fields of [`Looked`].
const LOOKED: [&str; 3] = ["model", "initial", "t_end"];

impl Subject {
    /// The scenario, checked.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range.
    pub fn scenario(&self) -> Result<Scenario, ModelError> {
        let Looked { model, initial, t_end } = self.view.clone();
        let mut scenario = Scenario { model, initial, t_end, ..Scenario::default() };
        self.device.put_into(&mut scenario)?;
        scenario.validate()?;
        Ok(scenario)
    }
}

/// What is asked about the device.
#[derive(Debug, Clone, PartialEq)]
pub enum Task {
    /// What it harvests.
    Harvest(HarvestTask),
    /// Power against the load.
    Load(LoadTask),
    /// The ceramics side by side.
    Materials(MaterialsTask),
    /// Its limits; the voltage by its ceramic where none is given.
    Limits(Limits),
    /// How far the model is to be trusted.
    Trust(TrustTask),
    /// A better design.
    Find(FindTask),
    /// An objective over two variables.
    Map(MapTask),
}

/// A request of the bench.
#[derive(Debug, Clone, PartialEq)]
pub struct DesignRequest {
    /// The device.
    pub subject: Subject,
    /// The question.
    pub task: Task,
}

/// An answer of the bench.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum DesignAnswer {
    /// What the device harvests.
    Harvest(Box<HarvestAnswer>),
    /// Power against the load.
    Load(LoadAnswer),
    /// The ceramics.
    Materials(MaterialsAnswer),
    /// The limits.
    Limits(LimitsAnswer),
    /// Trust.
    Trust(TrustAnswer),
    /// A design.
    Find(Box<FindAnswer>),
    /// A map.
    Map(MapAnswer),
}

impl DesignRequest {
    /// Reads the fields of a request for `task` about `device`; `None` when the bench has no such task.
    ///
    /// # Errors
    /// [`RequestError`] for the first field that is wrong.
    pub(in crate::jobs) fn read(
        task: &str,
        device: Described,
        fields: &Map<String, Value>,
    ) -> Result<Option<Self>, RequestError> {
        let part = |wanted: bool| {
            let chosen = fields.iter().filter(|(name, _)| LOOKED.contains(&name.as_str()) == wanted);
            Value::Object(chosen.map(|(name, value)| (name.clone(), value.clone())).collect())
        };
        let own = part(false);
        let task = match task {
            "harvest" => Task::Harvest(read(own)?),
            "load" => Task::Load(read(own)?),
            "materials" => Task::Materials(read(own)?),
            "limits" => Task::Limits(read(own)?),
            "trust" => Task::Trust(read(own)?),
            "find" => Task::Find(read(own)?),
            "map" => Task::Map(read(own)?),
            _ => return Ok(None),
        };
        Ok(Some(Self { subject: Subject { device, view: read(part(true))? }, task }))
    }

    /// Computes the answer.
    ///
    /// # Errors
    /// [`RequestError`] when a number is out of range or the question has no answer.
    pub fn answer(&self, budget: &Budget<'_>) -> Result<Answer, RequestError> {
        let scenario = self.subject.scenario()?;
        let answer = match &self.task {
            Task::Harvest(task) => DesignAnswer::Harvest(Box::new(task.answer(scenario, budget)?)),
            Task::Load(task) => DesignAnswer::Load(task.answer(scenario, budget)?),
            Task::Materials(task) => DesignAnswer::Materials(task.answer(&scenario, budget)?),
            Task::Limits(limits) => DesignAnswer::Limits(LimitsAnswer::new(*limits, &scenario)?),
            Task::Trust(task) => DesignAnswer::Trust(task.answer(&scenario, budget)?),
            Task::Find(task) => DesignAnswer::Find(Box::new(task.answer(scenario, budget)?)),
            Task::Map(task) => DesignAnswer::Map(task.answer(scenario, budget)?),
        };
        Ok(Answer::Design(answer))
    }
}

/// A failure of a study as that of a request.
fn failed(message: Option<&str>) -> Result<(), RequestError> {
    message.map_or(Ok(()), |message| Err(RequestError::Study(message.to_owned())))
}
