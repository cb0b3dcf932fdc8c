//! Modes of a beam whose tip has a rotary inertia j and a centre at the distance e from the beam's end, which the paper
//! leaves out.
//!
//! With J = j + eta e^2 the end of the beam obeys phi'' = omega^2 (J phi' + eta e phi) and
//! phi''' = c_1 phi - omega^2 eta (phi + e phi'). Without both it is the tip of Eqs. (20), (21).

use super::{Shape, Tip, clamped_pinned_wave_number};

/// Sine, cosine, exp(-lambda), and cosh and sinh times exp(-lambda).
struct Waves {
    sin: f64,
    cos: f64,
    decay: f64,
    cosh: f64,
    sinh: f64,
}

impl Waves {
    fn at(lambda: f64) -> Self {
        let (sin, cos) = lambda.sin_cos();
        let decay = (-lambda).exp();
        Self { sin, cos, decay, cosh: 0.5 * (1.0 + decay * decay), sinh: -0.5 * (-2.0 * lambda).exp_m1() }
    }

    /// 1 - cos cosh, times exp(-lambda): zero where a beam clamped at both ends vibrates.
    fn clamped(&self) -> f64 {
        self.decay - self.cos * self.cosh
    }
}

/// The determinant of the two conditions at the beam's end over -2, times exp(-lambda); Eq. (21) where j and e are zero.
fn characteristic(waves: &Waves, lambda: f64, c1: f64, tip: &Tip) -> f64 {
    let Waves { sin, cos, decay, cosh, sinh } = waves;
    let cubed = lambda.powi(3);
    let spring = c1 - tip.mass * lambda * cubed;
    cubed * (decay + cos * cosh)
        - spring * (cos * sinh - sin * cosh)
        - 2.0 * lambda.powi(5) * tip.mass * tip.offset * sin * sinh
        - cubed * cubed * tip.about_the_end() * (sin * cosh + cos * sinh)
        - cubed * (tip.inertia * spring + tip.mass * tip.offset * tip.offset * c1) * waves.clamped()
}

/// How many modes lie below `lambda` (Wittrick & Williams, Q. J. Mech. Appl. Math. 24, 263, 1971): those of the beam
/// clamped at both ends, and the negative eigenvalues of the stiffness that its end then shows, tip included.
fn modes_below(lambda: f64, c1: f64, tip: &Tip) -> usize {
    let waves = Waves::at(lambda);
    let clamped = waves.clamped();
    // The roots of cos cosh = 1 lie next to (m + 1/2) pi; at each the sign changes.
    let nearest = (lambda / std::f64::consts::PI - 0.5).round().max(0.0) as usize;
    let fixed =
        if nearest.is_multiple_of(2) == (clamped > 0.0) { nearest } else { nearest.saturating_sub(1) };
    let determinant = characteristic(&waves, lambda, c1, tip) / clamped;
    let Waves { sin, cos, cosh, sinh, .. } = waves;
    let displacement = lambda.powi(3) * (sin * cosh + cos * sinh) / clamped + c1 - tip.mass * lambda.powi(4);
    match (determinant < 0.0, displacement < 0.0) {
        (true, _) => fixed + 1,
        (false, true) => fixed + 2,
        (false, false) => fixed,
    }
}

/// The wave number of the mode `n`, counted from 1. Mass and inertia only lower it, and the stiffest spring pins the end.
pub(super) fn wave_number(c1: f64, tip: &Tip, n: usize) -> f64 {
    let (mut low, mut high) = (0.0, clamped_pinned_wave_number(n));
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if modes_below(middle, c1, tip) >= n { high = middle } else { low = middle }
    }
}

/// The shape at a wave number, scaled to phi(1) = 1. Its two coefficients are in the ratio that the moment at the end asks
/// for.
pub(super) fn shape(lambda: f64, c1: f64, tip: &Tip) -> Shape {
    let waves = Waves::at(lambda);
    let Waves { sin, cos, decay, cosh, sinh } = waves;
    let cubed = lambda.powi(3);
    let turning = cubed * tip.about_the_end();
    let lever = lambda * lambda * tip.mass * tip.offset;
    let spring = c1 - tip.mass * lambda * cubed;
    let denominator = if spring.abs() > cubed {
        // Where spring or mass nearly pin the end the difference cancels; the characteristic equation says what it is.
        2.0 * (cubed * (decay + cos * cosh)
            - 2.0 * cubed * lever * sin * sinh
            - cubed * turning * (sin * cosh + cos * sinh)
            - cubed * lever * lever * waves.clamped())
            / spring
    } else {
        2.0 * (cos * sinh - sin * cosh + turning * waves.clamped())
    };
    let a = sin * decay + sinh - turning * (cosh - cos * decay) - lever * (sinh - sin * decay);
    let b = cos * decay + cosh - turning * (sin * decay + sinh) + lever * (cos * decay - cosh);
    let growing = cos - sin + decay - turning * (sin + cos - decay) + lever * (cos - sin - decay);
    Shape { lambda, a: a / denominator, b: b / denominator, growing: growing / denominator }
}

