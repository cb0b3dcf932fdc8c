//! The tongue of a resonance in the plane of omega and beta: the curve on which the forced motion has a multiplier
//! on the unit circle, traced from above the resonance's centre down both flanks.
//!
//! The curve is the zero of one scalar, [`Instability::test`] on the forced orbit at (omega, beta). Each point is
//! predicted along the chord of the last two and corrected by secants, along beta where the curve runs across it
//! and along omega where it is steep, so that flanks may bend past the vertical. The trace ends at the borders of
//! the window, and where the crossing multiplier changes its kind.

use nalgebra::Complex;
use serde::{Deserialize, Serialize};

use super::OrbitError;
use super::boundary::{CriticalExcitation, search};
use super::floquet::Instability;
use super::newton::OrbitSolver;
use crate::model::reduced::ForceVisitor;
use crate::model::{ReducedSystem, RestForce};
use crate::theory::{CoupledModes, Resonance};

/// Longest and shortest step, as fractions of the window.
const STEP_RANGE: (f64, f64) = (2e-6, 0.02);
/// First step, small against the curvature at a sharp tip.
const FIRST_STEP: f64 = 2e-3;
/// Difference quotients for the first tangent, as fractions of the window.
const DIFFERENCE: f64 = 1e-5;
/// Turn of the curve in one step that is aimed at (radians).
const TURN: f64 = 0.12;
/// A point is located when the last correction is below this fraction of the window.
const LOCATED: f64 = 1e-8;
/// Evaluations a point may take before the step is shortened.
const MAX_EVALUATIONS: usize = 8;
/// Most points of a flank.
const MAX_POINTS: usize = 400;
/// Distance of the crossing multiplier from the unit circle beyond which the zero was not one of stability.
const ON_CIRCLE: f64 = 1e-4;

/// The part of the plane in which a tongue is traced.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Window {
    /// Largest distance of omega from the resonance's centre (dimensionless).
    pub span: f64,
    /// Largest beta (dimensionless).
    pub limit: f64,
}

impl Default for Window {
    /// Omega within 0.6 of the centre, beta up to 0.04, the range of the paper's figures.
    fn default() -> Self {
        Self { span: 0.6, limit: 0.04 }
    }
}

/// A point of a tongue's border.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TonguePoint {
    /// Excitation frequency (dimensionless).
    pub omega: f64,
    /// Excitation amplitude (dimensionless).
    pub beta: f64,
}

/// Why a flank is not followed any further.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FlankEnd {
    /// The window's border.
    Window,
    /// The crossing multiplier changes its kind: two instabilities meet.
    Meeting,
    /// The forced motion ends, in a fold or by escape or contact.
    MotionEnds,
    /// The largest number of points was reached.
    Points,
}

/// The border of a tongue.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Tongue {
    /// How the forced motion becomes unstable across it.
    pub instability: Instability,
    /// The border from the end of the flank on the side of low omega to that of high omega.
    pub points: Vec<TonguePoint>,
    /// Why the two flanks end, in the same order.
    pub ends: [FlankEnd; 2],
}

impl Tongue {
    /// The point of lowest beta.
    pub fn tip(&self) -> Option<TonguePoint> {
        self.points.iter().copied().min_by(|a, b| a.beta.total_cmp(&b.beta))
    }
}

