//! Why a design question has no answer.

use crate::dynamics::{IntegrationError, OrbitError, RunError};
use crate::model::ModelError;
use crate::sentence::{Say, Sentence, not_available};
use crate::theory::TheoryError;

/// A reason, in one sentence.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", self.say())]
pub enum DesignError {
    /// A number is out of range.
    Model(#[from] ModelError),
    /// A motion cannot be integrated.
    Integration(#[from] IntegrationError),
    /// A periodic motion cannot be found.
    Orbit(#[from] OrbitError),
    /// A motion has none.
    Run(#[from] RunError),
    /// The linear theory has no answer.
    Theory(#[from] TheoryError),
    /// The truncation has too few modes for the question.
    Mode {
        /// The mode asked for, counted from 1.
        mode: usize,
        /// How many there are.
        modes: usize,
    },
}

impl Say for DesignError {
    fn say(&self) -> Sentence {
        match self {
            Self::Model(error) => error.say(),
            Self::Integration(error) => error.say(),
            Self::Orbit(error) => error.say(),
            Self::Run(error) => error.say(),
            Self::Theory(error) => error.say(),
            Self::Mode { mode, modes } => not_available(&"mode", mode, (&1, modes)),
        }
    }
}
