//! How a run can end.

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::model::ModelError;
use crate::sentence::{Say, Sentence, said};

/// Tip displacement, in beam lengths, beyond which a motion counts as escaped: ten times the beam's own length,
/// far outside the validity of any of the force laws.
pub const ESCAPE_DISPLACEMENT: f64 = 10.0;

/// How a run ended. Escape and contact are results of the mechanics, not failures.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, SerBin, DeBin)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum Outcome {
    /// The run reached its end time.
    Completed,
    /// The tip left over the potential barrier of the truncated force law at this (dimensionless) time.
    Escaped {
        /// Time of escape (dimensionless).
        time: f64,
    },
    /// The magnets touched at this (dimensionless) time.
    Contact {
        /// Time of contact (dimensionless).
        time: f64,
    },
}

impl Outcome {
    /// Its word in answers.
    pub fn word(self) -> &'static str {
        match self {
            Self::Completed => "completed",
            Self::Escaped { .. } => "escaped",
            Self::Contact { .. } => "contact",
        }
    }

    /// The same where times are counted in another unit, or from another instant.
    #[must_use]
    pub fn retimed(self, of: impl Fn(f64) -> f64) -> Self {
        match self {
            Self::Completed => Self::Completed,
            Self::Escaped { time } => Self::Escaped { time: of(time) },
            Self::Contact { time } => Self::Contact { time: of(time) },
        }
    }

    /// The time at which the run ended early, if it did.
    pub fn early_end(&self) -> Option<f64> {
        match *self {
            Self::Completed => None,
            Self::Escaped { time } | Self::Contact { time } => Some(time),
        }
    }
}

/// Why a run could not be carried out.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{}", self.say())]
pub enum IntegrationError {
    /// The initial state has the wrong length or holds something that is not a number.
    InitialState {
        /// Required length 2N + 1.
        expected: usize,
        /// What was wrong.
        got: String,
    },
    /// The step fell below any useful size without an escape or a contact.
    StepTooSmall {
        /// Dimensionless time.
        time: f64,
        /// The tolerance asked for.
        tolerance: f64,
    },
    /// The motion is so much faster than the excitation that the run would hardly end.
    TooManySteps {
        /// Dimensionless time reached.
        time: f64,
        /// Steps done.
        steps: u64,
    },
}

impl Say for IntegrationError {
    fn say(&self) -> Sentence {
        match self {
            Self::InitialState { expected, got } => said(
                "initial must be {expected} finite numbers (q1..qN, dq1/dt..dqN/dt, v), got {got}",
                &[("expected", expected), ("got", got)],
            ),
            Self::StepTooSmall { time, tolerance } => said(
                "the step became too small at time {time}: the motion cannot be resolved to tolerance {tolerance}",
                &[("time", time), ("tolerance", tolerance)],
            ),
            Self::TooManySteps { time, steps } => said(
                "the motion is too fast to follow: {steps} steps have reached time {time} only; start nearer to rest, reduce beta or use the exact force law",
                &[("steps", steps), ("time", time)],
            ),
        }
    }
}

/// Why a motion of numbers not yet checked could not be computed.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{}", self.say())]
pub enum RunError {
    /// A number describes no device.
    Model(#[from] ModelError),
    /// The motion cannot be integrated.
    Integration(#[from] IntegrationError),
}

impl Say for RunError {
    fn say(&self) -> Sentence {
        match self {
            Self::Model(error) => error.say(),
            Self::Integration(error) => error.say(),
        }
    }
}
