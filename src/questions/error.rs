//! Why a request has no answer.

use serde::de::DeserializeOwned;
use serde_json::Value;
use thiserror::Error;

use super::design::DesignError;
use super::input::{self, FieldError, JsonError};
use crate::dynamics::attractors::verdict::VerdictError;
use crate::dynamics::{IntegrationError, OrbitError};
use crate::model::{ModelError, Parameter};
use crate::scheduler::Failure;
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
    #[error("task = {0} is not available: allowed are {1}")]
    Task(String, String),
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

/// Reads JSON, with the path of the field in the error, and the allowed range where the field has one.
pub(super) fn read<T: DeserializeOwned>(value: &Value) -> Result<T, RequestError> {
    input::known_fields(value, &[]).map_err(with_range)
}

/// An error of a field with the allowed range.
pub(super) fn with_range(FieldError { path, problem, .. }: FieldError) -> RequestError {
    let problem = match range(&path) {
        Some((low, high)) => format!("{problem}: allowed are {low} to {high}"),
        None => problem.to_string(),
    };
    RequestError::Field { field: if path == "." { "request".into() } else { path }, problem }
}

impl RequestError {
    /// The same of the field of that name.
    pub(super) fn of(self, name: &str) -> Self {
        match self {
            Self::Field { problem, .. } => Self::Field { field: name.to_owned(), problem },
            other => other,
        }
    }
}

/// A failure of a study as that of a request.
pub(super) fn failed(failure: Option<&Failure>) -> Result<(), RequestError> {
    failure.map_or(Ok(()), |failure| Err(RequestError::Study(failure.to_string())))
}

/// The range of the number at a path such as `parameters.beta`, `omega[3]` or `omega.from`, where it has one.
fn range(path: &str) -> Option<(f64, f64)> {
    let path = path.strip_suffix(".from").or_else(|| path.strip_suffix(".to")).unwrap_or(path);
    let name = path.rsplit('.').next().unwrap_or_default();
    let name = name.split('[').next().unwrap_or_default();
    Parameter::named(name).map(Parameter::range)
}
