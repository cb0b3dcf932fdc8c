//! Which starts lie on curves that are known already.

use super::curve::{Curve, CurvePoint, Start};
use crate::dynamics::bifurcations::plane::Plane;

/// Distance from a curve, in units of the window, within which a start may be on it: several times what its chords
/// cut off.
const NEAR: f64 = 2e-3;
/// Largest difference of a start's state from the curve's, relative to the largest the curve has in that component.
const SAME_STATE: f64 = 0.05;

/// The curves of one plane found so far.
#[derive(Debug, Clone, PartialEq)]
pub struct KnownCurves {
    plane: Plane,
    curves: Vec<Curve>,
}

impl KnownCurves {
    /// None yet.
    pub fn new(plane: Plane) -> Self {
        Self { plane, curves: Vec::new() }
    }

    /// Whether `start` lies on none of the curves, so that there is one to trace from it.
    pub fn is_new(&self, start: &Start) -> bool {
        !self.curves.iter().any(|curve| self.passes(curve, start))
    }

    /// Takes up `curve`, unless it is known: two workers may have traced it from different starts. Whether it was
    /// taken.
    pub fn add(&mut self, curve: Curve) -> bool {
        let Some(middle) = curve.points.get(curve.points.len() / 2) else { return false };
        let (at, state) = (middle.at, middle.state.clone());
        let new = self.is_new(&Start { kind: curve.kind, periods: curve.periods, at, state });
        if new {
            self.curves.push(curve);
        }
        new
    }

    /// The curves.
    pub fn curves(&self) -> &[Curve] {
        &self.curves
    }

    /// The curves, given away.
    pub fn into_curves(self) -> Vec<Curve> {
        self.curves
    }

    fn passes(&self, curve: &Curve, start: &Start) -> bool {
        if (curve.kind, curve.periods) != (start.kind, start.periods) {
            return false;
        }
        let near = |a: &CurvePoint, b: &CurvePoint| {
            let [x, y] = self.plane.scaled([b.at[0] - a.at[0], b.at[1] - a.at[1]]);
            let [u, v] = self.plane.scaled([start.at[0] - a.at[0], start.at[1] - a.at[1]]);
            let length = x * x + y * y;
            let fraction = if length > 0.0 { ((u * x + v * y) / length).clamp(0.0, 1.0) } else { 0.0 };
            let distance = (u - fraction * x).hypot(v - fraction * y);
            distance <= NEAR && self.same_state(curve, start, a, b, fraction)
        };
        match curve.points.as_slice() {
            [point] => near(point, point),
            points => points.windows(2).any(|pair| near(&pair[0], &pair[1])),
        }
    }

    /// Whether the orbit of `start` is the curve's between two of its points. An orbit of several periods has as many
    /// states at t = 0, of which a curve holds one.
    fn same_state(
        &self,
        curve: &Curve,
        start: &Start,
        a: &CurvePoint,
        b: &CurvePoint,
        fraction: f64,
    ) -> bool {
        let within = |i: usize| {
            let of = |point: &CurvePoint| point.state.get(i).copied().unwrap_or(0.0);
            let largest = curve.points.iter().map(|point| of(point).abs()).fold(0.0, f64::max);
            let expected = of(a) + fraction * (of(b) - of(a));
            (start.state[i] - expected).abs() <= SAME_STATE * largest
        };
        curve.periods > 1 || (0..start.state.len()).all(within)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::bifurcations::curves::CurveEnd;
    use crate::dynamics::bifurcations::plane::Axis;
    use crate::dynamics::integration::Measures;
    use crate::dynamics::orbits::{Instability, OrbitError};
    use crate::model::Parameter;

    fn start(kind: Instability, at: [f64; 2], state: f64) -> Start {
        Start { kind, periods: 1, at, state: vec![state] }
    }

    #[test]
    fn a_start_is_known_by_kind_place_and_orbit() -> Result<(), OrbitError> {
        let omega = Axis { parameter: Parameter::Omega, range: (8.0, 9.0) };
        let beta = Axis { parameter: Parameter::Beta, range: (0.0, 0.04) };
        let mut known = KnownCurves::new(Plane::new([omega, beta])?);
        let point = |fraction: f64| {
            let at = [8.2 + 0.4 * fraction, 0.01 + 0.02 * fraction];
            CurvePoint {
                at,
                state: vec![0.1 + 0.1 * fraction],
                measures: Measures::default(),
                coefficient: None,
            }
        };
        let points = vec![point(0.0), point(0.5), point(1.0)];
        let (kind, ends) = (Instability::Fold, [CurveEnd::Window, CurveEnd::Window]);
        let curve = Curve { kind, periods: 1, points, origin: 0, special: Vec::new(), ends };
        assert!(known.add(curve.clone()));
        assert!(!known.add(curve));
        let between = point(0.3);
        assert!(!known.is_new(&start(kind, between.at, 0.13)));
        assert!(known.is_new(&start(kind, between.at, 0.3)));
        assert!(known.is_new(&start(Instability::PeriodDoubling, between.at, 0.13)));
        assert!(known.is_new(&start(kind, [between.at[0], between.at[1] + 2e-4], 0.13)));
        assert!(known.is_new(&start(kind, [8.7, 0.035], 0.2)));
        Ok(())
    }
}
