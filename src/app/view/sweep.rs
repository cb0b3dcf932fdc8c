//! What the Sweep tab shows, as stored.

use serde::{Deserialize, Serialize};

use crate::dynamics::attractors::sweep::Dwell;
use crate::model::{ModelError, Parameter};
use crate::questions::sweep::COUNTS;
use crate::scenario::counted;

/// What is swept, and how.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct SweepView {
    /// What changes.
    pub parameter: Parameter,
    /// Lowest and highest value; about the resonance in view, or the present value, when absent.
    pub range: Option<(f64, f64)>,
    /// Number of values.
    pub count: usize,
    /// How long each is held.
    pub dwell: Dwell,
    /// What the response curves show.
    pub output: Output,
}

impl Default for SweepView {
    fn default() -> Self {
        let (parameter, dwell) = (Parameter::Omega, Dwell::default());
        Self { parameter, range: None, count: 240, dwell, output: Output::default() }
    }
}

impl SweepView {
    /// Checks range, number of values and dwell.
    pub(super) fn check(&self) -> Result<(), ModelError> {
        let Self { parameter, range, count, dwell, .. } = *self;
        if let Some((from, to)) = range {
            for end in [from, to] {
                ModelError::check(parameter.field(), end, parameter.range(), "")?;
            }
        }
        counted("sweep.count", count, COUNTS)?;
        dwell.validate()
    }
}

/// What a response curve shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Output {
    /// Root mean square of the voltage.
    #[default]
    Voltage,
    /// Mean power in the load.
    Power,
    /// Largest and smallest tip displacement over the gap.
    Tip,
}
