//! Why a design question has no answer.

use crate::dynamics::attractors::sweep::SweepError;
use crate::dynamics::{IntegrationError, OrbitError};
use crate::model::ModelError;
use crate::theory::TheoryError;

/// A reason, in one sentence.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DesignError {
    /// A number is out of range.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A motion cannot be integrated.
    #[error(transparent)]
    Integration(#[from] IntegrationError),
    /// A periodic motion cannot be found.
    #[error(transparent)]
    Orbit(#[from] OrbitError),
    /// A sweep has no answer.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// The linear theory has no answer.
    #[error(transparent)]
    Theory(#[from] TheoryError),
    /// The truncation has too few modes for the question.
    #[error("mode = {mode} is not available: allowed are 1 to {modes}")]
    Mode {
        /// The mode asked for, counted from 1.
        mode: usize,
        /// How many there are.
        modes: usize,
    },
}
