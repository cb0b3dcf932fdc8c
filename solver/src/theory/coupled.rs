//! The stability boundaries on the modes of beam and circuit together.
//!
//! The paper treats the coupling theta as small and so drops the circuit from its first-order equations. Here
//! the same argument is made with the eigenvalues lambda_i = -r_i + i O_i of the whole linear system. With
//! the forced tip motion S beta sin(omega t) (S complex) in the quadratic force c_2 s^2, two modes with
//! O_i + O_j near omega obey
//!
//! dy_i/dt = lambda_i y_i + beta k_ij e^(i omega t) conj(y_j), and the same with i and j exchanged,
//!
//! where k_ij conj(k_ji) = K_ij = c_2^2 |S|^2 rho_i conj(rho_j) and rho_i is the residue at lambda_i of the
//! tip receptance (tip displacement per tip force). It holds for any number of modes and any theta; it needs
//! light damping against the frequencies and a small forced motion: cubic terms, and the shift they cause,
//! are left out.

use nalgebra::{Complex, DVector};

use super::spectrum::eigenvalues;
use super::{DynamicStiffness, Resonance, TheoryError};
use crate::model::ReducedSystem;

/// Relative offset from an eigenvalue at which the inverse iteration solves, away from the exact singularity.
const ITERATION_OFFSET: f64 = 1e-8;

/// Decay rates below this fraction of the frequency are rounding errors of an undamped system.
const UNDAMPED: f64 = 1e-13;

/// One lightly damped oscillation of beam and circuit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoupledMode {
    /// Decay rate r (dimensionless, >= 0).
    pub decay: f64,
    /// Angular frequency O (dimensionless).
    pub frequency: f64,
    /// Residue of the tip receptance at the eigenvalue -r + i O (dimensionless).
    pub residue: Complex<f64>,
}

/// The coupled-mode theory of one structure; it depends on neither beta nor omega.
#[derive(Debug, Clone, PartialEq)]
pub struct CoupledModes {
    eigenvalues: Vec<Complex<f64>>,
    modes: Vec<CoupledMode>,
    stiffness: DynamicStiffness,
    c2: f64,
}

impl CoupledModes {
    /// One small eigenvalue problem of size 2N + 1 and an inverse iteration a mode.
    ///
    /// Modes that decay faster than they turn (r > O) are left out: their own oscillation is over before a
    /// resonance could build up, though they still take part in the forced motion.
    ///
    /// # Errors
    /// [`TheoryError::TooFewModes`] for a system of one mode, [`TheoryError::Overdamped`] when fewer than two
    /// are left, and the errors of [`eigenvalues`].
    pub fn new(system: &ReducedSystem) -> Result<Self, TheoryError> {
        if system.modes.len() < 2 {
            return Err(TheoryError::TooFewModes { found: system.modes.len() });
        }
        let eigenvalues = eigenvalues(system)?;
        let stiffness = DynamicStiffness::new(system);
        let light = eigenvalues.iter().filter(|value| value.im > 0.0 && -value.re <= value.im);
        let modes = light
            .map(|value| coupled_mode(&stiffness, *value).ok_or(TheoryError::NotFinite))
            .collect::<Result<Vec<_>, _>>()?;
        if modes.len() < 2 {
            return Err(TheoryError::Overdamped { found: modes.len() });
        }
        let c2 = system.magnet().taylor_coefficient(system.equilibrium.gap, 2);
        Ok(Self { eigenvalues, modes, stiffness, c2 })
    }

    /// All 2N + 1 eigenvalues of the linear system, ordered as by [`eigenvalues`].
    pub fn eigenvalues(&self) -> &[Complex<f64>] {
        &self.eigenvalues
    }

    /// The lightly damped modes by ascending frequency, at least two.
    pub fn modes(&self) -> &[CoupledMode] {
        &self.modes
    }

    /// Centre of the resonance, O_i + O_j (dimensionless).
    pub fn frequency(&self, resonance: Resonance) -> f64 {
        let (i, j) = resonance.pair();
        self.modes[i].frequency + self.modes[j].frequency
    }

    /// The lowest unstable beta at `omega` near a resonance of the paper; `None` and limits as
    /// [`Self::pair_boundary`].
    pub fn boundary(&self, resonance: Resonance, omega: f64) -> Option<f64> {
        let (i, j) = resonance.pair();
        self.pair_boundary(i, j, omega)
    }

    /// The lowest unstable beta at `omega` near O_i + O_j (dimensionless; it may lie beyond the accepted
    /// range of beta). `i` and `j` count [`Self::modes`] from 0 and may be equal (a subharmonic).
    ///
    /// `None` when there is no such mode, where no beta is unstable (without quadratic nonlinearity, or where
    /// the forced motion leaves the tip at rest), and at an undamped eigenfrequency. Where nothing dissipates
    /// it is the boundary of the undamped system, which is narrower than the limit of little damping.
    pub fn pair_boundary(&self, i: usize, j: usize, omega: f64) -> Option<f64> {
        let pair = self.pair(i, j, omega)?;
        pair.marginal_square().map(f64::sqrt)
    }

