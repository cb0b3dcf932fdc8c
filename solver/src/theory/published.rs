//! The stability boundaries of sections 3 and 4 as the paper prints them: two modes, undamped forced motion,
//! no electrical back-action.
//!
//! Near each resonance the slow amplitudes obey, with the detuning sigma,
//!
//! dY_i/dt + mu_i Y_i = g_i conj(Y_j) e^(i sigma t), where
//! mu_k = alpha m_k / (2 eta_2k), m_k = omega_k^2 eta_2k - c_1,
//! g_k = G / (2 omega_k eta_2k), G = c_2 (a_1 + a_2);
//!
//! i = j for the subharmonics. m_k is the bending energy of the mode, hence positive.
//!
//! At the difference omega_2 - omega_1 the product g_i g_j changes its sign and there is no instability at
//! this order. Where omega comes close to omega_1 or omega_2 themselves the formulas still return numbers,
//! but the theory behind them does not hold: the amplitudes a_k are no longer small.

use nalgebra::Complex;
use serde::{Deserialize, Serialize};

use super::TheoryError;
use super::steady_state::modal_amplitude;
use crate::model::{Mode, ReducedSystem};

/// The secondary resonances of the paper.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin,
)]
#[serde(rename_all = "lowercase")]
pub enum Resonance {
    /// Combination resonance, omega near omega_1 + omega_2 (section 3).
    Sum,
    /// First subharmonic, omega near 2 omega_1 (section 4.1).
    First,
    /// Second subharmonic, omega near 2 omega_2 (section 4.3).
    Second,
}

impl Resonance {
    /// All three, in the order of the paper.
    pub const ALL: [Self; 3] = [Self::Sum, Self::First, Self::Second];

    /// The two modes that the resonance excites, counted from 0; the same one twice for a subharmonic.
    pub const fn pair(self) -> (usize, usize) {
        match self {
            Self::Sum => (0, 1),
            Self::First => (0, 0),
            Self::Second => (1, 1),
        }
    }
}

/// The published theory of one structure. Excitations are arguments, so that a boundary costs a few
/// operations.
#[derive(Debug, Clone, PartialEq)]
pub struct Published {
    modes: [Mode; 2],
    /// m_1 and m_2, the stiffness that Kelvin-Voigt damping acts on (dimensionless). With damping by the air, which the
    /// paper leaves out, alpha m_k + a_m eta_2k takes the place of alpha m_k: here m_k, with 1 for alpha.
    bending: [f64; 2],
    alpha: f64,
    c2: f64,
}

impl Published {
    /// The theory for the first two modes of `system`; further modes are ignored, as in the paper.
    ///
    /// # Errors
    /// [`TheoryError::TooFewModes`] when the system has only one.
    pub fn new(system: &ReducedSystem) -> Result<Self, TheoryError> {
        if system.modes.len() < 2 {
            return Err(TheoryError::TooFewModes { found: system.modes.len() });
        }
        let modes = [system.modes[0].clone(), system.modes[1].clone()];
        let bending = [0, 1].map(|k| modes[k].omega * modes[k].omega * modes[k].eta2 - system.c1);
        let c2 = system.magnet().taylor_coefficient(system.equilibrium.gap, 2);
        let (alpha, air) = (system.parameters.alpha, system.parameters.air);
        if air > 0.0 {
            let bending = [0, 1].map(|k| alpha * bending[k] + air * modes[k].eta2);
            return Ok(Self { modes, bending, alpha: 1.0, c2 });
        }
        Ok(Self { modes, bending, alpha, c2 })
    }

    /// Centre of the resonance, omega_1 + omega_2, 2 omega_1 or 2 omega_2 (dimensionless).
    pub fn frequency(&self, resonance: Resonance) -> f64 {
        let (i, j) = resonance.pair();
        self.modes[i].omega + self.modes[j].omega
    }

    /// omega_2 - omega_1 (dimensionless), where section 3.2 finds no instability at any amplitude.
    pub fn difference_frequency(&self) -> f64 {
        self.modes[1].omega - self.modes[0].omega
    }

    /// Eqs. (46), (61), (73), sections 3.2, 4.1, 4.3: detuning sigma of omega from the resonance
    /// (dimensionless).
    #[doc(alias = "eq-46")]
    #[doc(alias = "eq-61")]
    #[doc(alias = "eq-73")]
    pub fn detuning(&self, resonance: Resonance, omega: f64) -> f64 {
        omega - self.frequency(resonance)
    }

    /// (a_1 + a_2) / beta by Eq. (43); `None` when omega is a natural frequency.
    fn amplitude_per_beta(&self, omega: f64) -> Option<f64> {
        Some(modal_amplitude(&self.modes[0], 1.0, omega)? + modal_amplitude(&self.modes[1], 1.0, omega)?)
    }

