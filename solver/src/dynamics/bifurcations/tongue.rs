//! The tongue of a resonance in the plane of omega and beta: the curve on which the forced motion has a multiplier
//! on the unit circle, traced from above the resonance's centre down both flanks by [`super::curves`].
//!
//! A curve of bifurcations goes on where a tongue ends: beyond a fold of the orbits it belongs to another motion than
//! the one that grows out of rest.

use serde::{Deserialize, Serialize};

use super::boundary::{Asked, ForcedSurvey};
use super::curves::{Curve, CurveEnd, SpecialKind, Start, trace_curve};
use super::plane::{Axis, Plane};
use crate::dynamics::orbits::{Instability, OrbitError, OrbitSolver};
use crate::model::{Parameter, ReducedSystem};
use crate::theory::{CoupledModes, Resonance};

/// The part of the plane in which a tongue is traced.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
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
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct TonguePoint {
    /// Excitation frequency (dimensionless).
    pub omega: f64,
    /// Excitation amplitude (dimensionless).
    pub beta: f64,
}

/// Why a flank is not followed any further.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
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
    /// The tongue is an island: both flanks meet.
    Closed,
}

/// The border of a tongue.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
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
/// `None` when the forced motion at the centre is not unstable by the resonance below the window's limit (see
/// [`super::resonance_boundary`]).
///
/// # Errors
/// [`OrbitError::Theory`] where the coupled modes do not exist, [`OrbitError::Model`] when the centre or the window's
/// limit is out of range, and [`OrbitError::Multipliers`].
pub fn trace_tongue(
    system: &ReducedSystem,
    resonance: Resonance,
    window: Window,
) -> Result<Option<Tongue>, OrbitError> {
    let centre = CoupledModes::new(system)?.frequency(resonance);
    let system = system.with_excitation(0.0, centre)?;
    let asked = Asked::Kind(resonance.instability());
    let survey = ForcedSurvey::of(&mut OrbitSolver::new(&system), window.limit, asked)?;
    let Some((loss, orbit)) = survey.found else { return Ok(None) };
    let start = Start { kind: loss.instability, periods: 1, at: [centre, loss.beta], state: orbit.state };
    let (lowest, highest) = Parameter::Omega.range();
    let omegas = ((centre - window.span).max(lowest), (centre + window.span).min(highest));
    let plane = Plane::new([
        Axis { parameter: Parameter::Omega, range: omegas },
        Axis { parameter: Parameter::Beta, range: (0.0, window.limit) },
    ])?;
    let curve = trace_curve(&system, &start, &plane)?;
    Ok(Some(Tongue::of(&curve)))
}

impl Tongue {
    /// The part of `curve` about its start on which it is the forced motion's.
    fn of(curve: &Curve) -> Self {
        let mut part = (0, curve.points.len());
        let mut ends = [0, 1].map(|side| FlankEnd::of(&curve.ends[side]));
        for fold in &curve.special {
            if !matches!(fold.kind, SpecialKind::FoldFlip | SpecialKind::FoldNeimarkSacker) {
                continue;
            }
            if fold.after <= curve.origin {
                (part.0, ends[0]) = (fold.after, FlankEnd::MotionEnds);
            } else if fold.after < part.1 {
                (part.1, ends[1]) = (fold.after, FlankEnd::MotionEnds);
            }
        }
        let point = |at: [f64; 2]| TonguePoint { omega: at[0], beta: at[1] };
        let points = curve.points[part.0..part.1].iter().map(|found| point(found.at)).collect();
        Self { instability: curve.kind, points, ends }
    }
}

impl FlankEnd {
    fn of(end: &CurveEnd) -> Self {
        match end {
            CurveEnd::Window => Self::Window,
            CurveEnd::Meeting { .. } => Self::Meeting,
            CurveEnd::Lost { .. } => Self::MotionEnds,
            CurveEnd::Points => Self::Points,
            CurveEnd::Closed => Self::Closed,
        }
    }
}
