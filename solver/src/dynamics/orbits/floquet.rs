//! Floquet multipliers of a periodic motion, and what they say about how it loses stability.

use nalgebra::{Complex, ComplexField, DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::orbit_error::OrbitError;
use crate::model::eigenvalues::{SHIFTS, eigenvalues};

/// Relative size at which the iteration drops an entry: above its own rounding errors.
const DEFLATION: f64 = 4e-16;
/// A multiplier is real when its imaginary part is below this fraction of its modulus.
const REAL: f64 = 1e-9;

/// How a periodic motion loses its stability, by the multiplier that leaves the unit circle first.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin,
)]
#[serde(rename_all = "snake_case")]
pub enum Instability {
    /// Through +1: the motion meets another one and both end (or exchange stability, in a symmetric system).
    Fold,
    /// Through -1: a motion of twice the period branches off.
    PeriodDoubling,
    /// A complex pair: a torus branches off, a slow modulation with a second frequency.
    NeimarkSacker,
}

impl Instability {
    /// The kind to which `multiplier` belongs by its place on the circle.
    pub fn of(multiplier: Complex<f64>) -> Self {
        if multiplier.im.abs() > REAL * multiplier.norm() {
            Self::NeimarkSacker
        } else if multiplier.re < 0.0 {
            Self::PeriodDoubling
        } else {
            Self::Fold
        }
    }

    /// A smooth function of the motion that changes sign where a multiplier crosses the unit circle in this way:
    /// the product of 1 - mu, of 1 + mu, or of mu_i mu_j - 1 over all pairs i < j.
    ///
    /// Multipliers that meet and part make corners in each of them, never in a symmetric product. The last one
    /// also vanishes where two real multipliers are reciprocal, which is no loss of stability.
    pub fn test(self, multipliers: &[Complex<f64>]) -> f64 {
        let one = Complex::from(1.0);
        let product: Complex<f64> = match self {
            Self::Fold => multipliers.iter().map(|mu| one - mu).product(),
            Self::PeriodDoubling => multipliers.iter().map(|mu| one + mu).product(),
            Self::NeimarkSacker => multipliers
                .iter()
                .enumerate()
                .flat_map(|(i, a)| multipliers[..i].iter().map(move |b| a * b - one))
                .product(),
        };
        product.re
    }
}

/// The multipliers, eigenvalues of a monodromy `matrix` (square, its components made comparable as by
/// [`super::PeriodMap::scaled_derivative`]), by descending modulus, the upper of a conjugate pair first.
///
/// Their errors are of the order of rounding times the largest entry, so tiny ones are only known to be tiny; two
/// that nearly coincide are good to about half the digits.
///
/// # Errors
/// [`OrbitError::Multipliers`] when an entry is not finite or the iteration exceeds its cap.
pub fn multipliers(matrix: &DMatrix<f64>) -> Result<Vec<Complex<f64>>, OrbitError> {
    let largest = matrix.iter().fold(0.0_f64, |most, entry| most.max(entry.abs()));
    if matrix.iter().any(|entry| !entry.is_finite()) {
        return Err(OrbitError::Multipliers);
    }
    let shifts = std::iter::once(0.0).chain(SHIFTS.map(|shift| shift * largest));
    let mut values = eigenvalues(matrix, shifts, DEFLATION).ok_or(OrbitError::Multipliers)?;
    values.sort_by(|a, b| b.norm_sqr().total_cmp(&a.norm_sqr()).then(b.im.total_cmp(&a.im)));
    Ok(values)
}

/// The unit eigenvector of `matrix` to the eigenvalue nearest to `multiplier`, by inverse iteration.
///
/// # Errors
/// [`OrbitError::Singular`] when the iteration breaks down.
pub(in crate::dynamics) fn eigenvector<T: ComplexField<RealField = f64> + Copy>(
    matrix: &DMatrix<T>,
    multiplier: T,
) -> Result<DVector<T>, OrbitError> {
    let n = matrix.nrows();
    // Away from the exact singularity, by less than the multiplier is known to.
    let moved = matrix - DMatrix::identity(n, n) * multiplier.scale(1.0 + 1e-9);
    let solver = moved.lu();
    let mut direction = DVector::from_element(n, T::one());
    for _ in 0..4 {
        direction = solver.solve(&direction).ok_or(OrbitError::Singular)?.normalize();
    }
    if direction.iter().all(|value| value.is_finite()) { Ok(direction) } else { Err(OrbitError::Singular) }
}
