//! The design bench: what a device harvests in SI units, with which load and ceramic, within which limits, and how far
//! the model is to be trusted there; all of it pieces of [`Work`](super::work::Work).

pub mod band;
pub mod error;
pub mod harvest;
pub mod linear;
pub mod plant;

pub use band::Interval;
pub use error::DesignError;
pub use harvest::{Harvest, Operating, operating};
pub use plant::Plant;
