//! The nonlinear rest R(s) of the magnet force, in the three laws a user can choose between.
//!
//! With s the tip displacement from equilibrium, the magnets pull back with c_1 s + R(s) (Eq. 16). The linear part
//! belongs to the modes; R is what makes the harvester nonlinear.

use serde::{Deserialize, Serialize};

use super::{Equilibrium, Magnet, ModelError};

pub mod exact;
pub use exact::Exact;

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

/// R(s) with its slope and potential, by whichever law. `s` is in beam lengths, R dimensionless.
///
/// Over an array of values the law is chosen once: the solvers' loops are compiled once for all laws, and are still
/// vector code.
#[derive(Debug, Clone, PartialEq)]
pub enum RestForce {
    /// R(s) = c_2 s^2, kept apart from [`Polynomial`] because it is the paper's model and the fastest.
    Quadratic {
        /// c_2 (dimensionless).
        c2: f64,
    },
    /// A Taylor polynomial.
    Polynomial(Polynomial),
    /// The magnet force itself.
    Exact(Exact),
}

impl RestForce {
    /// R(s) at each of the `s`.
    #[inline(always)]
    pub fn rest_at<const K: usize>(&self, s: &[f64; K]) -> [f64; K] {
        match self {
            Self::Quadratic { c2 } => s.map(|s| c2 * s * s),
            Self::Polynomial(law) => law.rest_at(s),
            // What is called works on copies in memory; the other laws' values stay in registers.
            Self::Exact(law) => law.rest_at(&{ *s }).map(|rest| rest),
        }
    }

    /// dR/ds at each of the `s`.
    #[inline(always)]
    pub fn slope_at<const K: usize>(&self, s: &[f64; K]) -> [f64; K] {
        match self {
            Self::Quadratic { c2 } => s.map(|s| 2.0 * c2 * s),
            Self::Polynomial(law) => law.slope_at(s),
            Self::Exact(law) => law.slope_at(s),
        }
    }

    /// R(s).
    #[inline]
    pub fn rest(&self, s: f64) -> f64 {
        self.rest_at(&[s])[0]
    }

    /// dR/ds.
    #[inline]
    pub fn slope(&self, s: f64) -> f64 {
        self.slope_at(&[s])[0]
    }

    /// The integral of R from 0 to s.
    pub fn potential(&self, s: f64) -> f64 {
        match self {
            Self::Quadratic { c2 } => c2 * s * s * s / 3.0,
            Self::Polynomial(law) => law.potential(s),
            Self::Exact(law) => law.potential(s),
        }
    }

    /// The tip displacement at which the magnets touch, when this law knows of it.
    #[inline]
    pub fn contact(&self) -> Option<f64> {
        match self {
            Self::Quadratic { .. } | Self::Polynomial(_) => None,
            Self::Exact(law) => law.contact(),
        }
    }
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

    #[inline]
    fn rest_at<const K: usize>(&self, s: &[f64; K]) -> [f64; K] {
        let sums = horner(self.coefficients.iter().copied(), s);
        std::array::from_fn(|i| s[i] * s[i] * sums[i])
    }

    // Needed once a step only.
    #[inline(never)]
    fn slope_at<const K: usize>(&self, s: &[f64; K]) -> [f64; K] {
        let weighted = self.coefficients.iter().enumerate().map(|(i, c)| (i as f64 + 2.0) * c);
        let sums = horner(weighted, s);
        std::array::from_fn(|i| s[i] * sums[i])
    }

    fn potential(&self, s: f64) -> f64 {
        let weighted = self.coefficients.iter().enumerate().map(|(i, c)| c / (i as f64 + 3.0));
        s * s * s * horner(weighted, &[s])[0]
    }
}

/// The polynomial with these coefficients, from the constant one up, at each of the `s`.
fn horner<const K: usize>(coefficients: impl DoubleEndedIterator<Item = f64>, s: &[f64; K]) -> [f64; K] {
    coefficients.rev().fold([0.0; K], |sums, c| std::array::from_fn(|i| sums[i] * s[i] + c))
}

#[cfg(test)]
mod tests {
    use super::*;

    const MAGNET: Magnet = Magnet { c0: 0.5084, h: 0.004167 };

    fn rest() -> Equilibrium {
        MAGNET.equilibrium(0.15).expect("the paper's magnets have an equilibrium")
    }

    #[test]
    fn slope_and_potential_are_derivative_and_integral_of_the_force() {
        let rest = rest();
        let laws = [
            RestForce::Quadratic { c2: -19.4 },
            RestForce::Polynomial(Polynomial::new(&MAGNET, &rest, 5)),
            RestForce::Exact(Exact::new(&MAGNET, &rest)),
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
        let polynomial = RestForce::Polynomial(Polynomial::new(&MAGNET, &rest(), 2));
        let quadratic = RestForce::Quadratic { c2: MAGNET.taylor_coefficient(rest().gap, 2) };
        for s in [-0.2, 0.01, 0.3] {
            assert!((polynomial.rest(s) - quadratic.rest(s)).abs() <= 1e-15);
        }
    }
}
