//! The curves of bifurcations of the forced motion in the plane of two parameters: lines across the window are searched
//! for starts, then what is new among these is traced.

use serde::{Deserialize, Serialize};

use super::Study;
use crate::dynamics::bifurcations::curves::{Curve, KnownCurves, Line, Search, Start, search_lines};
use crate::dynamics::{Axis, OrbitError, Plane};
use crate::jobs::work::{Finding, Work};
use crate::model::Parameter;
use crate::scenario::Scenario;

/// The parameters that a plane may have.
pub const PARAMETERS: [Parameter; 5] =
    [Parameter::Omega, Parameter::Beta, Parameter::Alpha, Parameter::D, Parameter::Kappa];

/// What is traced.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
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

/// A piece under way.
#[derive(Debug, Clone)]
enum Piece {
    Line,
    Start(Start),
}

/// Curves being traced.
#[derive(Debug, Clone)]
pub struct CurvesStudy {
    question: CurvesQuestion,
    lines: Vec<Line>,
    starts: Vec<Start>,
    known: KnownCurves,
    pieces: Vec<Option<Piece>>,
    returned: usize,
    failures: Vec<String>,
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
            Err(error) => (Vec::new(), vec![error.to_string()]),
        };
        lines.reverse();
        let known = KnownCurves::new(question.plane);
        Self { question, lines, starts: Vec::new(), known, pieces: Vec::new(), returned: 0, failures }
    }

    /// What is traced.
    pub fn question(&self) -> &CurvesQuestion {
        &self.question
    }

    /// The curves found so far.
    pub fn curves(&self) -> &[Curve] {
        self.known.curves()
    }

    /// What kept lines from being searched and starts from being traced.
    pub fn failures(&self) -> &[String] {
        &self.failures
    }

    /// Whether another piece under way may trace the curve of `start`: then its end is awaited.
    fn awaited(&self, start: &Start) -> bool {
        self.pieces.iter().flatten().any(|piece| match piece {
            Piece::Start(other) => (other.kind, other.periods) == (start.kind, start.periods),
            Piece::Line => false,
        })
    }
}

impl Study for CurvesStudy {
    fn next(&mut self) -> Option<(usize, Work)> {
        self.starts.retain(|start| self.known.is_new(start));
        let CurvesQuestion { scenario, plane } = &self.question;
        let free = (0..self.starts.len()).find(|i| !self.awaited(&self.starts[*i]));
        let (piece, work) = if let Some(i) = free {
            let start = self.starts.swap_remove(i);
            let work = Work::Trace { scenario: scenario.clone(), plane: *plane, start: start.clone() };
            (Piece::Start(start), work)
        } else {
            let line = self.lines.pop()?;
            (Piece::Line, Work::Line { scenario: scenario.clone(), plane: *plane, line })
        };
        self.pieces.push(Some(piece));
        Some((self.pieces.len() - 1, work))
    }

    fn take(&mut self, ticket: usize, finding: Result<Finding, String>) {
        if self.pieces.get_mut(ticket).and_then(Option::take).is_none() {
            return;
        }
        self.returned += 1;
        match finding {
            Ok(Finding::Starts(starts)) => self.starts.extend(starts),
            Ok(Finding::Curve(curve)) => {
                let branches = curve.branches();
                if self.known.add(*curve) {
                    self.starts.extend(branches);
                }
            }
            Ok(_) => {}
            Err(message) => self.failures.push(message),
        }
    }

    fn progress(&self) -> f64 {
        let left = self.lines.len() + self.starts.len() + self.pieces.iter().flatten().count();
        self.returned as f64 / (self.returned + left).max(1) as f64
    }

    fn finished(&self) -> bool {
        self.lines.is_empty()
            && self.pieces.iter().all(Option::is_none)
            && self.starts.iter().all(|start| !self.known.is_new(start))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Instability;
    use crate::jobs::study::complete;
    use crate::model::ParameterSet;

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
