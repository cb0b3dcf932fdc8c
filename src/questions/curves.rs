//! The curves of bifurcations of the forced motion in the plane of two parameters: lines across the window are searched
//! for starts, then what is new among these is traced.

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

use super::checks::{check_ends, count, system};
use super::error::RequestError;
use super::question::Question;
use crate::dynamics::bifurcations::curves::{
    Criticality, Curve, CurvePoint, KnownCurves, Line, Search, SpecialPoint, Start, bifurcations_along_line,
    search_lines, trace_curve,
};
use crate::dynamics::{Axis, CurveEnd, Instability, OrbitError, Plane};
use crate::model::Parameter;
use crate::scenario::Scenario;
use crate::scheduler::{Asked, Budget, Failure, Order, Piece, Study, complete_within};

/// The parameters that a plane of the page may have.
pub const PARAMETERS: [Parameter; 5] =
    [Parameter::Omega, Parameter::Beta, Parameter::Alpha, Parameter::D, Parameter::Kappa];
/// Numbers of lines that may be searched along each side.
const LINES: (usize, usize) = (0, 50);

/// Curves of bifurcations; the scenario's own values of the two parameters play no role.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Curves {
    /// The horizontal side of the window.
    pub x: Side,
    /// The vertical side.
    pub y: Side,
    /// Equidistant lines along each side that are searched, beside those at the frequencies of resonances.
    #[serde(default = "default_lines")]
    pub lines: usize,
    /// Whether the doubled motions that leave the forced one on these lines are searched, too.
    #[serde(default)]
    pub doubled: bool,
}

/// A side of the window.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object such as {\"parameter\":\"omega\",\"from\":8,\"to\":9}")]
pub struct Side {
    /// One of the ten numbers.
    pub parameter: Parameter,
    /// Its lowest value.
    pub from: f64,
    /// Its highest value.
    pub to: f64,
}

fn default_lines() -> usize {
    Search::default().lines
}

impl Curves {
    /// The curves of the forced motion in the window of two parameters with their ranges.
    pub fn over(axes: [(Parameter, (f64, f64)); 2]) -> Self {
        let [x, y] = axes.map(|(parameter, (from, to))| Side { parameter, from, to });
        let Search { lines, doubled } = Search::default();
        Self { x, y, lines, doubled }
    }

    /// The window.
    ///
    /// # Errors
    /// As [`Plane::new`].
    pub fn plane(&self) -> Result<Plane, OrbitError> {
        Plane::new(
            [self.x, self.y].map(|side| Axis { parameter: side.parameter, range: (side.from, side.to) }),
        )
    }

    fn check(&self) -> Result<(), RequestError> {
        for (field, side) in [("x", self.x), ("y", self.y)] {
            check_ends(field, (side.from, side.to), side.parameter.range())?;
        }
        count("lines", self.lines, LINES)
    }
}

/// Curves of bifurcations.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CurvesAnswer {
    /// The curves in the order in which they were found.
    pub curves: Vec<CurveAnswer>,
    /// What kept lines from being searched and curves from being traced.
    pub failed: Vec<String>,
}

/// A curve on which motions have a multiplier on the unit circle.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CurveAnswer {
    /// In which way.
    pub kind: Instability,
    /// Period of the motions in excitation periods.
    pub periods: usize,
    /// Why it ends before its first point and after its last one.
    pub ends: [CurveEnd; 2],
    /// Its points in order.
    pub points: Vec<PointAnswer>,
    /// The points of codimension two on it, in order.
    pub special: Vec<SpecialAnswer>,
}

/// A point of a curve.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PointAnswer {
    /// To which side motions branch off; null on folds and where it is not known.
    pub criticality: Option<Criticality>,
    /// The place, the motion and the normal form.
    #[serde(flatten)]
    pub point: CurvePoint,
}

