//! The linear part of the system together with its excitation, and its propagation by Taylor series.
//!
//! The extended vector (q_1..q_N, dq_1/dt..dq_N/dt, v, beta sin omega t, beta cos omega t) of length 2N + 3 obeys an
//! autonomous linear equation; with the rest force R as a known input it is y' = A y - g R. The amplitude beta is in
//! the vector, not in A, so that one preparation serves every excitation of a frequency.

use crate::model::ReducedSystem;

/// Remainder of the Taylor series, relative to the vector.
const REMAINDER: f64 = 1e-18;
/// Largest product of the fastest rate and a sub-step.
const MAX_RATE_STEP: f64 = 0.5;

/// Coefficients of the linear part, gathered for fast application.
#[derive(Debug, Clone)]
pub struct LinearPart {
    /// Number of modes N.
    pub modes: usize,
    stiffness: Vec<f64>,
    damping: Vec<f64>,
    /// 1 / eta_2k, the rest force's participation.
    inverse_mass: Vec<f64>,
    drive: Vec<f64>,
    theta: Vec<f64>,
    mutual_damping: f64,
    inverse_capacitance: f64,
    kappa: f64,
    omega: f64,
    /// An upper estimate of the fastest rate in the system, 1/time (dimensionless).
    pub rate: f64,
}

impl LinearPart {
    /// Gathers the linear part of `system`.
    pub fn new(system: &ReducedSystem) -> Self {
        let p = &system.parameters;
        let modes = &system.modes;
        let inverse_mass: Vec<f64> = modes.iter().map(|mode| 1.0 / mode.eta2).collect();
        let highest = modes.iter().last().map_or(0.0, |mode| mode.omega);
        let coupling: f64 = system.theta.iter().zip(&inverse_mass).map(|(t, m)| t * t * m / p.c).sum();
        let mobility: f64 = inverse_mass.iter().sum();
        let rate = highest
            + p.alpha * (highest * highest + system.c1.abs() * mobility)
            + coupling.sqrt()
            + p.kappa / p.c
            + p.omega;
        Self {
            modes: modes.len(),
            stiffness: modes.iter().map(|mode| mode.omega * mode.omega).collect(),
            damping: modes.iter().map(|mode| p.alpha * mode.omega * mode.omega).collect(),
            drive: modes.iter().map(|mode| p.omega * p.omega * mode.eta1 / mode.eta2).collect(),
            inverse_mass,
            theta: system.theta.clone(),
            mutual_damping: p.alpha * system.c1,
            inverse_capacitance: 1.0 / p.c,
            kappa: p.kappa,
            omega: p.omega,
            rate,
        }
    }

    /// Length 2N + 3 of the extended vector.
    pub fn extended_dimension(&self) -> usize {
        2 * self.modes + 3
    }

    /// Natural frequency omega_k of mode `k`, counted from 0.
    pub fn frequency(&self, k: usize) -> f64 {
        self.stiffness[k].sqrt()
    }

    /// `out` = A `y` - g `rest`; both vectors have length 2N + 3.
    pub fn apply(&self, y: &[f64], rest: f64, out: &mut [f64]) {
        let n = self.modes;
        let (voltage, sine, cosine) = (y[2 * n], y[2 * n + 1], y[2 * n + 2]);
        let tip_velocity: f64 = y[n..2 * n].iter().sum();
        let common = self.mutual_damping * tip_velocity - rest;
        let mut current = -self.kappa * voltage;
        for k in 0..n {
            let velocity = y[n + k];
            current += self.theta[k] * velocity;
            out[k] = velocity;
            out[n + k] = self.inverse_mass[k] * (common - self.theta[k] * voltage) + self.drive[k] * sine
                - self.stiffness[k] * y[k]
                - self.damping[k] * velocity;
        }
        out[2 * n] = current * self.inverse_capacitance;
        out[2 * n + 1] = self.omega * cosine;
        out[2 * n + 2] = -self.omega * sine;
    }

