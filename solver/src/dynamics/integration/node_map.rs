//! One scalar at the nodes of a step.

use super::rule::{NODES, NodeValues, add_scaled};

/// One scalar read at the nodes of a step: linear in the extended state at its start and in R at the nodes.
#[derive(Debug, Clone, Default)]
pub struct NodeMap {
    /// One row of node values for each component of the extended vector.
    pub from_state: Vec<NodeValues>,
    /// One row of node values for each node's R.
    pub from_rest: [NodeValues; NODES],
}

impl NodeMap {
    /// The part that comes from the state at the start of the step (extended).
    #[inline]
    pub fn free(&self, extended: &[f64]) -> NodeValues {
        let mut sum = [0.0; NODES];
        for (value, row) in extended.iter().zip(&self.from_state) {
            add_scaled(&mut sum, *value, row);
        }
        sum
    }

    /// The part that comes from R at the nodes.
    #[inline]
    pub fn forced(&self, rest: &NodeValues) -> NodeValues {
        let mut sum = [0.0; NODES];
        for (value, row) in rest.iter().zip(&self.from_rest) {
            add_scaled(&mut sum, *value, row);
        }
        sum
    }

    /// The scalar at the nodes.
    pub fn at_nodes(&self, extended: &[f64], rest: &NodeValues) -> NodeValues {
        let mut sum = self.free(extended);
        for (value, row) in rest.iter().zip(&self.from_rest) {
            add_scaled(&mut sum, *value, row);
        }
        sum
    }
}
