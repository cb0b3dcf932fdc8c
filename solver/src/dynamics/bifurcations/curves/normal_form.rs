//! The normal form of the bifurcation on a curve: which way the orbits or tori that branch off go.
//!
//! With M the monodromy matrix, B and C the second and third derivatives of the map, q and p the right and left
//! eigenvectors of M to the critical multiplier and <p, q> = 1, the map on the centre manifold is
//!
//! * at a fold x -> x + b x^2, b = <p, B(q,q)>/2;
//! * at a period doubling x -> -x + c x^3, c = <p, C(q,q,q)/6 + B(q, (1 - M)^-1 B(q,q))/2>;
//! * at a Neimark-Sacker point of multiplier m = exp(i theta) z -> m z (1 + D z |z|^2), with D of real part
//!   d = Re(<p, C(q,q,q*) + 2 B(q, (1 - M)^-1 B(q,q*)) + B(q*, (m^2 - M)^-1 B(q,q))>/m)/2
//!
//! (Kuznetsov, "Elements of Applied Bifurcation Theory", sections 5.4, 9.5 to 9.7; Kuznetsov & Meijer, "Numerical
//! Bifurcation Analysis of Maps"). A torus or an orbit of twice the period branches off to the side where the orbit is
//! unstable, and is stable but for multipliers that are not critical (supercritical), where c > 0 or d < 0.
//!
//! The derivative of the map is exact, so B along a direction is a central difference of it and C its second difference.
//! What these leave out is of the order of STEP^2, what rounding adds of that of 1e-14/STEP^2: coefficients are good to
//! about 1e-5 of the largest of their terms.

use nalgebra::{Complex, DMatrix, DVector};

use super::condition::Condition;
use crate::dynamics::bifurcations::arclength::Family;
use crate::dynamics::bifurcations::plane::Axis;
use crate::dynamics::orbits::floquet::eigenvector;
use crate::dynamics::orbits::{Instability, OrbitError};
use crate::model::{Parameter, ReducedSystem};

/// Step of the differences along an eigenvector, in units of the gap.
const STEP: f64 = 1e-3;

/// Distance of the cosine of a pair's angle from that of a real multiplier within which the coefficient, which grows
/// beyond all bounds there, is lost in the errors.
const REAL: f64 = 1e-5;

/// Distance of the critical multiplier from where it should be, relative to that from the next one, within which it is told
/// apart from it.
const ALONE: f64 = 0.1;

/// The coefficient of the normal form of a bifurcation of one parameter, as that of a [`super::CurvePoint`]: of the
/// `kind` at which the orbit of `periods` excitation periods of `system` is that has this `state` (length 2N + 1) at t = 0.
/// `None` at a fold, where it has no finite value, and where another multiplier is so near that the state is not known well
/// enough to tell the critical one's eigenvector from its neighbour's.
///
/// # Errors
/// Those of the map at the orbit and beside it, [`OrbitError::Singular`] where an eigenvector cannot be computed.
pub fn normal_form(
    system: &ReducedSystem,
    kind: Instability,
    periods: usize,
    state: &[f64],
) -> Result<Option<f64>, OrbitError> {
    if system.undamped() {
        return Ok(None);
    }
    let axis = Axis { parameter: Parameter::Beta, range: Parameter::Beta.range() };
    let mut family = Family::new(system, [axis], periods)?;
    let beta = family.beta();
    family.solver.evaluate_at(state, beta, periods)?;
    let multipliers = family.solver.multipliers()?;
    let Some(condition) = Condition::at(kind, &multipliers).filter(|_| is_alone(kind, &multipliers)) else {
        return Ok(None);
    };
    Ok(NormalForm::new(&mut family, condition, None)?.and_then(|form| form.coefficient))
}

/// Whether the critical one of the `multipliers` is of its `kind`, and much nearer to where it should be than to any other.
fn is_alone(kind: Instability, multipliers: &[Complex<f64>]) -> bool {
    let off = |mu: &Complex<f64>| match kind {
        Instability::Fold => (mu - 1.0).norm(),
        Instability::PeriodDoubling => (mu + 1.0).norm(),
        Instability::NeimarkSacker => (mu.norm() - 1.0).abs(),
    };
    let fits = multipliers.iter().enumerate().filter(|(_, mu)| Instability::of(**mu) == kind);
    let Some((critical, mu)) = fits.min_by(|a, b| off(a.1).total_cmp(&off(b.1))) else { return false };
    let others = multipliers.iter().enumerate().filter(|(i, _)| *i != critical);
    let nearest = others.map(|(_, other)| (other - mu).norm()).fold(f64::INFINITY, f64::min);
    off(mu) <= ALONE * nearest
}