/// A point of codimension two.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SpecialAnswer {
    /// To which side motions branch off on the curve before it and after it.
    pub criticality: [Option<Criticality>; 2],
    /// The place, the motion and the normal form.
    #[serde(flatten)]
    pub point: SpecialPoint,
}

impl CurveAnswer {
    fn of(curve: &Curve) -> Self {
        let known = curve.criticality();
        let beside = |after: usize| {
            let last = known.len().saturating_sub(1);
            [after.saturating_sub(1), after].map(|i| known.get(i.min(last)).copied().flatten())
        };
        let points = curve.points.iter().zip(&known);
        let points = points.map(|(point, criticality)| (point.clone(), *criticality));
        let special = curve.special.iter().cloned();
        Self {
            kind: curve.kind,
            periods: curve.periods,
            ends: curve.ends.clone(),
            points: points.map(|(point, criticality)| PointAnswer { criticality, point }).collect(),
            special: special.map(|point| SpecialAnswer { criticality: beside(point.after), point }).collect(),
        }
    }
}

impl Question for Curves {
    const TASK: &'static str = "curves";
    type Answer = CurvesAnswer;

    fn answer(&self, mut scenario: Scenario, budget: &Budget<'_>) -> Result<CurvesAnswer, RequestError> {
        self.check()?;
        for side in [self.x, self.y] {
            *scenario.parameters.get_mut(side.parameter) = side.from;
        }
        system(&scenario)?;
        let mut study = CurvesStudy::new(scenario, self.clone())?;
        complete_within(&mut study, budget);
        let curves = study.curves().iter().map(CurveAnswer::of).collect();
        Ok(CurvesAnswer { curves, failed: study.failures().iter().map(ToString::to_string).collect() })
    }
}

/// Bifurcations of the forced motion along a line across a plane of two parameters.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Crossings {
    /// The device and its other numbers.
    pub scenario: Scenario,
    /// The window.
    pub plane: Plane,
    /// The line.
    pub line: Line,
    /// Whether the doubled motions that leave the forced one are searched, too.
    pub doubled: bool,
}

impl Piece for Crossings {
    const NAME: &'static str = "line";
    type Found = Vec<Start>;

    fn carry_out(&self) -> Result<Vec<Start>, Failure> {
        let (system, _) = self.scenario.validate()?;
        Ok(bifurcations_along_line(&system, &self.plane, self.line, self.doubled)?)
    }
}

/// A curve of bifurcations.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Trace {
    /// The device and its other numbers.
    pub scenario: Scenario,
    /// The window.
    pub plane: Plane,
    /// A point of it.
    pub start: Start,
}

impl Piece for Trace {
    const NAME: &'static str = "curve";
    type Found = Curve;

    fn carry_out(&self) -> Result<Curve, Failure> {
        let (system, _) = self.scenario.validate()?;
        Ok(trace_curve(&system, &self.start, &self.plane)?)
    }
}

/// Curves being traced.
#[derive(Debug, Clone)]
pub struct CurvesStudy {
    asked: (Scenario, Curves),
    plane: Plane,
    lines: Vec<Line>,
    starts: Vec<Start>,
    known: KnownCurves,
    /// The starts whose curves are being traced, by the order in which they were handed out.
    traced: Vec<(usize, Start)>,
    handed: usize,
    returned: usize,
    failures: Vec<Failure>,
}

impl CurvesStudy {
    /// Nothing traced yet of the curves of `scenario`'s device.
    ///
    /// # Errors
    /// As [`Plane::new`].
    pub fn new(scenario: Scenario, question: Curves) -> Result<Self, OrbitError> {
        let plane = question.plane()?;
        let search = Search { lines: question.lines, doubled: question.doubled };
        let lines = scenario
            .validate()
            .map_err(OrbitError::from)
            .and_then(|(system, _)| search_lines(&system, &plane, search));
        let (mut lines, failures) = match lines {
            Ok(lines) => (lines, Vec::new()),
            Err(error) => (Vec::new(), vec![error.into()]),
        };
        lines.reverse();
        Ok(Self {
            asked: (scenario, question),
            plane,
            lines,
            starts: Vec::new(),
            known: KnownCurves::new(plane),
            traced: Vec::new(),
            handed: 0,
            returned: 0,
            failures,
        })
    }

