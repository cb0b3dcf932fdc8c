//! Where periodic motions lose their stability as numbers change.
//!
//! Read in this order:
//!
//! * [`boundary`] finds where the motion that grows out of rest loses its stability, [`forced`] goes on past that.
//! * [`plane`] has the parameters that change, `arclength` the orbits over them, `bracket` the root between two places.
//! * [`continuation`] follows periodic motions in any one parameter, along a [`branch`], at the `pace` that resonances ask for.
//! * [`curves`] follows their bifurcations in any two; [`tongue`] is the curve about a resonance.
//!
//! Built on `orbits` and `integration`; it does not know of `attractors`.

mod arclength;
pub mod boundary;
mod bracket;
pub mod branch;
pub mod continuation;
pub mod curves;
pub mod forced;
mod pace;
pub mod plane;
pub mod tongue;

pub use boundary::{
    CriticalExcitation, Loss, ResonanceBoundary, critical_excitation, largest_multipliers, resonance_boundary,
};
pub use branch::{Bifurcation, Branch, BranchEnd, BranchPoint, Course};
pub use continuation::{follow_branch, follow_doubled, follow_forced};
pub use curves::{Curve, CurveEnd, Line, SpecialKind, Start, find_curves, trace_curve};
pub use forced::ForcedMotion;
pub use plane::{Axis, Plane};
pub use tongue::{Tongue, trace_tongue};