/// The coefficient at a place and what it was computed with.
#[derive(Debug, Clone)]
pub(super) struct NormalForm {
    /// c or d for an eigenvector of unit length in the components that the map's scales make comparable, over the gap;
    /// `None` where it has no finite value.
    pub(super) coefficient: Option<f64>,
    /// The coefficient times what is zero where it is infinite: smooth along a curve, and zero with the coefficient.
    pub(super) test: f64,
    /// Eigenvectors of a period doubling, right and left, which fix the sign of `test`.
    real: Option<[DVector<f64>; 2]>,
}

impl NormalForm {
    /// The coefficient of a period doubling or a Neimark-Sacker point at the orbit that the solver of `family`
    /// evaluated last, with eigenvectors on the side of those of `like`; `None` at a fold and next to where a pair
    /// becomes real.
    ///
    /// # Errors
    /// [`OrbitError::Singular`] where an eigenvector cannot be computed, and those of the map beside the orbit.
    pub(super) fn new<const K: usize>(
        family: &mut Family<K>,
        condition: Condition,
        like: Option<&Self>,
    ) -> Result<Option<Self>, OrbitError> {
        Differences::at(family, STEP).form(condition, like)
    }
}

/// The map's derivative at an orbit and beside it.
struct Differences<'a, const K: usize> {
    family: &'a mut Family<K>,
    state: Vec<f64>,
    middle: DMatrix<f64>,
    /// Unit of the components over that of the map's scales.
    gap: f64,
    step: f64,
}

impl<'a, const K: usize> Differences<'a, K> {
    fn at(family: &'a mut Family<K>, step: f64) -> Self {
        let state = family.solver.state().to_vec();
        let gap = family.solver.map().gap();
        let middle = family.solver.monodromy().clone();
        Self { family, state, middle, gap, step }
    }

    fn form(
        &mut self,
        condition: Condition,
        like: Option<&NormalForm>,
    ) -> Result<Option<NormalForm>, OrbitError> {
        let form = match condition.kind {
            Instability::Fold => return Ok(None),
            Instability::PeriodDoubling => self.doubling(like)?,
            Instability::NeimarkSacker if 1.0 - condition.cosine.abs() < REAL => return Ok(None),
            Instability::NeimarkSacker => self.torus(condition.cosine)?,
        };
        if form.test.is_finite() { Ok(Some(form)) } else { Err(OrbitError::Singular) }
    }

    fn doubling(&mut self, like: Option<&NormalForm>) -> Result<NormalForm, OrbitError> {
        let like = like.and_then(|like| like.real.as_ref());
        let right = oriented(eigenvector(&self.middle, -1.0)?, like.map(|[right, _]| right));
        let left = oriented(eigenvector(&self.middle.transpose(), -1.0)?, like.map(|[_, left]| left));
        let (second, third) = self.along(&right)?;
        let determinant = self.family.solver.newton_matrix().determinant();
        // (1 - M)^-1 grows beyond all bounds where the determinant vanishes, their product does not.
        let bent = self.family.solver.response(&second * &right)? * determinant;
        let test = left.dot(&(third * &right * (determinant / 6.0) + second * bent * 0.5));
        let coefficient = finite(test / (left.dot(&right) * determinant));
        Ok(NormalForm { coefficient, test, real: Some([right, left]) })
    }

    fn torus(&mut self, cosine: f64) -> Result<NormalForm, OrbitError> {
        let n = self.middle.nrows();
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let multiplier = Complex::new(cosine, sine);
        let matrix = self.middle.map(Complex::from);
        let right = eigenvector(&matrix, multiplier)?;
        let left = eigenvector(&matrix.transpose(), multiplier.conj())?;
        let parts = [right.map(|value| value.re), right.map(|value| value.im)];
        let [(b0, c0), (b1, c1)] = [self.along(&parts[0])?, self.along(&parts[1])?];
        let second = b0.map(Complex::from) + b1.map(|value| Complex::new(0.0, value));
        let third = (c0 + c1).map(Complex::from) * &right;
        // B(q,q*) is real.
        let straight = (&second * right.conjugate()).map(|value| value.re);
        let bent = self.family.solver.response(straight)?.map(Complex::from);
        let doubled = DMatrix::identity(n, n) * (multiplier * multiplier) - matrix;
        let turned = doubled.lu().solve(&(&second * &right)).ok_or(OrbitError::Singular)?;
        let sum = third + &second * bent * Complex::from(2.0) + second.conjugate() * turned;
        let value = 0.5 * (left.dotc(&sum) / (left.dotc(&right) * multiplier)).re;
        let test = value * self.family.solver.newton_matrix().determinant() * sine * sine;
        Ok(NormalForm { coefficient: finite(value), test, real: None })
    }

