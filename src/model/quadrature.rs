//! Gauss-Legendre quadrature on [0, 1], for the modal integrals and as the nodes of the collocation integrator.

use std::f64::consts::PI;

/// Nodes (ascending, in (0, 1)) and weights (sum 1) of the `n`-point Gauss-Legendre rule, n >= 1.
///
/// The nodes are the roots of the Legendre polynomial, found by Newton's iteration from the usual cosine estimate;
/// good to rounding for n up to a few hundred.
pub fn gauss_legendre(n: usize) -> (Vec<f64>, Vec<f64>) {
    let mut nodes = vec![0.0; n];
    let mut weights = vec![0.0; n];
    for i in 0..n {
        let mut x = -(PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..20 {
            let (value, derivative) = legendre(n, x);
            slope = derivative;
            let step = value / slope;
            x -= step;
            if step.abs() < 1e-16 {
                break;
            }
        }
        nodes[i] = 0.5 * (1.0 + x);
        weights[i] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
    (nodes, weights)
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