#[cfg(test)]
mod tests {
    use super::super::{MAX_MODES, ModeSet};
    use super::*;
    use crate::model::{ModelError, quadrature::gauss_legendre};

    const TIPS: [(f64, Tip); 6] = [
        (1.345, Tip { mass: 0.02, inertia: 1e-3, offset: 0.0 }),
        (0.0, Tip { mass: 1.4, inertia: 0.05, offset: 0.1 }),
        (-2.9, Tip { mass: 0.0, inertia: 3.0, offset: 0.0 }),
        (200.0, Tip { mass: 5.0, inertia: 0.0, offset: 0.3 }),
        (-1.0, Tip { mass: 100.0, inertia: 100.0, offset: -0.5 }),
        (0.0, Tip { mass: 0.5, inertia: 1e-9, offset: 0.0 }),
    ];

    #[test]
    fn modes_meet_the_conditions_at_the_end_and_are_orthogonal_in_the_whole_mass() -> Result<(), ModelError> {
        let (nodes, weights) = gauss_legendre(48);
        for (c1, tip) in TIPS {
            let modes = ModeSet::with_tip(c1, tip, MAX_MODES)?;
            for (n, mode) in modes.iter().enumerate() {
                let amplitude = 1.0 + mode.eta2.sqrt() + mode.tip_slope.abs();
                assert!((mode.shape(1.0) - 1.0).abs() < 1e-11 * amplitude, "{tip:?} {n}");
                let square = mode.omega * mode.omega;
                let fixed = mode.shape(0.0).abs() + mode.slope(0.0).abs();
                assert!(fixed < 1e-10 * amplitude * mode.wave_number, "{tip:?} {n}: {fixed}");
                // Rayleigh's quotient with phi'' by differences would lose digits: the same by parts,
                // omega^2 eta_2 = integral of phi''^2 + c_1, with phi'''' = omega^2 phi, is what orthogonality asks for.
                for other in modes.iter().take(n) {
                    let beam: f64 = nodes
                        .iter()
                        .zip(&weights)
                        .map(|(x, weight)| weight * mode.shape(*x) * other.shape(*x))
                        .sum();
                    let centre = |slope: f64| 1.0 + tip.offset * slope;
                    let (a, b) = (mode.tip_slope, other.tip_slope);
                    let whole = beam + tip.mass * centre(a) * centre(b) + tip.inertia * a * b;
                    let scale = (mode.eta2 * other.eta2).sqrt();
                    assert!(whole.abs() < 1e-9 * scale, "{tip:?} {n}: {whole} of {scale}");
                }
                assert!(square > 0.0);
            }
            let ascending = modes.iter().zip(modes.iter().skip(1)).all(|(a, b)| a.omega < b.omega);
            assert!(ascending, "{tip:?}");
        }
        Ok(())
    }

    #[test]
    fn a_tip_that_hardly_turns_is_the_point_mass() -> Result<(), ModelError> {
        let point = ModeSet::new(1.345, 0.02, MAX_MODES)?;
        for (inertia, offset) in [(1e-12, 0.0), (0.0, 1e-12), (1e-300, -1e-300)] {
            let turning = ModeSet::with_tip(1.345, Tip { mass: 0.02, inertia, offset }, MAX_MODES)?;
            for (a, b) in turning.iter().zip(point.iter()) {
                for (a, b) in
                    [(a.omega, b.omega), (a.eta1, b.eta1), (a.eta2, b.eta2), (a.tip_slope, b.tip_slope)]
                {
                    assert!((a / b - 1.0).abs() < 1e-6, "{inertia} {offset}: {a} {b}");
                }
            }
            let first = turning[0].omega / point[0].omega - 1.0;
            assert!(first.abs() < 1e-11, "{first}");
        }
        Ok(())
    }

    #[test]
    fn a_rigid_body_on_a_massless_beam_is_the_textbook_one() -> Result<(), ModelError> {
        // Two degrees of freedom on the tip's compliance [[1/3, 1/2], [1/2, 1]]: a body so heavy that the beam weighs
        // nothing beside it. With K its inverse, M = [[m, m e], [m e, j + m e^2]].
        let (mass, inertia, offset) = (90.0, 60.0, 0.4);
        let modes = ModeSet::with_tip(0.0, Tip { mass, inertia, offset }, 2)?;
        let turning = inertia + mass * offset * offset;
        // det(K - w M) = 0 with K = [[12, -6], [-6, 4]].
        let (a, b, c) = (
            mass * turning - (mass * offset).powi(2),
            -(12.0 * turning + 4.0 * mass + 12.0 * mass * offset),
            12.0,
        );
        let root = (b * b - 4.0 * a * c).sqrt();
        for (mode, expected) in modes.iter().zip([(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)]) {
            assert!((mode.omega * mode.omega / expected - 1.0).abs() < 6e-3, "{} {expected}", mode.omega);
        }
        Ok(())
    }
}
