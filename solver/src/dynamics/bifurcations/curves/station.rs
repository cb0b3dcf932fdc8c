//! A place on a curve with everything that is read there, and what lies between two of them.

use nalgebra::{Complex, DVector};

use super::condition::Condition;
use super::curve::{CurvePoint, SpecialKind, SpecialPoint};
use super::normal_form::NormalForm;
use super::surface::{Direction, Fold, Surface};
use crate::dynamics::bifurcations::arclength::Family;
use crate::dynamics::integration::measures::Observer;
use crate::dynamics::integration::{Measures, Step};
use crate::dynamics::orbits::period_map::StepDerivative;
use crate::dynamics::orbits::{Instability, OrbitError};

/// How far the cubic through two stations is trusted beyond them, in their distances.
const CUBIC_REACH: f64 = 2.0;

/// A function that vanishes at a point of codimension two.
#[derive(Debug, Clone, Copy)]
pub(super) struct Test {
    pub(super) kind: SpecialKind,
    pub(super) value: f64,
    /// Its derivative along the curve.
    pub(super) slope: f64,
}

/// An orbit on the curve.
#[derive(Debug, Clone)]
pub(super) struct Station {
    pub(super) place: DVector<f64>,
    pub(super) direction: Direction,
    pub(super) condition: Condition,
    pub(super) multipliers: Vec<Complex<f64>>,
    /// Tests of codimension two that follow from the multipliers, with their derivatives along the curve.
    pub(super) tests: Vec<Test>,
    /// What half the period does to the place; zero where the orbit has half the period.
    pub(super) halving: Option<DVector<f64>>,
    /// Not on a curve of folds, and not where it cannot be computed.
    form: Option<NormalForm>,
    at: [f64; 2],
    measures: Measures,
}

