//! What the Live tab shows, as stored.

use serde::{Deserialize, Serialize};

use crate::model::ModelError;
use crate::scenario::counted;

/// Slowest and fastest run, in excitation periods a second.
pub const SPEEDS: (f64, f64) = (0.05, 200.0);
/// Shortest and longest window of the oscilloscope, in excitation periods.
pub const WINDOWS: (usize, usize) = (1, 48);
/// Weakest and strongest kick: how far it makes mode 1 alone swing, in gaps.
pub const KICKS: (f64, f64) = (0.001, 2.0);

/// What the oscilloscope and the phase portrait show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Trace {
    /// The voltage and its rate.
    #[default]
    Voltage,
    /// The tip's displacement and velocity.
    Tip,
}

/// The Live tab.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct LiveView {
    /// What is traced.
    pub trace: Trace,
    /// Excitation periods a second.
    pub speed: f64,
    /// Excitation periods across the oscilloscope.
    pub periods: usize,
    /// How far a kick makes mode 1 alone swing, in gaps.
    pub kick: f64,
}

impl Default for LiveView {
    fn default() -> Self {
        Self { trace: Trace::default(), speed: 2.0, periods: 12, kick: 0.2 }
    }
}

impl LiveView {
    /// Checks that everything is in its range.
    ///
    /// # Errors
    /// [`ModelError`] naming what is not.
    pub(super) fn check(&self) -> Result<(), ModelError> {
        ModelError::check("live.speed", self.speed, SPEEDS, " periods a second")?;
        ModelError::check("live.kick", self.kick, KICKS, "")?;
        counted("live.periods", self.periods, WINDOWS)
    }
}
