//! Motions in time, in four rooms. Each may use those before it, and none after it:
//!
//! * [`integration`] carries a state on in time, and reads runs.
//! * [`orbits`] finds periodic motions, with the multipliers that judge them.
//! * [`bifurcations`] is where these lose their stability, in one parameter and in two.
//! * [`attractors`] says what motion a start leads to, and how that is known.
//!
//! The names used most are here, without their room.

pub mod attractors;
pub mod bifurcations;
pub mod integration;
pub mod orbits;

pub use attractors::{
    Effort, Exponent, Inquiry, Motion, Reached, Settler, Verdict, VoltageSpectrum, arrive, reach,
};
pub use bifurcations::{
    Axis, Bifurcation, Branch, BranchEnd, BranchPoint, Course, CriticalExcitation, Curve, CurveEnd,
    ForcedMotion, Line, Loss, Plane, ResonanceBoundary, SpecialKind, Start, Tongue, critical_excitation,
    find_curves, follow_branch, follow_doubled, follow_forced, largest_multipliers, resonance_boundary,
    trace_curve, trace_tongue,
};
pub use integration::{
    Collocation, ESCAPE_DISPLACEMENT, IntegrationError, Measures, NODES, Ongoing, Outcome, Reach, RunError,
    Settings, Trajectory,
};
pub use orbits::{Balance, Instability, Orbit, OrbitError, OrbitSolver, PeriodMap};
