//! The design bench: what a device harvests in SI units, with which load and ceramic, within which limits, and how far
//! the model is to be trusted there.

pub mod alignment;
pub mod band;
pub mod bounds;
mod branches;
pub mod change;
pub mod columns;
pub mod error;
pub mod evolution;
pub mod fit;
pub mod harvest;
pub mod layout;
pub mod linear;
pub mod load;
pub mod materials;
pub mod measured;
pub mod measured_error;
pub mod peak;
pub mod plant;
pub mod point;
pub mod polish;
pub mod published;
pub mod record;
pub mod rectified;
pub mod space;
pub mod thin;
pub mod tolerance;
pub mod trust;

pub use band::Interval;
pub use bounds::Bounds;
pub(in crate::questions) use branches::delivering_branches;
pub use error::DesignError;
pub use harvest::{Harvest, Operating, operating};
pub use plant::Plant;
pub use point::HarvestPoint;
pub use rectified::RectifiedPoint;
