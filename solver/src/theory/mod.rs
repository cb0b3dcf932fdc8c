//! Sections 3 and 4 of the paper: the forced motion to first order and where it loses its stability.
//!
//! * [`steady_state`] is the paper's forced motion (Eqs. 43, 45, 59, 71, 80); [`linear_response`] is the
//!   exact one of
//!   the linear system, circuit and damping kept; [`continuous`] is that of the beam without truncation.
//! * [`published`] holds the stability boundaries as printed (Eqs. 56, 57, 72, 81) with their growth rates.
//! * [`coupled`] is the same argument carried out on the modes of beam and circuit together, whose
//!   eigenvalues come
//!   from [`spectrum`]: any number of modes, no smallness of the electromechanical coupling.

pub mod continuous;
pub mod coupled;
pub mod error;
pub mod linear_response;
pub mod published;
pub mod source;
pub mod spectrum;
pub mod steady_state;

pub use continuous::ContinuousResponse;
pub use coupled::CoupledModes;
pub use error::TheoryError;
pub use linear_response::{DynamicStiffness, LinearResponse};
pub use published::{Published, Resonance};
pub use source::Source;
pub use steady_state::{Harmonic, SteadyState};
