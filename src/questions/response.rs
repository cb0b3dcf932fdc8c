//! Response curves: the branch of the forced motion over a range of one parameter, and the doubled branches that leave
//! it, with their stable and unstable parts.

use serde::{Deserialize, Serialize};

use crate::dynamics::bifurcations::branch::MOST_EFFORT;
use crate::dynamics::orbits::period_map::MOST_PERIODS;
use crate::dynamics::{
    Bifurcation, Branch, BranchEnd, BranchPoint, Course, Instability, Measures, Orbit, OrbitError,
    follow_branch, follow_doubled, follow_forced,
};
use crate::model::{Along, ModelError, Parameter};
use crate::scenario::Scenario;

/// Most points of a branch.
const MOST_POINTS: usize = 1500;
/// How often period doublings are followed unless a question says otherwise: to motions of 2 and 4 periods.
pub const DOUBLINGS: usize = 2;
/// Two places of a parameter are the same within this fraction of its range: doublings and where branches close are located ten
/// times better.
const SAME: f64 = 1e-8;

/// A point of a response curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct ResponsePoint {
    /// The parameter's value.
    pub value: f64,
    /// Means and extremes.
    #[serde(flatten)]
    pub measures: Measures,
    /// Modulus of the largest multiplier over the branch's period.
    pub multiplier: f64,
}

/// A change of stability on a response curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Change {
    /// How stability is lost or regained.
    pub kind: Instability,
    /// The periodic motion there.
    pub point: ResponsePoint,
}

/// A branch of periodic motions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct ResponseCurve {
    /// Period in excitation periods.
    pub periods: usize,
    /// Its points in the order in which they were found.
    pub points: Vec<ResponsePoint>,
    /// Changes of stability on it.
    pub changes: Vec<Change>,
    /// Why it ends, in words; empty at the end of the range.
    pub end: String,
    /// Whether more of it, or of the branches that leave it, was left out because it would take too long.
    pub cut: bool,
}

/// The forced motion of the device of `scenario` while a parameter goes through `range`, and the doubled ones that leave it;
/// `moved` is that parameter, and what follows the frequency meanwhile.
///
/// # Errors
/// [`OrbitError`] when the device is not valid at the low end, or has no forced motion at either end.
pub fn response(
    scenario: &Scenario,
    moved: (Parameter, Along),
    range: (f64, f64),
) -> Result<Vec<ResponseCurve>, OrbitError> {
    Ok(branches(scenario, moved, range, DOUBLINGS)?.iter().map(curve).collect())
}

/// Where a branch begins.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::questions) enum Begin {
    /// At the orbit from which it was followed one way, or where that was followed the other way too, why it ends there.
    End(BranchEnd),
    /// In a period doubling.
    Born {
        /// Index of the branch that doubles its period.
        on: usize,
        /// The parameter's value there.
        value: f64,
    },
}

/// A branch that was followed.
pub(in crate::questions) struct Followed {
    pub(in crate::questions) branch: Branch,
    /// Of its motions, in excitation periods.
    pub(in crate::questions) periods: usize,
    /// Where it begins; it ends as `branch` says.
    pub(in crate::questions) begin: Begin,
    /// Whether branches that leave it were left out, because they would have taken too long.
    left_out: bool,
}

impl Followed {
    /// Whether more of it, or of the branches that leave it, is not there.
    pub(in crate::questions) fn is_cut(&self) -> bool {
        let cut = |end: &BranchEnd| matches!(end, BranchEnd::Points | BranchEnd::Effort);
        self.left_out || cut(&self.branch.end) || matches!(&self.begin, Begin::End(end) if cut(end))
    }
}

/// Branches being followed.
struct Following<'a> {
    scenario: &'a Scenario,
    branches: Vec<Followed>,
    /// Where branches of so many periods ended on one of half of them: from there they need not be followed again.
    closed: Vec<(usize, f64)>,
    /// What was computed so far.
    effort: u64,
}

