//! The Live tab: controls, oscilloscope, phase portrait and beam of a run in which time goes on.

mod controls;
mod readout;
mod tab;
pub(super) mod traced;

pub(super) use controls::show as controls;
pub(in crate::app) use tab::show;