/// Traces the tongue of `resonance` within `window` about its centre, the sum of the coupled modes' frequencies. The
/// beta and omega of `system` itself are not used.
///
/// `None` when the forced motion at the centre is not unstable in the resonance's way below the window's limit.
///
/// # Errors
/// [`OrbitError::Theory`] where the coupled modes do not exist, [`OrbitError::Model`] when the centre is out of
/// omega's range, and [`OrbitError::Multipliers`].
pub fn trace_tongue(
    system: &ReducedSystem,
    resonance: Resonance,
    window: Window,
) -> Result<Option<Tongue>, OrbitError> {
    struct Trace<'a>(&'a ReducedSystem, Instability, Window);
    impl ForceVisitor for Trace<'_> {
        type Output = Result<Option<Tongue>, OrbitError>;
        fn visit<F: RestForce + 'static>(self, force: F) -> Self::Output {
            let Self(system, kind, window) = self;
            let mut solver = OrbitSolver::new(system, force)?;
            let (CriticalExcitation::Unstable { beta, .. }, orbit) =
                search(&mut solver, window.limit, Some(kind))?
            else {
                return Ok(None);
            };
            let centre = system.parameters.omega;
            let start = Sample { omega: centre, beta, state: orbit.state };
            let mut tracer = Tracer { system, solver, kind, window, centre };
            let (low, low_end) = tracer.flank(&start, -1.0)?;
            let (high, high_end) = tracer.flank(&start, 1.0)?;
            let point = |sample: &Sample| TonguePoint { omega: sample.omega, beta: sample.beta };
            let points = low.iter().rev().chain(std::iter::once(&start)).chain(&high).map(point).collect();
            Ok(Some(Tongue { instability: kind, points, ends: [low_end, high_end] }))
        }
    }
    let centre = CoupledModes::new(system)?.frequency(resonance);
    let system = system.with_excitation(0.0, centre)?;
    system.dispatch(Trace(&system, resonance.instability(), window))
}

/// A place in the plane with the forced orbit there.
#[derive(Debug, Clone)]
struct Sample {
    omega: f64,
    beta: f64,
    state: Vec<f64>,
}

/// Along which coordinate a point is corrected.
#[derive(Clone, Copy, PartialEq)]
enum Along {
    Beta,
    Omega,
}

struct Tracer<'a, F> {
    system: &'a ReducedSystem,
    solver: OrbitSolver<F>,
    kind: Instability,
    window: Window,
    centre: f64,
}

