//! What a start leads to.
//!
//! * [`settle`] is the one answer to that question: every task and every tab asks it.
//! * `neighbourhood` tells whether a run lies in the linear neighbourhood of a periodic motion, and what it does there.
//! * [`rotation`] has means and frequencies by weighted Birkhoff averages, `zero_one` the 0-1 test for chaos.

mod neighbourhood;
pub mod rotation;
pub mod settle;
mod zero_one;
