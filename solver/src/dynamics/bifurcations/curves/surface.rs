//! The surface of periodic orbits over two parameters, and curves on it.
//!
//! A place x (see `bifurcations::arclength`) has n = 2N + 1 components of the state and two parameters. The n
//! equations of periodicity leave a surface, smooth where it folds over the parameters, with the null space of their
//! derivative as its tangent plane; a curve of bifurcations is the zero on it of one scalar (see
//! [`super::condition`]). The gradient of that scalar is needed within the plane only: two difference quotients.

use nalgebra::{DMatrix, DVector};

use super::condition::Condition;
use crate::dynamics::bifurcations::arclength::Family;
use crate::dynamics::bifurcations::plane::Plane;
use crate::dynamics::orbits::{Instability, OrbitError};
use crate::model::{Parameter, ReducedSystem};

/// Iterations of a correction, and the one that takes nothing from where it started.
const MAX_ITERATIONS: usize = 10;
const RENEWAL: usize = 5;
/// A correction below this is the last one, and one after which the next, if it shrinks as this one did, is below that.
const SETTLED: f64 = 1e-9;
const FORESEEN: f64 = 1e-11;
/// Smallest sine of the angle in the tangent plane between the curve and the line on which the held parameter is
/// constant for points to be corrected along that line.
const TRANSVERSAL: f64 = 0.1;

/// The orbits of `periods` excitation periods over a plane.
pub(super) struct Surface {
    pub(super) family: Family<2>,
    /// The parameter that is held while another is cheaper to change: changing beta needs no new map.
    held: usize,
    /// Without any damping multipliers are reciprocal in pairs, and what tells points of codimension two vanishes
    /// everywhere.
    pub(super) undamped: bool,
}

/// The curve at a place: its direction, what corrections start from, and what changes along it.
#[derive(Debug, Clone)]
pub(super) struct Direction {
    /// Unit tangent.
    pub(super) tangent: DVector<f64>,
    /// Derivatives of the condition's tests along it, in their order.
    pub(super) slopes: Vec<f64>,
    /// On a curve of folds.
    pub(super) fold: Option<Fold>,
    /// Gradient of the condition within the surface.
    pub(super) gradient: DVector<f64>,
    /// Normal of the hyperplane in which the next point is corrected.
    pub(super) normal: DVector<f64>,
}

/// A fold of the surface of orbits over the plane.
///
/// With q the unit vector in the tangent plane along which the parameters stand still and r that across it, the
/// determinant of 1 - M changes along q by -2 b, the coefficient of the fold (see [`super::normal_form`]), times the
/// sum of the products of all but one of its eigenvalues: no second derivative of the map is needed.
#[derive(Debug, Clone)]
pub(super) struct Fold {
    /// q, on the same side along the curve.
    still: DVector<f64>,
    /// Unit vector of the plane to which r leads, on the same side along the curve, and the tangent's component along
    /// it: zero, with a change of sign, in a cusp.
    pub(super) heading: ([f64; 2], f64),
    /// b for a unit vector as in [`super::normal_form`], where it is finite.
    pub(super) coefficient: Option<f64>,
}

impl Surface {
    pub(super) fn new(system: &ReducedSystem, plane: &Plane, periods: usize) -> Result<Self, OrbitError> {
        let family = Family::new(system, *plane.axes(), periods)?;
        let held = usize::from(plane.axes()[0].parameter == Parameter::Beta);
        Ok(Self { family, held, undamped: system.undamped() })
    }

