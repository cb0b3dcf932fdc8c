//! The nonlinear rest R(s) of the magnet force, in the three laws a user can choose between.
//!
//! With s the tip displacement from equilibrium, the magnets pull back with c_1 s + R(s) (Eq. 16). The linear part
//! belongs to the modes; R is what makes the harvester nonlinear.

use serde::{Deserialize, Serialize};

use super::{Equilibrium, Magnet, ModelError};

/// Which R(s) the tip feels.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin,
)]
#[serde(rename_all = "lowercase")]
pub enum ForceLaw {
    /// c_2 s^2, the paper's truncation (section 3).
    #[default]
    Quadratic,
    /// Sum of c_j s^j for j = 2 to the given degree; meaningful only for |s| below the gap s0.
    Taylor(usize),
    /// F(s0) - F(s0 + s) - c_1 s, the magnet force itself.
    Exact,
}

impl ForceLaw {
    /// Largest degree of [`ForceLaw::Taylor`].
    pub const MAX_DEGREE: usize = 15;

    /// Checks the degree of a Taylor law.
    ///
    /// # Errors
    /// [`ModelError::Count`] when the degree is not 2 to [`Self::MAX_DEGREE`].
    pub fn validate(self) -> Result<Self, ModelError> {
        match self {
            Self::Taylor(value) if !(2..=Self::MAX_DEGREE).contains(&value) => Err(ModelError::Count {
                field: "taylor degree",
                value,
                minimum: 2,
                maximum: Self::MAX_DEGREE,
            }),
            law => Ok(law),
        }
    }
}

/// R(s) with its slope and potential. `s` is in beam lengths, R dimensionless.
pub trait RestForce {
    /// R(s).
    fn rest(&self, s: f64) -> f64;
    /// dR/ds.
    fn slope(&self, s: f64) -> f64;
    /// The integral of R from 0 to s.
    fn potential(&self, s: f64) -> f64;
    /// The tip displacement at which the magnets touch, when this law knows of it.
    fn contact(&self) -> Option<f64>;
}

/// A polynomial R(s) = c_2 s^2 + c_3 s^3 + .. (Eq. 16 truncated).
#[derive(Debug, Clone, PartialEq)]
pub struct Polynomial {
    /// c_2, c_3, ..
    coefficients: Vec<f64>,
}

impl Polynomial {
    /// The Taylor polynomial of the magnet's force at its equilibrium, up to `degree` >= 2.
    pub fn new(magnet: &Magnet, rest: &Equilibrium, degree: usize) -> Self {
        let coefficients = (2..=degree as u32).map(|j| magnet.taylor_coefficient(rest.gap, j)).collect();
        Self { coefficients }
    }
}

impl RestForce for Polynomial {
    #[inline]
    fn rest(&self, s: f64) -> f64 {
        s * s * self.coefficients.iter().rev().fold(0.0, |sum, c| sum * s + c)
    }

    #[inline]
    fn slope(&self, s: f64) -> f64 {
        let weighted = self.coefficients.iter().enumerate().rev();
        s * weighted.fold(0.0, |sum, (i, c)| sum * s + (i as f64 + 2.0) * c)
    }

    fn potential(&self, s: f64) -> f64 {
        let weighted = self.coefficients.iter().enumerate().rev();
        s * s * s * weighted.fold(0.0, |sum, (i, c)| sum * s + c / (i as f64 + 3.0))
    }

    fn contact(&self) -> Option<f64> {
        None
    }
}

/// R(s) = c_2 s^2, kept apart from [`Polynomial`] because it is the paper's model and the fastest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quadratic {
    /// c_2 (dimensionless).
    pub c2: f64,
}

impl RestForce for Quadratic {
    #[inline]
    fn rest(&self, s: f64) -> f64 {
        self.c2 * s * s
    }

    #[inline]
    fn slope(&self, s: f64) -> f64 {
        2.0 * self.c2 * s
    }

    fn potential(&self, s: f64) -> f64 {
        self.c2 * s * s * s / 3.0
    }

    fn contact(&self) -> Option<f64> {
        None
    }
}

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

    /// M(s), M'(s), Q(s) and Q'(s)/Q(s).
    fn fraction(&self, s: f64) -> (f64, f64, f64, f64) {
        let (mut m, mut dm) = (0.0, 0.0);
        for coefficient in self.numerator.iter().rev() {
            dm = dm * s + m;
            m = m * s + coefficient;
        }
        let near = self.gap + s;
        let (middle, far) = (near + self.magnet.h, near + 2.0 * self.magnet.h);
        let product = near * middle * far;
        (m, dm, product * product, 2.0 * (1.0 / near + 1.0 / middle + 1.0 / far))
    }
}

impl RestForce for Exact {
    #[inline]
    fn rest(&self, s: f64) -> f64 {
        if self.is_small(s) {
            let numerator = self.numerator.iter().rev().fold(0.0, |sum, c| sum * s + c);
            let near = self.gap + s;
            let product = near * (near + self.magnet.h) * (near + 2.0 * self.magnet.h);
            s * s * numerator / (product * product)
        } else {
            self.force_at_rest - self.magnet.force(self.gap + s) - self.c1 * s
        }
    }

    #[inline]
    fn slope(&self, s: f64) -> f64 {
        if self.is_small(s) {
            let (m, dm, q, log_slope) = self.fraction(s);
            s * (2.0 * m + s * (dm - m * log_slope)) / q
        } else {
            self.magnet.taylor_coefficient(self.gap + s, 1) - self.c1
        }
    }

    fn potential(&self, s: f64) -> f64 {
        let magnets = self.magnet.potential(self.gap + s) - self.magnet.potential(self.gap);
        self.force_at_rest * s - 0.5 * self.c1 * s * s + magnets
    }

    fn contact(&self) -> Option<f64> {
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

    #[test]
    fn slope_and_potential_are_derivative_and_integral_of_the_force() {
        let rest = rest();
        let laws: [Box<dyn RestForce>; 3] = [
            Box::new(Quadratic { c2: -19.4 }),
            Box::new(Polynomial::new(&MAGNET, &rest, 5)),
            Box::new(Exact::new(&MAGNET, &rest)),
        ];
        for law in &laws {
            for s in [-0.14, -0.0846, -0.03, 0.002, 0.0847, 0.2] {
                let step = 1e-6;
                let slope = (law.rest(s + step) - law.rest(s - step)) / (2.0 * step);
                assert!((law.slope(s) - slope).abs() < 1e-5 * (1.0 + slope.abs()), "{s}");
                let force = (law.potential(s + step) - law.potential(s - step)) / (2.0 * step);
                assert!((law.rest(s) - force).abs() < 1e-5 * (1.0 + force.abs()), "{s}");
            }
        }
    }

    #[test]
    fn the_taylor_law_of_degree_two_is_the_quadratic_law() {
        let polynomial = Polynomial::new(&MAGNET, &rest(), 2);
        let quadratic = Quadratic { c2: MAGNET.taylor_coefficient(rest().gap, 2) };
        for s in [-0.2, 0.01, 0.3] {
            assert!((polynomial.rest(s) - quadratic.rest(s)).abs() <= 1e-15);
        }
    }
}
