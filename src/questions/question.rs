//! What a question is.

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::error::RequestError;
use crate::scenario::Scenario;
use crate::scheduler::Budget;

/// A question: its fields with their defaults, and its answer about a device, with a model and a start.
pub trait Question: Serialize + DeserializeOwned {
    /// How requests name it.
    const TASK: &'static str;
    /// What of a scenario it takes besides device and model: `initial`, `t_end`.
    const TAKES: &'static [&'static str] = &[];
    /// Whether it counts the dielectric loss beside the load, as what is asked in watts does; where it does not, its answers
    /// about a lossy device say so.
    const COUNTS_LOSS: bool = false;
    /// What is answered.
    type Answer: Serialize;

    /// Computes the answer about `scenario`, which is not checked yet, as far as `budget` goes. What is no piece of work has
    /// a counted one of its own.
    ///
    /// # Errors
    /// [`RequestError`] when a number is out of range or the question has no answer.
    fn answer(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<Self::Answer, RequestError>;
}
