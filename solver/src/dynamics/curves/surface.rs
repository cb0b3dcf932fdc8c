//! The surface of periodic orbits over two parameters, and curves on it.
//!
//! A place x (see [`crate::dynamics::arclength`]) has n = 2N + 1 components of the state and two parameters. The n
//! equations of periodicity leave a surface, smooth where it folds over the parameters, with the null space of their
//! derivative as its tangent plane; a curve of bifurcations is the zero on it of one scalar (see
//! [`super::condition`]). The gradient of that scalar is needed within the plane only: two difference quotients.

use nalgebra::{DMatrix, DVector};

use super::condition::Condition;
use crate::dynamics::OrbitError;
use crate::dynamics::arclength::Family;
use crate::dynamics::plane::Plane;
use crate::model::{Parameter, ReducedSystem};

/// Iterations of a correction.
const MAX_ITERATIONS: usize = 10;
/// A correction below this is the last one.
const SETTLED: f64 = 1e-9;
/// Smallest sine of the angle in the tangent plane between the curve and the line on which the held parameter is
/// constant for points to be corrected along that line.
const TRANSVERSAL: f64 = 0.1;

/// The orbits of `periods` excitation periods over a plane.
pub(super) struct Surface {
    pub(super) family: Family<2>,
    /// The parameter that is held while another is cheaper to change: changing beta needs no new map.
    held: usize,
}

/// The curve at a place: its direction and what corrections start from.
#[derive(Debug, Clone)]
pub(super) struct Direction {
    /// Unit tangent.
    pub(super) tangent: DVector<f64>,
    /// Gradient of the condition within the surface.
    gradient: DVector<f64>,
    /// Normal of the hyperplane in which the next point is corrected.
    pub(super) normal: DVector<f64>,
}

impl Surface {
    pub(super) fn new(system: &ReducedSystem, plane: &Plane, periods: usize) -> Result<Self, OrbitError> {
        let family = Family::new(system, *plane.axes(), periods)?;
        let held = usize::from(plane.axes()[0].parameter == Parameter::Beta);
        Ok(Self { family, held })
    }

    /// The curve's direction at `place`, on which its solver is, on the side of `like`.
    pub(super) fn direction(
        &mut self,
        place: &DVector<f64>,
        condition: Condition,
        like: Option<&DVector<f64>>,
    ) -> Result<Direction, OrbitError> {
        let here = self.value(condition)?;
        let (_, derivative) = self.family.linearised(place, true)?;
        let (level, across) = self.tangent_plane(&derivative)?;
        let slopes =
            [self.slope(place, &level, condition, here)?, self.slope(place, &across, condition, here)?];
        let gradient = &level * slopes[0] + &across * slopes[1];
        let mut tangent = (&across * slopes[0] - &level * slopes[1]).normalize();
        if tangent.iter().any(|value| !value.is_finite()) {
            return Err(OrbitError::Singular);
        }
        let n = self.family.dimension();
        let forward = like.map_or_else(|| tangent[n], |like| like.dot(&tangent));
        if forward < 0.0 {
            tangent.neg_mut();
        }
        let mut normal = tangent.clone();
        if tangent.dot(&across).abs() > TRANSVERSAL && across[n + self.held].abs() > 1e-3 {
            normal.fill(0.0);
            normal[n + self.held] = 1.0;
        }
        Ok(Direction { tangent, gradient, normal })
    }

    /// The point of the curve near `guess` in the hyperplane through it with the `normal`, corrected from what is
    /// known at `from`: Newton's iteration, with Broyden's update of the gradient.
    pub(super) fn correct(
        &mut self,
        guess: &DVector<f64>,
        normal: &DVector<f64>,
        condition: Condition,
        from: &Direction,
    ) -> Result<DVector<f64>, OrbitError> {
        let n = self.family.dimension();
        let unit = from.gradient.norm();
        let mut gradient = &from.gradient / unit;
        let mut place = guess.clone();
        let mut before: Option<(DVector<f64>, f64)> = None;
        let mut residual = f64::INFINITY;
        for iteration in 1..=MAX_ITERATIONS {
            let (defect, derivative) = self.family.linearised(&place, iteration == 5)?;
            residual = defect.amax();
            let value = self.value(condition)? / unit;
            if let Some((step, old)) = before {
                let missed = value - old - gradient.dot(&step);
                gradient += &step * (missed / step.norm_squared());
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
            if step.amax() <= SETTLED {
                return Ok(place);
            }
            before = Some((step, value));
        }
        Err(OrbitError::NoConvergence { iterations: MAX_ITERATIONS, residual })
    }

    /// The condition at the orbit evaluated last.
    fn value(&self, condition: Condition) -> Result<f64, OrbitError> {
        condition.value(&self.family.solver.multipliers()?).ok_or(OrbitError::Multipliers)
    }

    /// Two orthogonal unit vectors that span the null space of `derivative`, n x (n + 2): one along which the held
    /// parameter is constant, and the other.
    fn tangent_plane(&self, derivative: &DMatrix<f64>) -> Result<(DVector<f64>, DVector<f64>), OrbitError> {
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
        if finite { Ok((level, across)) } else { Err(OrbitError::Singular) }
    }

    /// Derivative of the condition, `here` at `place`, along a unit `vector` of the tangent plane.
    fn slope(
        &mut self,
        place: &DVector<f64>,
        vector: &DVector<f64>,
        condition: Condition,
        here: f64,
    ) -> Result<f64, OrbitError> {
        let step = self.family.step_along(place, vector)?;
        Ok((self.value(condition)? - here) / step)
    }
}
