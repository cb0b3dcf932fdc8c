//! Natural frequencies and modes of the beam with its tip mass and the linear part of the magnet force.

use std::f64::consts::PI;

use super::quadrature::gauss_legendre;
use super::{MAX_MODES, ModelError, Parameters};

mod turning;

/// Points of the quadrature of the modal integrals; mode 8 has four waves, far below what 48 points resolve.
const QUADRATURE_POINTS: usize = 48;

/// One mode of Eq. (18): frequency, shape and the integrals the reduced system needs. All dimensionless.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// Wave number lambda_n, the square root of the frequency.
    pub wave_number: f64,
    /// Natural angular frequency omega_n.
    pub omega: f64,
    /// Participation eta_1n = eta (1 + e phi_n'(1)) + integral of phi_n.
    pub eta1: f64,
    /// Modal mass eta_2n = eta (1 + e phi_n'(1))^2 + j phi_n'(1)^2 + integral of phi_n^2.
    pub eta2: f64,
    /// Slope of the mode at the tip, phi_n'(1); times theta it is the modal coupling theta_n of Eq. (27).
    pub tip_slope: f64,
    shape: Shape,
}

impl Mode {
    /// Eq. (22), section 2.3: phi_n(x) for x in 0..=1, scaled to phi_n(1) = 1.
    #[doc(alias = "eq-22")]
    pub fn shape(&self, x: f64) -> f64 {
        self.shape.value(x)
    }

    /// phi_n'(x).
    pub fn slope(&self, x: f64) -> f64 {
        self.shape.slope(x)
    }
}

/// What is fixed to the end of the beam, as the paper has it a point mass. All dimensionless.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tip {
    /// Its mass over that of the beam, eta.
    pub mass: f64,
    /// Its rotary inertia j about its own centre, in m_b L^2.
    pub inertia: f64,
    /// Distance e of its centre from the end of the beam, outwards.
    pub offset: f64,
}

impl Tip {
    /// The tip of a device.
    pub fn of(parameters: &Parameters) -> Self {
        Self { mass: parameters.eta, inertia: parameters.j, offset: parameters.e }
    }

    fn is_point(&self) -> bool {
        self.inertia == 0.0 && self.offset == 0.0
    }

    /// Rotary inertia about the end of the beam, j + eta e^2.
    fn about_the_end(&self) -> f64 {
        self.inertia + self.mass * self.offset * self.offset
    }
}

/// The first modes of a beam, in ascending frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeSet {
    modes: Vec<Mode>,
}

impl ModeSet {
    /// The first `count` modes for tip spring `c1` and tip mass ratio `eta` (both dimensionless).
    ///
    /// # Errors
    /// [`ModelError::Count`] unless `count` is 1 to [`MAX_MODES`]; [`ModelError::Buckled`] when c1 <= -3, where
    /// the first frequency would vanish.
    pub fn new(c1: f64, eta: f64, count: usize) -> Result<Self, ModelError> {
        Self::with_tip(c1, Tip { mass: eta, ..Tip::default() }, count)
    }

    /// The same for a tip that turns with the beam's end.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_tip(c1: f64, tip: Tip, count: usize) -> Result<Self, ModelError> {
        if !(1..=MAX_MODES).contains(&count) {
            return Err(ModelError::Count { field: "modes", value: count, minimum: 1, maximum: MAX_MODES });
        }
        if c1 <= -3.0 {
            return Err(ModelError::Buckled { c1 });
        }
        let (nodes, weights) = gauss_legendre(QUADRATURE_POINTS);
        let modes = (1..=count)
            .map(|n| {
                let (wave_number, shape) = if tip.is_point() {
                    let wave_number = wave_number(c1, tip.mass, n);
                    (wave_number, Shape::new(wave_number, c1, tip.mass))
                } else {
                    let wave_number = turning::wave_number(c1, &tip, n);
                    (wave_number, turning::shape(wave_number, c1, &tip))
                };
                let (mut first, mut second) = (0.0, 0.0);
                for (x, weight) in nodes.iter().zip(&weights) {
                    let value = shape.value(*x);
                    first += weight * value;
                    second += weight * value * value;
                }
                let tip_slope = shape.slope(1.0);
                // The tip's centre moves as far as phi_n(1) + e phi_n'(1).
                let centre = 1.0 + tip.offset * tip_slope;
                Mode {
                    wave_number,
                    omega: wave_number * wave_number,
                    eta1: tip.mass * centre + first,
                    eta2: tip.mass * centre * centre + tip.inertia * tip_slope * tip_slope + second,
                    tip_slope,
                    shape,
                }
            })
            .collect();
        Ok(Self { modes })
    }

    /// The slope of the tip under a unit moment there that the modes left out would add, at rest (dimensionless):
    /// the static slope of the whole beam less the sum of phi_k'(1)^2/(eta_2k omega_k^2) over the modes kept.
    ///
    /// The whole beam bends as phi'''' = 0, phi(0) = phi'(0) = 0, phi''(1) = 1, phi'''(1) = `c1` phi(1), a cubic with the
    /// slope 1 - (c1/4)/(1 + c1/3) at the tip. The modes, whose phi''(1) is 0, reach it only like 1/N.
    pub fn residual_compliance(&self, c1: f64) -> f64 {
        let whole = 1.0 - 0.25 * c1 / (1.0 + c1 / 3.0);
        let kept: f64 = self.modes.iter().map(|mode| (mode.tip_slope / mode.omega).powi(2) / mode.eta2).sum();
        // Every mode left out adds to it; a nearly buckled beam may leave rounding alone.
        (whole - kept).max(0.0)
    }

    /// How many modes there are.
    pub fn len(&self) -> usize {
        self.modes.len()
    }

    /// Never true: a set has at least one mode.
    pub fn is_empty(&self) -> bool {
        self.modes.is_empty()
    }

    /// The modes, first to last.
    pub fn iter(&self) -> std::slice::Iter<'_, Mode> {
        self.modes.iter()
    }
}