    /// The curve's direction at `place`, on which its solver is, on the side of `like`, from the `derivative` there.
    pub(super) fn direction(
        &mut self,
        place: &DVector<f64>,
        condition: Condition,
        derivative: &DMatrix<f64>,
        like: Option<&Direction>,
    ) -> Result<Direction, OrbitError> {
        let here = self.values(condition)?;
        let [level, across] = self.tangent_plane(derivative)?;
        let along =
            [self.slopes(place, &level, condition, &here)?, self.slopes(place, &across, condition, &here)?];
        let [rise, climb] = [along[0][0], along[1][0]];
        let gradient = &level * rise + &across * climb;
        let steepness = rise.hypot(climb);
        let mut parts = [-climb / steepness, rise / steepness];
        if parts.iter().any(|value| !value.is_finite()) {
            return Err(OrbitError::Singular);
        }
        let n = self.family.dimension();
        let mut tangent = &level * parts[0] + &across * parts[1];
        let forward = like.map_or_else(|| tangent[n], |like| like.tangent.dot(&tangent));
        if forward < 0.0 {
            tangent.neg_mut();
            parts = parts.map(|part| -part);
        }
        let slopes = along[0].iter().zip(&along[1]).skip(1);
        let slopes = slopes.map(|(a, b)| a * parts[0] + b * parts[1]).collect();
        let mut normal = tangent.clone();
        if tangent.dot(&across).abs() > TRANSVERSAL && across[n + self.held].abs() > 1e-3 {
            normal.fill(0.0);
            normal[n + self.held] = 1.0;
        }
        let fold = (condition.kind == Instability::Fold).then(|| {
            let sum = here.get(1).copied().unwrap_or(f64::NAN);
            self.fold([level, across], [rise, climb], parts, sum, like.and_then(|like| like.fold.as_ref()))
        });
        Ok(Direction { tangent, slopes, fold, gradient, normal })
    }

    /// The fold in the tangent plane with this `basis`, the determinant's `slopes` and the curve's `tangent` in it, and
    /// the `sum` of the products of all but one eigenvalue of 1 - M; on the side of `like`.
    fn fold(
        &mut self,
        basis: [DVector<f64>; 2],
        slopes: [f64; 2],
        tangent: [f64; 2],
        sum: f64,
        like: Option<&Fold>,
    ) -> Fold {
        let n = self.family.dimension();
        let [a, b] = basis.each_ref().map(|vector| [vector[n], vector[n + 1]]);
        let dot = |p: [f64; 2], q: [f64; 2]| p[0] * q[0] + p[1] * q[1];
        // The parameters move most along r.
        let (sine, cosine) = (0.5 * (2.0 * dot(a, b)).atan2(dot(a, a) - dot(b, b))).sin_cos();
        let (r, q) = ([cosine, sine], [-sine, cosine]);
        let moved: [f64; 2] = std::array::from_fn(|k| a[k] * r[0] + b[k] * r[1]);
        let length = moved[0].hypot(moved[1]);
        let (mut ahead, mut part) = (moved.map(|value| value / length), dot(tangent, r));
        if like.map_or(part, |like| dot(like.heading.0, ahead)) < 0.0 {
            (ahead, part) = (ahead.map(|value| -value), -part);
        }
        let mut still = &basis[0] * q[0] + &basis[1] * q[1];
        let mut slope = dot(slopes, q);
        if like.is_some_and(|like| like.still.dot(&still) < 0.0) {
            still.neg_mut();
            slope = -slope;
        }
        let coefficient = -0.5 * slope / (sum * self.family.length(&still));
        let coefficient = (coefficient.is_finite() && !self.undamped).then_some(coefficient);
        Fold { still, heading: (ahead, part * length), coefficient }
    }