    /// The curves found so far.
    pub fn curves(&self) -> &[Curve] {
        self.known.curves()
    }

    /// What kept lines from being searched and starts from being traced.
    pub fn failures(&self) -> &[Failure] {
        &self.failures
    }

    /// Whether another piece under way may trace the curve of `start`: then its end is awaited.
    fn awaited(&self, start: &Start) -> bool {
        self.traced.iter().any(|(_, other)| (other.kind, other.periods) == (start.kind, start.periods))
    }
}

impl Asked for CurvesStudy {
    type Question = (Scenario, Curves);

    fn asked(&self) -> &Self::Question {
        &self.asked
    }
}

impl Study for CurvesStudy {
    fn next(&mut self) -> Option<Order<Self>> {
        self.starts.retain(|start| self.known.is_new(start));
        let (scenario, plane, doubled) = (self.asked.0.clone(), self.plane, self.asked.1.doubled);
        let number = self.handed;
        let free = (0..self.starts.len()).find(|i| !self.awaited(&self.starts[*i]));
        let order = if let Some(i) = free {
            let start = self.starts.swap_remove(i);
            self.traced.push((number, start.clone()));
            Order::new(Trace { scenario, plane, start }, move |study: &mut Self, found| {
                study.returned += 1;
                study.traced.retain(|(other, _)| *other != number);
                match found {
                    Ok(curve) => {
                        let branches = curve.branches();
                        if study.known.add(curve) {
                            study.starts.extend(branches);
                        }
                    }
                    Err(message) => study.failures.push(message),
                }
            })
        } else {
            let line = self.lines.pop()?;
            Order::new(Crossings { scenario, plane, line, doubled }, |study: &mut Self, found| {
                study.returned += 1;
                match found {
                    Ok(starts) => study.starts.extend(starts),
                    Err(message) => study.failures.push(message),
                }
            })
        };
        self.handed += 1;
        Some(order)
    }

    fn progress(&self) -> f64 {
        let left = self.lines.len() + self.starts.len() + self.handed - self.returned;
        self.returned as f64 / (self.returned + left).max(1) as f64
    }

    fn finished(&self) -> bool {
        self.lines.is_empty()
            && self.handed == self.returned
            && self.starts.iter().all(|start| !self.known.is_new(start))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Instability;
    use crate::model::ParameterSet;
    use crate::scheduler::complete;

    #[test]
    fn the_first_tongue_is_found_without_help() {
        let parameters = ParameterSet { alpha: 1e-4, ..Default::default() };
        let scenario = Scenario { parameters, ..Default::default() };
        let axes = [(Parameter::Omega, (7.8, 8.5)), (Parameter::Beta, (0.0, 0.004))];
        let mut study = CurvesStudy::new(scenario, Curves::over(axes)).expect("a window");
        complete(&mut study);
        assert!(study.finished() && study.failures().is_empty(), "{:?}", study.failures());
        let doublings: Vec<_> =
            study.curves().iter().filter(|curve| curve.kind == Instability::PeriodDoubling).collect();
        assert_eq!(doublings.len(), 1);
        // An independent program's boundary: 0.001628 at omega = 8.0969.
        let crossing =
            doublings[0].points.windows(2).find(|pair| pair[0].at[0] <= 8.0969 && pair[1].at[0] > 8.0969);
        let pair = crossing.expect("the curve passes there");
        let share = (8.0969 - pair[0].at[0]) / (pair[1].at[0] - pair[0].at[0]);
        let beta = pair[0].at[1] + share * (pair[1].at[1] - pair[0].at[1]);
        assert!((beta - 0.001628).abs() < 2e-6, "{beta}");
    }
}
