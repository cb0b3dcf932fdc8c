//! Gauss-Legendre quadrature on [0, 1], for the modal integrals and as the nodes of the collocation integrator.

use std::f64::consts::PI;

/// Nodes (ascending, in (0, 1)) and weights (sum 1) of the `n`-point Gauss-Legendre rule, n >= 1.
///
/// The nodes are the roots of the Legendre polynomial, found by Newton's iteration from the usual cosine estimate in
/// the distance from the nearer end, so that they and their weights are good to a few units of rounding relative to
/// that distance, for n up to a few hundred.
pub fn gauss_legendre(n: usize) -> (Vec<f64>, Vec<f64>) {
    let mut nodes = vec![0.0; n];
    let mut weights = vec![0.0; n];
    for i in 0..n.div_ceil(2) {
        // 1 - cos, without cancellation.
        let mut t = 2.0 * (0.5 * PI * (i as f64 + 0.75) / (n as f64 + 0.5)).sin().powi(2);
        let mut slope = 1.0;
        for _ in 0..20 {
            let (value, derivative) = legendre_near_the_end(n, t);
            slope = derivative;
            let step = value / slope;
            t -= step;
            if step.abs() < 1e-16 * t {
                break;
            }
        }
        let weight = 1.0 / (t * (2.0 - t) * slope * slope);
        (nodes[i], nodes[n - 1 - i]) = (0.5 * t, 1.0 - 0.5 * t);
        (weights[i], weights[n - 1 - i]) = (weight, weight);
    }
    (nodes, weights)
}

/// Legendre polynomial of degree `n` and its derivative with respect to `t` at 1 - t, by the recurrence for the
/// differences of neighbours, which are small where t is.
fn legendre_near_the_end(n: usize, t: f64) -> (f64, f64) {
    let (mut value, mut difference) = (1.0, 0.0);
    for k in 0..n {
        let k = k as f64;
        difference = (k * difference - (2.0 * k + 1.0) * t * value) / (k + 1.0);
        value += difference;
    }
    (value, n as f64 * (difference - t * value) / (t * (2.0 - t)))
}

/// Legendre polynomial of degree `n` and its derivative at `x` in (-1, 1).
pub fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    if n == 0 {
        return (1.0, 0.0);
    }
    for k in 2..=n {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
    }
    (value, n as f64 * (x * value - before) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_and_weights_are_those_of_forty_digit_arithmetic() {
        let (nodes, weights) = gauss_legendre(8);
        for (values, reference) in [
            (nodes, [0.019855071751231884, 0.10166676129318664, 0.2372337950418355, 0.4082826787521751]),
            (weights, [0.05061426814518813, 0.11119051722668724, 0.15685332293894363, 0.181341891689181]),
        ] {
            for (value, reference) in values.iter().zip(reference) {
                assert!((value / reference - 1.0).abs() < 1e-15, "{value} {reference}");
            }
        }
    }

    #[test]
    fn a_rule_of_n_points_integrates_powers_up_to_2n_minus_1() {
        for n in [1, 2, 5, 8, 64] {
            let (nodes, weights) = gauss_legendre(n);
            for power in [0, 1, 2 * n - 1] {
                let sum: f64 = nodes.iter().zip(&weights).map(|(x, w)| w * x.powi(power as i32)).sum();
                let exact = 1.0 / (power as f64 + 1.0);
                assert!((sum - exact).abs() < 1e-15 * 8.0, "n = {n}, power {power}: {sum}");
            }
        }
    }
}
