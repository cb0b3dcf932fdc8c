//! The units in which a device's dimensionless numbers count.

use std::f64::consts::TAU;

use super::{Device, ElectricalScaling};

/// Standard gravity (m/s^2), the g in which accelerations of the base are given, always as peaks: B (2 pi f)^2. The
/// gravity that makes a beam sag is a dimension of its device.
pub const STANDARD_GRAVITY: f64 = 9.80665;

/// The SI values of the dimensionless units of a device. Volts are volts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// Of time, sqrt(m_b L^3 / (E I)) (s).
    pub time: f64,
    /// Of length, L (m).
    pub length: f64,
    /// Of power (W): that in which kappa v^2 is V^2/R_eq.
    ///
    /// Consistently it is E I/(L Ts), which is that of mechanical power too. The printed scaling leaves a factor L out
    /// of the circuit; its unit is E I/(L^2 Ts), and in it mechanical powers are those that belong to the printed
    /// circuit, so that the energy balance closes there as well.
    pub power: f64,
}

impl Units {
    /// The units of `device`.
    pub fn of(device: &Device, scaling: ElectricalScaling) -> Self {
        let (time, length) = (device.time_unit(), device.beam_length);
        let power = 1.0 / (scaling.factor(length, device.bending_stiffness()) * time);
        Self { time, length, power }
    }

    /// Frequency (Hz) of the dimensionless angular frequency `omega`.
    pub fn hertz(&self, omega: f64) -> f64 {
        omega / (TAU * self.time)
    }

    /// Dimensionless angular frequency of a frequency in Hz.
    pub fn omega(&self, hertz: f64) -> f64 {
        TAU * hertz * self.time
    }

    /// Millimetres of a length in beam lengths.
    pub fn millimetres(&self, length: f64) -> f64 {
        1e3 * length * self.length
    }

    /// Watts of a dimensionless power.
    pub fn watts(&self, power: f64) -> f64 {
        power * self.power
    }

    /// Peak of the base's acceleration, beta omega^2 dimensionless, in g.
    pub fn acceleration(&self, beta: f64, omega: f64) -> f64 {
        beta * omega * omega * self.length / (self.time * self.time * STANDARD_GRAVITY)
    }

    /// The beta whose acceleration at `omega` has the peak `acceleration` (g).
    pub fn beta_of(&self, acceleration: f64, omega: f64) -> f64 {
        acceleration * STANDARD_GRAVITY * self.time * self.time / (omega * omega * self.length)
    }
}
