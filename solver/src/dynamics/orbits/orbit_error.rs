//! Why a periodic orbit, its multipliers or a curve of them could not be computed.

use thiserror::Error;

use crate::dynamics::integration::IntegrationError;
use crate::model::ModelError;
use crate::sentence::{Say, Sentence, not_available, said};
use crate::theory::TheoryError;

/// A reason why there is no answer about a periodic motion.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{}", self.say())]
pub enum OrbitError {
    /// The device or the guess does not suit the integrator.
    Integration(#[from] IntegrationError),
    /// A parameter left its range.
    Model(#[from] ModelError),
    /// The theory that supplies the start has no answer.
    Theory(#[from] TheoryError),
    /// The motion left over the potential barrier within the map.
    Escaped {
        /// Dimensionless time since the start of the map.
        time: f64,
    },
    /// The magnets touched within the map.
    Contact {
        /// Dimensionless time since the start of the map.
        time: f64,
    },
    /// The present grid is too coarse for the motion.
    Unresolved {
        /// Steps of one excitation period.
        steps: usize,
    },
    /// Newton's iteration found no periodic motion.
    NoConvergence {
        /// Iterations done.
        iterations: usize,
        /// Last defect of periodicity, as a displacement over the gap s0.
        residual: f64,
    },
    /// The orbit is at a fold: a multiplier is 1 to rounding.
    Singular,
    /// The eigenvalue iteration exceeded its cap.
    Multipliers,
    /// A period of no or too many excitation periods was asked for.
    Periods {
        /// Number of excitation periods asked for.
        periods: usize,
        /// Largest number allowed.
        most: usize,
    },
    /// Without any damping tori surround every stable orbit; none branches off.
    Undamped,
    /// A curve of orbits bends more sharply than its shortest steps.
    Sharp,
    /// The motion that grows out of rest does not reach the excitation.
    MotionEnds {
        /// The excitation amplitude asked for.
        beta: f64,
    },
    /// A rectangle of parameters is empty, or its sides are the same parameter.
    Plane {
        /// Name of a parameter concerned.
        parameter: &'static str,
    },
}

impl Say for OrbitError {
    fn say(&self) -> Sentence {
        match self {
            Self::Integration(error) => error.say(),
            Self::Model(error) => error.say(),
            Self::Theory(error) => error.say(),
            Self::Escaped { time } => said("the motion escapes at time {time}", &[("time", time)]),
            Self::Contact { time } => said("the magnets touch at time {time}", &[("time", time)]),
            Self::Unresolved { steps } => {
                said("{steps} steps a period are too few to follow the motion", &[("steps", steps)])
            }
            Self::NoConvergence { iterations, residual } => said(
                "no periodic motion found near the guess: after {iterations} iterations the state still misses itself by {residual} of the gap",
                &[("iterations", iterations), ("residual", &format!("{residual:.1e}"))],
            ),
            Self::Singular => {
                said("the periodic motion cannot be isolated: one of its multipliers is 1", &[])
            }
            Self::Multipliers => said("the multipliers did not converge", &[]),
            Self::Periods { periods, most } => not_available(&"periods", periods, (&1, most)),
            Self::Undamped => said("without any damping there is no onset of a modulation", &[]),
            Self::Sharp => said("the curve bends too sharply to be followed", &[]),
            Self::MotionEnds { beta } => {
                said("the forced motion ends below beta = {beta}", &[("beta", beta)])
            }
            Self::Plane { parameter } => said(
                "the plane's range of {parameter} must grow, and its two parameters must differ",
                &[("parameter", parameter)],
            ),
        }
    }
}
