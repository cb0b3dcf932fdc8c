//! The requests: what may be asked, with every default and every check.

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use thiserror::Error;

use super::answer::Answer;
use super::boundary::{self, Theory};
use super::simulate;
use crate::dynamics::IntegrationError;
use crate::model::{ModelError, Parameter, ParameterSet, ReducedSystem};
use crate::scenario::ModelChoice;
use crate::theory::{CoupledModes, Resonance, TheoryError};

/// Why a request has no answer; each is one line.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RequestError {
    /// The text is not JSON.
    #[error("the request is not valid JSON: {0}")]
    Json(String),
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
    /// A number describes no device.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The motion cannot be integrated.
    #[error(transparent)]
    Integration(#[from] IntegrationError),
    /// The theory has no answer.
    #[error(transparent)]
    Theory(#[from] TheoryError),
}

const TASKS: &str = "\"modes\", \"boundary\", \"simulate\"";

/// A checked question.
#[derive(Debug, Clone, PartialEq)]
pub enum Request {
    /// Equilibrium, Taylor coefficients, modes and eigenvalues of a device.
    Modes(ModesRequest),
    /// Lowest unstable excitation amplitude over frequency.
    Boundary(BoundaryRequest),
    /// A run in time.
    Simulate(SimulateRequest),
}

/// The device and truncation asked about; every other request has the same two fields.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ModesRequest {
    /// The ten numbers; missing ones are the paper's.
    pub parameters: ParameterSet,
    /// Modes and force law.
    pub model: ModelChoice,
}

/// A stability boundary.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BoundaryRequest {
    /// The ten numbers; beta and omega play no role.
    #[serde(default)]
    pub parameters: ParameterSet,
    /// Modes and force law; the theories use the quadratic term.
    #[serde(default)]
    pub model: ModelChoice,
    /// Which resonance.
    pub resonance: Resonance,
    /// Which theory.
    pub theory: Theory,
    /// Excitation frequencies (dimensionless).
    pub omega: Vec<f64>,
}

/// A run in time.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SimulateRequest {
    /// The ten numbers; missing ones are the paper's.
    pub parameters: ParameterSet,
    /// Modes and force law.
    pub model: ModelChoice,
    /// End time (dimensionless).
    pub t_end: f64,
    /// State at time 0, length 2N + 1; rest when absent.
    pub initial: Option<Vec<f64>>,
    /// Integrator.
    pub method: Method,
    /// Steps a period, for `rk4`.
    pub steps_per_period: u32,
    /// Bound on the error within a step, for `adaptive`.
    pub tolerance: f64,
    /// Number of equally spaced times at which the state is given, the first and the last included.
    pub samples: usize,
}

impl Default for SimulateRequest {
    fn default() -> Self {
        Self {
            parameters: ParameterSet::default(),
            model: ModelChoice::default(),
            t_end: 600.0,
            initial: None,
            method: Method::Adaptive,
            steps_per_period: crate::dynamics::rk4::PAPER_STEPS_PER_PERIOD,
            tolerance: crate::dynamics::Settings::default().tolerance,
            samples: 101,
        }
    }
}

/// The integrators of a simulate request.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// The classical Runge-Kutta method with fixed steps, as the paper runs it.
    Rk4,
    /// The exponential collocation with error control.
    Adaptive,
}

impl Request {
    /// Reads a request.
    ///
    /// # Errors
    /// [`RequestError`] for the first thing that is wrong.
    pub fn parse(json: &str) -> Result<Self, RequestError> {
        let value: Value =
            serde_json::from_str(json).map_err(|error| RequestError::Json(error.to_string()))?;
        let Value::Object(mut fields) = value else {
            return Err(RequestError::Json("expected an object such as {\"task\":\"modes\"}".into()));
        };
        let task = fields.remove("task").unwrap_or(Value::Null);
        let fields = Value::Object(fields);
        match task.as_str() {
            Some("modes") => Ok(Self::Modes(read(fields)?)),
            Some("boundary") => Ok(Self::Boundary(read(fields)?)),
            Some("simulate") => Ok(Self::Simulate(read(fields)?)),
            _ => Err(RequestError::Task(task.to_string())),
        }
    }

    /// Computes the answer.
    ///
    /// # Errors
    /// [`RequestError`] when a number is out of range or the question has no answer.
    pub fn answer(&self) -> Result<Answer, RequestError> {
        match self {
            Self::Modes(request) => {
                let system = request.model.system(request.parameters)?;
                Ok(Answer::modes(&system, &CoupledModes::new(&system)?))
            }
            Self::Boundary(request) => boundary::answer(request),
            Self::Simulate(request) => simulate::answer(request),
        }
    }
}

/// Deserialises with the path of the field in the error, and the allowed range where the field has one.
fn read<T: DeserializeOwned>(value: Value) -> Result<T, RequestError> {
    serde_path_to_error::deserialize(value).map_err(|error| {
        let path = error.path().to_string();
        let name = path.rsplit('.').next().unwrap_or_default();
        let range = Parameter::ALL.iter().find(|parameter| parameter.field() == name).map(|p| p.range());
        let problem = match range {
            Some((low, high)) => format!("{}: allowed are {low} to {high}", error.inner()),
            None => error.inner().to_string(),
        };
        RequestError::Field { field: if path == "." { "request".into() } else { path }, problem }
    })
}

impl BoundaryRequest {
    /// The system, with the frequencies checked.
    ///
    /// # Errors
    /// [`ModelError`] naming the first number out of range.
    pub fn system(&self) -> Result<ReducedSystem, ModelError> {
        for omega in &self.omega {
            ModelError::check("omega", *omega, Parameter::Omega.range(), "")?;
        }
        self.model.system(self.parameters)
    }
}