    /// Carries `y` (length 2N + 3) over `duration` in place, while R(t) is the polynomial with the Taylor
    /// coefficients `rest` about the start.
    pub fn propagate(&self, y: &mut [f64], duration: f64, rest: &[f64], workspace: &mut Workspace) {
        let count = (self.rate * duration / MAX_RATE_STEP).ceil().max(1.0);
        let step = duration / count;
        let Workspace { term, next, rest: scaled } = workspace;
        scaled.clear();
        // Term k carries step^k, and so must the coefficient of R that enters it.
        let mut power = 1.0;
        for coefficient in rest {
            scaled.push(coefficient * power);
            power *= step;
        }
        next.resize(y.len(), 0.0);
        let order = order(self.rate * step).max(rest.len());
        for _ in 0..count as usize {
            term.clear();
            term.extend_from_slice(y);
            for k in 0..order {
                self.apply(term, scaled.get(k).copied().unwrap_or(0.0), next);
                let scale = step / (k as f64 + 1.0);
                for (value, sum) in next.iter_mut().zip(y.iter_mut()) {
                    *value *= scale;
                    *sum += *value;
                }
                std::mem::swap(term, next);
            }
            move_origin_by_one(scaled);
        }
    }
}

/// Number of terms after which those of exp(x) are below [`REMAINDER`].
fn order(x: f64) -> usize {
    let (mut term, mut k) = (1.0, 0);
    while term > REMAINDER && k < 40 {
        k += 1;
        term *= x / k as f64;
    }
    k
}

/// Coefficients of the polynomial p(x + 1) from those of p(x), in place.
fn move_origin_by_one(coefficients: &mut [f64]) {
    let degree = coefficients.len();
    for first in 0..degree.saturating_sub(1) {
        for k in (first..degree - 1).rev() {
            coefficients[k] += coefficients[k + 1];
        }
    }
}

/// Vectors that [`LinearPart::propagate`] reuses, so that it does not allocate.
#[derive(Debug, Clone, Default)]
pub struct Workspace {
    term: Vec<f64>,
    next: Vec<f64>,
    rest: Vec<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ForceLaw, ParameterSet, Parameters};

    fn part() -> LinearPart {
        let set = ParameterSet { beta: 0.01, ..Default::default() };
        let system = Parameters::new(set).and_then(|p| ReducedSystem::new(p, 2, ForceLaw::Quadratic));
        LinearPart::new(&system.expect("the paper's device is valid"))
    }

    #[test]
    fn propagation_agrees_with_the_matrix_exponential() {
        let part = part();
        let dimension = part.extended_dimension();
        let mut matrix = nalgebra::DMatrix::zeros(dimension, dimension);
        for j in 0..dimension {
            let mut unit = vec![0.0; dimension];
            unit[j] = 1.0;
            let mut column = vec![0.0; dimension];
            part.apply(&unit, 0.0, &mut column);
            matrix.column_mut(j).copy_from_slice(&column);
        }
        let start: Vec<f64> = vec![0.01, -0.02, 0.1, 0.4, 3.0, 0.6, 0.8];
        let mut y = start.clone();
        part.propagate(&mut y, 0.7, &[], &mut Workspace::default());
        let expected = (matrix * 0.7).exp() * nalgebra::DVector::from_vec(start);
        for (value, expected) in y.iter().zip(expected.iter()) {
            assert!((value - expected).abs() < 1e-12 * (1.0 + expected.abs()), "{value} {expected}");
        }
    }

    #[test]
    fn a_polynomial_rest_force_is_integrated_like_in_many_small_steps() {
        let part = part();
        let polynomial = [0.3, -2.0, 5.0, 1.0];
        let mut once = vec![0.01, 0.0, 0.0, 0.1, 1.0, 0.0, 1.0];
        let mut often = once.clone();
        let mut workspace = Workspace::default();
        part.propagate(&mut once, 0.2, &polynomial, &mut workspace);
        // Midpoint values of R on 4,000 intervals: an independent second-order method.
        let count = 4000;
        let step = 0.2 / f64::from(count);
        for i in 0..count {
            let t = step * (f64::from(i) + 0.5);
            let rest = polynomial.iter().rev().fold(0.0, |sum, c| sum * t + c);
            part.propagate(&mut often, step, &[rest], &mut workspace);
        }
        for (a, b) in once.iter().zip(&often) {
            assert!((a - b).abs() < 1e-7 * (1.0 + b.abs()), "{a} {b}");
        }
    }
}
