//! The force between the tip magnet and the fixed one, its equilibrium with the beam, and its Taylor series.

use super::{ModelError, Parameters};

/// Stiffness of the beam's tip against a transverse force, 3 E I / L^3, in the model's unit.
const BEAM_TIP_STIFFNESS: f64 = 3.0;

/// A pair of coaxial magnets: strength `c0` (negative: attracting) and length `h` in beam lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Magnet {
    /// Strength c_0 (dimensionless).
    pub c0: f64,
    /// Length h of each magnet in beam lengths.
    pub h: f64,
}

impl Magnet {
    /// Eq. (11), section 2.1: the repelling force F at distance `x` (beam lengths), dimensionless.
    ///
    /// The three inverse squares of the paper nearly cancel when h is small; written over a common denominator
    /// about the centre u = x + h nothing cancels: F = 2 c0 h^2 (3 u^2 - h^2) / (u^2 (u^2 - h^2)^2).
    #[doc(alias = "eq-11")]
    #[inline]
    pub fn force(&self, x: f64) -> f64 {
        let (u2, h2) = ((x + self.h).powi(2), self.h * self.h);
        // u^2 - h^2 = x (x + 2 h), in the form that keeps its digits near contact.
        let gap = x * (x + 2.0 * self.h);
        2.0 * self.c0 * h2 * (3.0 * u2 - h2) / (u2 * gap * gap)
    }

    /// The integral of the force from `x` to infinity, the magnets' potential energy (dimensionless).
    pub fn potential(&self, x: f64) -> f64 {
        let gap = x * (x + 2.0 * self.h);
        2.0 * self.c0 * self.h * self.h / ((x + self.h) * gap)
    }

    /// Eq. (17), section 2.2: coefficient c_j of z^j in F(s0) - F(s0 + z), dimensionless, for j >= 1.
    ///
    /// Again the difference of three powers is summed as a series of positive terms where it would cancel.
    #[doc(alias = "eq-17")]
    pub fn taylor_coefficient(&self, s0: f64, j: u32) -> f64 {
        let sign = if j % 2 == 1 { 1.0 } else { -1.0 };
        self.c0 * f64::from(j + 1) * sign * second_difference(s0, self.h, j + 2)
    }

    /// Eqs. (12), (13), section 2.2: the stable equilibrium, F(d + A_e) = 3 A_e, for a gap `d` in beam lengths.
    ///
    /// # Errors
    /// [`ModelError::PullIn`] when attracting magnets leave no equilibrium, [`ModelError::Buckled`] when the one
    /// they leave is unstable.
    #[doc(alias = "eq-13")]
    pub fn equilibrium(&self, d: f64) -> Result<Equilibrium, ModelError> {
        // Residual force on the tip at s, positive when it is pushed away from the fixed magnet.
        let residual = |s: f64| self.force(s) - BEAM_TIP_STIFFNESS * (s - d);
        let (near, far) = if self.c0 >= 0.0 {
            // The repelling force only decreases, so the root is unique and lies within F(d)/3 behind d.
            (d, d + self.force(d) / BEAM_TIP_STIFFNESS)
        } else {
            (self.closest_stable_distance(d)?, d)
        };
        let s0 = bisect(residual, near, far);
        let c1 = self.taylor_coefficient(s0, 1);
        if c1 <= -BEAM_TIP_STIFFNESS {
            return Err(ModelError::Buckled { c1 });
        }
        Ok(Equilibrium { displacement: s0 - d, gap: s0 })
    }

    /// For attracting magnets: the distance where the magnet's softening equals the beam's stiffness. Nearer than
    /// that nothing is stable; if the beam cannot even hold the tip there, there is no equilibrium at all.
    fn closest_stable_distance(&self, d: f64) -> Result<f64, ModelError> {
        let stiffness = |s: f64| self.taylor_coefficient(s, 1) + BEAM_TIP_STIFFNESS;
        let (mut inner, mut outer) = (d, d);
        while stiffness(outer) <= 0.0 {
            outer *= 2.0;
        }
        while stiffness(inner) > 0.0 {
            inner *= 0.5;
            if inner < d * 1e-12 {
                return Ok(inner);
            }
        }
        let closest = bisect(stiffness, inner, outer);
        let smallest = closest - self.force(closest) / BEAM_TIP_STIFFNESS;
        if d < smallest {
            return Err(ModelError::PullIn { c0: self.c0, d, h: self.h, smallest });
        }
        Ok(closest)
    }
}

/// Where the tip rests.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Equilibrium {
    /// A_e, displacement of the tip away from the fixed magnet, in beam lengths.
    pub displacement: f64,
    /// s0 = d + A_e, distance of the magnets at rest, in beam lengths.
    pub gap: f64,
}

impl Equilibrium {
    /// The equilibrium of the magnets and gap of `parameters`.
    ///
    /// # Errors
    /// As [`Magnet::equilibrium`].
    pub fn new(parameters: &Parameters) -> Result<Self, ModelError> {
        Magnet { c0: parameters.c0, h: parameters.h }.equilibrium(parameters.d)
    }

