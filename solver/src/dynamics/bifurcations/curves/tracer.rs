//! Tracing a curve of bifurcations by pseudo-arclength: predict, correct, measure the turn, look for points of
//! codimension two.
//!
//! Reference: Kuznetsov, "Elements of Applied Bifurcation Theory", chapter 10; Govaerts, "Numerical Methods for
//! Bifurcations of Dynamical Equilibria". The curve passes its own folds in either parameter and those of the surface
//! of orbits. Points are good to about 1e-9 of the window.
//!
//! Where it stops working: a test for points of codimension two that vanishes twice within one step (a thirtieth of the
//! window) is suspected by its values and slopes at the step's ends, and the step divided; where these do not show it,
//! both points are overlooked. Where a second multiplier stays near the critical one along the curve, their resonance is located
//! as well as the multipliers are known, to about 1e-6 of the window. A tip whose radius is below about 1e-6 of the
//! window ends the curve: narrow the window, or start on its other side. Without any damping
//! ([`ReducedSystem::undamped`]) there are no Neimark-Sacker curves, points of codimension two are not looked for, and
//! a tongue reaches beta = 0 in a corner, where the trace of its flank ends.

use nalgebra::DVector;

use super::condition::Condition;
use super::curve::{Curve, CurveEnd, CurvePoint, SpecialPoint, Start};
use super::locate::{KNOWN, ends, halved, leaves, specials};
use super::station::Station;
use super::surface::Surface;
use crate::dynamics::bifurcations::arclength::DIFFERENCE;
use crate::dynamics::bifurcations::plane::Plane;
use crate::dynamics::orbits::{Instability, OrbitError};
use crate::model::{ModelError, ReducedSystem};

/// First, shortest and longest step, in units of the gap and of the window.
const STEPS: (f64, f64, f64) = (1e-3, 1e-8, 0.15);
/// Longest step in the plane, in units of the window.
const PLANE_STEP: f64 = 0.03;
/// Turn of the tangent in one step that is aimed at, and the largest (radians).
const TURN: (f64, f64) = (0.12, 0.3);
/// A correction longer than this part of the step may have led to another curve.
const DOUBTFUL: f64 = 0.2;
/// Most points of one side of a curve.
const MOST_POINTS: usize = 600;
/// Distance in the window at which a border of what can be built explains that a curve is lost.
const BESIDE: f64 = 1e-3;
/// Distance in the window below which two places of a curve are one.
const SAME: f64 = 1e-6;

/// Traces the curve of bifurcations through `start` within the `plane`, to both sides. The device, but for the plane's
/// two parameters, is that of `system`.
///
/// # Errors
/// [`OrbitError`] when the start is outside the plane, there is no such bifurcation near it, or no device. Once begun,
/// a curve that is lost is an answer, [`CurveEnd::Lost`].
pub fn trace_curve(system: &ReducedSystem, start: &Start, plane: &Plane) -> Result<Curve, OrbitError> {
    for (axis, value) in plane.axes().iter().zip(start.at) {
        ModelError::check(axis.parameter.field(), value, axis.range, "")?;
    }
    let system = plane.system(system, start.at)?;
    if system.undamped() && start.kind == Instability::NeimarkSacker {
        return Err(OrbitError::Undamped);
    }
    let mut surface = Surface::new(&system, plane, start.periods)?;
    let place = surface.family.place(&start.state, start.at);
    let (_, derivative) = surface.family.linearised(&place, true)?;
    let multipliers = surface.family.solver.multipliers()?;
    let condition = Condition::at(start.kind, &multipliers).ok_or(OrbitError::Multipliers)?;
    let near = surface.direction(&place, condition, &derivative, None)?;
    let place = surface.correct(&place, &near.tangent, condition, &near.gradient)?;
    let origin = Station::read(&mut surface, place, condition, None)?;
    let mut tracer = Tracer { surface, plane };
    let back = tracer.side(origin.clone().reversed());
    let middle = origin.point(&tracer.surface);
    let forth = match back.end {
        CurveEnd::Closed => Side { points: Vec::new(), special: Vec::new(), end: CurveEnd::Closed },
        _ => tracer.side(origin),
    };
    let before = back.points.len();
    let mut special: Vec<SpecialPoint> = Vec::new();
    let backwards = |point: SpecialPoint| SpecialPoint { after: before + 1 - point.after, ..point };
    let forwards = |point: SpecialPoint| SpecialPoint { after: before + point.after, ..point };
    let sides =
        (back.special.into_iter().rev().map(backwards)).chain(forth.special.into_iter().map(forwards));
    for point in sides {
        // A start that is one itself is met from both sides.
        let known =
            |other: &SpecialPoint| other.kind == point.kind && plane.distance(other.at, point.at) < SAME;
        if !special.iter().any(known) {
            special.push(point);
        }
    }
    Ok(Curve {
        kind: start.kind,
        periods: start.periods,
        points: back.points.into_iter().rev().chain([middle]).chain(forth.points).collect(),
        origin: before,
        special,
        ends: [back.end, forth.end],
    })
}

