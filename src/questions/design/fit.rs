//! Least squares: dimensions of a device that bring its voltage over frequency closest to a measured one.
//!
//! Levenberg and Marquardt's method on the logarithms of the dimensions, which stay positive so and count alike. The kept
//! crate for it is built on another version of nalgebra than ours and would bring that along; what is needed of it are the
//! few lines here.
//!
//! Reference: Nocedal & Wright, "Numerical Optimization" (2006), section 10.3; standard errors from the covariance
//! s^2 (J^T J)^-1 of the linearised problem.

use nalgebra::{DMatrix, DVector};

use super::change::from_rest;
use super::{DesignError, Plant};
use crate::model::{Dimension, ModelError, Parameter, Shaking};
use crate::questions::motions::{Coordinate, at_place};
use crate::scenario::Scenario;
use crate::theory::LinearResponse;

/// Root mean square voltage (V) of the device of `scenario` with these `dimensions`, at each of the `frequencies` (Hz): of
/// the motion reached from rest, 0 where that ends. Without magnets it is the closed form.
///
/// # Errors
/// [`DesignError`] when there is no such device.
pub fn voltages(
    scenario: &Scenario,
    shaking: Shaking,
    dimensions: &[(Dimension, f64)],
    frequencies: &[f64],
) -> Result<Vec<f64>, DesignError> {
    let coordinates: Vec<Coordinate> =
        dimensions.iter().map(|(dimension, _)| Coordinate::Dimension(*dimension)).collect();
    let values: Vec<f64> = dimensions.iter().map(|(_, value)| *value).collect();
    let there = at_place(scenario, &coordinates, &values)?;
    let plant = Plant::new(&there)?.shaken(shaking);
    let linear = there.parameters.c0 == 0.0;
    let voltage = |hertz: &f64| {
        let omega = plant.units.omega(*hertz);
        ModelError::check("data: frequency", omega, Parameter::Omega.range(), "")?;
        if linear {
            let set = plant.along.at(&plant.scenario.parameters, Parameter::Omega, omega);
            let system = plant.scenario.model.system(set)?;
            return Ok(LinearResponse::new(&system)?.voltage.norm() * std::f64::consts::FRAC_1_SQRT_2);
        }
        let cell = from_rest(&plant, omega)?;
        Ok(if cell.lasts() { cell.measures.v_rms } else { 0.0 })
    };
    frequencies.iter().map(voltage).collect()
}

/// A linearised least-squares problem: residuals, and their derivatives by each unknown.
#[derive(Debug, Clone, PartialEq)]
pub struct Normal {
    /// J^T J.
    products: DMatrix<f64>,
    /// J^T r.
    gradient: DVector<f64>,
    /// Sum of squares of r.
    square: f64,
    /// Number of residuals.
    count: usize,
}

impl Normal {
    /// Of the `residuals` and the `columns` of their derivatives, one an unknown, all of the same length.
    pub fn new(residuals: &[f64], columns: &[Vec<f64>]) -> Self {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        Self {
            products: DMatrix::from_fn(columns.len(), columns.len(), |i, j| dot(&columns[i], &columns[j])),
            gradient: DVector::from_fn(columns.len(), |i, _| dot(&columns[i], residuals)),
            square: dot(residuals, residuals),
            count: residuals.len(),
        }
    }

    /// The step of the unknowns with the damping `lambda`, relative to the diagonal; `None` where the data tell nothing of
    /// one of them.
    pub fn step(&self, lambda: f64) -> Option<Vec<f64>> {
        let mut damped = self.products.clone();
        for k in 0..damped.nrows() {
            damped[(k, k)] *= 1.0 + lambda;
        }
        let step = damped.cholesky()?.solve(&self.gradient);
        Some(step.iter().map(|part| -part).collect())
    }

    /// By how much the sum of squares would fall on the linear problem with this step.
    pub fn promised(&self, step: &[f64]) -> f64 {
        let step = DVector::from_column_slice(step);
        -(2.0 * self.gradient.dot(&step) + step.dot(&(&self.products * &step)))
    }

    /// Standard errors of the unknowns; `None` without more data than unknowns, or where these tell nothing of one.
    pub fn standard_errors(&self) -> Option<Vec<f64>> {
        let unknowns = self.products.nrows();
        let spare = self.count.checked_sub(unknowns).filter(|spare| *spare > 0)?;
        let inverse = self.products.clone().cholesky()?.inverse();
        let variance = self.square / spare as f64;
        Some((0..unknowns).map(|k| (variance * inverse[(k, k)]).sqrt()).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_has_the_errors_of_the_textbook() {
        // y = a + b x through (0, 1), (1, 3), (2, 4), (3, 4): a = 1.5, b = 1, s^2 = 0.5; errors by the closed forms
        // s_b = s/sqrt(sum (x - mean)^2), s_a = s_b sqrt(mean of x^2).
        let (x, y) = ([0.0, 1.0, 2.0, 3.0], [1.0, 3.0, 4.0, 4.0]);
        let columns = [vec![1.0; 4], x.to_vec()];
        let residuals: Vec<f64> = y.iter().map(|y| -y).collect();
        let step = Normal::new(&residuals, &columns).step(0.0).expect("a step");
        assert!((step[0] - 1.5).abs() < 1e-12 && (step[1] - 1.0).abs() < 1e-12, "{step:?}");
        let left: Vec<f64> = x.iter().zip(y).map(|(x, y)| step[0] + step[1] * x - y).collect();
        let errors = Normal::new(&left, &columns).standard_errors().expect("errors");
        let slope = (0.5_f64 / 5.0).sqrt();
        assert!((errors[1] / slope - 1.0).abs() < 1e-12, "{errors:?}");
        assert!((errors[0] / (slope * 3.5_f64.sqrt()) - 1.0).abs() < 1e-12, "{errors:?}");
        let nothing = Normal::new(&residuals, &[vec![1.0; 4], vec![0.0; 4]]);
        assert_eq!((nothing.step(1e-3), nothing.standard_errors()), (None, None));
    }
}
