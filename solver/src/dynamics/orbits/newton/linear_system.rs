//! The linear system of Newton's iteration, and what else follows from the derivative of the map. Quantities are scaled;
//! without a load the row of the voltage, which is then linearly dependent, makes room for that of the charge.

use nalgebra::{Complex, DMatrix, DVector};

use super::OrbitSolver;
use crate::dynamics::orbits::floquet::multipliers;
use crate::dynamics::orbits::orbit_error::OrbitError;

impl OrbitSolver {
    /// Multipliers of the orbit found last, without that of the conserved charge when there is no load.
    ///
    /// # Errors
    /// [`OrbitError::Multipliers`].
    pub fn multipliers(&self) -> Result<Vec<Complex<f64>>, OrbitError> {
        let Some((c, theta)) = &self.charge else { return multipliers(&self.matrix) };
        // Among the states without charge, where the voltage follows from the displacements.
        let last = self.state.len() - 1;
        let voltage = |j: usize| theta.get(j).map_or(0.0, |theta| theta / (c * self.map.scales()[last]));
        let entry = |i, j| self.matrix[(i, j)] + self.matrix[(i, last)] * voltage(j);
        multipliers(&DMatrix::from_fn(last, last, entry))
    }

    /// d(state)/d(beta) along the orbits through the one found last, length 2N + 1.
    ///
    /// # Errors
    /// [`OrbitError::Singular`] at a fold.
    pub fn beta_slope(&self) -> Result<Vec<f64>, OrbitError> {
        let mut slope = self.solved(self.beta_derivative())?;
        slope.iter_mut().zip(self.map.scales()).for_each(|(value, scale)| *value *= scale);
        Ok(slope.as_slice().to_vec())
    }

    /// Newton's correction of the state, scaled.
    pub(super) fn correction(&self) -> Result<DVector<f64>, OrbitError> {
        self.solved(self.defect())
    }

    /// Image minus state, scaled; without a load the last entry asks for no charge.
    pub(in crate::dynamics) fn defect(&self) -> DVector<f64> {
        let (image, scales) = (self.map.image(), self.map.scales());
        let mut defect = DVector::from_fn(self.state.len(), |i, _| (image[i] - self.state[i]) / scales[i]);
        if let Some((c, theta)) = &self.charge {
            let last = defect.len() - 1;
            let charge: f64 = theta.iter().zip(&self.state).map(|(theta, q)| theta * q).sum();
            defect[last] = (charge / c - self.state[last]) / scales[last];
        }
        defect
    }

    /// Minus the derivative of [`Self::defect`], 1 - M, scaled. Without a load the last row, which is then linearly
    /// dependent, makes room for that of the charge.
    pub(in crate::dynamics) fn newton_matrix(&self) -> DMatrix<f64> {
        let n = self.state.len();
        let mut matrix = DMatrix::from_fn(n, n, |i, j| f64::from(u8::from(i == j)) - self.matrix[(i, j)]);
        if let Some((c, theta)) = &self.charge {
            let scale = self.map.scales()[n - 1];
            for j in 0..n - 1 {
                matrix[(n - 1, j)] = -theta.get(j).map_or(0.0, |theta| theta / (c * scale));
            }
            matrix[(n - 1, n - 1)] = 1.0;
        }
        matrix
    }

    /// Derivative of [`Self::defect`] with respect to beta, scaled.
    pub(in crate::dynamics) fn beta_derivative(&self) -> DVector<f64> {
        let n = self.state.len();
        let scales = self.map.scales();
        let mut derivative = DVector::from_fn(n, |i, _| self.map.derivative(i, n) / scales[i]);
        if self.charge.is_some() {
            derivative[n - 1] = 0.0;
        }
        derivative
    }

    /// (1 - M)^-1 `right`, scaled, for a right-hand side that holds no charge.
    pub(in crate::dynamics) fn response(&self, mut right: DVector<f64>) -> Result<DVector<f64>, OrbitError> {
        if self.charge.is_some() {
            let last = right.len() - 1;
            right[last] = 0.0;
        }
        self.solved(right)
    }

    fn solved(&self, mut right: DVector<f64>) -> Result<DVector<f64>, OrbitError> {
        let solvable = self.newton_matrix().lu().solve_mut(&mut right);
        let finite = solvable && right.iter().all(|value| value.is_finite());
        finite.then_some(right).ok_or(OrbitError::Singular)
    }
}
