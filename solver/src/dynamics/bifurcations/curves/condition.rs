//! What the multipliers of an orbit say on a curve of bifurcations: the scalar that vanishes on it, and those that
//! vanish at its points of codimension two.
//!
//! The critical multipliers, one for folds and period doublings, two for Neimark-Sacker, are set apart; the tests are
//! symmetric products over the others, smooth where those meet and part. On a Neimark-Sacker curve the critical pair is
//! known by its half-sum, the cosine of its angle, which passes smoothly through +-1 where the pair becomes real: beyond,
//! the curve is one of neutral saddles, no bifurcation. Reference: Kuznetsov, "Elements of Applied Bifurcation
//! Theory", sections 9.1 and 10.2.

use nalgebra::Complex;

use super::curve::SpecialKind;
use crate::dynamics::orbits::Instability;

/// Relative imaginary part below which a sum or product of two multipliers is real.
const REAL: f64 = 1e-9;
/// Distance from the unit circle within which a located multiplier is on it.
const ON_CIRCLE: f64 = 1e-4;

/// The condition that defines a curve, with the half-sum that the critical pair had last.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Condition {
    pub(super) kind: Instability,
    /// Not used for folds and period doublings.
    pub(super) cosine: f64,
}

impl Condition {
    /// The condition of `kind` at a place with these `multipliers`, one of which is on the circle.
    pub(super) fn at(kind: Instability, multipliers: &[Complex<f64>]) -> Option<Self> {
        if kind != Instability::NeimarkSacker {
            return Some(Self { kind, cosine: 0.0 });
        }
        let candidates = pairs(multipliers).into_iter().map(|(i, j)| (multipliers[i], multipliers[j]));
        let nearest = candidates.min_by(|a, b| defect(*a).abs().total_cmp(&defect(*b).abs()))?;
        Some(Self { kind, cosine: half_sum(nearest) })
    }

    /// The same, with the critical pair's half-sum among these `multipliers`.
    pub(super) fn renewed(self, multipliers: &[Complex<f64>]) -> Option<Self> {
        let cosine = match self.kind {
            Instability::NeimarkSacker => half_sum(self.pair(multipliers)?),
            _ => 0.0,
        };
        Some(Self { cosine, ..self })
    }

    /// A scalar that is zero on the curve; `None` when there is no pair.
    pub(super) fn value(self, multipliers: &[Complex<f64>]) -> Option<f64> {
        match self.kind {
            Instability::NeimarkSacker => self.pair(multipliers).map(defect),
            kind => Some(kind.test(multipliers)),
        }
    }

    /// The tests of codimension two: each changes its sign where the curve passes such a point.
    pub(super) fn tests(self, multipliers: &[Complex<f64>]) -> Vec<(SpecialKind, f64)> {
        let rest = self.rest(multipliers);
        let product = |kind: Instability| kind.test(&rest);
        let torus = product(Instability::NeimarkSacker);
        match self.kind {
            Instability::Fold => vec![
                (SpecialKind::OneToOne, second(multipliers, 1.0)),
                (SpecialKind::FoldFlip, product(Instability::PeriodDoubling)),
                (SpecialKind::FoldNeimarkSacker, torus),
            ],
            Instability::PeriodDoubling => vec![
                (SpecialKind::OneToTwo, second(multipliers, -1.0)),
                (SpecialKind::FoldFlip, product(Instability::Fold)),
                (SpecialKind::FlipNeimarkSacker, torus),
            ],
            Instability::NeimarkSacker => vec![
                (SpecialKind::OneToOne, 1.0 - self.cosine),
                (SpecialKind::OneToTwo, self.cosine + 1.0),
                (SpecialKind::OneToThree, self.cosine + 0.5),
                (SpecialKind::OneToFour, self.cosine),
                (SpecialKind::FoldNeimarkSacker, product(Instability::Fold)),
                (SpecialKind::FlipNeimarkSacker, product(Instability::PeriodDoubling)),
                (SpecialKind::DoubleNeimarkSacker, torus),
            ],
        }
    }

    /// Whether a located zero of the test for `special` is one: a product over pairs also vanishes for a real pair.
    pub(super) fn confirms(self, special: SpecialKind, multipliers: &[Complex<f64>]) -> bool {
        let torus = match special {
            SpecialKind::DoubleNeimarkSacker => true,
            SpecialKind::FoldNeimarkSacker | SpecialKind::FlipNeimarkSacker => {
                self.kind != Instability::NeimarkSacker
            }
            _ => false,
        };
        let on_circle = |mu: &Complex<f64>| {
            (mu.norm() - 1.0).abs() < ON_CIRCLE && Instability::of(*mu) == Instability::NeimarkSacker
        };
        !torus || self.rest(multipliers).iter().any(on_circle)
    }

    /// The critical pair among `multipliers`: nearly reciprocal, and the one known by its half-sum.
    fn pair(self, multipliers: &[Complex<f64>]) -> Option<(Complex<f64>, Complex<f64>)> {
        self.critical_pair(multipliers).map(|(i, j)| (multipliers[i], multipliers[j]))
    }

