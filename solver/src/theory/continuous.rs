//! The linear response of the continuous beam with its circuit: the same as [`LinearResponse`](super::LinearResponse)
//! with every mode there is, by a closed form that no mode enters.

use nalgebra::{Complex, Matrix5, Vector5};

use super::TheoryError;
use crate::model::ReducedSystem;

/// Complex amplitudes of the steady state of the beam of Eqs. (14), (15), (31), the magnet's rest force R(s) left out,
/// under the base motion beta sin(omega t).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContinuousResponse {
    /// Tip displacement from equilibrium (beam lengths).
    pub tip: Complex<f64>,
    /// Voltage (volts).
    pub voltage: Complex<f64>,
}

impl ContinuousResponse {
    /// That of the device of `system` under its own excitation. Modes, force law and residual moment play no role.
    ///
    /// With the base's motion in it the displacement is w = a cos px + b sin px + c e^(-px) + d e^(p(x-1)), where
    /// (1 + i alpha omega) p^4 = omega^2. The clamp moves with the base, w(0) = beta, w'(0) = 0; the tip bears the moment
    /// -theta v and the force of spring c_1 and mass eta; the circuit takes theta i omega w'(1).
    ///
    /// Damping by the air acts on the motion relative to the base. Less a constant, w then obeys the same with
    /// omega^2 - i omega a_m for omega^2 and beta omega^2/(omega^2 - i omega a_m) for beta. The tip turns about its own
    /// centre, at the distance e from the end: it adds a moment and, by e, a force.
    ///
    /// # Errors
    /// [`TheoryError::Undamped`] when there is no damping and omega is exactly an eigenfrequency.
    pub fn new(system: &ReducedSystem) -> Result<Self, TheoryError> {
        let p = &system.parameters;
        let rate = Complex::new(0.0, p.omega);
        let stiffness = rate * p.alpha + 1.0;
        let square = p.omega * p.omega;
        let inertia = Complex::new(square, -p.omega * p.air);
        let base = Complex::from(p.beta) * square / inertia;
        let wave = (inertia / stiffness).powf(0.25);
        let (sin, cos, decay) = (wave.sin(), wave.cos(), (-wave).exp());
        let (zero, one) = (Complex::from(0.0), Complex::from(1.0));
        // Bending moment and shear are stiffness p^2 and stiffness p^3 times these.
        let (moment, shear) = (stiffness * wave * wave, stiffness * wave * wave * wave);
        let tip = -inertia * p.eta + system.c1;
        // Forces of the tip's slope and moments of its displacement, and moments of its slope.
        let mixed = inertia * (p.eta * p.e) * wave;
        let (lever, turning) = (inertia * (p.eta * p.e), inertia * (p.j + p.eta * p.e * p.e) * wave);
        let current = -rate * p.theta * wave;
        #[rustfmt::skip]
        let matrix = Matrix5::new(
            one, zero, one, decay, zero,
            zero, one, -one, decay, zero,
            turning * sin - (moment + lever) * cos, -turning * cos - (moment + lever) * sin,
            (moment + turning - lever) * decay, moment - turning - lever, Complex::from(p.theta),
            (shear - mixed) * sin - tip * cos, (mixed - shear) * cos - tip * sin,
            -(shear + tip + mixed) * decay, shear - tip + mixed, zero,
            -current * sin, current * cos, -current * decay, current, rate * p.c + p.kappa,
        );
        let right = Vector5::new(one, zero, zero, Complex::from(-system.c1), zero) * base;
        let undamped = TheoryError::Undamped { omega: p.omega };
        let x = matrix.lu().solve(&right).ok_or(undamped.clone())?;
        let response = Self { tip: x[0] * cos + x[1] * sin + x[2] * decay + x[3] - base, voltage: x[4] };
        if response.tip.is_finite() && response.voltage.is_finite() { Ok(response) } else { Err(undamped) }
    }
}