/// The numbers of the orbit at `place`, whose derivative is evaluated with them.
fn measured(family: &mut Family<2>, place: &DVector<f64>) -> Result<Measures, OrbitError> {
    let (state, beta, periods) = (family.state(place), family.beta(), family.periods);
    loop {
        let mut observer = Observer::default();
        let seen = |step: &Step<'_>, _: &StepDerivative<'_>| {
            observer.record(step, 1.0);
        };
        if family.solver.evaluate_observed_at(&state, beta, periods, seen)? <= 1.0 {
            return Ok(observer.measures(family.system.parameters.kappa).unwrap_or_default());
        }
        family.solver.map().refine()?;
    }
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
        let measures = measured(family, &place)?;
        let at = family.values(&place);
        let multipliers = family.solver.multipliers()?;
        let condition = condition.renewed(&multipliers).ok_or(OrbitError::Multipliers)?;
        let defect = family.defect_there();
        let derivative = family.derivative(&place, &defect, true)?;
        let form = if surface.undamped {
            None
        } else {
            NormalForm::new(family, condition, like.and_then(|like| like.form.as_ref())).unwrap_or_default()
        };
        let direction =
            surface.direction(&place, condition, &derivative, like.map(|like| &like.direction))?;
        let tests = condition.tests(&multipliers).into_iter().zip(&direction.slopes);
        let tests = tests.map(|((kind, value), slope)| Test { kind, value, slope: *slope }).collect();
        Ok(Self { place, direction, condition, multipliers, tests, halving, form, at, measures })
    }

    /// The value of the test for `kind` at a `place` beside this station, without what else [`Self::read`] reads.
    pub(super) fn test_beside(
        &self,
        surface: &mut Surface,
        place: &DVector<f64>,
        kind: SpecialKind,
    ) -> Result<f64, OrbitError> {
        if kind == SpecialKind::Cusp {
            let there = Self::read(surface, place.clone(), self.condition, Some(self))?;
            return there.test(kind).ok_or(OrbitError::Singular);
        }
        let family = &mut surface.family;
        family.defect(place)?;
        let multipliers = family.solver.multipliers()?;
        let condition = self.condition.renewed(&multipliers).ok_or(OrbitError::Multipliers)?;
        let known = condition.tests(&multipliers).into_iter().find(|(other, _)| *other == kind);
        let value = match known {
            Some((_, value)) => Some(value),
            None => NormalForm::new(family, condition, self.form.as_ref())?.map(|form| form.test),
        };
        value.ok_or(OrbitError::Singular)
    }

    /// Turns the station round, to leave it the other way.
    pub(super) fn reversed(mut self) -> Self {
        let Direction { tangent, slopes, fold, .. } = &mut self.direction;
        tangent.neg_mut();
        slopes.iter_mut().for_each(|slope| *slope = -*slope);
        self.tests.iter_mut().for_each(|test| test.slope = -test.slope);
        if let Some(fold) = fold {
            fold.heading.1 = -fold.heading.1;
        }
        self
    }

    /// The same at another `place` near it, without what only the condition tells there.
    pub(super) fn moved(mut self, surface: &mut Surface, place: DVector<f64>) -> Result<Self, OrbitError> {
        surface.family.set(surface.family.values(&place))?;
        self.measures = measured(&mut surface.family, &place)?;
        self.at = surface.family.values(&place);
        self.place = place;
        (self.form, self.direction.fold) = (None, None);
        Ok(self)
    }

    pub(super) fn point(&self, surface: &Surface) -> CurvePoint {
        let state = surface.family.state(&self.place);
        CurvePoint { at: self.at, state, measures: self.measures, coefficient: self.coefficient() }
    }

    /// The coefficient of the normal form, where it is finite.
    pub(super) fn coefficient(&self) -> Option<f64> {
        match &self.direction.fold {
            Some(fold) => fold.coefficient,
            None => self.form.as_ref()?.coefficient,
        }
    }

    /// The value of the test for `kind`, if there is one here.
    pub(super) fn test(&self, kind: SpecialKind) -> Option<f64> {
        match kind {
            SpecialKind::Cusp => self.direction.fold.as_ref().map(|fold| fold.heading.1),
            SpecialKind::GeneralizedPeriodDoubling if self.condition.kind == Instability::PeriodDoubling => {
                self.form.as_ref().map(|form| form.test)
            }
            SpecialKind::Chenciner if self.condition.kind == Instability::NeimarkSacker => {
                self.form.as_ref().map(|form| form.test)
            }
            _ => self.tests.iter().find(|test| test.kind == kind).map(|test| test.value),
        }
    }

    pub(super) fn special(&self, surface: &Surface, kind: SpecialKind, after: usize) -> SpecialPoint {
        let state = surface.family.state(&self.place);
        let multipliers = self.multipliers.iter().map(|value| [value.re, value.im]).collect();
        let coefficient = if kind.has_coefficient(self.condition.kind) { self.coefficient() } else { None };
        SpecialPoint { kind, at: self.at, state, multipliers, coefficient, after }
    }

    /// The derivative of the test for `kind` along the curve, where it is known.
    pub(super) fn slope(&self, kind: SpecialKind) -> Option<f64> {
        self.tests.iter().find(|test| test.kind == kind).map(|test| test.slope)
    }

    /// How far the curve has gone in the plane on the way to `next`, along its directions at both folds.
    pub(super) fn advance(&self, next: &Self) -> Option<f64> {
        let (here, there) = (self.direction.fold.as_ref()?, next.direction.fold.as_ref()?);
        let n = self.place.len() - 2;
        let moved = [n, n + 1].map(|k| next.place[k] - self.place[k]);
        let along = |fold: &Fold| moved[0] * fold.heading.0[0] + moved[1] * fold.heading.0[1];
        Some(0.5 * (along(here) + along(there)))
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

    /// The place expected a `step` on: on the cubic through this station and the one `before`, or on the tangent
    /// where there is none near.
    pub(super) fn predict(&self, before: Option<&Self>, step: f64) -> DVector<f64> {
        match self.reach(before, step) {
            Some((before, fraction)) => cubic(before, self, fraction),
            None => &self.place + &self.direction.tangent * step,
        }
    }

    /// The condition's gradient expected there, on the straight line through those at both.
    pub(super) fn gradient(&self, before: Option<&Self>, step: f64) -> DVector<f64> {
        match self.reach(before, step) {
            Some((before, fraction)) => before.direction.gradient.lerp(&self.direction.gradient, fraction),
            None => self.direction.gradient.clone(),
        }
    }

    /// The station `before`, and the place a `step` on as a fraction of the way from there to here, if it is near.
    fn reach<'a>(&self, before: Option<&'a Self>, step: f64) -> Option<(&'a Self, f64)> {
        let before = before?;
        let width = (&self.place - &before.place).norm();
        (step <= CUBIC_REACH * width).then(|| (before, 1.0 + step / width))
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
    use crate::dynamics::bifurcations::plane::{Axis, Plane};
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
