//! Where a theory has no answer, in sentences a user understands.

use thiserror::Error;

/// A reason why a theory says nothing about a system or an excitation.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TheoryError {
    /// The undamped first-order response is infinite.
    #[error(
        "omega = {omega} is the natural frequency of mode {mode}: the first-order theory has no steady state there"
    )]
    NaturalFrequency {
        /// Number of the mode, counted from 1.
        mode: usize,
        /// The excitation frequency (dimensionless).
        omega: f64,
    },
    /// The undamped linear system is excited exactly at one of its eigenvalues.
    #[error(
        "omega = {omega} is an undamped eigenfrequency of beam and circuit: there is no linear steady state"
    )]
    Undamped {
        /// The excitation frequency (dimensionless).
        omega: f64,
    },
    /// A theory of two modes was asked about fewer.
    #[error("the resonance theories need at least two modes, the system has {found}")]
    TooFewModes {
        /// How many modes the system has.
        found: usize,
    },
    /// The damping leaves fewer than two modes that oscillate lightly damped.
    #[error(
        "only {found} of the coupled modes oscillate lightly damped (decay slower than they turn): the coupled-mode theory needs two"
    )]
    Overdamped {
        /// How many lightly damped pairs of eigenvalues there are.
        found: usize,
    },
    /// The eigenvalue iteration did not converge within its cap.
    #[error("the eigenvalues of the linear system were not found within {iterations} iterations")]
    NoConvergence {
        /// The cap.
        iterations: usize,
    },
    /// The coefficients of the linear system overflow.
    #[error("the coefficients of the linear system are not finite numbers")]
    NotFinite,
}