    /// Eqs. (56), (72), (81), sections 3.2, 4.1, 4.3: the |sigma| up to which the forced motion is unstable,
    /// when its amplitudes are those at `beta` and `omega` (dimensionless).
    ///
    /// `None` when it is stable at any detuning, or omega is a natural frequency.
    #[doc(alias = "eq-56")]
    #[doc(alias = "eq-72")]
    #[doc(alias = "eq-81")]
    pub fn critical_detuning(&self, resonance: Resonance, beta: f64, omega: f64) -> Option<f64> {
        let g = self.c2 * beta * self.amplitude_per_beta(omega)?;
        let (i, j) = resonance.pair();
        let (w, m) = (|k: usize| self.modes[k].omega, |k: usize| self.bending[k]);
        let radicand = g * g / (w(i) * w(j) * m(i) * m(j)) - self.alpha * self.alpha;
        (radicand >= 0.0).then(|| self.width(resonance) * radicand.sqrt())
    }

    /// The factor before the root of Eq. (56), m_1/(2 eta_21) + m_2/(2 eta_22); for a subharmonic m_k/eta_2k,
    /// which brings Eqs. (72), (81) to the same form.
    fn width(&self, resonance: Resonance) -> f64 {
        let (i, j) = resonance.pair();
        0.5 * (self.bending[i] / self.modes[i].eta2 + self.bending[j] / self.modes[j].eta2)
    }

    /// Eq. (57), section 3.2, and Eqs. (72), (81) solved for beta in the same way: the lowest unstable beta_0
    /// at `omega` (dimensionless; it may lie beyond the accepted range of beta).
    ///
    /// `None` where no beta is unstable: without quadratic nonlinearity, or where the modes cancel at the
    /// tip; and when omega is a natural frequency, where the theory has no answer.
    ///
    /// At alpha = 0 this is the limit of vanishing damping, as the paper draws it. With no damping at all the
    /// sum resonance grows only nearer to its centre, as [`Self::growth_rate`] says: unequal damping
    /// destabilises.
    #[doc(alias = "eq-57")]
    pub fn boundary(&self, resonance: Resonance, omega: f64) -> Option<f64> {
        let (i, j) = resonance.pair();
        let (w, m) = (|k: usize| self.modes[k].omega, |k: usize| self.bending[k]);
        let detuning = self.detuning(resonance, omega) / self.width(resonance);
        let needed = (w(i) * w(j) * m(i) * m(j)).sqrt() * self.alpha.hypot(detuning);
        let per_beta = (self.c2 * self.amplitude_per_beta(omega)?).abs();
        let beta = needed / per_beta;
        (per_beta > 0.0 && beta.is_finite()).then_some(beta)
    }

    /// Eqs. (52), (68), (79), sections 3.2, 4.1, 4.3: the larger growth rate r of the resonant pair of modes,
    /// per unit of dimensionless time; negative is decay. `None` when omega is a natural frequency.
    ///
    /// With Y_1 ~ e^((rho + i sigma/2) t) and conj(Y_2) ~ e^((rho - i sigma/2) t), rho = r + i s, the two
    /// modes of the sum resonance give the complex quadratic (rho + mu_1 + i sigma/2)(rho + mu_2 - i sigma/2)
    /// = g_1 g_2, so rho = -(mu_1 + mu_2)/2 + sqrt(((mu_1 - mu_2 + i sigma)/2)^2 + g_1 g_2), whose principal
    /// root grows faster. The subharmonics are the case of one mode twice, Eqs. (68), (79).
    #[doc(alias = "eq-52")]
    #[doc(alias = "eq-68")]
    #[doc(alias = "eq-79")]
    pub fn growth_rate(&self, resonance: Resonance, beta: f64, omega: f64) -> Option<f64> {
        let g = self.c2 * beta * self.amplitude_per_beta(omega)?;
        let (i, j) = resonance.pair();
        let damping = |k: usize| 0.5 * self.alpha * self.bending[k] / self.modes[k].eta2;
        let gain = |k: usize| 0.5 * g / (self.modes[k].omega * self.modes[k].eta2);
        let half = 0.5 * Complex::new(damping(i) - damping(j), self.detuning(resonance, omega));
        let root = (half * half + gain(i) * gain(j)).sqrt();
        Some(root.re - 0.5 * (damping(i) + damping(j)))
    }

    /// Eqs. (58), (69), (70), sections 3.2-4.1: whether the forced motion is stable by all three resonances,
    /// the boundary counted as stable. `None` when omega is a natural frequency.
    #[doc(alias = "eq-58")]
    #[doc(alias = "eq-69")]
    #[doc(alias = "eq-70")]
    pub fn stable(&self, beta: f64, omega: f64) -> Option<bool> {
        self.amplitude_per_beta(omega)?;
        let below = |resonance| self.boundary(resonance, omega).is_none_or(|boundary| beta <= boundary);
        Some(Resonance::ALL.into_iter().all(below))
    }
}