    fn critical_pair(self, multipliers: &[Complex<f64>]) -> Option<(usize, usize)> {
        let distance = |(i, j): &(usize, usize)| {
            let pair = (multipliers[*i], multipliers[*j]);
            defect(pair).abs() + (half_sum(pair) - self.cosine).abs()
        };
        pairs(multipliers).into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// The multipliers that are not critical.
    fn rest(self, multipliers: &[Complex<f64>]) -> Vec<Complex<f64>> {
        let nearest = |target: f64| {
            let distance = |i: &usize| (multipliers[*i] - target).norm();
            (0..multipliers.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
        };
        let critical = match self.kind {
            Instability::Fold => nearest(1.0).map(|i| (i, i)),
            Instability::PeriodDoubling => nearest(-1.0).map(|i| (i, i)),
            Instability::NeimarkSacker => self.critical_pair(multipliers),
        };
        let others = multipliers.iter().enumerate();
        others.filter(|(i, _)| critical.is_none_or(|(a, b)| *i != a && *i != b)).map(|(_, mu)| *mu).collect()
    }
}

/// Whether a second multiplier is at `critical`, +-1, where one is: the sum of the products of all but one of
/// 1 - mu critical. In the product without the nearest one the error of a nearly double multiplier would decide.
fn second(multipliers: &[Complex<f64>], critical: f64) -> f64 {
    let factors: Vec<Complex<f64>> = multipliers.iter().map(|mu| 1.0 - mu * critical).collect();
    let without = |i: usize| -> Complex<f64> {
        factors.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, factor)| factor).product()
    };
    (0..factors.len()).map(without).sum::<Complex<f64>>().re
}

/// Product of a pair, less 1.
fn defect((a, b): (Complex<f64>, Complex<f64>)) -> f64 {
    (a * b).re - 1.0
}

/// Half the sum of a pair: the cosine of its angle when it is on the circle.
fn half_sum((a, b): (Complex<f64>, Complex<f64>)) -> f64 {
    0.5 * (a + b).re
}

/// The pairs with real sum and product: conjugates, or two real multipliers.
fn pairs(multipliers: &[Complex<f64>]) -> Vec<(usize, usize)> {
    let real = |value: Complex<f64>, size: f64| value.im.abs() <= REAL * size;
    let mut pairs = Vec::new();
    for (j, b) in multipliers.iter().enumerate() {
        for (i, a) in multipliers[..j].iter().enumerate() {
            let size = a.norm() + b.norm();
            if real(a + b, size) && real(a * b, size * size) {
                pairs.push((i, j));
            }
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polar(modulus: f64, angle: f64) -> [Complex<f64>; 2] {
        let value = Complex::from_polar(modulus, angle);
        [value, value.conj()]
    }

    fn test(condition: Condition, multipliers: &[Complex<f64>], kind: SpecialKind) -> f64 {
        condition.tests(multipliers).into_iter().find(|(other, _)| *other == kind).expect("such a test").1
    }

    #[test]
    fn the_pair_is_known_by_its_angle() {
        let multipliers = [polar(1.0 + 1e-4, 0.8), polar(1.0 - 1e-9, 2.3)].concat();
        let condition = Condition::at(Instability::NeimarkSacker, &multipliers).expect("a pair");
        assert!((condition.cosine - 2.3_f64.cos()).abs() < 1e-8);
        // Where the other pair is nearer to the circle, the angle decides.
        let later = [polar(1.0, 0.8), polar(1.02, 2.31)].concat();
        let value = condition.value(&later).expect("a pair");
        assert!((value - (1.02_f64.powi(2) - 1.0)).abs() < 1e-12);
        assert!(test(condition, &multipliers, SpecialKind::DoubleNeimarkSacker) > 0.0);
        let crossed = [polar(1.0 - 1e-4, 0.8), polar(1.0, 2.3)].concat();
        assert!(test(condition, &crossed, SpecialKind::DoubleNeimarkSacker) < 0.0);
        assert!(condition.confirms(SpecialKind::DoubleNeimarkSacker, &crossed));
    }

    #[test]
    fn the_pair_is_followed_through_a_double_multiplier() {
        let condition = Condition { kind: Instability::NeimarkSacker, cosine: -0.999 };
        let saddle = [Complex::from(-1.05), Complex::from(-1.0 / 1.05), Complex::from(0.2)];
        assert!(condition.value(&saddle).expect("a pair").abs() < 1e-12);
        let beyond = condition.renewed(&saddle).expect("a pair");
        assert!(test(beyond, &saddle, SpecialKind::OneToTwo) < 0.0);
    }

    #[test]
    fn a_second_critical_multiplier_changes_a_sign() {
        for (kind, at, special) in [
            (Instability::Fold, 1.0, SpecialKind::OneToOne),
            (Instability::Fold, -1.0, SpecialKind::FoldFlip),
            (Instability::PeriodDoubling, -1.0, SpecialKind::OneToTwo),
            (Instability::PeriodDoubling, 1.0, SpecialKind::FoldFlip),
        ] {
            let critical = if kind == Instability::Fold { 1.0 } else { -1.0 };
            let condition = Condition { kind, cosine: 0.0 };
            let value = |second: f64| {
                test(condition, &[critical, second, 0.3].map(Complex::from), special).is_sign_positive()
            };
            assert_ne!(value(at - 1e-3), value(at + 1e-3), "{kind:?} {special}");
        }
    }

    #[test]
    fn reciprocal_real_multipliers_are_no_torus() {
        let condition = Condition { kind: Instability::Fold, cosine: 0.0 };
        let saddle = [1.0, 2.0, 0.5].map(Complex::from);
        assert!(!condition.confirms(SpecialKind::FoldNeimarkSacker, &saddle));
        let torus = [vec![Complex::from(1.0)], polar(1.0, 1.0).to_vec()].concat();
        assert!(condition.confirms(SpecialKind::FoldNeimarkSacker, &torus));
    }
}
