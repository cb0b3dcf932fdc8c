//! Eigenvalues of the linear system of beam and circuit together.

use nalgebra::{Complex, DMatrix, Schur};

use super::TheoryError;
use crate::model::ReducedSystem;

/// Cap of the eigenvalue iteration; 17 x 17 matrices take about forty.
const MAX_ITERATIONS: usize = 1000;

/// The 2N + 1 eigenvalues of the linear system (the matrix A of Eq. (60) without its quadratic term), dimensionless:
/// ascending in frequency, the upper of a conjugate pair first.
///
/// # Errors
/// [`TheoryError::NotFinite`] when a coefficient overflows, [`TheoryError::NoConvergence`] when the iteration
/// exceeds its cap.
pub fn eigenvalues(system: &ReducedSystem) -> Result<Vec<Complex<f64>>, TheoryError> {
    let mut matrix = energy_matrix(system);
    if matrix.iter().any(|entry| !entry.is_finite()) {
        return Err(TheoryError::NotFinite);
    }
    // The iteration judges an entry by the diagonal beside it, which vanishes without damping. Moved along by its
    // own size the matrix has a diagonal to judge by.
    let shift = matrix.amax();
    for k in 0..matrix.nrows() {
        matrix[(k, k)] += shift;
    }
    let schur = Schur::try_new(matrix, f64::EPSILON, MAX_ITERATIONS)
        .ok_or(TheoryError::NoConvergence { iterations: MAX_ITERATIONS })?;
    let mut eigenvalues: Vec<_> = schur.complex_eigenvalues().iter().map(|value| value - shift).collect();
    eigenvalues.sort_by(|a, b| a.im.abs().total_cmp(&b.im.abs()).then(b.im.total_cmp(&a.im)));
    Ok(eigenvalues)
}

/// The matrix A in coordinates whose squares are energies, (omega_k q_k, dq_k/dt) sqrt(eta_2k) and sqrt(c) v.
///
/// All exchange of energy is antisymmetric in them and all loss symmetric, so that the matrix is as well balanced
/// as it can be; in (q, dq/dt, v) the entries theta/c and theta differ by six orders of magnitude.
fn energy_matrix(system: &ReducedSystem) -> DMatrix<f64> {
    let n = system.modes.len();
    let p = &system.parameters;
    let mut matrix = DMatrix::zeros(2 * n + 1, 2 * n + 1);
    for (k, mode) in system.modes.iter().enumerate() {
        matrix[(k, n + k)] = mode.omega;
        matrix[(n + k, k)] = -mode.omega;
        for (j, other) in system.modes.iter().enumerate() {
            matrix[(n + k, n + j)] = p.alpha * system.c1 / (mode.eta2 * other.eta2).sqrt();
        }
        matrix[(n + k, n + k)] -= p.alpha * mode.omega * mode.omega;
        let coupling = system.theta[k] / (mode.eta2 * p.c).sqrt();
        matrix[(n + k, 2 * n)] = -coupling;
        matrix[(2 * n, n + k)] = coupling;
    }
    matrix[(2 * n, 2 * n)] = -p.kappa / p.c;
    matrix
}
