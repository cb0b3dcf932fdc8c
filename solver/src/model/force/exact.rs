//! The magnet force itself as a law, without loss of digits for small displacements.

use crate::model::{Equilibrium, Magnet};

/// The magnet force itself, R(s) = F(s0) - F(s0 + s) - c_1 s.
///
/// For small s the three terms cancel to second order. F is a rational function with the denominator
/// Q(s) = (s0 + s)^2 (s0 + h + s)^2 (s0 + 2h + s)^2, so R = s^2 M(s) / Q(s) exactly, with M of degree five whose
/// coefficients follow from c_2..c_7; that form keeps its digits there. Near contact M itself cancels, while the
/// difference of forces does not, hence two branches.
#[derive(Debug, Clone, PartialEq)]
pub struct Exact {
    magnet: Magnet,
    gap: f64,
    force_at_rest: f64,
    c1: f64,
    /// M_0..M_5.
    numerator: [f64; 6],
}

impl Exact {
    /// The force law of a magnet at its equilibrium.
    pub fn new(magnet: &Magnet, rest: &Equilibrium) -> Self {
        let gap = rest.gap;
        let mut denominator = [0.0; 7];
        denominator[0] = 1.0;
        for root in [gap, gap, gap + magnet.h, gap + magnet.h, gap + 2.0 * magnet.h, gap + 2.0 * magnet.h] {
            for k in (0..7).rev() {
                denominator[k] = denominator[k] * root + if k > 0 { denominator[k - 1] } else { 0.0 };
            }
        }
        let mut numerator = [0.0; 6];
        for (i, j) in (2..8).enumerate() {
            let coefficient = magnet.taylor_coefficient(gap, j);
            for k in i..6 {
                numerator[k] += coefficient * denominator[k - i];
            }
        }
        Self {
            magnet: *magnet,
            gap,
            force_at_rest: magnet.force(gap),
            c1: magnet.taylor_coefficient(gap, 1),
            numerator,
        }
    }

    fn is_small(&self, s: f64) -> bool {
        s.abs() < 0.5 * self.gap
    }

    /// R(s).
    pub fn rest(&self, s: f64) -> f64 {
        self.rest_at(&[s])[0]
    }

    // Long: called, so that loops over the shorter laws stay short.
    #[inline(never)]
    pub(super) fn rest_at<const K: usize>(&self, s: &[f64; K]) -> [f64; K] {
        // Nearly always all are small, and without a branch for each they are done by vectors.
        if s.iter().all(|s| self.is_small(*s)) {
            s.map(|s| self.rest_when_small(s))
        } else {
            s.map(|s| if self.is_small(s) { self.rest_when_small(s) } else { self.rest_when_large(s) })
        }
    }

    #[inline(never)]
    pub(super) fn slope_at<const K: usize>(&self, s: &[f64; K]) -> [f64; K] {
        if s.iter().all(|s| self.is_small(*s)) {
            s.map(|s| self.slope_when_small(s))
        } else {
            s.map(|s| if self.is_small(s) { self.slope_when_small(s) } else { self.slope_when_large(s) })
        }
    }

    #[inline]
    fn rest_when_small(&self, s: f64) -> f64 {
        let numerator = self.numerator.iter().rev().fold(0.0, |sum, c| sum * s + c);
        let near = self.gap + s;
        let product = near * (near + self.magnet.h) * (near + 2.0 * self.magnet.h);
        s * s * numerator / (product * product)
    }

    fn rest_when_large(&self, s: f64) -> f64 {
        self.force_at_rest - self.magnet.force(self.gap + s) - self.c1 * s
    }

    #[inline]
    fn slope_when_small(&self, s: f64) -> f64 {
        // M(s) and M'(s), then Q'(s) / Q(s).
        let (mut m, mut dm) = (0.0, 0.0);
        for coefficient in self.numerator.iter().rev() {
            dm = dm * s + m;
            m = m * s + coefficient;
        }
        let near = self.gap + s;
        let (middle, far) = (near + self.magnet.h, near + 2.0 * self.magnet.h);
        let product = near * middle * far;
        let log_slope = 2.0 * (1.0 / near + 1.0 / middle + 1.0 / far);
        s * (2.0 * m + s * (dm - m * log_slope)) / (product * product)
    }

    fn slope_when_large(&self, s: f64) -> f64 {
        self.magnet.taylor_coefficient(self.gap + s, 1) - self.c1
    }

    pub(super) fn potential(&self, s: f64) -> f64 {
        let magnets = self.magnet.potential(self.gap + s) - self.magnet.potential(self.gap);
        self.force_at_rest * s - 0.5 * self.c1 * s * s + magnets
    }

    /// The tip displacement at which the magnets touch; `None` without magnets.
    pub fn contact(&self) -> Option<f64> {
        (self.magnet.c0 != 0.0).then_some(-self.gap)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MAGNET: Magnet = Magnet { c0: 0.5084, h: 0.004167 };

    fn rest() -> Equilibrium {
        MAGNET.equilibrium(0.15).expect("the paper's magnets have an equilibrium")
    }

    /// The three-term form of the remainder, r(X) = s^2 (3X + 2s) / (X^3 (X + s)^2) summed over the poles: a
    /// different arrangement of the same algebra that is good to about ten digits.
    fn remainder_by_poles(magnet: &Magnet, s0: f64, s: f64) -> f64 {
        let r = |x: f64| s * s * (3.0 * x + 2.0 * s) / (x.powi(3) * (x + s).powi(2));
        -magnet.c0 * (r(s0) + r(s0 + 2.0 * magnet.h) - 2.0 * r(s0 + magnet.h))
    }

    #[test]
    fn the_exact_law_agrees_with_the_remainder_by_poles() {
        for magnet in [MAGNET, Magnet { c0: -1e-3, h: 0.05 }] {
            let rest = magnet.equilibrium(0.15).expect("both pairs have an equilibrium");
            let law = Exact::new(&magnet, &rest);
            for fraction in [-0.99, -0.9, -0.6, -0.49, -0.1, -1e-3, 1e-4, 0.01, 0.3, 0.499, 0.51, 2.0] {
                let s = fraction * rest.gap;
                let ratio = law.rest(s) / remainder_by_poles(&magnet, rest.gap, s);
                assert!((ratio - 1.0).abs() < 1e-9, "{magnet:?} s/s0 = {fraction}: {ratio}");
            }
        }
    }

    #[test]
    fn close_to_rest_the_exact_law_is_its_quadratic_term() {
        let law = Exact::new(&MAGNET, &rest());
        let s = 1e-9;
        let (c2, c3) = (-19.378543266711, 223.38294552191);
        assert!((law.rest(s) / (c2 * s * s + c3 * s * s * s) - 1.0).abs() < 1e-11);
    }
}