/// One side of a curve, without its start.
struct Side {
    points: Vec<CurvePoint>,
    /// Counted with the start.
    special: Vec<SpecialPoint>,
    end: CurveEnd,
}

/// What a trace works with.
struct Tracer<'a> {
    surface: Surface,
    plane: &'a Plane,
}

impl Tracer<'_> {
    /// The part of the curve ahead of `origin`.
    fn side(&mut self, origin: Station) -> Side {
        let mut side = Side { points: Vec::new(), special: Vec::new(), end: CurveEnd::Points };
        let mut here = origin.clone();
        let mut past: Vec<Station> = Vec::new();
        let mut step = STEPS.0;
        while side.points.len() < MOST_POINTS {
            let (next, border) = match self.advance(&here, past.last(), step) {
                Err(_) if step > STEPS.1 => {
                    step *= 0.5;
                    continue;
                }
                Err(_) if self.at_border(here.at()) => {
                    side.end = CurveEnd::Window;
                    break;
                }
                Err(reason) => {
                    let reason = self.obstacle(&here).unwrap_or(reason).to_string();
                    side.end = CurveEnd::Lost { reason };
                    break;
                }
                Ok(next) => next,
            };
            let after = side.points.len() + 1;
            let mut end = halved(&mut self.surface, &past, &here).or_else(|| leaves(&here, &next));
            if end.is_none() && !self.surface.undamped {
                for (kind, station) in specials(&mut self.surface, past.last(), &here, &next, 0) {
                    if ends(&station, kind) {
                        end = Some((kind, station));
                        break;
                    }
                    side.special.push(station.special(&self.surface, kind, after));
                }
            }
            if let Some((special, station)) = end {
                side.special.push(station.special(&self.surface, special, after));
                side.points.push(station.point(&self.surface));
                side.end = CurveEnd::Meeting { special };
                break;
            }
            if next.condition.cosine.abs() > 1.0 {
                // The point in which it ends was not located.
                side.end = CurveEnd::Lost { reason: OrbitError::Singular.to_string() };
                break;
            }
            if after > 2 && self.returns(&origin, &here, &next) {
                side.points.push(origin.point(&self.surface));
                side.end = CurveEnd::Closed;
                break;
            }
            side.points.push(next.point(&self.surface));
            if border {
                side.end = CurveEnd::Window;
                break;
            }
            let turn = here.direction.tangent.dot(&next.direction.tangent).clamp(-1.0, 1.0).acos();
            let [a, b] = next.heading();
            let longest = (PLANE_STEP / a.hypot(b)).min(STEPS.2);
            step = (step * (TURN.0 / turn.max(1e-3)).clamp(0.5, 1.6)).clamp(STEPS.1, longest);
            past.push(std::mem::replace(&mut here, next));
            if past.len() == KNOWN {
                past.remove(0);
            }
        }
        side
    }

    /// The station a `step` on, and whether it is on the window's border.
    ///
    /// # Errors
    /// Also [`OrbitError::Sharp`] when the step is too long to be sure that it is the same curve.
    fn advance(
        &mut self,
        here: &Station,
        before: Option<&Station>,
        step: f64,
    ) -> Result<(Station, bool), OrbitError> {
        // Short enough for the bend of the curve; no shorter than that needs, for the errors of the map.
        self.surface.family.difference = (DIFFERENCE * step / STEPS.0).clamp(0.1 * DIFFERENCE, DIFFERENCE);
        let mut guess = here.predict(before, step);
        let gradient = here.gradient(before, step);
        let mut border = self.first_border(here.at(), self.surface.family.values(&guess));
        let mut next = None;
        if border.is_none() {
            let station = self.land(here, &guess, &here.direction.normal, &gradient)?;
            border = self.first_border(here.at(), station.at());
            next = border.is_none().then_some(station);
        }
        let (next, reached) = match (next, border) {
            (Some(next), _) => (next, false),
            (None, None) => return Err(OrbitError::Singular),
            (None, Some((k, value, fraction))) => {
                let place = here.predict(before, step * fraction);
                guess = self.surface.family.with_value(place, k, value);
                let mut normal = DVector::zeros(guess.len());
                normal[guess.len() - 2 + k] = 1.0;
                let next = self.land(here, &guess, &normal, &gradient)?;
                if self.first_border(here.at(), next.at()).is_some() {
                    return Err(OrbitError::Singular);
                }
                (next, true)
            }
        };
        let moved = (&next.place - &guess).norm();
        let straight = here.direction.tangent.dot(&next.direction.tangent) > TURN.1.cos();
        if straight && moved <= DOUBTFUL * step {
            return Ok((next, reached));
        }
        Err(OrbitError::Sharp)
    }

    /// Whether a point is as good as on the window's border: at the last, orbits may be of another kind, as those
    /// without a load are.
    fn at_border(&self, at: [f64; 2]) -> bool {
        (0..2).any(|k| {
            let axis = self.plane.axes()[k];
            let (low, high) = axis.range;
            (at[k] - low).min(high - at[k]) < SAME * axis.width()
        })
    }

    /// Why there is no device beside `here`, if there is none: towards such a border the orbits change so fast that
    /// steps become too short before it is reached.
    fn obstacle(&mut self, here: &Station) -> Option<OrbitError> {
        let mut found = None;
        for (k, axis) in self.plane.axes().iter().enumerate() {
            for side in [-BESIDE, BESIDE] {
                let mut at = here.at();
                at[k] = (at[k] + side * axis.width()).clamp(axis.range.0, axis.range.1);
                found = found.or(self.surface.family.set(at).err());
            }
        }
        found
    }

    /// The station at the curve's point in the hyperplane through `guess`, where the condition may have this `gradient`,
    /// with the `normal`.
    fn land(
        &mut self,
        from: &Station,
        guess: &DVector<f64>,
        normal: &DVector<f64>,
        gradient: &DVector<f64>,
    ) -> Result<Station, OrbitError> {
        let place = self.surface.correct(guess, normal, from.condition, gradient)?;
        Station::read(&mut self.surface, place, from.condition, Some(from))
    }

    /// The border first crossed on the way from a point inside: the parameter, its value, the fraction of the way.
    fn first_border(&self, from: [f64; 2], to: [f64; 2]) -> Option<(usize, f64, f64)> {
        let crossed = |k: usize| {
            let (low, high) = self.plane.axes()[k].range;
            let slack = 1e-12 * (high - low);
            let inside = to[k] >= low - slack && to[k] <= high + slack;
            let value = to[k].clamp(low, high);
            let fraction = ((value - from[k]) / (to[k] - from[k])).clamp(0.0, 1.0);
            (!inside).then_some((k, value, fraction))
        };
        [crossed(0), crossed(1)].into_iter().flatten().min_by(|a, b| a.2.total_cmp(&b.2))
    }

    /// Whether the step between two stations passes the `origin` again, in its direction.
    fn returns(&mut self, origin: &Station, here: &Station, next: &Station) -> bool {
        let ahead = |station: &Station| (&station.place - &origin.place).dot(&origin.direction.tangent);
        let length = (&next.place - &here.place).norm();
        let near = (&next.place - &origin.place).norm() <= 2.0 * length;
        if !(near && ahead(here) < 0.0 && ahead(next) >= 0.0) {
            return false;
        }
        let fraction = ahead(here) / (ahead(here) - ahead(next));
        let guess = super::station::cubic(here, next, fraction);
        let found =
            self.surface.correct(&guess, &origin.direction.tangent, here.condition, &here.direction.gradient);
        found.is_ok_and(|place| (place - &origin.place).amax() < 1e2 * SAME)
    }
}
