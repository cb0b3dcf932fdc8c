//! Finding the curves of a window: the bifurcations on a few lines across it, each the start of a curve.
//!
//! The work is cut into items that do not need each other: [`search_lines`] lists the lines,
//! [`bifurcations_along_line`] searches one, [`super::trace_curve`] traces from one start, and
//! [`super::KnownCurves`] says which starts are worth it. [`find_curves`] does them one after the other.
//!
//! Only what the lines meet is found, and what branches off it in points of codimension two: a closed curve that
//! fits between the lines is overlooked, and so is one of orbits that are not connected with the forced motion.

use serde::{Deserialize, Serialize};

use super::curve::{Curve, Start};
use super::known::KnownCurves;
use super::tracer::trace_curve;
use crate::dynamics::bifurcations::branch::{Bifurcation, Course};
use crate::dynamics::bifurcations::continuation::{follow_doubled, follow_forced};
use crate::dynamics::bifurcations::plane::{Axis, Plane};
use crate::dynamics::orbits::march::Forced;
use crate::dynamics::orbits::{Instability, OrbitError, OrbitSolver};
use crate::model::{Along, Parameter, ReducedSystem};
use crate::theory::spectrum::frequencies;

/// Most points of a branch along a line: a resonance can be followed up without end, and beyond about this many, of which a
/// third may lie about narrow resonances, the tip moves by more than the beam's length.
const MOST_POINTS: usize = 450;
/// Most lines through the centres of resonances.
const MOST_CENTRES: usize = 12;

/// How much is searched.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Search {
    /// Equidistant lines along each parameter.
    pub lines: usize,
    /// Whether the doubled motions that branch off on the lines are followed as well.
    pub doubled: bool,
}

impl Default for Search {
    /// Three lines along each parameter, the forced motion only.
    fn default() -> Self {
        Self { lines: 3, doubled: false }
    }
}

/// A line across a plane along one of its axes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Line {
    /// Which axis, 0 or 1, the line runs along.
    pub along: usize,
    /// Value of the other parameter.
    pub at: f64,
}

/// What a search found.
#[derive(Debug, Clone, PartialEq)]
pub struct Survey {
    /// The curves.
    pub curves: Vec<Curve>,
    /// What kept lines from being searched and starts from being traced.
    pub failures: Vec<OrbitError>,
}

/// The lines to search: equidistant ones along both axes, and those along which one of them, the frequency, is that of
/// a mode of beam and circuit or the sum of two (those of `system`), where tongues are widest at the lowest beta.
///
/// # Errors
/// [`OrbitError::Theory`] when there are no such frequencies.
pub fn search_lines(system: &ReducedSystem, plane: &Plane, search: Search) -> Result<Vec<Line>, OrbitError> {
    let mut lines = Vec::new();
    for (along, other) in [(0, 1), (1, 0)] {
        let across = &plane.axes()[other];
        if across.parameter == Parameter::Omega {
            let frequencies = frequencies(system)?;
            let sums = frequencies.iter().enumerate();
            let sums = sums.flat_map(|(i, a)| frequencies[i..].iter().map(move |b| a + b));
            let mut centres: Vec<f64> = sums.chain(frequencies.iter().copied()).collect();
            centres.retain(|omega| across.range.0 < *omega && *omega < across.range.1);
            lines.extend(centres.into_iter().take(MOST_CENTRES).map(|at| Line { along, at }));
        }
        let fraction = |i: usize| (i as f64 + 0.5) / search.lines as f64;
        lines.extend((0..search.lines).map(|i| Line { along, at: across.at(fraction(i)) }));
    }
    Ok(lines)
}

/// The bifurcations of the forced motion on a line across the plane, followed through its folds as by [`follow_forced`]. With
/// `doubled` also those of the doubled motions that branch off.
///
/// # Errors
/// [`OrbitError`] when the forced motion exists at neither end, or a doubled motion cannot be found at its birth.
pub fn bifurcations_along_line(
    system: &ReducedSystem,
    plane: &Plane,
    line: Line,
    doubled: bool,
) -> Result<Vec<Start>, OrbitError> {
    let along = line.along.min(1);
    let axis = plane.axes()[along];
    let at = |value: f64| {
        let mut at = [line.at; 2];
        at[along] = value;
        at
    };
    let forced = |value| {
        let system = plane.system(system, at(value))?;
        let state = forced_state(&system)?;
        Ok((system, state))
    };
    let Axis { parameter, range } = axis;
    let course = Course {
        parameter,
        along: Along::default(),
        range,
        periods: 1,
        upwards: true,
        most_points: MOST_POINTS,
    };
    let start = |periods| {
        move |found: &Bifurcation| Start {
            kind: found.kind,
            periods,
            at: at(found.point.value),
            state: found.point.state.clone(),
        }
    };
    let mut starts = Vec::new();
    for branch in follow_forced(&forced, &course)? {
        let Some(first) = branch.points.first() else { continue };
        let device = plane.system(system, at(first.value))?;
        starts.extend(branch.bifurcations.iter().map(start(1)));
        let births = branch.bifurcations.iter().filter(|birth| birth.kind == Instability::PeriodDoubling);
        for birth in births.filter(|_| doubled) {
            starts.extend(follow_doubled(&device, birth, &course)?.bifurcations.iter().map(start(2)));
        }
        if device.undamped() {
            starts.retain(|start: &Start| start.kind != Instability::NeimarkSacker);
        }
    }
    Ok(starts)
}

/// Finds the curves of the forced motion in the window `plane` of `system`, with `search.doubled` also those of the
/// doubled motions.
///
/// # Errors
/// As [`search_lines`]; what fails later is in the answer.
pub fn find_curves(system: &ReducedSystem, plane: &Plane, search: Search) -> Result<Survey, OrbitError> {
    let mut known = KnownCurves::new(*plane);
    let mut failures = Vec::new();
    for line in search_lines(system, plane, search)? {
        match bifurcations_along_line(system, plane, line, search.doubled) {
            Ok(mut starts) => {
                starts.reverse();
                trace_all(system, plane, starts, &mut known, &mut failures);
            }
            Err(error) => failures.push(error),
        }
    }
    Ok(Survey { curves: known.into_curves(), failures })
}

/// Traces what is new among `starts`, and what branches off the curves found.
fn trace_all(
    system: &ReducedSystem,
    plane: &Plane,
    mut starts: Vec<Start>,
    known: &mut KnownCurves,
    failures: &mut Vec<OrbitError>,
) {
    while let Some(start) = starts.pop() {
        if !known.is_new(&start) {
            continue;
        }
        match trace_curve(system, &start, plane) {
            Ok(curve) => {
                let branches = curve.branches();
                if known.add(curve) {
                    starts.extend(branches);
                }
            }
            Err(error) => failures.push(error),
        }
    }
}

/// The state of the motion that grows out of rest as beta grows from 0 to that of `system`.
fn forced_state(system: &ReducedSystem) -> Result<Vec<f64>, OrbitError> {
    let mut solver = OrbitSolver::new(system);
    let beta = system.parameters.beta;
    let there = Forced::at_rest(&mut solver)?.march_to(&mut solver, beta)?;
    there.map(|forced| forced.state).ok_or(OrbitError::MotionEnds { beta })
}
