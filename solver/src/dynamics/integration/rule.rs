//! The Gauss rule of a step, and polynomials of degree seven by their values at its nodes.

use std::sync::LazyLock;

use crate::model::quadrature::{gauss_legendre, legendre};

/// Number of collocation nodes in a step; the state at its end is then of order sixteen in its length.
pub const NODES: usize = 8;

/// A value at each node of a step.
pub type NodeValues = [f64; NODES];

/// Most terms of a Taylor series that [`Rule::moments`] serve.
pub(super) const MOST_TERMS: usize = 24;

/// The Gauss nodes in (0, 1), the cardinal polynomials in powers of (2 x - 1), and Legendre projections.
#[derive(Debug)]
pub struct Rule {
    /// Nodes as fractions of the step.
    pub nodes: NodeValues,
    /// Monomial coefficients of the cardinal polynomials about the middle of the step, for x in -1..1.
    cardinal: [[f64; NODES]; NODES],
    /// Row k gives the Legendre coefficient of degree k of a polynomial from its node values.
    projection: [NodeValues; NODES],
    /// Rows that give the two highest Legendre coefficients of a polynomial from its node values.
    pub highest: [NodeValues; 2],
    /// The same for values that already carry the quadrature weights.
    pub(super) highest_of_weighted: [NodeValues; 2],
    /// For the first and the second half of the step: row l has the l-th cardinal polynomial's values at that
    /// half's own nodes.
    pub(super) halves: [[NodeValues; NODES]; 2],
    /// Row k has the integrals of (1 - x)^k times each cardinal polynomial over the step of length 1.
    pub(super) moments: [NodeValues; MOST_TERMS],
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
    // By a rule that is exact up to degree 31, and from the nodes as they are rounded.
    let cardinal_at = |x: f64| -> NodeValues {
        std::array::from_fn(|l| {
            let others = nodes.iter().enumerate().filter(|(j, _)| *j != l);
            others.map(|(_, node)| (x - node) / (nodes[l] - node)).product()
        })
    };
    let (mut projection, mut moments) = ([[0.0; NODES]; NODES], [[0.0; NODES]; MOST_TERMS]);
    let (points, fine_weights) = gauss_legendre(16);
    for (x, weight) in points.iter().zip(&fine_weights) {
        let values = cardinal_at(*x);
        for (degree, row) in projection.iter_mut().enumerate() {
            let factor = (2 * degree + 1) as f64 * legendre(degree, 2.0 * x - 1.0).0;
            add_scaled(row, weight * factor, &values);
        }
        let mut power = *weight;
        for row in &mut moments {
            add_scaled(row, power, &values);
            power *= 1.0 - x;
        }
    }
    let halves = [0.0, 0.5].map(|from| {
        let at_nodes = nodes.map(|node| cardinal_at(from + 0.5 * node));
        std::array::from_fn(|l| at_nodes.map(|values| values[l]))
    });
    let highest = [projection[NODES - 1], projection[NODES - 2]];
    let highest_of_weighted = highest.map(|row| std::array::from_fn(|j| row[j] / weights[j]));
    Rule { nodes, cardinal, projection, highest, highest_of_weighted, halves, moments }
});