impl std::ops::Index<usize> for ModeSet {
    type Output = Mode;

    fn index(&self, index: usize) -> &Mode {
        &self.modes[index]
    }
}

/// Eq. (21), section 2.3, times exp(-lambda): zero at the wave numbers of the modes.
#[doc(alias = "eq-21")]
pub fn characteristic(lambda: f64, c1: f64, eta: f64) -> f64 {
    let (sin, cos) = lambda.sin_cos();
    let decay = (-lambda).exp();
    // cosh and sinh times exp(-lambda), which stay of order one for every mode.
    let cosh = 0.5 * (1.0 + decay * decay);
    let sinh = -0.5 * (-2.0 * lambda).exp_m1();
    lambda.powi(3) * (decay + cos * cosh) - (c1 - eta * lambda.powi(4)) * (cos * sinh - sin * cosh)
}

/// The n-th root of Eq. (21).
///
/// Spring and mass act at the tip only, so the roots interlace with those of the clamped-pinned beam: one below
/// the first (when c1 > -3) and one between each two.
fn wave_number(c1: f64, eta: f64, n: usize) -> f64 {
    let pinned = |n: usize| if n == 0 { 0.0 } else { clamped_pinned_wave_number(n) };
    super::magnet::bisect(|lambda| characteristic(lambda, c1, eta), lower_end(pinned(n - 1)), pinned(n))
}

/// Eq. (21) vanishes identically at 0, which is no mode.
fn lower_end(pinned: f64) -> f64 {
    if pinned == 0.0 { 1e-4 } else { pinned }
}

/// n-th root of tan lambda = tanh lambda, the clamped-pinned beam.
fn clamped_pinned_wave_number(n: usize) -> f64 {
    let mut lambda = (n as f64 + 0.25) * PI;
    for _ in 0..4 {
        let residual = (-2.0 * lambda).exp();
        // atan(tanh lambda) = pi/4 - atan(exp(-2 lambda)), exactly.
        lambda = n as f64 * PI + 0.25 * PI - residual.atan();
    }
    lambda
}

/// Coefficients of a mode shape, scaled so that nothing overflows or cancels for high modes.
#[derive(Debug, Clone, PartialEq)]
struct Shape {
    lambda: f64,
    /// (sin + sinh) exp(-lambda) / denominator and (cos + cosh) exp(-lambda) / denominator.
    a: f64,
    b: f64,
    /// (b - a) exp(lambda), the coefficient of the growing exponential, computed without cancellation.
    growing: f64,
}

impl Shape {
    fn new(lambda: f64, c1: f64, eta: f64) -> Self {
        let (sin, cos) = lambda.sin_cos();
        let decay = (-lambda).exp();
        let cosh = 0.5 * (1.0 + decay * decay);
        let sinh = -0.5 * (-2.0 * lambda).exp_m1();
        let (cubed, tip) = (lambda.powi(3), c1 - eta * lambda.powi(4));
        // Where spring or mass nearly pin the tip the difference cancels; Eq. (21) says what it is.
        let denominator = if tip.abs() > cubed {
            2.0 * cubed * (decay + cos * cosh) / tip
        } else {
            2.0 * (cos * sinh - sin * cosh)
        };
        Self {
            lambda,
            a: (sin * decay + sinh) / denominator,
            b: (cos * decay + cosh) / denominator,
            // cosh - sinh = exp(-lambda), so the two big parts cancel exactly.
            growing: (cos - sin + decay) / denominator,
        }
    }

