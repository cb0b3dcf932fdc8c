//! What motion a start leads to.
//!
//! Read in this order:
//!
//! * [`motion`] has the classes, [`settle`] the one answer to that question: every task and every tab asks it.
//!   `pursuit` follows one start from look to look, `repertoire` keeps the periodic motions found, [`effort`]
//!   says how much work a start is worth.
//! * What it decides by: `strobe` keeps the stroboscopic states of a run, whose recurrence is that of [`poincare`];
//!   `neighbourhood` tells whether they lie in the linear neighbourhood of a periodic motion, and what they do there;
//!   [`rotation`] has means and frequencies by weighted Birkhoff averages, `zero_one` the 0-1 test for chaos, [`lyapunov`]
//!   the exponents, from the growth of `tangent` vectors. `meter` measures what does not repeat.
//! * `arrival` says whether rounding decides where a start leads.
//! * [`dielectric`] takes a dielectric's loss at the frequency of the motion that it has a part in.
//! * [`rectified`] follows the device with a rectifier until its cycle repeats.
//! * [`signature`] tells whether two starts lead to the same motion; [`sweep`] carries a motion from one value of a
//!   parameter to the next.
//! * [`spectrum`] has lines, [`spectral_label`] their names, [`voltage_spectrum`] those of a motion's voltage.
//! * [`verdict`] is all that is known of a motion with its [`evidence`]; `inquiry` computes it.
//!
//! The uppermost room: it may use all others, and none of them uses it.

mod arrival;
pub mod dielectric;
pub mod effort;
pub mod evidence;
mod inquiry;
pub mod lyapunov;
mod meter;
pub mod motion;
mod neighbourhood;
pub mod poincare;
mod pursuit;
pub mod rectified;
mod repertoire;
pub mod rotation;
pub mod settle;
pub mod signature;
pub mod spectral_label;
pub mod spectrum;
mod strobe;
pub mod sweep;
mod tangent;
pub mod verdict;
pub mod voltage_spectrum;
mod zero_one;

pub use arrival::arrive;
pub use effort::Effort;
pub use inquiry::Inquiry;
pub use lyapunov::Exponent;
pub use motion::{Motion, Reached};
pub use settle::{Settler, reach};
pub use verdict::Verdict;
pub use voltage_spectrum::VoltageSpectrum;
