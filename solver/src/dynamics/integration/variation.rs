//! The derivative of one collocation step: the 8 x 8 system that the variations of s at the nodes obey.
//!
//! With D = diag(dR/ds) at the nodes and K the table from R to s there, a change of the state at the start moves s
//! at the nodes by (I - K D)^-1 T times that change. K is of the order of the step squared, so I - K D is near the
//! identity and needs no pivoting; a step for which it is not is too long for the iteration as well.

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

    /// Replaces the right-hand side `x` by the solution.
    #[inline]
    pub(in crate::dynamics) fn solve(&self, x: &mut NodeValues) {
        for k in 0..NODES {
            let factor = x[k];
            add_scaled(x, factor, &self.lower[k]);
        }
        for k in (0..NODES).rev() {
            x[k] *= self.inverse_pivots[k];
            let factor = x[k];
            add_scaled(x, factor, &self.upper[k]);
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
    let dimension = tables.dimension();
    let variation = Variation::new(&tables.tip.from_rest, slopes)?;
    let mut worst: f64 = 0.0;
    for (j, column) in columns.chunks_exact_mut(tables.stride()).enumerate() {
        let mut nodes;
        if j < dimension {
            nodes = tables.tip.from_state[j];
            column.copy_from_slice(tables.end_column(j));
        } else {
            // Beta enters through both phases of the excitation.
            nodes = [0.0; NODES];
            column.fill(0.0);
            for (part, j) in [(phase.0, j), (phase.1, j + 1)] {
                add_scaled(&mut nodes, part, &tables.tip.from_state[j]);
                add_padded(column, part, tables.end_column(j));
            }
        }
        variation.solve(&mut nodes);
        for (value, slope) in nodes.iter_mut().zip(slopes) {
            *value *= slope;
        }
        for (l, value) in nodes.iter().enumerate() {
            add_padded(column, *value, tables.end_column(dimension + 2 + l));
        }
        if let Some(scale) = scales.get(j) {
            worst = worst.max(high_degrees(&nodes) * scale);
        }
    }
    Some(worst)
}

/// Sum of the sizes of the two highest Legendre coefficients of what has these node values.
#[inline]
pub(in crate::dynamics) fn high_degrees(values: &NodeValues) -> f64 {
    RULE.highest.iter().map(|row| row.iter().zip(values).map(|(a, b)| a * b).sum::<f64>().abs()).sum()
}

/// `sum` += `factor` * `column`, both padded to an even length: whole vectors of two.
#[inline(always)]
pub(in crate::dynamics) fn add_padded(sum: &mut [f64], factor: f64, column: &[f64]) {
    let (sums, entries) = (sum.as_chunks_mut::<2>().0, column.as_chunks::<2>().0);
    for (sum, entry) in sums.iter_mut().zip(entries) {
        sum[0] += factor * entry[0];
        sum[1] += factor * entry[1];
    }
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
        let mut x = right;
        Variation::new(&kernel, &slopes).expect("near the identity").solve(&mut x);
        for j in 0..NODES {
            let sum: f64 = (0..NODES).map(|l| entry(j, l) * slopes[l] * x[l]).sum();
            assert!((x[j] - sum - right[j]).abs() < 1e-14);
        }
    }

    #[test]
    fn a_step_that_is_too_long_is_refused() {
        let mut kernel = [[0.0; NODES]; NODES];
        kernel[0][0] = 0.5;
        assert!(Variation::new(&kernel, &[2.0; NODES]).is_none());
    }
}