    /// Whether A_e is beyond the gap d, outside the paper's assumption |A_e| < d below Eq. (13).
    pub fn beyond_the_papers_assumption(&self) -> bool {
        self.displacement.abs() >= self.gap - self.displacement
    }
}

/// x^-p + (x + 2h)^-p - 2 (x + h)^-p without cancellation: with r = h/(x + h) it is
/// 2 (x + h)^-p sum_k binomial(p + 2k - 1, 2k) r^2k, all terms positive.
fn second_difference(x: f64, h: f64, p: u32) -> f64 {
    let centre = x + h;
    let ratio = h / centre;
    let power = |base: f64| base.powi(-(p as i32));
    // Beyond contact, where the centre may be negative, the series need not converge.
    if ratio.abs() > 0.25 {
        return power(x) + power(x + 2.0 * h) - 2.0 * power(centre);
    }
    let (mut term, mut sum) = (1.0, 0.0);
    let mut i = 0.0;
    let order = f64::from(p);
    loop {
        term *= (order + i) / (i + 1.0) * (order + i + 1.0) / (i + 2.0) * ratio * ratio;
        i += 2.0;
        let next = sum + term;
        if next == sum {
            return 2.0 * power(centre) * sum;
        }
        sum = next;
    }
}

/// Root of a function that changes sign once between `low` and `high`, by halving down to neighbouring doubles.
pub(crate) fn bisect(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let rising = f(high) > 0.0;
    loop {
        let middle = low + 0.5 * (high - low);
        if middle <= low.min(high) || middle >= low.max(high) {
            return middle;
        }
        if (f(middle) > 0.0) == rising {
            high = middle;
        } else {
            low = middle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAPER: Magnet = Magnet { c0: 0.5084, h: 0.004167 };

    #[test]
    fn the_force_equals_the_three_inverse_squares_of_the_paper() {
        let magnet = Magnet { c0: 0.7, h: 0.3 };
        let x: f64 = 0.4;
        let printed = 0.7 * (x.powi(-2) + (x + 0.6).powi(-2) - 2.0 * (x + 0.3).powi(-2));
        assert!((magnet.force(x) / printed - 1.0).abs() < 1e-14);
    }

    #[test]
    fn the_potential_is_the_integral_of_the_force() {
        let slope = (PAPER.potential(0.1 - 1e-5) - PAPER.potential(0.1 + 1e-5)) / 2e-5;
        assert!((slope / PAPER.force(0.1) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn both_forms_of_the_second_difference_agree_where_they_meet() {
        let x = 0.31;
        let h = 0.1; // ratio 0.244: the series is used
        let power = |base: f64| base.powi(-5);
        let direct = power(x) + power(x + 2.0 * h) - 2.0 * power(x + h);
        assert!((second_difference(x, h, 5) / direct - 1.0).abs() < 1e-14);
    }

    #[test]
    fn equilibria_balance_the_beam_and_are_stable_for_both_signs() -> Result<(), ModelError> {
        for magnet in [PAPER, Magnet { c0: -0.1, h: 0.004167 }, Magnet { c0: 0.0, h: 0.01 }] {
            let rest = magnet.equilibrium(0.15)?;
            let residual = magnet.force(rest.gap) - 3.0 * rest.displacement;
            assert!(residual.abs() < 1e-14, "{magnet:?}: {residual}");
            assert!(magnet.taylor_coefficient(rest.gap, 1) > -3.0);
        }
        Ok(())
    }

    #[test]
    fn strong_attraction_is_pull_in_not_a_number() {
        let strong = Magnet { c0: -5.0, h: 0.01 };
        let refused = strong.equilibrium(0.1);
        let Err(ModelError::PullIn { smallest, .. }) = refused else { panic!("{refused:?}") };
        // The gap that the message names is where equilibria begin.
        assert!(smallest > 0.1 && strong.equilibrium(0.999999 * smallest).is_err());
        assert!(strong.equilibrium(1.000001 * smallest).is_ok());
    }

    #[test]
    fn pull_in_happens_exactly_where_the_stable_root_vanishes() {
        let strength = |c0: f64| Magnet { c0, h: 0.01 }.equilibrium(0.15).is_ok();
        let (mut holds, mut pulls) = (0.0, -10.0);
        assert!(strength(holds) && !strength(pulls));
        for _ in 0..60 {
            let middle: f64 = 0.5 * (holds + pulls);
            if strength(middle) { holds = middle } else { pulls = middle }
        }
        let last = Magnet { c0: holds, h: 0.01 };
        let rest = last.equilibrium(0.15).map(|rest| last.taylor_coefficient(rest.gap, 1));
        // At the fold the tip's total stiffness vanishes.
        assert!(rest.is_ok_and(|c1| (c1 + 3.0).abs() < 1e-4));
    }
}
