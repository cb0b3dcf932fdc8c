//! The stable periodic motion that gives most over frequency: on the branches, between the points that represent them.

use serde::{Deserialize, Serialize};

use super::linear::highest_place;
use super::{Bounds, HarvestPoint, Plant};
use crate::dynamics::attractors::dielectric::orbit_with_loss;
use crate::dynamics::{Branch, BranchPoint, Measures, Orbit};
use crate::model::Parameter;
use crate::questions::response::Followed;

/// Golden sections that locate a peak between three points of a branch: to 1e-5 of their distance.
const SECTIONS: usize = 24;
/// Halvings that locate the place where a limit is met: to 1e-9 of a step.
const HALVINGS: usize = 30;
/// What may be gained between points of a branch, as a part of the power at the higher of them: a peak lower than the
/// best by more is not looked at.
const HIDDEN: f64 = 0.1;

/// What keeps a peak from being higher.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
#[serde(rename_all = "snake_case")]
pub enum Kept {
    /// Nothing: the power falls on both sides.
    Peak,
    /// A limit, which is just met there.
    Limit,
    /// The motion ends or loses its stability there: a cliff.
    Stability,
    /// The end of the window or of what is known of the branch.
    End,
}

/// The stable periodic motion that gives most, and where.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Peak {
    /// Frequency (Hz).
    pub frequency: f64,
    /// Its means and extremes in SI units: V, W, mm.
    #[serde(flatten)]
    pub measures: Measures,
    /// Its period in excitation periods.
    pub periods: usize,
    /// What keeps it from being higher.
    pub kept: Kept,
}

impl Peak {
    fn new(point: &HarvestPoint, periods: usize, kept: Kept) -> Self {
        let HarvestPoint { frequency, measures, .. } = *point;
        Self { frequency, measures, periods, kept }
    }
}

/// The highest stable motion of `plant` on `branches` over omega, of all or of those within
/// `bounds`; `None` when there is none.
///
/// Between the points that represent a branch its orbits are found by Newton's iteration: where the power has a maximum,
/// and where a limit is just met.
pub(super) fn highest(plant: &Plant, branches: &[Followed], bounds: Option<&Bounds>) -> Option<Peak> {
    let mut best: Option<Peak> = None;
    for Followed { branch, periods, .. } in branches {
        for arc in stable_arcs(branch) {
            Arc { plant, periods: *periods, bounds, knots: arc }.climb(&mut best);
        }
    }
    best
}

/// A point of a stable part of a branch, and whether the part ends there because stability does.
struct Knot<'a> {
    point: &'a BranchPoint,
    border: bool,
}

/// The stable parts of a branch, each with the places where stability is lost at its ends.
fn stable_arcs(branch: &Branch) -> Vec<Vec<Knot<'_>>> {
    let mut arcs = Vec::new();
    let mut arc: Vec<Knot<'_>> = Vec::new();
    let mut changes = branch.bifurcations.iter().peekable();
    for (index, point) in branch.points.iter().enumerate() {
        while let Some(change) = changes.next_if(|change| change.after <= index) {
            // It ends what was stable before it, and may begin what is stable after it.
            arc.push(Knot { point: &change.point, border: true });
            arcs.push(std::mem::take(&mut arc));
            arc.push(Knot { point: &change.point, border: true });
        }
        if point.stable() {
            arc.push(Knot { point, border: false });
        } else {
            arcs.push(std::mem::take(&mut arc));
        }
    }
    if let Some(change) = changes.next() {
        arc.push(Knot { point: &change.point, border: true });
    }
    arcs.push(arc);
    // A border alone is no motion that lasts.
    arcs.retain(|arc| arc.iter().any(|knot| !knot.border));
    arcs
}

/// A stable part of a branch in SI units.
struct Arc<'a> {
    plant: &'a Plant,
    periods: usize,
    bounds: Option<&'a Bounds>,
    knots: Vec<Knot<'a>>,
}

