//! The linear part of the system together with its excitation.
//!
//! The extended vector is the state (q_1..q_N, dq_1/dt..dq_N/dt, v) followed by what generates the excitation. It obeys an
//! autonomous linear equation; with the rest force R as a known input it is y' = A y - g R. For a sine the generator is
//! (beta sin omega t, beta cos omega t), whose amplitude is in the vector, not in A, so that one preparation serves every
//! excitation of a frequency. For any other motion of the base it is the acceleration and its derivatives, which within a
//! step are those of a polynomial: only the last one stays as it is. Either way the linear beam is carried exactly.

use crate::model::ReducedSystem;
use crate::model::base_motion::{DERIVATIVES, Signal};

/// Coefficients of the linear part, gathered for fast application.
#[derive(Debug, Clone)]
pub struct LinearPart {
    /// Number of modes N.
    pub modes: usize,
    stiffness: Vec<f64>,
    damping: Vec<f64>,
    /// 1 / eta_2k, the rest force's participation.
    inverse_mass: Vec<f64>,
    /// What the first entry of the generator does to each velocity.
    drive: Vec<f64>,
    generator: Generator,
    theta: Vec<f64>,
    /// See [`ReducedSystem::slopes`].
    pub(super) slopes: Vec<f64>,
    mutual_damping: f64,
    inverse_capacitance: f64,
    kappa: f64,
    /// An upper estimate of the fastest rate in the system, 1/time (dimensionless).
    pub rate: f64,
}

/// What generates the excitation.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Generator {
    /// beta sin(omega t) and beta cos(omega t).
    Rotation { omega: f64 },
    /// The base's acceleration and its derivatives, the k-th times `interval`^k, so that all are of one size.
    Polynomial { interval: f64 },
}

impl LinearPart {
    /// Gathers the linear part of `system` under its own sine.
    pub fn new(system: &ReducedSystem) -> Self {
        let square = system.parameters.omega * system.parameters.omega;
        Self::driven(system, square, Generator::Rotation { omega: system.parameters.omega })
    }

    /// The same under a base acceleration that is a polynomial within each interval of `signal`; the system's own sine plays
    /// no role.
    pub fn under(system: &ReducedSystem, signal: &Signal) -> Self {
        Self::driven(system, -1.0, Generator::Polynomial { interval: signal.interval() })
    }

    /// With `factor` times eta_1k as what the generator's first entry does to mode k.
    fn driven(system: &ReducedSystem, factor: f64, generator: Generator) -> Self {
        let p = &system.parameters;
        let generated = match generator {
            Generator::Rotation { omega } => omega,
            Generator::Polynomial { interval } => 1.0 / interval,
        };
        let modes = &system.modes;
        let inverse_mass: Vec<f64> = modes.iter().map(|mode| 1.0 / mode.eta2).collect();
        let highest = modes.iter().last().map_or(0.0, |mode| mode.omega);
        let coupling: f64 =
            system.theta.iter().zip(&inverse_mass).map(|(t, m)| t * t * m / system.capacitance).sum();
        let mobility: f64 = inverse_mass.iter().sum();
        let rate = highest
            + p.alpha * (highest * highest + system.c1.abs() * mobility)
            + p.air
            + coupling.sqrt()
            + p.kappa / system.capacitance
            + generated;
        Self {
            modes: modes.len(),
            stiffness: modes.iter().map(|mode| mode.omega * mode.omega).collect(),
            damping: modes.iter().map(|mode| p.alpha * mode.omega * mode.omega + p.air).collect(),
            drive: modes.iter().map(|mode| factor * mode.eta1 / mode.eta2).collect(),
            generator,
            inverse_mass,
            theta: system.theta.clone(),
            slopes: system.slopes.clone(),
            mutual_damping: p.alpha * system.c1,
            inverse_capacitance: 1.0 / system.capacitance,
            kappa: p.kappa,
            rate,
        }
    }

    /// The same with the voltage held where it is, as at the store of a rectifier that conducts: dv/dt = 0.
    #[must_use]
    pub(super) fn clamped(self) -> Self {
        Self { inverse_capacitance: 0.0, ..self }
    }

    /// Length 2N + 1 of the state.
    pub fn dimension(&self) -> usize {
        2 * self.modes + 1
    }

    /// Length of the extended vector: 2N + 3 under a sine.
    pub fn extended_dimension(&self) -> usize {
        let generated = match self.generator {
            Generator::Rotation { .. } => 2,
            Generator::Polynomial { .. } => DERIVATIVES,
        };
        self.dimension() + generated
    }

    /// Natural frequency omega_k of mode `k`, counted from 0.
    pub fn frequency(&self, k: usize) -> f64 {
        self.stiffness[k].sqrt()
    }

