//! Eigenvalues of the linear system of beam and circuit together.

use nalgebra::{Complex, DMatrix};

use super::{DynamicStiffness, TheoryError};
use crate::model::ReducedSystem;
use crate::model::eigenvalues::{self, MAX_ITERATIONS, SHIFTS};

/// Relative size at which the iteration drops an entry: safely above its own rounding errors. What accuracy
/// that leaves out, [`refined`] brings back.
const DEFLATION: f64 = 1e-14;

/// The 2N + 1 eigenvalues of the linear system (the matrix A of Eq. (60) without its quadratic term),
/// dimensionless: ascending in frequency, the upper of a conjugate pair first.
///
/// Each is good to rounding relative to its own size, except where two nearly coincide (critical damping).
///
/// # Errors
/// [`TheoryError::NotFinite`] when a coefficient overflows, [`TheoryError::NoConvergence`] when the iteration
/// exceeds its cap.
pub fn eigenvalues(system: &ReducedSystem) -> Result<Vec<Complex<f64>>, TheoryError> {
    let matrix = energy_matrix(system);
    if matrix.iter().any(|entry| !entry.is_finite()) {
        return Err(TheoryError::NotFinite);
    }
    let highest = system.modes.iter().last().map_or(1.0, |mode| mode.omega);
    let raw = eigenvalues::eigenvalues(&matrix, SHIFTS.map(|shift| shift * highest), DEFLATION)
        .ok_or(TheoryError::NoConvergence { iterations: MAX_ITERATIONS })?;
    let stiffness = DynamicStiffness::new(system);
    let mut eigenvalues = Vec::with_capacity(raw.len());
    for value in raw.into_iter().filter(|value| value.im >= 0.0) {
        let value = refined(&stiffness, value, highest);
        eigenvalues.push(value);
        if value.im > 0.0 {
            eigenvalues.push(value.conj());
        }
    }
    eigenvalues.sort_by(|a, b| a.im.abs().total_cmp(&b.im.abs()).then(b.im.total_cmp(&a.im)));
    Ok(eigenvalues)
}

/// The natural frequencies of beam and circuit together (dimensionless), ascending.
///
/// # Errors
/// As [`eigenvalues()`].
pub fn frequencies(system: &ReducedSystem) -> Result<Vec<f64>, TheoryError> {
    Ok(eigenvalues(system)?.iter().map(|value| value.im).filter(|im| *im > 0.0).collect())
}

/// Newton's iteration on the characteristic polynomial, whose small roots a matrix with large entries blurs.
fn refined(stiffness: &DynamicStiffness, value: Complex<f64>, highest: f64) -> Complex<f64> {
    let mut root = value;
    for _ in 0..2 {
        let Some(slope) = stiffness.logarithmic_slope(root) else { break };
        let step = slope.inv();
        // A larger step has met a multiple root or the circuit's pole; NaN fails the comparison as well. Of a
        // root at zero (an open circuit) only the absolute size is known.
        if step.norm() < (1e-3 * root.norm()).max(1e-10 * highest) {
            root -= step;
        } else {
            break;
        }
    }
    // A real root stays on the axis but for the sign of a zero.
    if value.im == 0.0 { root.re.into() } else { root }
}

/// The matrix A in coordinates whose squares are energies, (omega_k q_k, dq_k/dt) sqrt(eta_2k) and sqrt(c) v.
///
/// All exchange of energy is antisymmetric in them and all loss symmetric, so that the matrix is as well
/// balanced as it can be; in (q, dq/dt, v) the entries theta/c and theta differ by six orders of magnitude.
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
        matrix[(n + k, n + k)] -= p.alpha * mode.omega * mode.omega + p.air;
        let coupling = system.theta[k] / (mode.eta2 * system.capacitance).sqrt();
        matrix[(n + k, 2 * n)] = -coupling;
        matrix[(2 * n, n + k)] = coupling;
    }
    matrix[(2 * n, 2 * n)] = -p.kappa / system.capacitance;
    matrix
}
