//! Why a periodic orbit, its multipliers or a curve of them could not be computed.

use thiserror::Error;

use crate::dynamics::integration::IntegrationError;
use crate::model::ModelError;
use crate::theory::TheoryError;

/// A reason why there is no answer about a periodic motion.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum OrbitError {
    /// The device or the guess does not suit the integrator.
    #[error(transparent)]
    Integration(#[from] IntegrationError),
    /// A parameter left its range.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The theory that supplies the start has no answer.
    #[error(transparent)]
    Theory(#[from] TheoryError),
    /// The motion left over the potential barrier within the map.
    #[error("the motion escapes at time {time}")]
    Escaped {
        /// Dimensionless time since the start of the map.
        time: f64,
    },
    /// The magnets touched within the map.
    #[error("the magnets touch at time {time}")]
    Contact {
        /// Dimensionless time since the start of the map.
        time: f64,
    },
    /// The present grid is too coarse for the motion.
    #[error("{steps} steps a period are too few to follow the motion")]
    Unresolved {
        /// Steps of one excitation period.
        steps: usize,
    },
    /// Newton's iteration found no periodic motion.
    #[error(
        "no periodic motion found near the guess: after {iterations} iterations the state still misses itself by {residual:.1e} of the gap"
    )]
    NoConvergence {
        /// Iterations done.
        iterations: usize,
        /// Last defect of periodicity, as a displacement over the gap s0.
        residual: f64,
    },
    /// The orbit is at a fold: a multiplier is 1 to rounding.
    #[error("the periodic motion cannot be isolated: one of its multipliers is 1")]
    Singular,
    /// The eigenvalue iteration exceeded its cap.
    #[error("the multipliers did not converge")]
    Multipliers,
    /// A period of no or too many excitation periods was asked for.
    #[error("periods = {periods} is not available: allowed are 1 to {most}")]
    Periods {
        /// Number of excitation periods asked for.
        periods: usize,
        /// Largest number allowed.
        most: usize,
    },
    /// Without any damping tori surround every stable orbit; none branches off.
    #[error("without any damping there is no onset of a modulation")]
    Undamped,
    /// A curve of orbits bends more sharply than its shortest steps.
    #[error("the curve bends too sharply to be followed")]
    Sharp,
    /// The motion that grows out of rest does not reach the excitation.
    #[error("the forced motion ends below beta = {beta}")]
    MotionEnds {
        /// The excitation amplitude asked for.
        beta: f64,
    },
    /// A rectangle of parameters is empty, or its sides are the same parameter.
    #[error("the plane's range of {parameter} must grow, and its two parameters must differ")]
    Plane {
        /// Name of a parameter concerned.
        parameter: &'static str,
    },
}
