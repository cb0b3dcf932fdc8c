//! The truncation in use: how many modes, and which force law.

use serde::{Deserialize, Serialize};

use super::{ForceLaw, ModelError, ParameterSet, Parameters, ReducedSystem};

/// Which truncation is used.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
#[serde(default, deny_unknown_fields)]
pub struct ModelChoice {
    /// Number of modes N, 1 to 8.
    pub modes: usize,
    /// Law of the magnets' rest force.
    pub force: ForceLaw,
}

impl Default for ModelChoice {
    /// The paper's: two modes, quadratic force.
    fn default() -> Self {
        Self { modes: 2, force: ForceLaw::Quadratic }
    }
}

impl ModelChoice {
    /// The reduced system of `set` under this choice: raw input becomes valid here.
    ///
    /// # Errors
    /// [`ModelError`], naming what is out of range.
    pub fn system(&self, set: ParameterSet) -> Result<ReducedSystem, ModelError> {
        ReducedSystem::new(Parameters::new(set)?, self.modes, self.force)
    }
}
