//! Everything about a step of given length that does not depend on the state: the collocation's tables.
//!
//! In a step of length h the rest force R(s(t)) is the polynomial through its values at the eight Gauss nodes.
//! The rest of the system is linear, so the tip displacement at the nodes, the voltage there and the state at the
//! end are linear in the state at the start, the excitation's phase and those eight values; here are the matrices.

use super::linear::LinearPart;
use super::node_map::NodeMap;
use super::propagator::{BLOCK, Propagator};
use super::rule::{NODES, NodeValues, RULE};

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
    /// Slope at the tip at the nodes.
    pub tip_slope: NodeMap,
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
        Self::of(&Propagator::new(part, step))
    }

    /// Prepares steps as long as the longest duration of `propagator`.
    pub fn of(propagator: &Propagator) -> Self {
        let (part, step) = (propagator.part(), propagator.duration());
        let n = part.modes;
        let extended = part.extended_dimension();
        let dimension = 2 * n + 1;
        // Rows are padded to whole blocks; the padding stays zero.
        let stride = dimension.next_multiple_of(BLOCK);
        let empty = || NodeMap { from_state: vec![[0.0; NODES]; extended], ..Default::default() };
        let mut tables = Self {
            step,
            tip: empty(),
            voltage: empty(),
            voltage_rate: empty(),
            tip_slope: empty(),
            guess: [[0.0; NODES]; 2],
            gain: 0.0,
            end_gain: 0.0,
            end: vec![0.0; stride * (extended + NODES)],
            stride,
            dimension,
        };
        for (column, out) in tables.end.chunks_exact_mut(stride).enumerate() {
            propagator.end_column(column, &mut out[..dimension]);
        }
        let mut rows = vec![vec![0.0; extended]; 4];
        rows[0][..n].fill(1.0);
        rows[1][2 * n] = 1.0;
        rows[3][..dimension].copy_from_slice(&part.slopes);
        let (voltage, rate) = rows.split_at_mut(2);
        part.apply_transposed(&voltage[1], &mut rate[0]);
        let maps = [&mut tables.tip, &mut tables.voltage, &mut tables.voltage_rate, &mut tables.tip_slope];
        for (map, row) in maps.into_iter().zip(&rows) {
            propagator.read_at_nodes(row, map);
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
        let from_rest = &self.end[part.extended_dimension() * self.stride..];
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

    /// What a unit of component `column` of the extended state at the start (beyond it: of R at the nodes)
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
