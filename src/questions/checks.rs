//! What several questions check or name in the same way.

use serde::{Deserialize, Serialize};

use super::error::RequestError;
use crate::dynamics::Motion;
use crate::model::{ModelError, Parameter, ReducedSystem};
use crate::scenario::{END_TIME, Scenario};
use crate::spacing::between;

/// Equally spaced values, both ends included.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object such as {\"from\":8,\"to\":9,\"count\":41}")]
pub struct Span {
    /// The first and lowest one.
    pub from: f64,
    /// The last one.
    pub to: f64,
    /// How many.
    #[serde(default = "Span::default_count")]
    pub count: usize,
}

impl Span {
    const fn default_count() -> usize {
        41
    }

    /// Both ends.
    pub fn range(&self) -> (f64, f64) {
        (self.from, self.to)
    }

    /// The value of this index from 0.
    pub fn at(&self, index: usize) -> f64 {
        between(self.range(), index, self.count)
    }

    /// Checks the values of `parameter`, and that there are no more than `most`.
    pub(super) fn check(&self, parameter: Parameter, most: usize) -> Result<(), RequestError> {
        let field = parameter.field();
        check_ends(field, self.range(), parameter.range())?;
        count(&format!("{field}.count"), self.count, (2, most))
    }
}

/// Checks a range that a request gives as from and to.
pub(super) fn check_ends(field: &str, (from, to): (f64, f64), limits: (f64, f64)) -> Result<(), ModelError> {
    ModelError::check(&format!("{field}.from"), from, limits, "")?;
    ModelError::check(&format!("{field}.to"), to, (from, limits.1), "").map(|_| ())
}

/// Checks a number of things.
pub(super) fn count(
    field: &str,
    value: usize,
    (minimum, maximum): (usize, usize),
) -> Result<(), RequestError> {
    if (minimum..=maximum).contains(&value) {
        return Ok(());
    }
    Err(RequestError::Count { field: field.to_owned(), value, minimum, maximum })
}

/// Checks a state for a model whose states have `expected` numbers, if one is given.
pub(super) fn state(
    field: &'static str,
    state: Option<&Vec<f64>>,
    expected: usize,
) -> Result<(), RequestError> {
    let Some(state) = state else { return Ok(()) };
    if state.len() != expected {
        return Err(RequestError::State { field, expected, got: state.len() });
    }
    for value in state {
        ModelError::check(field, *value, (-1e6, 1e6), "")?;
    }
    Ok(())
}

/// The device of a scenario, its duration and its start checked.
pub(super) fn system(scenario: &Scenario) -> Result<ReducedSystem, RequestError> {
    ModelError::check("t_end", scenario.t_end, END_TIME, "")?;
    let system = scenario.model.system(scenario.parameters)?;
    state("initial", scenario.initial.as_ref(), system.dimension())?;
    Ok(system)
}

/// The class of a motion in a word or two, such as "period 1", without times and reasons.
pub(super) fn class(motion: Motion) -> String {
    match motion {
        Motion::Escape { .. } => "escape".to_owned(),
        Motion::Contact { .. } => "contact".to_owned(),
        Motion::Undecided { .. } => "undecided".to_owned(),
        lasting => lasting.to_string(),
    }
}