/// Follows the forced motion of the device of `scenario` while a parameter goes through `range`, from the low end and, where
/// it does not come through to that of the high end, from there too; then so many `doublings` of the branches' periods.
/// `moved` is that parameter, and what follows the frequency meanwhile.
///
/// The forced motion at an end is the one that Newton's iteration reaches from the linear response there. Branches that
/// touch none of these, such as isolas, are not found.
///
/// # Errors
/// [`OrbitError`] when the device is not valid at the low end, or has no forced motion at either end.
pub(in crate::questions) fn branches(
    scenario: &Scenario,
    moved: (Parameter, Along),
    range: (f64, f64),
    doublings: usize,
) -> Result<Vec<Followed>, OrbitError> {
    let (parameter, along) = moved;
    let forced = |value| {
        let system = scenario.model.system(along.at(&scenario.parameters, parameter, value))?;
        let state = Orbit::find(&system, None, 1)?.state;
        Ok((system, state))
    };
    let course = Course { parameter, along, range, periods: 1, upwards: true, most_points: MOST_POINTS };
    let mut following = Following { scenario, branches: Vec::new(), closed: Vec::new(), effort: 0 };
    for branch in follow_forced(&forced, &course)? {
        following.add(branch, Begin::End(BranchEnd::Range), course, doublings)?;
    }
    Ok(following.branches)
}

/// Follows the periodic motion `orbit` of the device of `scenario` both ways in the same manner, then the `doublings`.
///
/// # Errors
/// [`OrbitError`] when the device is not valid, or the orbit is exactly a bifurcation.
pub(in crate::questions) fn branches_through(
    scenario: &Scenario,
    (parameter, along): (Parameter, Along),
    range: (f64, f64),
    orbit: &Orbit,
    doublings: usize,
) -> Result<Vec<Followed>, OrbitError> {
    let system = scenario.model.system(scenario.parameters)?;
    let value = scenario.parameters.get(parameter);
    let upwards = value < range.1;
    let course =
        Course { parameter, along, range, periods: orbit.periods, upwards, most_points: MOST_POINTS };
    let follow = |upwards: bool| {
        let mut branch = follow_branch(&system, &orbit.state, &Course { upwards, ..course })?;
        // Without rounding.
        branch.points.iter_mut().take(1).for_each(|first| first.value = value);
        if branch.end == BranchEnd::Closed {
            branch.points.iter_mut().rev().take(1).for_each(|last| last.value = value);
        }
        Ok::<Branch, OrbitError>(branch)
    };
    let mut branch = follow(upwards)?;
    let mut begin = BranchEnd::Range;
    if branch.end == BranchEnd::Closed {
        begin = BranchEnd::Closed;
    } else if upwards && value > range.0 {
        (branch, begin) = match follow(false)? {
            back if back.end == BranchEnd::Closed => (back, BranchEnd::Closed),
            back => joined(back, branch),
        };
    }
    let mut following = Following { scenario, branches: Vec::new(), closed: Vec::new(), effort: 0 };
    following.add(branch, Begin::End(begin), course, doublings)?;
    Ok(following.branches)
}

/// Two branches that leave the same orbit as one, from the end of the first to that of the second, and why the first ends.
fn joined(mut back: Branch, mut forth: Branch) -> (Branch, BranchEnd) {
    let (count, before) = (back.points.len(), back.points.len().saturating_sub(1));
    back.points.reverse();
    back.points.pop();
    back.points.append(&mut forth.points);
    back.bifurcations.reverse();
    back.bifurcations.iter_mut().for_each(|found| found.after = count - found.after);
    let moved = |found: Bifurcation| Bifurcation { after: before + found.after, ..found };
    back.bifurcations.extend(forth.bifurcations.into_iter().map(moved));
    back.effort += forth.effort;
    let begin = std::mem::replace(&mut back.end, forth.end);
    (back, begin)
}

fn same(a: f64, b: f64, (low, high): (f64, f64)) -> bool {
    (a - b).abs() <= SAME * (high - low)
}

impl Following<'_> {
    /// Adds a branch, and those that leave its period doublings, unless a doubled branch already ended there, or all
    /// together have taken as much effort as a single one may.
    fn add(
        &mut self,
        branch: Branch,
        begin: Begin,
        course: Course,
        doublings: usize,
    ) -> Result<(), OrbitError> {
        let births: Vec<Bifurcation> = branch
            .bifurcations
            .iter()
            .filter(|found| found.kind == Instability::PeriodDoubling)
            .cloned()
            .collect();
        let place = self.branches.len();
        self.effort += branch.effort;
        self.branches.push(Followed { branch, periods: course.periods, begin, left_out: false });
        if doublings == 0 || 2 * course.periods > MOST_PERIODS {
            return Ok(());
        }
        let system = self.scenario.model.system(self.scenario.parameters)?;
        for birth in &births {
            let value = birth.point.value;
            let periods = 2 * course.periods;
            let ended = |(of, at): &(usize, f64)| *of == periods && same(*at, value, course.range);
            if self.closed.iter().any(ended) {
                continue;
            }
            if self.effort > MOST_EFFORT {
                self.branches[place].left_out = true;
                break;
            }
            // A doubling so degenerate that no doubled motion is found beside it leaves the rest of the picture intact.
            let Ok(doubled) = follow_doubled(&system, birth, &course) else { continue };
            if let BranchEnd::Halved { value } = doubled.end {
                self.closed.push((periods, value));
            }
            let course = Course { periods, ..course };
            self.add(doubled, Begin::Born { on: place, value }, course, doublings - 1)?;
        }
        Ok(())
    }
}

