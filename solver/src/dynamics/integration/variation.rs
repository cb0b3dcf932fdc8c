//! The derivative of one collocation step: the 8 x 8 system that the variations of s at the nodes obey.
//!
//! With D = diag(dR/ds) at the nodes and K the table from R to s there, a change of the state at the start moves s
//! at the nodes by (I - K D)^-1 T times that change. K is of the order of the step squared, so I - K D is near the
//! identity and needs no pivoting; a step for which it is not is too long for the iteration as well.

use super::propagator::BLOCK;
use super::rule::{NODES, NodeValues, RULE, add_scaled};
use super::tables::StepTables;

/// A pivot below this is far from the identity's.
const SMALLEST_PIVOT: f64 = 0.05;

/// The factors of I - K D. Work is over whole arrays of eight, of which the other triangle is zero.
#[derive(Debug, Clone, Default)]
pub(in crate::dynamics) struct Variation {
    /// Columns of the unit lower factor below the diagonal, negative.
    lower: [NodeValues; NODES],
    /// Columns of the upper factor above the diagonal, negative.
    upper: [NodeValues; NODES],
    inverse_pivots: NodeValues,
}

impl Variation {
    /// Factorises I - K D, where `kernel` holds the columns of K and `slopes` dR/ds at the nodes.
    ///
    /// `None` when a pivot is so small that the step is too long.
    #[inline]
    pub(in crate::dynamics) fn new(kernel: &[NodeValues; NODES], slopes: &NodeValues) -> Option<Self> {
        let mut columns = [[0.0; NODES]; NODES];
        for (l, column) in columns.iter_mut().enumerate() {
            column[l] = 1.0;
            add_scaled(column, -slopes[l], &kernel[l]);
        }
        let mut factors = Self::default();
        for k in 0..NODES {
            let own = columns[k];
            let pivot = own[k];
            if !(pivot.abs() > SMALLEST_PIVOT) {
                return None;
            }
            let inverse = 1.0 / pivot;
            factors.inverse_pivots[k] = inverse;
            for (i, entry) in own.iter().enumerate() {
                if i < k {
                    factors.upper[k][i] = -entry;
                } else if i > k {
                    factors.lower[k][i] = -inverse * entry;
                }
            }
            for column in &mut columns[k + 1..] {
                let factor = column[k];
                add_scaled(column, factor, &factors.lower[k]);
            }
        }
        Some(factors)
    }

    /// Replaces the right-hand sides, K of them with their values at a node side by side, by the solutions. Several at once
    /// need not wait for one another.
    #[inline(always)]
    pub(in crate::dynamics) fn solve<const K: usize>(&self, x: &mut [[f64; K]; NODES]) {
        for k in 0..NODES {
            let own = x[k];
            for (row, factor) in x.iter_mut().zip(&self.lower[k]).skip(k + 1) {
                add_scaled(row, *factor, &own);
            }
        }
        for k in (0..NODES).rev() {
            let own = x[k].map(|value| value * self.inverse_pivots[k]);
            x[k] = own;
            for (row, factor) in x.iter_mut().zip(&self.upper[k]).take(k) {
                add_scaled(row, *factor, &own);
            }
        }
    }
}

