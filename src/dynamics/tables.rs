//! Everything about a step of given length that does not depend on the state: the collocation's tables.
//!
//! In a step of length h the rest force R(s(t)) is the polynomial through its values at the eight Gauss nodes.
//! The rest of the system is linear, so the tip displacement at the nodes, the voltage there and the state at the
//! end are linear in the state at the start, the excitation's phase and those eight values; here are the matrices.

use std::sync::LazyLock;

use super::linear::{LinearPart, Workspace};
use crate::model::quadrature::{gauss_legendre, legendre};

/// Number of collocation nodes in a step; the state at its end is then of order sixteen in its length.
pub const NODES: usize = 8;

/// Entries of the state at the end of a step that are summed together.
pub(super) const BLOCK: usize = 4;

/// A value at each node of a step.
pub type NodeValues = [f64; NODES];

/// The Gauss nodes in (0, 1), the cardinal polynomials in powers of (2 x - 1), and Legendre projections.
#[derive(Debug)]
pub struct Rule {
    /// Nodes as fractions of the step.
    pub nodes: NodeValues,
    /// Monomial coefficients of the cardinal polynomials about the middle of the step, for x in -1..1.
    cardinal: [[f64; NODES]; NODES],
    /// Rows that give the two highest Legendre coefficients of a polynomial from its node values.
    pub highest: [NodeValues; 2],
    /// The same for values that already carry the quadrature weights.
    highest_of_weighted: [NodeValues; 2],
}

/// The rule used throughout.
pub static RULE: LazyLock<Rule> = LazyLock::new(|| {
    let (points, weights) = gauss_legendre(NODES);
    let mut nodes = [0.0; NODES];
    nodes.copy_from_slice(&points);
    let mut cardinal = [[0.0; NODES]; NODES];
    for (l, polynomial) in cardinal.iter_mut().enumerate() {
        polynomial[0] = 1.0;
        let own = 2.0 * nodes[l] - 1.0;
        for (_, node) in nodes.iter().enumerate().filter(|(j, _)| *j != l) {
            let other = 2.0 * node - 1.0;
            for k in (0..NODES).rev() {
                let lower = if k > 0 { polynomial[k - 1] } else { 0.0 };
                polynomial[k] = (lower - other * polynomial[k]) / (own - other);
            }
        }
    }
    let highest_of_weighted = [NODES - 1, NODES - 2]
        .map(|degree| nodes.map(|node| (2 * degree + 1) as f64 * legendre(degree, 2.0 * node - 1.0).0));
    let highest = highest_of_weighted.map(|row| std::array::from_fn(|j| row[j] * weights[j]));
    Rule { nodes, cardinal, highest, highest_of_weighted }
});

impl Rule {
    /// Taylor coefficients, about `fraction` of a step of length `h`, of the polynomial with the given node
    /// values, in powers of time.
    pub fn taylor(&self, values: &NodeValues, fraction: f64, h: f64) -> NodeValues {
        let mut coefficients = [0.0; NODES];
        for (value, polynomial) in values.iter().zip(&self.cardinal) {
            for (sum, c) in coefficients.iter_mut().zip(polynomial) {
                *sum += value * c;
            }
        }
        let origin = 2.0 * fraction - 1.0;
        for first in 0..NODES - 1 {
            for k in (first..NODES - 1).rev() {
                coefficients[k] += origin * coefficients[k + 1];
            }
        }
        let mut scale = 1.0;
        for coefficient in &mut coefficients {
            *coefficient *= scale;
            scale *= 2.0 / h;
        }
        coefficients
    }
}

/// One scalar read at the nodes of a step: linear in the extended state at its start and in R at the nodes.
#[derive(Debug, Clone, Default)]
pub struct NodeMap {
    /// One row of node values for each component of the extended vector.
    pub from_state: Vec<NodeValues>,
    /// One row of node values for each node's R.
    pub from_rest: [NodeValues; NODES],
}

