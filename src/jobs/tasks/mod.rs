//! The tasks that a request may name: for each its fields with their defaults, the checks, and the answer.

use serde::{Deserialize, Serialize};

use crate::dynamics::Motion;
use crate::jobs::RequestError;
use crate::model::{ModelError, Parameter};

pub mod basin;
pub mod boundary;
pub mod chart;
pub mod design;
pub mod device;
pub mod modes;
pub mod orbit;
pub mod simulate;
pub mod sweep;
pub mod verdict;

/// The answer to a request.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Answer {
    /// To a modes request.
    Modes(modes::ModesAnswer),
    /// To a boundary request.
    Boundary(boundary::BoundaryAnswer),
    /// To a simulate request.
    Simulate(simulate::SimulateAnswer),
    /// To an orbit request.
    Orbit(orbit::OrbitAnswer),
    /// To a chart request.
    Chart(chart::ChartAnswer),
    /// To a sweep request.
    Sweep(sweep::SweepAnswer),
    /// To a verdict request.
    Verdict(Box<verdict::VerdictAnswer>),
    /// To a basin request.
    Basin(basin::BasinAnswer),
    /// To a request of the design bench.
    Design(design::DesignAnswer),
}

/// Equally spaced values, both ends included.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
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

    fn range(&self) -> (f64, f64) {
        (self.from, self.to)
    }

    /// Checks the values of `parameter`, and that there are no more than `most`.
    fn check(&self, parameter: Parameter, most: usize) -> Result<(), RequestError> {
        let field = parameter.field();
        check_ends(field, self.range(), parameter.range())?;
        count(&format!("{field}.count"), self.count, (2, most))
    }
}

/// Checks a range that a request gives as from and to.
fn check_ends(field: &str, (from, to): (f64, f64), limits: (f64, f64)) -> Result<(), ModelError> {
    ModelError::check(&format!("{field}.from"), from, limits, "")?;
    ModelError::check(&format!("{field}.to"), to, (from, limits.1), "").map(|_| ())
}

/// Checks a number of things.
fn count(field: &str, value: usize, (minimum, maximum): (usize, usize)) -> Result<(), RequestError> {
    if (minimum..=maximum).contains(&value) {
        return Ok(());
    }
    Err(RequestError::Count { field: field.to_owned(), value, minimum, maximum })
}

/// Checks a state for a model whose states have `expected` numbers, if one is given.
fn state(field: &'static str, state: Option<&Vec<f64>>, expected: usize) -> Result<(), RequestError> {
    let Some(state) = state else { return Ok(()) };
    if state.len() != expected {
        return Err(RequestError::State { field, expected, got: state.len() });
    }
    for value in state {
        ModelError::check(field, *value, (-1e6, 1e6), "")?;
    }
    Ok(())
}

/// The class of a motion in a word or two, such as "period 1", without times and reasons.
fn class(motion: Motion) -> String {
    match motion {
        Motion::Escape { .. } => "escape".to_owned(),
        Motion::Contact { .. } => "contact".to_owned(),
        Motion::Undecided { .. } => "undecided".to_owned(),
        lasting => lasting.to_string(),
    }
}