pub(in crate::questions) fn curve(followed: &Followed) -> ResponseCurve {
    let Followed { branch, periods, .. } = followed;
    let end = match &branch.end {
        BranchEnd::Range | BranchEnd::Halved { .. } | BranchEnd::Closed => String::new(),
        BranchEnd::Lost { reason } => reason.to_string(),
        BranchEnd::Points => "the largest number of points was reached".to_owned(),
        BranchEnd::Effort => "following it further would take too long".to_owned(),
    };
    let change = |found: &Bifurcation| Change { kind: found.kind, point: point(&found.point) };
    ResponseCurve {
        periods: *periods,
        points: branch.points.iter().map(point).collect(),
        changes: branch.bifurcations.iter().map(change).collect(),
        end,
        cut: followed.is_cut(),
    }
}

pub(in crate::questions) fn point(point: &BranchPoint) -> ResponsePoint {
    ResponsePoint {
        value: point.value,
        measures: point.measures,
        multiplier: point.multipliers.first().map_or(0.0, |mu| mu.norm()),
    }
}

/// Checks the range of a response or a sweep.
///
/// # Errors
/// [`ModelError`] naming the end that is out of range.
pub fn check_range(parameter: Parameter, (low, high): (f64, f64)) -> Result<(), ModelError> {
    let (minimum, maximum) = parameter.range();
    ModelError::check(parameter.field(), low, (minimum, maximum), "")?;
    ModelError::check(parameter.field(), high, (low, maximum), "")?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ForceLaw, ParameterSet};
    use crate::scenario::ModelChoice;

    #[test]
    fn the_doubled_branch_of_figure_9_is_part_of_its_frequency_response() {
        let parameters = ParameterSet { alpha: 1e-4, beta: 0.01, omega: 8.0969, ..Default::default() };
        let scenario = Scenario { parameters, ..Default::default() };
        let curves =
            response(&scenario, (Parameter::Omega, Along::default()), (7.5, 8.8)).expect("a response");
        assert_eq!(curves[0].periods, 1);
        // The motion of the figure, by interpolation on the stable doubled branch: 14.1783 V rms.
        let doubled = curves.iter().filter(|curve| curve.periods == 2);
        let pair = doubled
            .flat_map(|curve| curve.points.windows(2))
            .find(|pair| {
                (pair[0].value - 8.0969) * (pair[1].value - 8.0969) <= 0.0 && pair[0].multiplier < 1.0
            })
            .expect("a stable doubled branch passes the figure's frequency");
        let share = (8.0969 - pair[0].value) / (pair[1].value - pair[0].value);
        let volts = |i: usize| pair[i].measures.v_rms;
        let v_rms = volts(0) + share * (volts(1) - volts(0));
        assert!((v_rms / 14.1783 - 1.0).abs() < 2e-3, "{v_rms}");
    }

    #[test]
    fn a_doubled_branch_between_two_doublings_is_followed_once() {
        let model = ModelChoice { force: ForceLaw::Exact, ..Default::default() };
        let parameters = ParameterSet { alpha: 1e-3, beta: 7.5e-4, ..Default::default() };
        let scenario = Scenario { parameters, model, ..Default::default() };
        let curves =
            response(&scenario, (Parameter::Omega, Along::default()), (7.9, 8.8)).expect("a response");
        let kinds =
            |curve: &ResponseCurve| curve.changes.iter().map(|change| change.kind).collect::<Vec<_>>();
        let found: Vec<_> = curves.iter().map(|curve| (curve.periods, kinds(curve))).collect();
        // The exact force hardens: the doubled branch leans to high frequencies and turns back at a fold.
        let doublings = vec![Instability::PeriodDoubling; 2];
        assert_eq!(found, vec![(1, doublings), (2, vec![Instability::Fold])]);
    }
}