    /// `out` = A `y` - g `rest`; both are extended vectors.
    pub fn apply(&self, y: &[f64], rest: f64, out: &mut [f64]) {
        let n = self.modes;
        let (voltage, generated) = (y[2 * n], y[2 * n + 1]);
        let tip_velocity: f64 = y[n..2 * n].iter().sum();
        let common = self.mutual_damping * tip_velocity - rest;
        let mut current = -self.kappa * voltage;
        for k in 0..n {
            let velocity = y[n + k];
            current += self.theta[k] * velocity;
            out[k] = velocity;
            out[n + k] = self.inverse_mass[k] * (common - self.theta[k] * voltage)
                + self.drive[k] * generated
                - self.stiffness[k] * y[k]
                - self.damping[k] * velocity;
        }
        out[2 * n] = current * self.inverse_capacitance;
        let (old, new) = (&y[2 * n + 1..], &mut out[2 * n + 1..]);
        match self.generator {
            Generator::Rotation { omega } => (new[0], new[1]) = (omega * old[1], -omega * old[0]),
            Generator::Polynomial { interval } => {
                for (new, next) in new.iter_mut().zip(old[1..].iter().chain([&0.0])) {
                    *new = next / interval;
                }
            }
        }
    }

    /// `out` = transpose of A times `row`: how a linear functional of the vector looks a moment earlier.
    pub(super) fn apply_transposed(&self, row: &[f64], out: &mut [f64]) {
        let n = self.modes;
        let voltage = row[2 * n];
        let current = voltage * self.inverse_capacitance;
        let (mut tip, mut back_action, mut drive) = (0.0, 0.0, 0.0);
        for k in 0..n {
            let force = row[n + k] * self.inverse_mass[k];
            tip += force;
            back_action += force * self.theta[k];
            drive += row[n + k] * self.drive[k];
        }
        for k in 0..n {
            out[k] = -self.stiffness[k] * row[n + k];
            out[n + k] =
                row[k] + self.mutual_damping * tip - self.damping[k] * row[n + k] + self.theta[k] * current;
        }
        out[2 * n] = -back_action - self.kappa * current;
        let (old, new) = (&row[2 * n + 1..], &mut out[2 * n + 1..]);
        match self.generator {
            Generator::Rotation { omega } => (new[0], new[1]) = (-omega * old[1], omega * old[0]),
            Generator::Polynomial { interval } => {
                new[0] = 0.0;
                for k in 1..DERIVATIVES {
                    new[k] = old[k - 1] / interval;
                }
            }
        }
        new[0] += drive;
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::model::{ForceLaw, ParameterSet, Parameters};

    /// The linear part of the paper's device with some of its numbers changed.
    pub(in crate::dynamics) fn part(set: ParameterSet, modes: usize) -> LinearPart {
        let system = Parameters::new(set).and_then(|p| ReducedSystem::new(p, modes, ForceLaw::Quadratic));
        LinearPart::new(&system.expect("the paper's device is valid"))
    }

    /// Round numbers, so that a reference needs no modes: a circuit with kappa / c = 1e7, beside it a beam with
    /// frequencies 4 and 20 under the excitation of frequency 1.
    pub(in crate::dynamics) fn stiff() -> LinearPart {
        LinearPart {
            modes: 2,
            stiffness: vec![16.0, 400.0],
            damping: vec![0.016, 0.4],
            inverse_mass: vec![3.5, 3.25],
            drive: vec![1.5, -0.75],
            theta: vec![0.0125, 0.046875],
            slopes: vec![1.4, 4.8, 0.0, 0.0, -3e-4],
            mutual_damping: 0.00125,
            inverse_capacitance: 1e9,
            kappa: 0.01,
            generator: Generator::Rotation { omega: 1.0 },
            rate: 1.1e7,
        }
    }

    /// The matrix A.
    pub(in crate::dynamics) fn matrix(part: &LinearPart) -> nalgebra::DMatrix<f64> {
        let size = part.extended_dimension();
        let mut matrix = nalgebra::DMatrix::zeros(size, size);
        for j in 0..size {
            let mut unit = vec![0.0; size];
            unit[j] = 1.0;
            let mut column = vec![0.0; size];
            part.apply(&unit, 0.0, &mut column);
            matrix.column_mut(j).copy_from_slice(&column);
        }
        matrix
    }

    #[test]
    fn the_transposed_is_the_transpose() {
        let signal = Signal::new(0.05, vec![0.0; DERIVATIVES]).expect("long enough");
        let shaken =
            LinearPart { generator: Generator::Polynomial { interval: signal.interval() }, ..stiff() };
        for part in [part(ParameterSet { alpha: 0.02, ..Default::default() }, 3), stiff(), shaken] {
            let matrix = matrix(&part);
            for i in 0..matrix.nrows() {
                let mut unit = vec![0.0; matrix.nrows()];
                unit[i] = 1.0;
                let mut row = vec![0.0; matrix.nrows()];
                part.apply_transposed(&unit, &mut row);
                for (j, entry) in row.iter().enumerate() {
                    assert!((entry - matrix[(i, j)]).abs() <= 1e-15 * entry.abs(), "{i} {j}");
                }
            }
        }
    }
}
