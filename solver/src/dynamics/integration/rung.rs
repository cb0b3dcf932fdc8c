//! Steps of one length, and those half as long: everything about them that does not depend on the state.

use std::sync::{Arc, OnceLock};

use super::linear::LinearPart;
use super::propagator::Propagator;
use super::tables::StepTables;

/// Steps of one length of one linear part. Whoever steps through the same part shares them, and what one of them has
/// halved.
#[derive(Debug)]
pub(in crate::dynamics) struct Rung {
    /// The flow over a step.
    pub(in crate::dynamics) propagator: Propagator,
    /// The tables of a step.
    pub(in crate::dynamics) tables: StepTables,
    /// Steps half as long, once somebody has needed them.
    half: OnceLock<Arc<Self>>,
}

impl Rung {
    /// Steps of length `step` (dimensionless) of `part`.
    pub(in crate::dynamics) fn new(part: &LinearPart, step: f64) -> Self {
        let propagator = Propagator::new(part, step);
        let tables = StepTables::of(&propagator);
        Self { propagator, tables, half: OnceLock::new() }
    }

    /// Steps half as long.
    pub(in crate::dynamics) fn half(&self) -> Arc<Self> {
        let halved = || Arc::new(Self::new(self.propagator.part(), 0.5 * self.tables.step));
        Arc::clone(self.half.get_or_init(halved))
    }
}
