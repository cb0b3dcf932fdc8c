//! Branches of periodic orbits: what to follow, the points, and why a branch ends.

use nalgebra::Complex;

use crate::dynamics::integration::Measures;
use crate::dynamics::orbits::{Instability, OrbitError};
use crate::model::{Along, Parameter};

/// What to follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Course {
    /// The number that changes.
    pub parameter: Parameter,
    /// What follows the frequency meanwhile.
    pub along: Along,
    /// Where it may go; the ends belong to the branch.
    pub range: (f64, f64),
    /// Period of the orbits in excitation periods.
    pub periods: usize,
    /// Whether it grows at first.
    pub upwards: bool,
    /// Most points.
    pub most_points: usize,
}

/// A point of a branch.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchPoint {
    /// The parameter's value.
    pub value: f64,
    /// State at t = 0, length 2N + 1.
    pub state: Vec<f64>,
    /// Multipliers over the course's period by descending modulus.
    pub multipliers: Vec<Complex<f64>>,
    /// Means and extremes over that period.
    pub measures: Measures,
}

impl BranchPoint {
    /// Whether every multiplier is inside the unit circle.
    pub fn stable(&self) -> bool {
        self.multipliers.iter().all(|mu| mu.norm() < 1.0)
    }
}

/// A place on a branch where a multiplier crosses the unit circle.
#[derive(Debug, Clone, PartialEq)]
pub struct Bifurcation {
    /// How many points of the branch lie before it.
    pub after: usize,
    /// Its kind.
    pub kind: Instability,
    /// The orbit there.
    pub point: BranchPoint,
}

/// Most that is computed for a branch, as [`crate::dynamics::OrbitSolver::effort`]: some seconds, where usual ones take
/// hundredths.
pub const MOST_EFFORT: u64 = 8_000_000;

/// Why a branch is not followed any further.
#[derive(Debug, Clone, PartialEq)]
pub enum BranchEnd {
    /// The end of the range.
    Range,
    /// A doubled branch closes on the orbit of half its period, at this value of the parameter.
    Halved {
        /// The parameter where the half orbit doubles its period.
        value: f64,
    },
    /// The next point could not be found: the motion touches or escapes, or cannot be resolved.
    Lost {
        /// What the last attempt met.
        reason: OrbitError,
    },
    /// The branch is closed: it came back to its start, which is its last point, too.
    Closed,
    /// The largest number of points was reached.
    Points,
    /// More was computed than a branch may cost.
    Effort,
}

/// A branch of periodic orbits.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    /// Its points in order.
    pub points: Vec<BranchPoint>,
    /// The changes of stability on it.
    pub bifurcations: Vec<Bifurcation>,
    /// Why it ends.
    pub end: BranchEnd,
    /// What was computed for it, as [`crate::dynamics::OrbitSolver::effort`].
    pub effort: u64,
}
