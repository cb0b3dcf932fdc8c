//! The paper's steady state to first order: every mode follows the excitation undamped, and the circuit
//! follows the modes without acting back on them. Damping does not enter.

use super::TheoryError;
use crate::model::{Mode, ReducedSystem};

/// Relative distance to a natural frequency below which Eq. (43) is all rounding: the frequencies themselves
/// are not known better than this.
const FREQUENCY_ACCURACY: f64 = 1e-13;

/// A quantity that varies as amplitude sin(omega t + phase).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonic {
    /// Amplitude in the unit of the quantity (volts, beam lengths). Negative where a printed formula makes it
    /// so.
    pub amplitude: f64,
    /// Phase ahead of the excitation, in radians.
    pub phase: f64,
    /// Angular frequency (dimensionless).
    pub omega: f64,
}

impl Harmonic {
    /// The value at time `t` (dimensionless), in the unit of the amplitude.
    pub fn value(&self, t: f64) -> f64 {
        self.amplitude * (self.omega * t + self.phase).sin()
    }

    /// The rate of change at time `t`, per unit of dimensionless time.
    pub fn rate(&self, t: f64) -> f64 {
        self.amplitude * self.omega * (self.omega * t + self.phase).cos()
    }

    /// The one point (value, rate) of the Poincare map, at t = 2 pi k / omega for every k.
    pub fn stroboscopic_point(&self) -> (f64, f64) {
        (self.value(0.0), self.rate(0.0))
    }

    /// Root mean square over a period, in the unit of the amplitude.
    pub fn root_mean_square(&self) -> f64 {
        self.amplitude.abs() * std::f64::consts::FRAC_1_SQRT_2
    }
}

/// Eq. (43), section 3.1: amplitude a_k of a mode under the excitation beta, omega, in beam lengths.
///
/// `None` when omega is the natural frequency of the mode, to within rounding.
#[doc(alias = "eq-43")]
pub fn modal_amplitude(mode: &Mode, beta: f64, omega: f64) -> Option<f64> {
    if (mode.omega - omega).abs() <= FREQUENCY_ACCURACY * mode.omega {
        return None;
    }
    // As a product of sum and difference the denominator keeps its digits close to resonance.
    let detuning = (mode.omega - omega) * (mode.omega + omega);
    Some(omega * omega * beta * mode.eta1 / (mode.eta2 * detuning))
}

/// The forced motion that the paper calls stable steady-state response.
#[derive(Debug, Clone, PartialEq)]
pub struct SteadyState {
    /// a_k of Eq. (43), one a mode, in beam lengths: mode k moves as a_k sin(omega t).
    pub amplitudes: Vec<f64>,
    /// Tip displacement from equilibrium, in beam lengths.
    pub tip: Harmonic,
    /// Voltage, in volts.
    pub voltage: Harmonic,
}

impl SteadyState {
    /// Eqs. (45), (59), (71), (80), sections 3.1-4.3: the forced part of V_2, the steady-state voltage
    /// v = omega (sum of a_k theta_k) / sqrt(kappa^2 + c^2 omega^2) sin(omega t + atan(kappa / (c omega))).
    ///
    /// All four print the same response, for the regions where one or the other resonance leaves it stable;
    /// ask [`Published::stable`](super::Published::stable) for that. The sum runs over all modes of `system`,
    /// of which the paper keeps two. The electrical back-action, left out here, shifts the resonances:
    /// [`LinearResponse`](super::LinearResponse) has it.
    ///
    /// # Errors
    /// [`TheoryError::NaturalFrequency`] when omega is one of the natural frequencies.
    #[doc(alias = "eq-45")]
    #[doc(alias = "eq-59")]
    #[doc(alias = "eq-71")]
    #[doc(alias = "eq-80")]
    pub fn new(system: &ReducedSystem) -> Result<Self, TheoryError> {
        let p = &system.parameters;
        let amplitudes = system
            .modes
            .iter()
            .enumerate()
            .map(|(k, mode)| {
                modal_amplitude(mode, p.beta, p.omega)
                    .ok_or(TheoryError::NaturalFrequency { mode: k + 1, omega: p.omega })
            })
            .collect::<Result<Vec<_>, _>>()?;
        let coupled: f64 = amplitudes.iter().zip(&system.theta).map(|(a, theta)| a * theta).sum();
        let susceptance = p.c * p.omega;
        let voltage = Harmonic {
            amplitude: p.omega * coupled / p.kappa.hypot(susceptance),
            phase: (p.kappa / susceptance).atan(),
            omega: p.omega,
        };
        let tip = Harmonic { amplitude: amplitudes.iter().sum(), phase: 0.0, omega: p.omega };
        Ok(Self { amplitudes, tip, voltage })
    }
}
