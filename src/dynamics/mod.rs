//! Time integration and what is read off a trajectory.
//!
//! * [`rk4`] repeats the paper's own runs, step by step.
//! * [`collocation`] is the integrator behind everything else: the linear beam and circuit are carried by their
//!   exact propagator, the magnet's rest force by Gauss-Legendre collocation; [`linear`] and [`tables`] prepare it.
//! * [`trajectory`] keeps the steps of a run for dense output; [`poincare`] and [`summary`] read them.

pub mod collocation;
pub mod linear;
pub mod outcome;
pub mod poincare;
pub mod rk4;
pub mod summary;
pub mod tables;
pub mod trajectory;

pub use collocation::{Collocation, Settings};
pub use outcome::{IntegrationError, Outcome};
pub use trajectory::Trajectory;

/// Tip displacement, in beam lengths, beyond which a motion counts as escaped: ten times the beam's own length,
/// far outside the validity of any of the force laws.
pub const ESCAPE_DISPLACEMENT: f64 = 10.0;
