//! Within a step: the flow from any offset to a later one, under the step's own polynomial R.

use super::{Propagator, add, scale};
use crate::dynamics::integration::rule::{NODES, NodeValues, RULE};

impl Propagator {
    /// Carries `y` (length 2N + 3) from one offset within a step to a later one, both in units of time from the
    /// step's start and no further apart than the longest duration.
    pub(in crate::dynamics) fn carry(
        &self,
        y: &mut [f64],
        from: f64,
        to: f64,
        rest: &StepRest,
        workspace: &mut Workspace,
    ) {
        let count = ((to - from) / self.unit).max(0.0);
        let whole = (count as u64).min(2 * self.units() - 1);
        let mut position = from;
        for (level, flow) in self.flows.iter().enumerate().rev() {
            if whole >> level & 1 == 0 {
                continue;
            }
            let duration = self.unit * (1_u64 << level) as f64;
            let values = RULE.values(&rest.coefficients, position / rest.step, duration / rest.step);
            let Workspace { next, .. } = workspace;
            next.clear();
            next.resize(self.stride, 0.0);
            let inputs = y.iter().chain(&values);
            for (value, column) in inputs.zip(flow.columns.chunks_exact(self.stride)) {
                add(next, *value, column);
            }
            add(y, 1.0, next);
            position += duration;
        }
        if to > position {
            self.carry_briefly(y, position, to - position, rest, workspace);
        }
    }

    /// By Taylor series, over at most a unit.
    fn carry_briefly(
        &self,
        y: &mut [f64],
        from: f64,
        duration: f64,
        rest: &StepRest,
        workspace: &mut Workspace,
    ) {
        // Term k carries duration^k, and so must the coefficient of R that enters it.
        let coefficients = RULE.taylor(&rest.values, from / rest.step, rest.step / duration);
        let Workspace { term, next } = workspace;
        term.clear();
        term.extend_from_slice(y);
        next.resize(self.width, 0.0);
        next.truncate(self.width);
        for k in 0..self.terms.max(NODES) {
            self.part.apply(term, coefficients.get(k).copied().unwrap_or(0.0), next);
            scale(next, duration / (k as f64 + 1.0));
            add(y, 1.0, next);
            std::mem::swap(term, next);
        }
    }
}

/// The polynomial R of a step.
#[derive(Debug, Clone, Default)]
pub(in crate::dynamics) struct StepRest {
    /// Length of the step (dimensionless).
    step: f64,
    values: NodeValues,
    coefficients: NodeValues,
}

impl StepRest {
    /// The polynomial with the given `values` at the nodes of a step.
    pub(in crate::dynamics) fn new(values: &NodeValues, step: f64) -> Self {
        Self { step, values: *values, coefficients: RULE.coefficients(values) }
    }

    /// R at `place`, a fraction of the step.
    pub(in crate::dynamics) fn at(&self, place: f64) -> f64 {
        RULE.values(&self.coefficients, place, 0.0)[0]
    }
}

/// Vectors that [`Propagator::carry`] reuses, so that it does not allocate.
#[derive(Debug, Clone, Default)]
pub(in crate::dynamics) struct Workspace {
    term: Vec<f64>,
    next: Vec<f64>,
}
