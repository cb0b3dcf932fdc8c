//! The curves of bifurcations of the forced motion in the plane of two parameters: lines across the window are searched
//! for starts, then what is new among these is traced.

use nanoserde::{DeBin, SerBin};

use crate::dynamics::bifurcations::curves::{
    Curve, KnownCurves, Line, Search, Start, bifurcations_along_line, search_lines, trace_curve,
};
use crate::dynamics::{Axis, OrbitError, Plane};
use crate::model::Parameter;
use crate::scenario::Scenario;
use crate::scheduler::{Asked, Failure, Order, Piece, Study};

/// The parameters that a plane may have.
pub const PARAMETERS: [Parameter; 5] =
    [Parameter::Omega, Parameter::Beta, Parameter::Alpha, Parameter::D, Parameter::Kappa];

/// What is traced.
#[derive(Debug, Clone, PartialEq)]
pub struct CurvesQuestion {
    /// The device and its other numbers.
    pub scenario: Scenario,
    /// The window.
    pub plane: Plane,
}

impl CurvesQuestion {
    /// The curves of the device of `scenario` in the window of two parameters with their ranges.
    ///
    /// # Errors
    /// As [`Plane::new`].
    pub fn new(scenario: Scenario, axes: [(Parameter, (f64, f64)); 2]) -> Result<Self, OrbitError> {
        let plane = Plane::new(axes.map(|(parameter, range)| Axis { parameter, range }))?;
        Ok(Self { scenario, plane })
    }
}

/// Bifurcations of the forced motion along a line across a plane of two parameters.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Along {
    /// The device and its other numbers.
    pub scenario: Scenario,
    /// The window.
    pub plane: Plane,
    /// The line.
    pub line: Line,
}

impl Piece for Along {
    const NAME: &'static str = "line";
    type Found = Vec<Start>;

    fn carry_out(&self) -> Result<Vec<Start>, Failure> {
        let (system, _) = self.scenario.validate()?;
        Ok(bifurcations_along_line(&system, &self.plane, self.line, false)?)
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
    question: CurvesQuestion,
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
    /// Nothing traced yet.
    pub fn new(question: CurvesQuestion) -> Self {
        let lines = question
            .scenario
            .validate()
            .map_err(OrbitError::from)
            .and_then(|(system, _)| search_lines(&system, &question.plane, Search::default()));
        let (mut lines, failures) = match lines {
            Ok(lines) => (lines, Vec::new()),
            Err(error) => (Vec::new(), vec![error.into()]),
        };
        lines.reverse();
        let known = KnownCurves::new(question.plane);
        Self {
            question,
            lines,
            starts: Vec::new(),
            known,
            traced: Vec::new(),
            handed: 0,
            returned: 0,
            failures,
        }
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
    type Question = CurvesQuestion;

    fn asked(&self) -> &Self::Question {
        &self.question
    }
}

impl Study for CurvesStudy {
    fn next(&mut self) -> Option<Order<Self>> {
        self.starts.retain(|start| self.known.is_new(start));
        let CurvesQuestion { scenario, plane } = self.question.clone();
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
            Order::new(Along { scenario, plane, line }, |study: &mut Self, found| {
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
        let mut study = CurvesStudy::new(CurvesQuestion::new(scenario, axes).expect("a window"));
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
