//! The requests: what may be asked.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use thiserror::Error;

use super::budget::Budget;
use super::design::DesignError;
use super::input::{self, FieldError, JsonError, cut};
use super::tasks::Answer;
use super::tasks::basin::BasinRequest;
use super::tasks::boundary::BoundaryRequest;
use super::tasks::chart::ChartRequest;
use super::tasks::design::DesignRequest;
use super::tasks::device::Described;
use super::tasks::modes::ModesRequest;
use super::tasks::orbit::OrbitRequest;
use super::tasks::simulate::SimulateRequest;
use super::tasks::sweep::SweepRequest;
use super::tasks::verdict::VerdictRequest;
use crate::dynamics::attractors::verdict::VerdictError;
use crate::dynamics::{IntegrationError, OrbitError};
use crate::model::{ModelError, Parameter};
use crate::theory::TheoryError;

/// Why a request has no answer; each is one line.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RequestError {
    /// The text is not JSON, or not such as a request is.
    #[error("the request: {0}")]
    Json(#[from] JsonError),
    /// The JSON is another value than an object.
    #[error("the request must be an object such as {{\"task\":\"modes\"}}")]
    NoObject,
    /// The task is missing or unknown.
    #[error("task = {0} is not available: allowed are {TASKS}")]
    Task(String),
    /// A field is unknown, missing or of the wrong type.
    #[error("{field}: {problem}")]
    Field {
        /// Path of the field, such as `parameters.beta`.
        field: String,
        /// What is wrong, and what is allowed.
        problem: String,
    },
    /// Too few or too many of something.
    #[error("{field} = {value} is not available: allowed are {minimum} to {maximum}")]
    Count {
        /// Path of the field, or what is counted.
        field: String,
        /// How many were asked for.
        value: usize,
        /// Fewest allowed.
        minimum: usize,
        /// Most allowed.
        maximum: usize,
    },
    /// A state does not suit the model.
    #[error("{field} must be {expected} numbers (q1..qN, dq1/dt..dqN/dt, v), got {got}")]
    State {
        /// Name of the field.
        field: &'static str,
        /// Required length 2N + 1.
        expected: usize,
        /// Length given.
        got: usize,
    },
    /// A number describes no device.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The motion cannot be integrated.
    #[error(transparent)]
    Integration(#[from] IntegrationError),
    /// The theory has no answer.
    #[error(transparent)]
    Theory(#[from] TheoryError),
    /// There is no such periodic motion.
    #[error(transparent)]
    Orbit(#[from] OrbitError),
    /// There is no verdict.
    #[error(transparent)]
    Verdict(#[from] VerdictError),
    /// The design bench has no answer.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// A part of a large question failed.
    #[error("{0}")]
    Study(String),
}

const TASKS: &str = "\"modes\", \"boundary\", \"simulate\", \"orbit\", \"chart\", \"sweep\", \"verdict\", \
                     \"basin\", \"harvest\", \"load\", \"materials\", \"limits\", \"trust\", \"find\", \"map\"";

/// A request with what it may cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Asked {
    /// The question.
    pub request: Request,
    /// Computing time (s, summed over all cores) after which the answer has what there is.
    pub budget: f64,
}

/// An answer, and what it lacks.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Whole {
    /// What was asked for.
    #[serde(flatten)]
    pub answer: Answer,
    /// What of it is missing, and why; absent when it is whole.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub missing: Option<String>,
}

impl Asked {
    /// Computes the answer, within `budget` and the request's own.
    ///
    /// # Errors
    /// [`RequestError`] when a number is out of range or the question has no answer.
    pub fn answer(&self, budget: Budget<'_>) -> Result<Whole, RequestError> {
        let budget = budget.of(self.budget);
        let answer = self.request.answer(&budget)?;
        Ok(Whole { answer, missing: budget.missing() })
    }
}

/// A checked question.
#[derive(Debug, Clone, PartialEq)]
pub enum Request {
    /// Equilibrium, Taylor coefficients, modes and eigenvalues of a device.
    Modes(ModesRequest),
    /// Lowest unstable excitation amplitude over frequency.
    Boundary(BoundaryRequest),
    /// A run in time.
    Simulate(SimulateRequest),
    /// A periodic motion with its multipliers.
    Orbit(OrbitRequest),
    /// A chart over frequency and amplitude.
    Chart(ChartRequest),
    /// A sweep, the state carried from value to value.
    Sweep(SweepRequest),
    /// What motion a start leads to, and what that rests on.
    Verdict(VerdictRequest),
    /// Which motions the starts of a plane lead to.
    Basin(BasinRequest),
    /// What a device delivers, bears and could be.
    Design(Box<DesignRequest>),
}

impl Request {
    /// Reads a request.
    ///
    /// # Errors
    /// [`RequestError`] for the first thing that is wrong.
    pub fn parse(json: &str) -> Result<Asked, RequestError> {
        let Value::Object(mut fields) = input::json(json)? else {
            return Err(RequestError::NoObject);
        };
        let task = fields.remove("task").unwrap_or(Value::Null);
        let budget =
            fields.remove_entry("budget").map(|own| read::<Own>(Value::Object([own].into_iter().collect())));
        let budget = budget.transpose()?.map_or(Budget::USUAL, |own| own.budget);
        ModelError::check("budget", budget, Budget::RANGE, " s")?;
        let device = Described::take(&mut fields)?;
        Ok(Asked { request: Self::of(&task, device, fields)?, budget })
    }

    fn of(task: &Value, device: Described, mut fields: Map<String, Value>) -> Result<Self, RequestError> {
        if let Some(request) = DesignRequest::read(task.as_str().unwrap_or_default(), device, &fields)? {
            return Ok(Self::Design(Box::new(request)));
        }
        if device != Described::default() {
            let numbers = serde_json::to_value(device.numbers()?).unwrap_or_default();
            fields.insert("parameters".to_owned(), numbers);
        }
        let fields = Value::Object(fields);
        match task.as_str() {
            Some("modes") => Ok(Self::Modes(read(fields)?)),
            Some("boundary") => Ok(Self::Boundary(read(fields)?)),
            Some("simulate") => Ok(Self::Simulate(read(fields)?)),
            Some("orbit") => Ok(Self::Orbit(read(fields)?)),
            Some("chart") => Ok(Self::Chart(read(fields)?)),
            Some("sweep") => Ok(Self::Sweep(read(fields)?)),
            Some("verdict") => Ok(Self::Verdict(read(fields)?)),
            Some("basin") => Ok(Self::Basin(read(fields)?)),
            _ => Err(RequestError::Task(cut(&task.to_string()))),
        }
    }

    /// Computes the answer, as far as `budget` goes. Tasks without pieces have a counted one of their own.
    ///
    /// # Errors
    /// [`RequestError`] when a number is out of range or the question has no answer.
    pub fn answer(&self, budget: &Budget<'_>) -> Result<Answer, RequestError> {
        match self {
            Self::Modes(request) => request.answer(),
            Self::Boundary(request) => request.answer(budget),
            Self::Simulate(request) => request.answer(budget),
            Self::Orbit(request) => request.answer(),
            Self::Chart(request) => request.answer(budget),
            Self::Sweep(request) => request.answer(budget),
            Self::Verdict(request) => request.answer(),
            Self::Basin(request) => request.answer(budget),
            Self::Design(request) => request.answer(budget),
        }
    }
}

/// What every request may say of itself.
#[derive(Debug, Clone, Copy, Deserialize)]
struct Own {
    budget: f64,
}

/// Deserialises with the path of the field in the error, and the allowed range where the field has one.
pub(super) fn read<T: DeserializeOwned>(value: Value) -> Result<T, RequestError> {
    input::fields(value).map_err(|FieldError { path, problem }| {
        let problem = match range(&path) {
            Some((low, high)) => format!("{problem}: allowed are {low} to {high}"),
            None => problem,
        };
        RequestError::Field { field: if path == "." { "request".into() } else { path }, problem }
    })
}

/// The range of the number at a path such as `parameters.beta`, `omega[3]` or `omega.from`, where it has one.
fn range(path: &str) -> Option<(f64, f64)> {
    let path = path.strip_suffix(".from").or_else(|| path.strip_suffix(".to")).unwrap_or(path);
    let name = path.rsplit('.').next().unwrap_or_default();
    let name = name.split('[').next().unwrap_or_default();
    Parameter::ALL.iter().find(|parameter| parameter.field() == name).map(|parameter| parameter.range())
}
