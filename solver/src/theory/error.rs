//! Where a theory has no answer, in sentences a user understands.

use thiserror::Error;

use crate::sentence::{Say, Sentence, said};

/// A reason why a theory says nothing about a system or an excitation.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{}", self.say())]
pub enum TheoryError {
    /// The undamped first-order response is infinite.
    NaturalFrequency {
        /// Number of the mode, counted from 1.
        mode: usize,
        /// The excitation frequency (dimensionless).
        omega: f64,
    },
    /// The undamped linear system is excited exactly at one of its eigenvalues.
    Undamped {
        /// The excitation frequency (dimensionless).
        omega: f64,
    },
    /// A theory of two modes was asked about fewer.
    TooFewModes {
        /// How many modes the system has.
        found: usize,
    },
    /// The damping leaves fewer than two modes that oscillate lightly damped.
    Overdamped {
        /// How many lightly damped pairs of eigenvalues there are.
        found: usize,
    },
    /// The eigenvalue iteration did not converge within its cap.
    NoConvergence {
        /// The cap.
        iterations: usize,
    },
    /// The coefficients of the linear system overflow.
    NotFinite,
}

impl Say for TheoryError {
    fn say(&self) -> Sentence {
        match self {
            Self::NaturalFrequency { mode, omega } => said(
                "omega = {omega} is the natural frequency of mode {mode}: the first-order theory has no steady state there",
                &[("omega", omega), ("mode", mode)],
            ),
            Self::Undamped { omega } => said(
                "omega = {omega} is an undamped eigenfrequency of beam and circuit: there is no linear steady state",
                &[("omega", omega)],
            ),
            Self::TooFewModes { found } => said(
                "the resonance theories need at least two modes, the system has {found}",
                &[("found", found)],
            ),
            Self::Overdamped { found } => said(
                "only {found} of the coupled modes oscillate lightly damped (decay slower than they turn): the coupled-mode theory needs two",
                &[("found", found)],
            ),
            Self::NoConvergence { iterations } => said(
                "the eigenvalues of the linear system were not found within {iterations} iterations",
                &[("iterations", iterations)],
            ),
            Self::NotFinite => said("the coefficients of the linear system are not finite numbers", &[]),
        }
    }
}
