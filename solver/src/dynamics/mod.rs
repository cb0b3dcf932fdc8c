//! Time integration and what is read off a trajectory.
//!
//! * [`rk4`] repeats the paper's own runs, step by step.
//! * [`collocation`] is the integrator behind everything else: the linear beam and circuit are carried by their
//!   exact [`propagator`], the magnet's rest force by Gauss-Legendre collocation; [`linear`] and [`tables`] prepare it.
//! * [`trajectory`] keeps the steps of a run for dense output; [`poincare`] and [`summary`] read them.
//! * [`ongoing`] is a motion without an end, whose numbers may change on the way.
//! * [`period_map`] is the stroboscopic map with its exact derivative, [`newton`] finds its fixed points, [`orbit`]
//!   and [`floquet`] say what they are.
//! * [`sweep`] carries a motion from one value of a parameter to the next.
//! * [`attractors`] says what motion a start leads to, [`motion`] has the classes; [`lyapunov`] has its exponents, [`spectrum`] and
//!   [`voltage_spectrum`] its lines, which [`spectral_label`] names, and [`verdict`] weighs all of it.
//! * [`signature`] tells whether two starts lead to the same motion.
//! * [`balance`] is the energy balance of a motion.
//! * [`forced`] is the motion that grows out of rest with the excitation.
//! * [`boundary`] and [`tongue`] find where the forced motion loses its stability, [`continuation`] follows periodic
//!   motions in any parameter, [`curves`] their bifurcations in any two.

mod arclength;
pub mod attractors;
pub mod balance;
pub mod boundary;
mod bracket;
pub mod branch;
pub mod collocation;
pub mod continuation;
pub mod curves;
pub mod evidence;
mod extremes;
pub mod floquet;
pub mod forced;
mod inquiry;
pub mod linear;
pub mod lyapunov;
mod march;
mod meter;
pub mod motion;
pub mod newton;
pub mod ongoing;
pub mod orbit;
pub mod orbit_error;
pub mod outcome;
pub mod period_map;
pub mod plane;
pub mod poincare;
pub mod propagator;
pub mod rk4;
mod rule;
pub mod signature;
pub mod spectral_label;
pub mod spectrum;
mod strobe;
pub mod summary;
pub mod sweep;
pub mod tables;
mod tangent;
pub mod tongue;
pub mod trajectory;
mod variation;
pub mod verdict;
pub mod voltage_spectrum;

pub use attractors::settle::{Effort, Settler, reach};
pub use balance::Balance;
pub use boundary::{
    CriticalExcitation, Loss, ResonanceBoundary, critical_excitation, largest_multipliers, resonance_boundary,
};
pub use branch::{Bifurcation, Branch, BranchEnd, BranchPoint, Course};
pub use collocation::{Collocation, Settings};
pub use continuation::{follow_branch, follow_doubled};
pub use curves::{Curve, CurveEnd, Line, SpecialKind, Start, find_curves, trace_curve};
pub use floquet::Instability;
pub use forced::ForcedMotion;
pub use inquiry::Inquiry;
pub use lyapunov::{Exponent, Lyapunov};
pub use motion::{Motion, Reached};
pub use newton::OrbitSolver;
pub use ongoing::{Ongoing, Reach};
pub use orbit::Orbit;
pub use orbit_error::OrbitError;
pub use outcome::{IntegrationError, Outcome};
pub use period_map::PeriodMap;
pub use plane::{Axis, Plane};
pub use rule::NODES;
pub use tongue::{Tongue, trace_tongue};
pub use trajectory::Trajectory;
pub use verdict::Verdict;
pub use voltage_spectrum::VoltageSpectrum;

/// Tip displacement, in beam lengths, beyond which a motion counts as escaped: ten times the beam's own length,
/// far outside the validity of any of the force laws.
pub const ESCAPE_DISPLACEMENT: f64 = 10.0;
