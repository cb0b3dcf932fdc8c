//! Eigenvalues of small real matrices, by an iteration that always ends.

use nalgebra::{Complex, DMatrix, Schur};

/// Cap of the iteration; 17 x 17 matrices take about forty.
pub const MAX_ITERATIONS: usize = 1000;

/// Diagonals to try, in units of the matrix. The iteration judges an entry by the diagonal beside it, which vanishes
/// for undamped vibrations and for multipliers a quarter turn apart; moved along, the matrix has one to judge by.
pub const SHIFTS: [f64; 3] = [1.37, 0.71, 2.93];

/// Eigenvalues of the square `matrix` in no particular order, from its Schur form on a diagonal moved by each of
/// `shifts` in turn until the iteration converges. `deflation` is the relative size at which it drops an entry; below
/// about 4e-16 its own rounding errors keep it from ending.
///
/// `None` when no shift makes it converge within [`MAX_ITERATIONS`], as with entries that are not finite.
pub fn eigenvalues(
    matrix: &DMatrix<f64>,
    shifts: impl IntoIterator<Item = f64>,
    deflation: f64,
) -> Option<Vec<Complex<f64>>> {
    shifts.into_iter().find_map(|shift| {
        let mut moved = matrix.clone();
        for k in 0..moved.nrows() {
            moved[(k, k)] += shift;
        }
        let schur = Schur::try_new(moved, deflation, MAX_ITERATIONS)?;
        Some(schur.complex_eigenvalues().iter().map(|value| value - shift).collect())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vanishing_diagonal_needs_a_shift() {
        // Fourth roots of one.
        let circulant = DMatrix::from_fn(4, 4, |i, j| if (i + 1) % 4 == j { 1.0 } else { 0.0 });
        let values = eigenvalues(&circulant, SHIFTS, 4e-16);
        let values = values.expect("one of the shifts converges");
        for root in
            [Complex::new(1.0, 0.0), Complex::new(0.0, 1.0), Complex::new(-1.0, 0.0), Complex::new(0.0, -1.0)]
        {
            assert!(values.iter().any(|value| (value - root).norm() < 1e-13), "{root}: {values:?}");
        }
    }

    #[test]
    fn a_matrix_that_is_not_finite_has_none() {
        let matrix = DMatrix::from_element(3, 3, f64::NAN);
        assert_eq!(eigenvalues(&matrix, SHIFTS, 4e-16), None);
    }
}