    /// With y = lambda x: a (cos y - cosh y) + b (sinh y - sin y), where sinh and cosh are regrouped into
    /// exponentials: -(a + b)/2 e^-y + (b - a)/2 e^y.
    fn value(&self, x: f64) -> f64 {
        let y = self.lambda * x;
        if self.lambda < 1.0 {
            // Long waves: the hyperbolic and trigonometric parts cancel, their series does not.
            return self.a * cos_minus_cosh(y) + self.b * sinh_minus_sin(y);
        }
        let (sin, cos) = y.sin_cos();
        let growing = 0.5 * self.growing * (y - self.lambda).exp();
        self.a * cos - self.b * sin - 0.5 * (self.a + self.b) * (-y).exp() + growing
    }

    fn slope(&self, x: f64) -> f64 {
        let y = self.lambda * x;
        let (sin, cos) = y.sin_cos();
        if self.lambda < 1.0 {
            return self.lambda * (-self.a * (sin + y.sinh()) - self.b * cos_minus_cosh(y));
        }
        let growing = 0.5 * self.growing * (y - self.lambda).exp();
        self.lambda * (-self.a * sin - self.b * cos + 0.5 * (self.a + self.b) * (-y).exp() + growing)
    }
}

/// cos y - cosh y = -2 (y^2/2! + y^6/6! + ..), for 0 <= y <= 1.
fn cos_minus_cosh(y: f64) -> f64 {
    -2.0 * every_fourth_power(y, 2.0)
}

/// sinh y - sin y = 2 (y^3/3! + y^7/7! + ..), for 0 <= y <= 1.
fn sinh_minus_sin(y: f64) -> f64 {
    2.0 * every_fourth_power(y, 3.0)
}

/// y^k/k! + y^(k+4)/(k+4)! + .. for k = 2 or 3 and 0 <= y <= 1.
fn every_fourth_power(y: f64, k: f64) -> f64 {
    let mut power = k;
    let mut term = if k == 2.0 { y * y / 2.0 } else { y * y * y / 6.0 };
    let mut sum = term;
    for _ in 0..4 {
        term *= y.powi(4) / ((power + 1.0) * (power + 2.0) * (power + 3.0) * (power + 4.0));
        power += 4.0;
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_magnet_and_tip_mass_it_is_the_textbook_cantilever() -> Result<(), ModelError> {
        let modes = ModeSet::new(0.0, 0.0, 3)?;
        for (mode, lambda) in
            modes.iter().zip([1.875_104_068_711_961, 4.694_091_132_974_175, 7.854_757_438_237_613])
        {
            assert!((mode.wave_number / lambda - 1.0).abs() < 1e-14);
            assert!(
                (mode.eta2 - 0.25).abs() < 1e-14,
                "a cantilever's mode with unit tip has the integral 1/4"
            );
        }
        Ok(())
    }

    #[test]
    fn shapes_meet_the_boundary_conditions_and_the_closed_form_integrals() -> Result<(), ModelError> {
        for (c1, eta) in [(1.345, 0.02), (-2.999, 0.0), (200.0, 5.0), (-1.0, 100.0)] {
            for mode in ModeSet::new(c1, eta, MAX_MODES)?.iter() {
                // Values are sums of terms as large as the shape between clamp and tip.
                let amplitude = 1.0 + mode.eta2.sqrt();
                assert!(mode.shape(0.0).abs() < 1e-13 * amplitude);
                assert!(mode.slope(0.0).abs() < 1e-11 * amplitude * mode.wave_number);
                assert!(
                    (mode.shape(1.0) - 1.0).abs() < 1e-13 * amplitude,
                    "c1 {c1} lambda {}",
                    mode.wave_number
                );
                // Integrating phi'''' = lambda^4 phi by parts, with phi''(1) = 0 and phi'''(1) = c1 - eta lambda^4:
                let fourth = mode.wave_number.powi(4);
                let third = c1 - eta * fourth;
                let square = (3.0 * third + fourth - 2.0 * mode.tip_slope * third) / (4.0 * fourth);
                // The closed form, unlike the quadrature, cancels for long waves.
                let tolerance = 1e-12 * (1.0 + mode.eta2) + 1e-14 * third.abs() / fourth;
                let error = (mode.eta2 - eta - square).abs();
                assert!(error < tolerance, "c1 {c1} lambda {}: {error}", mode.wave_number);
            }
        }
        Ok(())
    }

    #[test]
    fn a_buckled_beam_is_an_error() {
        assert_eq!(ModeSet::new(-3.0, 0.02, 2), Err(ModelError::Buckled { c1: -3.0 }));
    }
}
