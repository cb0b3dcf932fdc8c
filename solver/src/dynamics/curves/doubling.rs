//! The cubic coefficient of a period doubling: whether the doubled orbit branches off towards the side where the
//! orbit is unstable (supercritical, a stable one) or back from it (subcritical).
//!
//! On the centre manifold the map is x -> -x + c x^3 with c = <p, C(q,q,q)/6 + B(q, (1 - M)^-1 B(q,q))/2>/<p, q>, q
//! and p the right and left eigenvectors of the monodromy matrix M to -1, B and C the second and third derivatives of
//! the map; c > 0 is supercritical (Kuznetsov, "Elements of Applied Bifurcation Theory", section 5.4). The first
//! derivative of the map is exact, so B along q is a central difference of it and C(q,q,.) its second difference.

use nalgebra::{DMatrix, DVector};

use crate::dynamics::OrbitError;
use crate::dynamics::arclength::Family;
use crate::dynamics::floquet::eigenvector;

/// Step of the differences along the eigenvector, in units of the gap.
const STEP: f64 = 1e-3;

/// The coefficient at a place and what it was computed with.
#[derive(Debug, Clone)]
pub(super) struct Doubling {
    /// <p, q> det(1 - M) c, up to the signs of p and q, the same along a curve: finite, and smooth, also where the
    /// multiplier -1 is double or another one is 1.
    pub(super) test: f64,
    right: DVector<f64>,
    left: DVector<f64>,
}

impl Doubling {
    /// The coefficient at the orbit that the solver of `family` evaluated last, with eigenvectors on the side of
    /// those of `like`.
    ///
    /// # Errors
    /// [`OrbitError::Singular`] where an eigenvector cannot be computed, and those of the map beside the orbit.
    pub(super) fn new<const K: usize>(
        family: &mut Family<K>,
        like: Option<&Self>,
    ) -> Result<Self, OrbitError> {
        let state = family.solver.state().to_vec();
        let middle = family.solver.map().scaled_derivative();
        let inverse = family.solver.newton_matrix();
        let right = oriented(eigenvector(&middle, -1.0)?, like.map(|like| &like.right));
        let left = oriented(eigenvector(&middle.transpose(), -1.0)?, like.map(|like| &like.left));
        let step = STEP * family.solver.map().gap();
        let [low, high] = [-step, step].map(|step| beside(family, &state, &(&right * step)));
        let (low, high) = (low?, high?);
        let second = |along: &DVector<f64>| (&high - &low) * along / (2.0 * step);
        let third = (&high + &low - 2.0 * &middle) * &right / (step * step);
        let determinant = inverse.determinant();
        let bent = family.solver.response(second(&right))? * determinant;
        let test = left.dot(&(third * (determinant / 6.0) + second(&bent) * 0.5));
        Ok(Self { test, right, left })
    }
}

/// The map's derivative, scaled, at `state` moved by `offset` (scaled).
fn beside<const K: usize>(
    family: &mut Family<K>,
    state: &[f64],
    offset: &DVector<f64>,
) -> Result<DMatrix<f64>, OrbitError> {
    let beta = family.beta();
    let map = family.solver.map();
    let moved: Vec<f64> = state
        .iter()
        .zip(offset.iter().zip(map.scales()))
        .map(|(y, (part, scale))| y + part * scale)
        .collect();
    map.apply(&moved, beta, family.periods, |_, _| ())?;
    Ok(map.scaled_derivative())
}

/// `vector` on the side of `like`.
fn oriented(vector: DVector<f64>, like: Option<&DVector<f64>>) -> DVector<f64> {
    if like.is_some_and(|like| like.dot(&vector) < 0.0) { -vector } else { vector }
}