impl NodeMap {
    /// The part that comes from the state at the start of the step (extended, length 2N + 3).
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

/// `sum` += `factor` * `row`.
#[inline]
pub fn add_scaled(sum: &mut NodeValues, factor: f64, row: &NodeValues) {
    for (sum, value) in sum.iter_mut().zip(row) {
        *sum += factor * value;
    }
}

/// The tables of a step of one length.
#[derive(Debug, Clone)]
pub struct StepTables {
    /// Length h of the step (dimensionless time).
    pub step: f64,
    /// Tip displacement s at the nodes.
    pub tip: NodeMap,
    /// Voltage v at the nodes.
    pub voltage: NodeMap,
    /// dv/dt at the nodes.
    pub voltage_rate: NodeMap,
    /// Change of s at the nodes when R is 1, and when R is the time since the start: the first guess of the
    /// iteration.
    pub guess: [NodeValues; 2],
    /// Largest row sum of `tip.from_rest`: how far an error of R moves s within the step.
    pub gain: f64,
    /// How far the part of R that the nodes cannot see moves the tip at the end of the step: that part is
    /// orthogonal to low degrees, so only the high Legendre coefficients of the propagator let it through.
    pub end_gain: f64,
    /// Columns of the map from the extended state and then R at the nodes to the state at the end, each of
    /// `stride` entries.
    end: Vec<f64>,
    stride: usize,
    dimension: usize,
}

impl StepTables {
    /// Prepares steps of length `step` of the linear part `part`.
    pub fn new(part: &LinearPart, step: f64) -> Self {
        let n = part.modes;
        let extended = part.extended_dimension();
        let dimension = 2 * n + 1;
        // Rows are padded to whole blocks; the padding stays zero.
        let stride = dimension.next_multiple_of(BLOCK);
        let mut tables = Self {
            step,
            tip: NodeMap { from_state: vec![[0.0; NODES]; extended], ..Default::default() },
            voltage: NodeMap { from_state: vec![[0.0; NODES]; extended], ..Default::default() },
            voltage_rate: NodeMap { from_state: vec![[0.0; NODES]; extended], ..Default::default() },
            guess: [[0.0; NODES]; 2],
            gain: 0.0,
            end_gain: 0.0,
            end: vec![0.0; stride * (extended + NODES)],
            stride,
            dimension,
        };
        let mut workspace = Workspace::default();
        let mut y = vec![0.0; extended];
        let mut derivative = vec![0.0; extended];
        for column in 0..extended + NODES {
            y.fill(0.0);
            let mut cardinal = [0.0; NODES];
            if column < extended {
                y[column] = 1.0
            } else {
                cardinal[column - extended] = 1.0
            }
            let mut reached = 0.0;
            for j in 0..=NODES {
                let target = if j < NODES { RULE.nodes[j] } else { 1.0 };
                let rest =
                    if column < extended { [0.0; NODES] } else { RULE.taylor(&cardinal, reached, step) };
                let rest: &[f64] = if column < extended { &[] } else { &rest };
                part.propagate(&mut y, (target - reached) * step, rest, &mut workspace);
                reached = target;
                if j == NODES {
                    break;
                }
                part.apply(&y, 0.0, &mut derivative);
                for (map, value) in [
                    (&mut tables.tip, y[..n].iter().sum()),
                    (&mut tables.voltage, y[2 * n]),
                    (&mut tables.voltage_rate, derivative[2 * n]),
                ] {
                    let row = match column.checked_sub(extended) {
                        None => &mut map.from_state[column],
                        Some(node) => &mut map.from_rest[node],
                    };
                    row[j] = value;
                }
            }
            tables.end[column * stride..column * stride + dimension].copy_from_slice(&y[..dimension]);
        }
        let ramp = RULE.nodes.map(|node| node * step);
        tables.guess = [tables.tip.forced(&[1.0; NODES]), tables.tip.forced(&ramp)];
        let row_sum = |j: usize| tables.tip.from_rest.iter().map(|row| row[j].abs()).sum::<f64>();
        tables.gain = (0..NODES).map(row_sum).fold(0.0, f64::max);
        tables.end_gain = tables.high_degrees_of_the_propagator(part);
        tables
    }

    /// See [`Self::end_gain`]: the two highest Legendre coefficients of the end state's response to R, as
    /// displacements (velocities divided by their mode's frequency).
    fn high_degrees_of_the_propagator(&self, part: &LinearPart) -> f64 {
        let from_rest = &self.end[(self.dimension + 2) * self.stride..];
        let mut most: f64 = 0.0;
        for row in &RULE.highest_of_weighted {
            for k in 0..2 * part.modes {
                let entries = from_rest.chunks_exact(self.stride).map(|column| column[k]);
                let coefficient: f64 = entries.zip(row).map(|(entry, factor)| entry * factor).sum();
                let scale = if k < part.modes { 1.0 } else { part.frequency(k - part.modes) };
                most = most.max(coefficient.abs() / scale);
            }
        }
        most
    }

    /// The state (first 2N + 1 entries of `out`, whose length is the padded [`Self::stride`]) at the end of the
    /// step, from the extended state at its start and R at the nodes.
    #[inline]
    pub fn end(&self, extended: &[f64], rest: &NodeValues, out: &mut [f64]) {
        // Block by block, so that the sums stay in registers.
        for (block, out) in out.chunks_exact_mut(BLOCK).enumerate() {
            let mut sums = [0.0; BLOCK];
            let inputs = extended.iter().chain(rest);
            for (value, column) in inputs.zip(self.end.chunks_exact(self.stride)) {
                for (sum, entry) in sums.iter_mut().zip(&column[block * BLOCK..(block + 1) * BLOCK]) {
                    *sum += value * entry;
                }
            }
            out.copy_from_slice(&sums);
        }
    }

    /// What a unit of component `column` of the extended state at the start (from 2N + 3 on: of R at the nodes)
    /// does to the state at the end; padded to [`Self::stride`].
    #[inline]
    pub(crate) fn end_column(&self, column: usize) -> &[f64] {
        &self.end[column * self.stride..(column + 1) * self.stride]
    }

    /// Length 2N + 1 of the state.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// Length of the padded state that [`Self::end`] writes.
    pub fn stride(&self) -> usize {
        self.stride
    }
}
