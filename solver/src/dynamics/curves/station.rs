//! A place on a curve with everything that is read there, and what lies between two of them.

use nalgebra::{Complex, DVector};

use super::condition::Condition;
use super::curve::{CurvePoint, SpecialKind, SpecialPoint};
use super::doubling::Doubling;
use super::surface::{Direction, Surface};
use crate::dynamics::orbit::Observer;
use crate::dynamics::{Instability, OrbitError};

/// How far the cubic through two stations is trusted beyond them, in their distances.
const CUBIC_REACH: f64 = 2.0;

/// An orbit on the curve.
#[derive(Debug, Clone)]
pub(super) struct Station {
    pub(super) place: DVector<f64>,
    pub(super) direction: Direction,
    pub(super) condition: Condition,
    pub(super) multipliers: Vec<Complex<f64>>,
    /// Tests of codimension two; that of a cusp is the course's turn.
    pub(super) tests: Vec<(SpecialKind, f64)>,
    /// What half the period does to the place; zero where the orbit has half the period.
    pub(super) halving: Option<DVector<f64>>,
    doubling: Option<Doubling>,
    at: [f64; 2],
    v_rms: f64,
}

impl Station {
    /// Reads the orbit at `place`, on the side of `like` in everything that has two; the first one has the
    /// `condition` of its kind.
    pub(super) fn read(
        surface: &mut Surface,
        place: DVector<f64>,
        condition: Condition,
        like: Option<&Self>,
    ) -> Result<Self, OrbitError> {
        let family = &mut surface.family;
        let periods = family.periods;
        let state = family.state(&place);
        family.set(family.values(&place))?;
        let beta = family.beta();
        let halving = if periods.is_multiple_of(2) {
            family.solver.evaluate_at(&state, beta, periods / 2)?;
            let image = family.solver.map().image().to_vec();
            Some(family.place(&image, family.values(&place)) - &place)
        } else {
            None
        };
        family.solver.evaluate_at(&state, beta, periods)?;
        let mut observer = Observer::default();
        family.solver.evaluate_observed(beta, periods, |step, _| observer.record(step))?;
        let multipliers = family.solver.multipliers()?;
        let condition = condition.renewed(&multipliers).ok_or(OrbitError::Multipliers)?;
        let mut tests = condition.tests(&multipliers);
        let doubling = if condition.kind == Instability::PeriodDoubling {
            let doubling = Doubling::new(family, like.and_then(|like| like.doubling.as_ref()))?;
            tests.push((SpecialKind::GeneralizedPeriodDoubling, doubling.test));
            Some(doubling)
        } else {
            None
        };
        let v_rms = observer.measures(family.system.parameters.kappa).v_rms;
        let at = family.values(&place);
        let direction = surface.direction(&place, condition, like.map(|like| &like.direction.tangent))?;
        Ok(Self { place, direction, condition, multipliers, tests, halving, doubling, at, v_rms })
    }

    /// Turns the station round, to leave it the other way.
    pub(super) fn reversed(mut self) -> Self {
        self.direction.tangent.neg_mut();
        self
    }

    /// The same at another `place`.
    pub(super) fn moved(mut self, surface: &Surface, place: DVector<f64>) -> Self {
        self.at = surface.family.values(&place);
        self.place = place;
        self
    }

    pub(super) fn point(&self, surface: &Surface) -> CurvePoint {
        CurvePoint { at: self.at, state: surface.family.state(&self.place), v_rms: self.v_rms }
    }

    pub(super) fn special(&self, surface: &Surface, kind: SpecialKind, after: usize) -> SpecialPoint {
        let state = surface.family.state(&self.place);
        let multipliers = self.multipliers.iter().map(|value| [value.re, value.im]).collect();
        SpecialPoint { kind, at: self.at, state, multipliers, after }
    }

    /// The two parameters.
    pub(super) fn at(&self) -> [f64; 2] {
        self.at
    }

    /// The tangent's part in the plane of the parameters.
    pub(super) fn heading(&self) -> [f64; 2] {
        let n = self.place.len() - 2;
        [self.direction.tangent[n], self.direction.tangent[n + 1]]
    }

    /// The cosine of the angle between the headings of two stations times the length of the other's heading: it
    /// changes its sign at a cusp.
    pub(super) fn turn(&self, other: &Self) -> f64 {
        let ([a, b], [c, d]) = (self.heading(), other.heading());
        (a * c + b * d) / a.hypot(b)
    }

    /// The place expected a `step` on: on the cubic through this station and the one `before`, or on the tangent
    /// where there is none near.
    pub(super) fn predict(&self, before: Option<&Self>, step: f64) -> DVector<f64> {
        if let Some(before) = before {
            let width = (&self.place - &before.place).norm();
            if step <= CUBIC_REACH * width {
                return cubic(before, self, 1.0 + step / width);
            }
        }
        &self.place + &self.direction.tangent * step
    }
}

/// The place at `fraction` of the way from `a` to `b`, on the cubic with their tangents.
pub(super) fn cubic(a: &Station, b: &Station, fraction: f64) -> DVector<f64> {
    let t = fraction;
    let chord = &b.place - &a.place;
    let width = chord.norm();
    let start = &a.direction.tangent * width;
    let end = &b.direction.tangent * width;
    // Hermite's form about a.
    &a.place
        + start * (t * (1.0 - t) * (1.0 - t))
        + chord * (t * t * (3.0 - 2.0 * t))
        + end * (t * t * (t - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::plane::{Axis, Plane};
    use crate::model::{ForceLaw, Parameter, ParameterSet, Parameters, ReducedSystem};

    /// The chord taken for the arc between the stations, h^3/24 shorter on a unit circle, decides the error.
    #[test]
    fn the_prediction_is_of_third_order() -> Result<(), OrbitError> {
        let set = ParameterSet { alpha: 1e-4, beta: 1e-3, omega: 8.0969, ..Default::default() };
        let system = ReducedSystem::new(Parameters::new(set)?, 1, ForceLaw::Quadratic)?;
        let axes = [(Parameter::Omega, (8.0, 9.0)), (Parameter::Beta, (0.0, 0.04))];
        let plane = Plane::new(axes.map(|(parameter, range)| Axis { parameter, range }))?;
        let mut surface = Surface::new(&system, &plane, 1)?;
        surface.family.solver.find(&[0.0; 3], set.beta, 1)?;
        let place = surface.family.place(surface.family.solver.state(), [set.omega, set.beta]);
        let condition = Condition { kind: Instability::Fold, cosine: 0.0 };
        let station = Station::read(&mut surface, place, condition, None)?;
        // On a circle of radius 1 in the first two components.
        let on_circle = |angle: f64| {
            let mut station = station.clone();
            station.place.fill(0.0);
            station.direction.tangent.fill(0.0);
            (station.place[0], station.place[1]) = angle.sin_cos();
            (station.direction.tangent[0], station.direction.tangent[1]) = (angle.cos(), -angle.sin());
            station
        };
        let error = |step: f64| {
            let guess = on_circle(0.0).predict(Some(&on_circle(-step)), step);
            (guess - on_circle(step).place).norm()
        };
        assert!(error(0.02) < 0.02_f64.powi(3), "{}", error(0.02));
        let order = (error(0.04) / error(0.02)).log2();
        assert!(order > 2.8, "{order}");
        Ok(())
    }
}
