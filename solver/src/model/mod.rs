//! Section 2 of the paper, in its order: device, parameters, magnet, modes, the reduced system.

mod along;
pub mod base_motion;
pub mod choice;
pub mod damping;
pub mod device;
pub mod dimension;
pub mod eigenvalues;
pub mod energy;
pub mod error;
pub mod fact;
pub mod force;
pub mod inverse;
pub mod layers;
pub mod limits;
pub mod magnet;
pub mod materials;
pub mod modes;
mod open_circuit;
pub mod parameters;
pub mod quadrature;
pub mod reduced;
pub mod substances;
pub mod units;

pub use along::{Along, Shaking};
pub use choice::ModelChoice;
pub use device::ElectricalScaling;
pub use dimension::{Device, Dimension};
pub use error::ModelError;
pub use fact::{Fact, Part, Scale};
pub use force::{ForceLaw, RestForce};
pub use layers::Layers;
pub use limits::{Demand, Limits};
pub use magnet::{Equilibrium, Magnet};
pub use modes::{Mode, ModeSet};
pub use parameters::{Parameter, ParameterSet, Parameters};
pub use reduced::ReducedSystem;
pub use units::{STANDARD_GRAVITY, Units};

/// Largest number of modes a truncation may keep (dimensionless count).
pub const MAX_MODES: usize = 8;

/// Length of the state vector (q_1..q_N, dq_1/dt..dq_N/dt, v) of an N-mode truncation.
pub const fn state_dimension(modes: usize) -> usize {
    2 * modes + 1
}
