//! The linear system (magnet rest force left out) with its circuit and damping, exactly: complex amplitudes
//! of the steady state. It is the closed form for a harvester without magnet and the start of the
//! coupled-mode theory.

use nalgebra::{Complex, DMatrix, DVector};

use super::{Harmonic, TheoryError};
use crate::model::ReducedSystem;

/// The symmetric matrix M(s) with M(s) Q = F for modal displacements Q e^(s t) under modal forces F e^(s t),
/// after the voltage has been eliminated with Eq. (31):
///
/// M_kn = eta_2k (s^2 + (alpha omega_k^2 + a_m) s + omega_k^2) delta_kn - alpha c_1 s
/// + s theta_k theta_n / (kappa + c s).
///
/// It depends on the structure only, not on the excitation. N x N, dimensionless.
#[derive(Debug, Clone, PartialEq)]
pub struct DynamicStiffness {
    omega: Vec<f64>,
    eta1: DVector<Complex<f64>>,
    eta2: Vec<f64>,
    theta: Vec<f64>,
    alpha: f64,
    air: f64,
    c1: f64,
    c: f64,
    kappa: f64,
}

impl DynamicStiffness {
    /// Gathers the coefficients of `system`.
    pub fn new(system: &ReducedSystem) -> Self {
        let p = &system.parameters;
        let modes = &system.modes;
        Self {
            omega: modes.iter().map(|mode| mode.omega).collect(),
            eta1: DVector::from_iterator(modes.len(), modes.iter().map(|mode| mode.eta1.into())),
            eta2: modes.iter().map(|mode| mode.eta2).collect(),
            theta: system.theta.clone(),
            alpha: p.alpha,
            air: p.air,
            c1: system.c1,
            c: system.capacitance,
            kappa: p.kappa,
        }
    }

    /// M(s), N x N. The exponent `s` must not be -kappa/c, the pole of the circuit alone.
    pub fn matrix(&self, s: Complex<f64>) -> DMatrix<Complex<f64>> {
        let electrical = s / (s * self.c + self.kappa);
        let viscous = s * (self.alpha * self.c1);
        self.assemble(electrical, viscous, |omega| {
            s * s + (s * self.alpha + 1.0) * (omega * omega) + s * self.air
        })
    }

    /// dM/ds, N x N.
    pub fn derivative(&self, s: Complex<f64>) -> DMatrix<Complex<f64>> {
        let admittance = s * self.c + self.kappa;
        let electrical = Complex::from(self.kappa) / (admittance * admittance);
        let viscous = Complex::from(self.alpha * self.c1);
        self.assemble(electrical, viscous, |omega| s * 2.0 + (self.alpha * omega * omega + self.air))
    }

    /// p'(s)/p(s) of the characteristic polynomial p = (kappa + c s) det M. `None` exactly at a root.
    pub fn logarithmic_slope(&self, s: Complex<f64>) -> Option<Complex<f64>> {
        let relative = self.matrix(s).lu().solve(&self.derivative(s))?;
        Some(relative.trace() + Complex::from(self.c) / (s * self.c + self.kappa))
    }

    fn assemble(
        &self,
        electrical: Complex<f64>,
        viscous: Complex<f64>,
        diagonal: impl Fn(f64) -> Complex<f64>,
    ) -> DMatrix<Complex<f64>> {
        let n = self.omega.len();
        let mut matrix =
            DMatrix::from_fn(n, n, |k, j| electrical * (self.theta[k] * self.theta[j]) - viscous);
        for k in 0..n {
            matrix[(k, k)] += diagonal(self.omega[k]) * self.eta2[k];
        }
        matrix
    }

    /// Modal displacements, length N, per unit of beta under the base motion beta sin(omega t).
    ///
    /// `None` when the undamped system is excited exactly at an eigenfrequency.
    pub fn response(&self, omega: f64) -> Option<DVector<Complex<f64>>> {
        let force = self.eta1.map(|eta1| eta1 * (omega * omega));
        let response = self.matrix(Complex::new(0.0, omega)).lu().solve(&force)?;
        response.iter().all(|q| q.re.is_finite() && q.im.is_finite()).then_some(response)
    }

    /// Tip displacement per unit of beta (complex amplitude), `None` as in [`Self::response`].
    pub fn tip_response(&self, omega: f64) -> Option<Complex<f64>> {
        self.response(omega).map(|response| response.sum())
    }

    /// Voltage (volts) that the modal displacements Q drive at s by Eq. (31):
    /// V = s (sum of theta_n Q_n) / (kappa + c s).
    fn voltage(&self, displacements: &DVector<Complex<f64>>, s: Complex<f64>) -> Complex<f64> {
        let charge: Complex<f64> = displacements.iter().zip(&self.theta).map(|(q, theta)| q * *theta).sum();
        s * charge / (s * self.c + self.kappa)
    }
}

/// The steady state of the linear system: every quantity is the imaginary part of its complex amplitude times
/// exp(i omega t), so that the excitation is beta sin(omega t).
#[derive(Debug, Clone, PartialEq)]
pub struct LinearResponse {
    /// Excitation frequency (dimensionless).
    pub omega: f64,
    /// Complex amplitudes of q_1..q_N, in beam lengths.
    pub displacements: DVector<Complex<f64>>,
    /// Complex amplitude of the voltage, in volts.
    pub voltage: Complex<f64>,
}

impl LinearResponse {
    /// The response of `system` under its own excitation, with the magnet rest force R(s) left out.
    ///
    /// # Errors
    /// [`TheoryError::Undamped`] when there is no damping and omega is exactly an eigenfrequency.
    pub fn new(system: &ReducedSystem) -> Result<Self, TheoryError> {
        let stiffness = DynamicStiffness::new(system);
        let (beta, omega) = (system.parameters.beta, system.parameters.omega);
        let response = stiffness.response(omega).ok_or(TheoryError::Undamped { omega })?;
        let displacements = response.map(|q| q * beta);
        let voltage = stiffness.voltage(&displacements, Complex::new(0.0, omega));
        Ok(Self { omega, displacements, voltage })
    }

    /// Complex amplitude of the tip displacement from equilibrium, in beam lengths.
    pub fn tip(&self) -> Complex<f64> {
        self.displacements.sum()
    }

    /// The voltage as amplitude (volts) and phase (radians).
    pub fn voltage_harmonic(&self) -> Harmonic {
        let (amplitude, phase) = self.voltage.to_polar();
        Harmonic { amplitude, phase, omega: self.omega }
    }

    /// The state (q, dq/dt, v) at time `t`, length 2N + 1.
    pub fn state(&self, t: f64) -> Vec<f64> {
        let turn = Complex::from_polar(1.0, self.omega * t);
        let rate = turn * Complex::new(0.0, self.omega);
        let positions = self.displacements.iter().map(|q| (q * turn).im);
        let velocities = self.displacements.iter().map(|q| (q * rate).im);
        positions.chain(velocities).chain([(self.voltage * turn).im]).collect()
    }
}