    /// B and C along `vector`, scaled and over the gap: the matrices of w -> B(v, w) and w -> C(v, v, w).
    fn along(&mut self, vector: &DVector<f64>) -> Result<(DMatrix<f64>, DMatrix<f64>), OrbitError> {
        let low = self.beside(vector, -self.step)?;
        let high = self.beside(vector, self.step)?;
        let second = (&high - &low) / (2.0 * self.step);
        let third = (high + low - &self.middle * 2.0) / (self.step * self.step);
        Ok((second, third))
    }

    /// The map's derivative, scaled, `step` along `vector` from the orbit.
    fn beside(&mut self, vector: &DVector<f64>, step: f64) -> Result<DMatrix<f64>, OrbitError> {
        let beta = self.family.beta();
        let map = self.family.solver.map();
        let length = step * self.gap;
        let parts = vector.iter().zip(map.scales());
        let moved: Vec<f64> =
            self.state.iter().zip(parts).map(|(y, (part, scale))| y + length * part * scale).collect();
        map.apply(&moved, beta, self.family.periods, |_, _| ())?;
        Ok(map.scaled_derivative())
    }
}

/// `vector` on the side of `like`.
fn oriented(vector: DVector<f64>, like: Option<&DVector<f64>>) -> DVector<f64> {
    if like.is_some_and(|like| like.dot(&vector) < 0.0) { -vector } else { vector }
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::bifurcations::curves::{CurvePoint, Search, find_curves};
    use crate::dynamics::bifurcations::plane::Plane;
    use crate::model::{ForceLaw, ParameterSet, Parameters};

    /// Each point of the curves in the window of omega and beta, with the orbits evaluated there.
    fn each_point(
        (omega, beta, law): ((f64, f64), f64, ForceLaw),
        mut judge: impl FnMut(&mut Family<2>, Condition, &CurvePoint) -> Result<(), OrbitError>,
    ) -> Result<(), OrbitError> {
        let set = ParameterSet { alpha: 1e-4, ..Default::default() };
        let system = ReducedSystem::new(Parameters::new(set)?, 2, law)?;
        let axes = [(Parameter::Omega, omega), (Parameter::Beta, (0.0, beta))];
        let plane = Plane::new(axes.map(|(parameter, range)| Axis { parameter, range }))?;
        for curve in find_curves(&system, &plane, Search::default())?.curves {
            for point in &curve.points {
                let there = plane.system(&system, point.at)?;
                let mut family = Family::new(&there, *plane.axes(), curve.periods)?;
                let beta = family.beta();
                family.solver.evaluate_at(&point.state, beta, curve.periods)?;
                let multipliers = family.solver.multipliers()?;
                judge(&mut family, Condition::at(curve.kind, &multipliers).expect("on the curve"), point)?;
            }
        }
        Ok(())
    }

    /// From half to twice the step what the differences leave out would grow sixteenfold.
    #[test]
    fn coefficients_do_not_depend_on_the_step() -> Result<(), OrbitError> {
        let mut compared = 0;
        for window in [
            ((7.6, 8.8), 0.04, ForceLaw::Quadratic),
            ((6.0, 10.0), 0.1, ForceLaw::Quadratic),
            ((25.0, 26.0), 0.04, ForceLaw::Exact),
        ] {
            each_point(window, |family, condition, point| {
                let mut with = |step: f64| Differences::at(family, step).form(condition, None);
                if let (Some(low), Some(high)) = (with(0.5 * STEP)?, with(2.0 * STEP)?) {
                    let [a, b] = [low, high].map(|form| form.coefficient.expect("finite"));
                    assert!((a - b).abs() < 1e-4 * a.abs() + 1e-5, "{condition:?} {:?}: {a} {b}", point.at);
                    compared += 1;
                }
                Ok(())
            })?;
        }
        assert!(compared > 300, "{compared}");
        Ok(())
    }

    /// The change of the determinant along the fold against the second derivative of the map.
    #[test]
    fn the_coefficient_of_a_fold_is_that_of_its_definition() -> Result<(), OrbitError> {
        let mut compared = 0;
        each_point(((20.5, 22.5), 0.04, ForceLaw::Quadratic), |family, condition, point| {
            if condition.kind != Instability::Fold {
                return Ok(());
            }
            let mut differences = Differences::at(family, STEP);
            let right = eigenvector(&differences.middle, 1.0)?;
            let left = eigenvector(&differences.middle.transpose(), 1.0)?;
            let (second, _) = differences.along(&right)?;
            let expected = 0.5 * left.dot(&(second * &right)) / left.dot(&right);
            let found = point.coefficient.expect("finite");
            let missed = (found.abs() - expected.abs()).abs();
            assert!(missed < 1e-4 * expected.abs() + 1e-6, "{:?}: {found} {expected}", point.at);
            compared += 1;
            Ok(())
        })?;
        assert!(compared > 80, "{compared}");
        Ok(())
    }
}
