//! How a motion goes on from a state: time integration, and what is read off a run on the way.
//!
//! Read in this order:
//!
//! * [`outcome`] says how a run can end, [`rk4`] repeats the paper's own runs, step by step.
//! * [`collocation`] is the integrator behind everything else: the linear beam and circuit are carried by their exact
//!   [`propagator`], the magnet's rest force by Gauss-Legendre collocation. [`linear`] has the matrices, [`rule`] the
//!   nodes, [`tables`] what a step of one length needs, in part as [`node_map`]s, and `rung` has these for all who take such
//!   steps; `grid` says where steps begin and end, [`step`] is one of them as it is shown, `variation` its derivative.
//! * [`trajectory`] keeps the steps of a run for dense output; [`ongoing`] is a motion without an end, whose numbers may
//!   change on the way; [`shaken`] is a motion under any shaking of the base.
//! * [`rectified`] is a run with a rectifier in place of the load: two linear parts, and the instants at which one gives way
//!   to the other.
//! * `extremes` reads what lies between the nodes of steps, [`measures`] the numbers of a motion, [`summary`] a run while it
//!   is computed.
//!
//! It knows nothing of the other rooms.

pub mod collocation;
pub(super) mod extremes;
pub(super) mod grid;
pub mod linear;
pub mod measures;
pub mod node_map;
pub mod ongoing;
pub mod outcome;
pub mod propagator;
pub mod rectified;
pub mod rk4;
pub mod rule;
pub(super) mod rung;
pub mod shaken;
pub mod step;
pub mod summary;
pub mod tables;
pub mod trajectory;
pub(super) mod variation;

pub use collocation::{Collocation, Settings};
pub use measures::Measures;
pub use ongoing::{Ongoing, Reach};
pub use outcome::{ESCAPE_DISPLACEMENT, IntegrationError, Outcome, RunError};
pub use rule::NODES;
pub use shaken::Shaken;
pub use step::Step;
pub use trajectory::Trajectory;