    /// The point of the curve near `guess` in the hyperplane through it with the `normal`: Newton's iteration, with
    /// Broyden's update of the condition's `gradient` there.
    pub(super) fn correct(
        &mut self,
        guess: &DVector<f64>,
        normal: &DVector<f64>,
        condition: Condition,
        gradient: &DVector<f64>,
    ) -> Result<DVector<f64>, OrbitError> {
        let n = self.family.dimension();
        let unit = gradient.norm();
        let mut gradient = gradient / unit;
        let mut place = guess.clone();
        let mut before: Option<(DVector<f64>, f64)> = None;
        let mut residual = f64::INFINITY;
        for iteration in 1..=MAX_ITERATIONS {
            let renewed = iteration == RENEWAL;
            let (defect, derivative) = self.family.linearised(&place, renewed)?;
            residual = defect.amax();
            let values = self.values(condition)?;
            let value = values[0] / unit;
            if renewed {
                let basis = self.tangent_plane(&derivative)?;
                let slopes = basis.each_ref().map(|vector| self.slopes(&place, vector, condition, &values));
                let [level, across] = slopes;
                gradient = (&basis[0] * level?[0] + &basis[1] * across?[0]) / unit;
            } else if let Some((step, old)) = &before {
                let missed = value - old - gradient.dot(step);
                gradient += step * (missed / step.norm_squared());
            }
            let off = normal.dot(&(&place - guess));
            let mut matrix = DMatrix::zeros(n + 2, n + 2);
            matrix.rows_mut(0, n).copy_from(&derivative);
            matrix.set_row(n, &gradient.transpose());
            matrix.set_row(n + 1, &normal.transpose());
            let right = -defect.push(value).push(off);
            let step = matrix.lu().solve(&right).ok_or(OrbitError::Singular)?;
            if !step.iter().all(|part| part.is_finite()) {
                return Err(OrbitError::Singular);
            }
            place += &step;
            let size = step.amax();
            let falls = before.as_ref().map_or(1.0, |(before, _)| size / before.amax());
            if size <= SETTLED || size * falls <= FORESEEN {
                return Ok(place);
            }
            before = Some((step, value));
        }
        Err(OrbitError::NoConvergence { iterations: MAX_ITERATIONS, residual })
    }

    /// The condition at the orbit evaluated last, and then the tests for points of codimension two.
    fn values(&self, condition: Condition) -> Result<Vec<f64>, OrbitError> {
        let multipliers = self.family.solver.multipliers()?;
        let all = condition.renewed(&multipliers).zip(condition.value(&multipliers));
        let (condition, value) = all.ok_or(OrbitError::Multipliers)?;
        let tests = condition.tests(&multipliers).into_iter().map(|(_, test)| test);
        Ok(std::iter::once(value).chain(tests).collect())
    }

    /// Two orthogonal unit vectors that span the null space of `derivative`, n x (n + 2): one along which the held
    /// parameter is constant, and the other.
    fn tangent_plane(&self, derivative: &DMatrix<f64>) -> Result<[DVector<f64>; 2], OrbitError> {
        let rows = derivative.transpose().qr().q();
        let mut found: Vec<DVector<f64>> = Vec::new();
        for _ in 0..2 {
            // The unit vector that is farthest from all that is there already.
            let left = |index: usize| {
                let known: f64 = found.iter().map(|vector| vector[index] * vector[index]).sum();
                1.0 - known - rows.row(index).norm_squared()
            };
            let index = (0..rows.nrows()).max_by(|a, b| left(*a).total_cmp(&left(*b)));
            let mut vector = DVector::zeros(rows.nrows());
            vector[index.unwrap_or(0)] = 1.0;
            // Twice, against rounding.
            for _ in 0..2 {
                vector -= &rows * rows.tr_mul(&vector);
                for other in &found {
                    vector -= other * other.dot(&vector);
                }
            }
            found.push(vector.normalize());
        }
        let held = self.family.dimension() + self.held;
        let (a, b) = (found[0][held], found[1][held]);
        let length = a.hypot(b);
        let (a, b) = if length > 0.0 { (a / length, b / length) } else { (0.0, 1.0) };
        let mut level = &found[0] * b - &found[1] * a;
        level[held] = 0.0;
        let across = &found[0] * a + &found[1] * b;
        let finite = level.iter().chain(&across).all(|value| value.is_finite());
        if finite { Ok([level, across]) } else { Err(OrbitError::Singular) }
    }

    /// Derivatives of [`Self::values`], `here` at `place`, along a unit `vector` of the tangent plane.
    fn slopes(
        &mut self,
        place: &DVector<f64>,
        vector: &DVector<f64>,
        condition: Condition,
        here: &[f64],
    ) -> Result<Vec<f64>, OrbitError> {
        let step = self.family.step_along(place, vector)?;
        let there = self.values(condition)?;
        Ok(there.iter().zip(here).map(|(there, here)| (there - here) / step).collect())
    }
}