impl<F: RestForce> Tracer<'_, F> {
    /// The points of one flank beyond `start`, towards omega of the sign `side`, and why there are no more.
    fn flank(&mut self, start: &Sample, side: f64) -> Result<(Vec<Sample>, FlankEnd), OrbitError> {
        let mut points: Vec<Sample> = Vec::new();
        let mut step = FIRST_STEP;
        let tangent = self.tangent(start)?;
        let sign = side * tangent.0.signum();
        let mut direction = (sign * tangent.0, sign * tangent.1);
        while points.len() < MAX_POINTS {
            let last = points.last().unwrap_or(start);
            let before = points.len().checked_sub(2).map_or(start, |i| &points[i]);
            let before = (!points.is_empty()).then_some(before);
            let found = self.next(last, before, direction, step);
            let next = match found {
                Ok(Some(next)) => next,
                Ok(None) | Err(_) if step > STEP_RANGE.0 => {
                    step *= 0.5;
                    continue;
                }
                Ok(None) => return Ok((points, FlankEnd::Meeting)),
                Err(OrbitError::Multipliers) => return Err(OrbitError::Multipliers),
                Err(_) => return Ok((points, FlankEnd::MotionEnds)),
            };
            let chord = self.direction(last, &next);
            let cosine = (chord.0 * direction.0 + chord.1 * direction.1).clamp(-1.0, 1.0);
            let turn = cosine.acos();
            if turn > 4.0 * TURN && step > STEP_RANGE.0 {
                step *= 0.5;
                continue;
            }
            if !self.inside(&next) {
                points.push(next);
                return Ok((points, FlankEnd::Window));
            }
            step = (step * (TURN / turn.max(1e-3)).clamp(0.5, 1.6)).clamp(STEP_RANGE.0, STEP_RANGE.1);
            direction = chord;
            points.push(next);
        }
        Ok((points, FlankEnd::Points))
    }

    /// Unit tangent of the curve at its start, in units of the window, by difference quotients of the test function.
    fn tangent(&mut self, start: &Sample) -> Result<(f64, f64), OrbitError> {
        let Window { span, limit } = self.window;
        let mut slopes = [0.0; 2];
        for (slope, (omega, beta)) in
            slopes.iter_mut().zip([(DIFFERENCE * span, 0.0), (0.0, DIFFERENCE * limit)])
        {
            for side in [-1.0, 1.0] {
                self.solver.retune(&self.system.with_excitation(0.0, start.omega + side * omega)?)?;
                self.solver.follow(&start.state, start.beta + side * beta, 1)?;
                *slope += side * self.kind.test(&self.solver.multipliers()?);
            }
        }
        let length = slopes[0].hypot(slopes[1]);
        Ok((-slopes[1] / length, slopes[0] / length))
    }

    /// The point of the curve one step on, or `None` when there is none of the same kind.
    fn next(
        &mut self,
        last: &Sample,
        before: Option<&Sample>,
        direction: (f64, f64),
        step: f64,
    ) -> Result<Option<Sample>, OrbitError> {
        let Window { span, limit } = self.window;
        let (mut omega, mut beta) =
            (last.omega + step * direction.0 * span, last.beta + step * direction.1 * limit);
        // The point that leaves the window is put on its border.
        let along = if direction.0.abs() > 0.5 * direction.1.abs() && beta < limit {
            omega = omega.clamp(self.centre - span, self.centre + span);
            Along::Beta
        } else {
            beta = beta.min(limit);
            Along::Omega
        };
        // The orbit is extrapolated like the point.
        let mut guess = last.state.clone();
        if let Some(before) = before {
            let (a, b) = (self.distance(before, last), step);
            for (value, old) in guess.iter_mut().zip(&before.state) {
                *value += (*value - old) * (b / a);
            }
        }
        if along == Along::Beta {
            self.solver.retune(&self.system.with_excitation(0.0, omega)?)?;
        }
        let unit = if along == Along::Beta { limit } else { span };
        let mut position = if along == Along::Beta { beta } else { omega };
        let mut change = 1e-3 * step.min(0.01) * unit;
        let mut value_before = None;
        for _ in 0..MAX_EVALUATIONS {
            let (omega_now, beta_now) =
                if along == Along::Beta { (omega, position) } else { (position, beta) };
            if along == Along::Omega {
                self.solver.retune(&self.system.with_excitation(0.0, omega_now)?)?;
            }
            self.solver.follow(&guess, beta_now, 1)?;
            guess.copy_from_slice(self.solver.state());
            let multipliers = self.solver.multipliers()?;
            let value = self.kind.test(&multipliers);
            if value_before.is_some() && change.abs() <= LOCATED * unit {
                let next = Sample { omega: omega_now, beta: beta_now, state: guess };
                return Ok(self.crossing(&multipliers).then_some(next));
            }
            if let Some(old) = value_before {
                change *= value / (old - value);
                if !(change.abs() <= 2.0 * step * unit) {
                    return Ok(None);
                }
            }
            value_before = Some(value);
            position += change;
        }
        Ok(None)
    }

    /// Whether one of `multipliers` is on the unit circle in the way of this tongue.
    fn crossing(&self, multipliers: &[Complex<f64>]) -> bool {
        multipliers.iter().any(|mu| (mu.norm() - 1.0).abs() < ON_CIRCLE && Instability::of(*mu) == self.kind)
    }

    fn inside(&self, point: &Sample) -> bool {
        let edge = 1.0 - 1e-9;
        (point.omega - self.centre).abs() < edge * self.window.span
            && point.beta < edge * self.window.limit
            && point.beta > 0.0
    }

    fn distance(&self, a: &Sample, b: &Sample) -> f64 {
        let Window { span, limit } = self.window;
        ((b.omega - a.omega) / span).hypot((b.beta - a.beta) / limit)
    }

    /// Unit vector from `a` to `b` in units of the window.
    fn direction(&self, a: &Sample, b: &Sample) -> (f64, f64) {
        let length = self.distance(a, b);
        let Window { span, limit } = self.window;
        ((b.omega - a.omega) / (span * length), (b.beta - a.beta) / (limit * length))
    }
}