/// The derivative of the step of `tables` where R has the `slopes` at the nodes: columns d(end)/d(state) and then
/// d(end)/d(beta) at the `phase` (sine and cosine) of the excitation, each of the tables' stride, in `columns`.
///
/// Returns the largest high part of R' times a variation at the nodes, one that `scales` make comparable, by which
/// the error is judged; `None` when the step is too long.
#[inline]
pub(in crate::dynamics) fn differentiate(
    tables: &StepTables,
    slopes: &NodeValues,
    phase: (f64, f64),
    scales: &[f64],
    columns: &mut [f64],
) -> Option<f64> {
    let (dimension, stride) = (tables.dimension(), tables.stride());
    let variation = Variation::new(&tables.tip.from_rest, slopes)?;
    let mut worst: f64 = 0.0;
    for (block, columns) in columns.chunks_mut(BLOCK * stride).enumerate() {
        let first = block * BLOCK;
        let mut nodes = [[0.0; BLOCK]; NODES];
        for (j, column) in columns.chunks_exact_mut(stride).enumerate() {
            let mut own;
            if first + j < dimension {
                own = tables.tip.from_state[first + j];
                column.copy_from_slice(tables.end_column(first + j));
            } else {
                // Beta enters through both phases of the excitation.
                own = [0.0; NODES];
                column.fill(0.0);
                let phases = [phase.0, phase.1];
                for (part, row) in phases.iter().zip(&tables.tip.from_state[dimension..]) {
                    add_scaled(&mut own, *part, row);
                }
                add_combination(column, phases.into_iter(), |k| tables.end_column(dimension + k));
            }
            nodes.iter_mut().zip(own).for_each(|(row, value)| row[j] = value);
        }
        variation.solve(&mut nodes);
        for (row, slope) in nodes.iter_mut().zip(slopes) {
            row.iter_mut().for_each(|value| *value *= slope);
        }
        for (j, column) in columns.chunks_exact_mut(stride).enumerate() {
            add_combination(column, nodes.iter().map(|row| row[j]), |l| tables.end_column(dimension + 2 + l));
        }
        let mut high = [0.0; BLOCK];
        for weights in &RULE.highest {
            let mut coefficients = [0.0; BLOCK];
            for (weight, row) in weights.iter().zip(&nodes) {
                add_scaled(&mut coefficients, *weight, row);
            }
            high.iter_mut().zip(coefficients).for_each(|(sum, coefficient)| *sum += coefficient.abs());
        }
        for (high, scale) in high.iter().zip(scales.iter().skip(first)) {
            worst = worst.max(high * scale);
        }
    }
    Some(worst)
}

/// `sum` += the sum of `factors` times the columns of the same number, all padded to whole blocks. Block by block, so that
/// the sums stay in registers.
#[inline(always)]
pub(in crate::dynamics) fn add_combination<'a>(
    sum: &mut [f64],
    factors: impl Iterator<Item = f64> + Clone,
    column: impl Fn(usize) -> &'a [f64],
) {
    for (block, sum) in sum.as_chunks_mut::<BLOCK>().0.iter_mut().enumerate() {
        let mut sums = *sum;
        for (l, factor) in factors.clone().enumerate() {
            if let Some(entries) = column(l).as_chunks::<BLOCK>().0.get(block) {
                add_scaled(&mut sums, factor, entries);
            }
        }
        *sum = sums;
    }
}

/// Sum of the sizes of the two highest Legendre coefficients of what has these node values.
#[inline]
pub(in crate::dynamics) fn high_degrees(values: &NodeValues) -> f64 {
    RULE.highest.iter().map(|row| row.iter().zip(values).map(|(a, b)| a * b).sum::<f64>().abs()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_solution_satisfies_the_equations() {
        let entry = |i: usize, j: usize| 0.1 * ((3 * i + 5 * j + 1) as f64).sin();
        let kernel: [NodeValues; NODES] = std::array::from_fn(|l| std::array::from_fn(|j| entry(j, l)));
        let slopes: NodeValues = std::array::from_fn(|l| 1.0 - 0.4 * l as f64);
        let right: NodeValues = std::array::from_fn(|l| (l as f64).cos());
        let mut x = right.map(|value| [value, -2.0 * value, 0.0]);
        Variation::new(&kernel, &slopes).expect("near the identity").solve(&mut x);
        for j in 0..NODES {
            let sum: f64 = (0..NODES).map(|l| entry(j, l) * slopes[l] * x[l][0]).sum();
            assert!((x[j][0] - sum - right[j]).abs() < 1e-14);
            assert!((x[j][1] + 2.0 * x[j][0]).abs() < 1e-14 && x[j][2] == 0.0);
        }
    }

    #[test]
    fn a_step_that_is_too_long_is_refused() {
        let mut kernel = [[0.0; NODES]; NODES];
        kernel[0][0] = 0.5;
        assert!(Variation::new(&kernel, &[2.0; NODES]).is_none());
    }
}
