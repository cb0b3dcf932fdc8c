//! Periodic motions, of one device at one excitation.
//!
//! Read in this order:
//!
//! * [`period_map`] is the stroboscopic map with its exact derivative, [`newton`] finds its fixed points.
//! * `march` follows the motion that grows out of rest up to an excitation.
//! * [`orbit`] is a periodic motion, measured and judged by its multipliers, which are those of [`floquet`].
//! * [`balance`] is the energy balance of a motion; [`orbit_error`] says why there may be no orbit.
//!
//! Built on `integration` alone.

pub mod balance;
pub mod floquet;
pub(super) mod march;
pub mod newton;
pub mod orbit;
pub mod orbit_error;
pub mod period_map;

pub use balance::Balance;
pub use floquet::Instability;
pub use newton::OrbitSolver;
pub use orbit::Orbit;
pub use orbit_error::OrbitError;
pub use period_map::PeriodMap;