    /// Growth rate of the resonant pair at `beta` and `omega` per unit of dimensionless time, negative for
    /// decay; `None` at an undamped eigenfrequency.
    pub fn growth_rate(&self, resonance: Resonance, beta: f64, omega: f64) -> Option<f64> {
        let (i, j) = resonance.pair();
        Some(self.pair(i, j, omega)?.growth_rate(beta))
    }

    fn pair(&self, i: usize, j: usize, omega: f64) -> Option<Pair> {
        let (first, second) = (self.modes.get(i)?, self.modes.get(j)?);
        Some(Pair {
            mean_decay: 0.5 * (first.decay + second.decay),
            half_difference: 0.5 * (first.decay - second.decay),
            detuning: omega - first.frequency - second.frequency,
            coupling: self.gain(omega)? * first.residue * second.residue.conj(),
        })
    }

    /// c_2^2 |S|^2, the square of the stiffness that the forced motion modulates, per unit of beta.
    fn gain(&self, omega: f64) -> Option<f64> {
        Some((self.c2 * self.stiffness.tip_response(omega)?).norm_sqr())
    }

    /// The coupling K of modes `i` and `j` near the *difference* of their frequencies, per unit of beta
    /// squared: c_2^2 |S|^2 rho_i rho_j, without the conjugate.
    ///
    /// A residue is nearly -i/(2 O eta_2), so this K is negative where that of the sum is positive, and a
    /// negative K only shifts frequencies: there is no boundary. `None` when there is no such mode and at an
    /// undamped eigenfrequency.
    pub fn difference_coupling(&self, i: usize, j: usize, omega: f64) -> Option<Complex<f64>> {
        Some(self.gain(omega)? * self.modes.get(i)?.residue * self.modes.get(j)?.residue)
    }
}

/// Decay, frequency and residue of the mode at an eigenvalue known to rounding.
fn coupled_mode(stiffness: &DynamicStiffness, eigenvalue: Complex<f64>) -> Option<CoupledMode> {
    let near = eigenvalue * Complex::new(1.0, ITERATION_OFFSET);
    let solver = stiffness.matrix(near).lu();
    let slope = stiffness.derivative(eigenvalue);
    let tip_force = DVector::from_element(slope.nrows(), Complex::from(1.0));
    let mut shape = solver.solve(&tip_force)?.normalize();
    for _ in 0..2 {
        shape = solver.solve(&(&slope * shape))?.normalize();
    }
    // M is symmetric, so its left null vector is the right one and the residue of 1^T M^-1 1 is:
    let tip = shape.sum();
    let residue = tip * tip / shape.dot(&(&slope * &shape));
    let decay = if -eigenvalue.re <= UNDAMPED * eigenvalue.im { 0.0 } else { -eigenvalue.re };
    let finite = residue.re.is_finite() && residue.im.is_finite();
    finite.then_some(CoupledMode { decay, frequency: eigenvalue.im, residue })
}

/// Two coupled modes under a forced motion. The slow exponent rho of y_i obeys, at the frequency that both
/// share, (rho + r_i)(rho + r_j - i sigma) = beta^2 K.
struct Pair {
    /// (r_i + r_j)/2.
    mean_decay: f64,
    /// (r_i - r_j)/2.
    half_difference: f64,
    /// sigma = omega - O_i - O_j.
    detuning: f64,
    /// K.
    coupling: Complex<f64>,
}

impl Pair {
    /// The larger real part of rho = -R + i sigma/2 +- sqrt((D + i sigma/2)^2 + beta^2 K), with R the mean of
    /// the decay rates and D half their difference.
    fn growth_rate(&self, beta: f64) -> f64 {
        let half = Complex::new(self.half_difference, 0.5 * self.detuning);
        (half * half + self.coupling * (beta * beta)).sqrt().re - self.mean_decay
    }

    /// beta^2 at which the growth rate vanishes.
    ///
    /// A square root has the real part R when its square Z has (Im Z)^2 = 4 R^2 (R^2 - Re Z). That is a
    /// quadratic p B^2 + 2 q B - n = 0 for B = beta^2 with p and n not negative: one positive root.
    fn marginal_square(&self) -> Option<f64> {
        let (decay, difference) = (self.mean_decay, self.half_difference);
        let (a, b) = (self.coupling.re, self.coupling.im);
        let square = if decay == 0.0 {
            // Undamped, the two exponents meet on the imaginary axis.
            if a > 0.0 { 0.25 * self.detuning * self.detuning / a } else { return None }
        } else {
            let product = (decay - difference) * (decay + difference);
            let p = b * b;
            let q = difference * self.detuning * b + 2.0 * decay * decay * a;
            let n = product * (self.detuning * self.detuning + 4.0 * decay * decay);
            let root = (q * q + p * n).sqrt();
            if q > 0.0 { n / (q + root) } else { (root - q) / p }
        };
        square.is_finite().then_some(square)
    }
}
