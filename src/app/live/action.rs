//! What drives the run, and what ends it.

use crate::dynamics::Outcome;
use crate::sentence::Sentence;

/// What the user wants of the run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::app) enum LiveAction {
    /// Run, or pause.
    Toggle,
    /// Pause, and go on for one excitation period.
    StepPeriod,
    /// Pause, and go on for as much as a frame at the present speed.
    StepFrame,
    /// Kick the tip up (1) or down (-1).
    Kick(f64),
    /// Start from rest, at phase 0.
    FromRest,
    /// Start where the run of the other tabs has settled.
    FromSettled,
    /// Forget curves and points.
    Clear,
    /// Let the voltage be heard, or not.
    Sound,
}

/// Why the run stands still.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::app) enum End {
    /// Escape or contact.
    Outcome(Outcome),
    /// It cannot be computed.
    Failed(Sentence),
}