impl Rule {
    /// Taylor coefficients, about `fraction` of a step of length `h`, of the polynomial with the given node
    /// values, in powers of time.
    pub fn taylor(&self, values: &NodeValues, fraction: f64, h: f64) -> NodeValues {
        let mut coefficients = self.about_the_middle(values);
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

    /// Coefficients of the polynomial with the given node values in powers of 2 x - 1, which runs from -1 to 1.
    #[inline]
    pub(super) fn about_the_middle(&self, values: &NodeValues) -> NodeValues {
        let mut coefficients = [0.0; NODES];
        for (value, polynomial) in values.iter().zip(&self.cardinal) {
            add_scaled(&mut coefficients, *value, polynomial);
        }
        coefficients
    }

    /// Legendre coefficients of the polynomial with the given node values.
    pub(super) fn coefficients(&self, values: &NodeValues) -> NodeValues {
        self.projection.map(|row| row.iter().zip(values).map(|(factor, value)| factor * value).sum())
    }

    /// Values of the polynomial with the Legendre `coefficients` at the nodes of a part of the step, which begins
    /// at the fraction `from` and has the given `length`.
    pub(super) fn values(&self, coefficients: &NodeValues, from: f64, length: f64) -> NodeValues {
        let mut sum = [0.0; NODES];
        for (coefficient, polynomial) in coefficients.iter().zip(self.polynomials(from, length)) {
            add_scaled(&mut sum, *coefficient, &polynomial);
        }
        sum
    }

    /// The Legendre polynomials of degree 0 to 7 at the nodes of a part of the step, as [`Self::values`].
    pub(super) fn polynomials(&self, from: f64, length: f64) -> [NodeValues; NODES] {
        let x = self.nodes.map(|node| 2.0 * (from + length * node) - 1.0);
        let mut polynomials = [[1.0; NODES]; NODES];
        polynomials[1] = x;
        for k in 2..NODES {
            let (a, b) = ((2 * k - 1) as f64 / k as f64, (k - 1) as f64 / k as f64);
            for i in 0..NODES {
                polynomials[k][i] = a * x[i] * polynomials[k - 1][i] - b * polynomials[k - 2][i];
            }
        }
        polynomials
    }

    /// For a linear functional of polynomials, its value for each cardinal polynomial from those for the Legendre
    /// polynomials.
    pub(super) fn to_cardinal(&self, of_legendre: &NodeValues) -> NodeValues {
        let mut sum = [0.0; NODES];
        for (value, row) in of_legendre.iter().zip(&self.projection) {
            add_scaled(&mut sum, *value, row);
        }
        sum
    }
}

/// `sum` += `factor` * `row`.
#[inline(always)]
pub fn add_scaled<const K: usize>(sum: &mut [f64; K], factor: f64, row: &[f64; K]) {
    for (sum, value) in sum.iter_mut().zip(row) {
        *sum += factor * value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_of_degree_seven_is_known_everywhere_by_its_node_values() {
        let p = |x: f64| (x - 0.3) * (x + 0.2) * (x * x - 2.0) * (x - 0.9).powi(3) + 0.1;
        let values = RULE.nodes.map(p);
        let coefficients = RULE.coefficients(&values);
        let part = RULE.values(&coefficients, 0.35, 0.25);
        for (node, value) in RULE.nodes.iter().zip(part) {
            assert!((value - p(0.35 + 0.25 * node)).abs() < 1e-14);
        }
        let taylor = RULE.taylor(&values, 0.4, 2.0);
        let at = |t: f64| taylor.iter().rev().fold(0.0, |sum, c| sum * t + c);
        assert!((at(0.6) - p(0.7)).abs() < 1e-13);
        for (half, from) in RULE.halves.iter().zip([0.0, 0.5]) {
            for (i, node) in RULE.nodes.iter().enumerate() {
                let value: f64 = half.iter().zip(&values).map(|(row, value)| row[i] * value).sum();
                assert!((value - p(from + 0.5 * node)).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn the_moments_are_beta_functions() {
        // Of x^3 (1 - x)^k: 3! k! / (k + 4)!.
        let cubes = RULE.nodes.map(|x| x.powi(3));
        for (k, row) in RULE.moments.iter().enumerate() {
            let k = k as f64;
            let exact = 6.0 / ((k + 1.0) * (k + 2.0) * (k + 3.0) * (k + 4.0));
            let moment: f64 = row.iter().zip(&cubes).map(|(a, b)| a * b).sum();
            assert!((moment - exact).abs() < 1e-15, "{k}: {moment} {exact}");
        }
    }
}
