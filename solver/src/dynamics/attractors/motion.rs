//! What motion a start leads to: the classes, and what is known of the motion reached.
//! [`super::settle`] computes it.

use serde::{Deserialize, Serialize};

use super::lyapunov::Exponent;
use super::poincare::Recurrence;
use super::rotation::Rotation;
use crate::dynamics::integration::Measures;
use crate::dynamics::orbits::Orbit;
use crate::model::Demand;
use crate::sentence::{Say, Sentence, in_english, said};

/// The class of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum Motion {
    /// It repeats: there is a stable periodic motion that the run has arrived at, or approaches.
    Periodic {
        /// Its shortest period, in excitation periods.
        periods: usize,
    },
    /// It moves on a torus: further frequencies without a common period, no divergence of neighbours.
    Quasiperiodic,
    /// Neighbours diverge exponentially, yet it stays bounded.
    Chaotic,
    /// The tip left: over the potential barrier of a truncated force law, or beyond ten beam lengths.
    Escape {
        /// Time of escape (dimensionless).
        time: f64,
    },
    /// The magnets touched.
    Contact {
        /// Time of contact (dimensionless).
        time: f64,
    },
    /// The evidence does not decide.
    Undecided {
        /// Why it is undecided.
        why: Undecided,
    },
}

/// Why a motion has no class.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin,
)]
#[serde(rename_all = "snake_case")]
pub enum Undecided {
    /// Neighbours converge, so a periodic motion is approached, but the run has not come near it.
    TransientNotGone,
    /// The run is still near an unstable periodic motion and has not left it.
    NearUnstable,
    /// The Lyapunov exponent's error is too large for its sign.
    ExponentOpen,
    /// The exponent is zero but the stroboscopic points do not lie on closed curves, or not yet.
    PointsScattered,
    /// The motion is too fast for its derivative to be computed.
    Unresolved,
    /// Pieces of evidence contradict one another.
    EvidenceDisagrees,
    /// It moves chaotically, but has not lasted long enough to be called chaotic for good.
    MayBeTransient,
    /// Starts that differ by less than rounding lead to different motions.
    DependsOnRounding,
}

impl Motion {
    /// Whether both are of one class: periodic with the same period, or alike whatever the time or the reason is.
    pub fn same_class(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Periodic { periods: a }, Self::Periodic { periods: b }) => a == b,
            _ => std::mem::discriminant(self) == std::mem::discriminant(other),
        }
    }
}

impl Say for Motion {
    fn say(&self) -> Sentence {
        let at = |time: &f64| format!("{time:.4}");
        match self {
            Self::Periodic { periods } => said("period {periods}", &[("periods", periods)]),
            Self::Quasiperiodic => said("quasiperiodic", &[]),
            Self::Chaotic => said("chaotic", &[]),
            Self::Escape { time } => said("escape at t = {time}", &[("time", &at(time))]),
            Self::Contact { time } => said("contact at t = {time}", &[("time", &at(time))]),
            Self::Undecided { why } => said("undecided: {why}", &[("why", why)]),
        }
    }
}

impl Say for Undecided {
    fn say(&self) -> Sentence {
        match self {
            Self::TransientNotGone => said("the transient has not gone", &[]),
            Self::NearUnstable => said("the run is still near an unstable periodic motion", &[]),
            Self::ExponentOpen => said("the Lyapunov exponent has not converged", &[]),
            Self::PointsScattered => {
                said("the exponent is zero, but the stroboscopic points lie on no closed curves", &[])
            }
            Self::Unresolved => said("the motion is too fast to differentiate", &[]),
            Self::EvidenceDisagrees => said("the evidence disagrees", &[]),
            Self::MayBeTransient => said("it moves chaotically, but may still settle", &[]),
            Self::DependsOnRounding => said("the outcome depends on rounding", &[]),
        }
    }
}

in_english!(Motion);

/// What a start leads to.
#[derive(Debug, Clone, PartialEq)]
pub struct Reached {
    /// The class.
    pub motion: Motion,
    /// Means and extremes: of the periodic motion itself, else over the whole periods of the record. `None` when the
    /// motion ended.
    pub measures: Option<Measures>,
    /// Last stroboscopic state, length 2N + 1.
    pub state: Vec<f64>,
    /// Time of that state since the start (dimensionless).
    pub time: f64,
    /// The periodic motion reached, with its multipliers.
    pub orbit: Option<Orbit>,
    /// Distance of the last stroboscopic states from it, relative to the motion's amplitude: what is left of the
    /// transient.
    pub distance: Option<f64>,
    /// The exponents, when they were needed.
    pub exponent: Option<Exponent>,
    /// Whether the stroboscopic points at the end of the run recur; `None` when the motion ended or is rest. While a
    /// motion settles they may seem to repeat after a multiple of its period.
    pub recurrence: Option<Recurrence>,
    /// Turns about a torus in an excitation period, by the strongest frequency of the tip's stroboscopic displacement.
    pub rotation: Option<Rotation>,
    /// The 0-1 test of that displacement, when it was needed: near 0 on a regular motion, near 1 on a chaotic one.
    pub zero_one: Option<f64>,
    /// How much longer (dimensionless time) it would take to decide, where that is known.
    pub longer: Option<f64>,
    /// Stroboscopic states (length 2N + 1): of a periodic motion all of its shortest period, from the one nearest to
    /// [`Self::state`]; else that state alone.
    pub states: Vec<Vec<f64>>,
    /// Tip displacement once a period in the record, when there is one, in beam lengths.
    pub(super) tips: Vec<f64>,
    /// Tip displacement on the way, every 16 excitation periods from the start, in beam lengths.
    pub(super) notes: Vec<f64>,
}

/// The part of [`Reached`] that a chart stores.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Cell {
    /// The class.
    pub motion: Motion,
    /// Means and extremes; 0 when the motion ended.
    #[serde(flatten)]
    pub measures: Measures,
}

impl Cell {
    /// Of a motion with its numbers, if it has any.
    pub fn new(motion: Motion, measures: Option<Measures>) -> Self {
        Self { motion, measures: measures.unwrap_or_default() }
    }

    /// What the motion asks of the device; `None` when it ended.
    pub fn demand(&self) -> Option<Demand> {
        self.lasts().then(|| self.measures.demand())
    }

    /// Whether the motion goes on, so that it has means.
    pub fn lasts(&self) -> bool {
        !matches!(self.motion, Motion::Escape { .. } | Motion::Contact { .. })
    }
}

impl Reached {
    pub(super) fn with_orbit(self, orbit: Orbit) -> Self {
        Self { orbit: Some(orbit), ..self }
    }

    /// What a chart stores.
    pub fn cell(&self) -> Cell {
        Cell::new(self.motion, self.measures)
    }
}
