//! The truncation in use: how many modes, which force law, and whether the modes left out count in the circuit.

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
    /// Whether the circuit feels the modes left out: see [`ReducedSystem::with_residual_moment`].
    #[serde(skip_serializing_if = "is_off")]
    pub residual_moment: bool,
}

fn is_off(choice: &bool) -> bool {
    !choice
}

impl Default for ModelChoice {
    /// The paper's: two modes, quadratic force, nothing of the modes left out.
    fn default() -> Self {
        Self { modes: 2, force: ForceLaw::Quadratic, residual_moment: false }
    }
}

impl ModelChoice {
    /// That of a `system`.
    pub fn of(system: &ReducedSystem) -> Self {
        let ReducedSystem { modes, law, residual_moment, .. } = system;
        Self { modes: modes.len(), force: *law, residual_moment: *residual_moment }
    }

    /// The reduced system of `set` under this choice: raw input becomes valid here.
    ///
    /// # Errors
    /// [`ModelError`], naming what is out of range.
    pub fn system(&self, set: ParameterSet) -> Result<ReducedSystem, ModelError> {
        let system = ReducedSystem::new(Parameters::new(set)?, self.modes, self.force)?;
        Ok(system.with_residual_moment(self.residual_moment))
    }
}
