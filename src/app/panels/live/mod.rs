//! The Live tab: controls, oscilloscope, phase portrait and beam of a run in which time goes on.

pub(super) mod beam;
mod controls;
pub(super) mod portrait;
mod readout;
pub(super) mod scope;
mod tab;
mod traced;

pub(in crate::app) use tab::{PANELS, show};