impl Arc<'_> {
    /// Replaces `best` by what is higher here.
    fn climb(&self, best: &mut Option<Peak>) {
        let points: Vec<HarvestPoint> = self
            .knots
            .iter()
            .map(|knot| HarvestPoint::new(self.plant, knot.point.value, &knot.point.measures))
            .collect();
        let margins: Vec<f64> = points.iter().map(|point| self.margin(point)).collect();
        let last = points.len() - 1;
        for (i, found) in points.iter().enumerate() {
            if !(margins[i] >= 0.0) {
                continue;
            }
            let kept = if self.knots[i].border {
                Kept::Stability
            } else if i == 0 || i == last {
                Kept::End
            } else {
                Kept::Peak
            };
            offer(best, Peak::new(found, self.periods, kept));
        }
        // What is hidden between the points, the highest places first, so that the others need not be looked at.
        let mut steps: Vec<usize> = (0..last).collect();
        let power = |i: usize| points[i].measures.power.max(points[i + 1].measures.power);
        steps.sort_by(|i, j| power(*j).total_cmp(&power(*i)));
        for i in steps {
            let worth = best.as_ref().is_none_or(|best| power(i) * (1.0 + HIDDEN) > best.measures.power);
            if worth && (margins[i] >= 0.0) != (margins[i + 1] >= 0.0) {
                self.meet_limit(i, margins[i] >= 0.0, best);
            }
        }
        for i in 1..last {
            let peak = points[i].measures.power >= points[i - 1].measures.power
                && points[i].measures.power >= points[i + 1].measures.power;
            let worth = best
                .as_ref()
                .is_none_or(|best| points[i].measures.power * (1.0 + HIDDEN) > best.measures.power);
            if peak && worth {
                self.ascend(i, best);
            }
        }
    }

    /// The place between knots `i` and `i + 1` where a limit is just met, the first of them `within` all.
    fn meet_limit(&self, i: usize, within: bool, best: &mut Option<Peak>) {
        let (mut inside, mut outside) = if within { (0.0, 1.0) } else { (1.0, 0.0) };
        let mut found = None;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (inside + outside);
            let Some(point) = self.between(i, middle) else { break };
            if self.margin(&point) >= 0.0 {
                (inside, found) = (middle, Some(point));
            } else {
                outside = middle;
            }
        }
        if let Some(point) = found {
            offer(best, Peak::new(&point, self.periods, Kept::Limit));
        }
    }

    /// The maximum about knot `i`.
    fn ascend(&self, i: usize, best: &mut Option<Peak>) {
        // From -1 at the knot before to 1 at the one after.
        let at = |x: f64| if x < 0.0 { self.between(i - 1, 1.0 + x) } else { self.between(i, x) };
        let power = |x: f64| match at(x) {
            Some(point) if self.margin(&point) >= 0.0 => point.measures.power,
            _ => f64::NEG_INFINITY,
        };
        let place = highest_place(power, (-1.0, 1.0), SECTIONS);
        if let Some(point) = at(place).filter(|point| self.margin(point) >= 0.0) {
            offer(best, Peak::new(&point, self.periods, Kept::Peak));
        }
    }

    /// The orbit at `share` of the step from knot `i` to the next; `None` where Newton's iteration leaves the branch.
    fn between(&self, i: usize, share: f64) -> Option<HarvestPoint> {
        let (a, b) = (self.knots[i].point, self.knots[i + 1].point);
        let mix = |a: f64, b: f64| a + share * (b - a);
        let omega = mix(a.value, b.value);
        let guess: Vec<f64> = a.state.iter().zip(&b.state).map(|(a, b)| mix(*a, *b)).collect();
        let Plant { scenario, along, .. } = self.plant;
        let set = along.at(&scenario.parameters, Parameter::Omega, omega);
        let system = scenario.model.system(set).ok()?;
        let orbit = Orbit::find(&system, Some(&guess), self.periods).ok()?;
        let own = orbit_with_loss(&system, *along, (&orbit.state, self.periods)).ok()?;
        let orbit = own.map_or(orbit, |(_, own)| own);
        let measures = orbit.measures;
        // Between its ends a step's power is not far beyond them; another motion's is.
        let (low, high) = (a.measures.v_rms.min(b.measures.v_rms), a.measures.v_rms.max(b.measures.v_rms));
        let near = (low * (1.0 - HIDDEN)..=high * (1.0 + HIDDEN)).contains(&measures.v_rms);
        (near && orbit.periods == self.periods && orbit.stable())
            .then(|| HarvestPoint::new(self.plant, omega, &measures))
    }

    /// What is left to the nearest limit; nothing is limited without any.
    fn margin(&self, point: &HarvestPoint) -> f64 {
        self.bounds.map_or(f64::INFINITY, |bounds| {
            // What just touches has no margin and is not allowed.
            let margin = bounds.margin(&point.measures);
            if margin == 0.0 && !bounds.allows(&point.measures) { -f64::MIN_POSITIVE } else { margin }
        })
    }
}

fn offer(best: &mut Option<Peak>, peak: Peak) {
    if best.as_ref().is_none_or(|best| peak.measures.power > best.measures.power) {
        *best = Some(peak);
    }
}
