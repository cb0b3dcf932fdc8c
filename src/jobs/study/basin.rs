//! Basins of attraction: which motion each start of a plane leads to, and how many there are.

use serde::{Deserialize, Serialize};

use super::Study;
use super::motion_chart::{Coordinate, MotionChart, MotionQuestion};
use crate::dynamics::attractors::motion::Cell;
use crate::dynamics::attractors::signature::{Recogniser, Signature};
use crate::jobs::work::{Finding, Work};
use crate::model::{ModelError, ReducedSystem};
use crate::scenario::Scenario;

/// What is asked for: a plane of starts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BasinQuestion {
    /// Device, excitation, and the start that the other components have.
    pub scenario: Scenario,
    /// Index of the component (q_1..q_N, dq_1/dt.., v) that changes from column to column, with its value in the first
    /// and in the last one.
    pub x: (usize, (f64, f64)),
    /// The same from row to row.
    pub y: (usize, (f64, f64)),
    /// Number of columns and rows.
    pub size: (usize, usize),
}

impl BasinQuestion {
    /// Displacement and velocity of the first mode, up to a tip displacement of the gap either way, which is contact on
    /// one side, and up to the velocity of a free vibration that far.
    ///
    /// # Errors
    /// [`ModelError`] naming what of the scenario is out of range.
    pub fn first_mode(scenario: Scenario, size: (usize, usize)) -> Result<Self, ModelError> {
        let (system, _) = scenario.validate()?;
        let modes = scenario.model.modes;
        let gap = system.equilibrium.gap;
        let omega = system.modes.iter().next().map_or(1.0, |mode| mode.omega);
        let (x, y) = ((0, (-gap, gap)), (modes, (-omega * gap, omega * gap)));
        Ok(Self { scenario, x, y, size })
    }

    /// The same question about motions.
    pub fn motions(&self) -> MotionQuestion {
        MotionQuestion {
            scenario: self.scenario.clone(),
            x: (Coordinate::Start(self.x.0), self.x.1),
            y: (Coordinate::Start(self.y.0), self.y.1),
            size: self.size,
        }
    }
}

/// A motion that starts of the plane lead to.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Attractor {
    /// Its class, means and extremes. Escapes and contacts count as one each, at the time of the first one met; starts
    /// whose class is not decided count as one too.
    #[serde(flatten)]
    pub cell: Cell,
    /// A start of length 2N + 1 that leads to it: on the motion itself when it is periodic, its last stroboscopic state
    /// when it lasts otherwise, a start of the plane when it ends.
    pub start: Vec<f64>,
    /// In which order it was found, from 0: it stays the same while the chart is filled.
    pub number: usize,
    /// Known cells that lead to it.
    pub cells: usize,
    /// Their share of the known cells that lead anywhere, 0 to 1.
    pub fraction: f64,
}

/// An attractor as it is kept.
#[derive(Debug, Clone)]
struct Known {
    signature: Signature,
    start: Vec<f64>,
    cells: usize,
}

/// Basins being computed from coarse to fine, first along their borders.
#[derive(Debug, Clone)]
pub struct Basin {
    question: BasinQuestion,
    chart: MotionChart,
    recogniser: Recogniser,
    /// The start of the scenario, length 2N + 1.
    initial: Vec<f64>,
    known: Vec<Known>,
    /// Numbers of the attractors by descending number of cells, and the place of each number in that list.
    order: Vec<usize>,
    rank: Vec<usize>,
}

impl Basin {
    /// Nothing yet of what `question` asks for.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range.
    pub fn new(question: BasinQuestion) -> Result<Self, ModelError> {
        let motions = question.motions();
        motions.validate()?;
        let (system, initial): (ReducedSystem, _) = question.scenario.validate()?;
        Ok(Self {
            question,
            chart: MotionChart::new(motions),
            recogniser: Recogniser::new(&system),
            initial,
            known: Vec::new(),
            order: Vec::new(),
            rank: Vec::new(),
        })
    }

    /// What was asked.
    pub fn question(&self) -> &BasinQuestion {
        &self.question
    }

    /// The motions, cell by cell.
    pub fn chart(&self) -> &MotionChart {
        &self.chart
    }

    /// The attractors met so far, by descending fraction.
    pub fn attractors(&self) -> Vec<Attractor> {
        let all = self.known.iter().map(|known| known.cells).sum::<usize>().max(1);
        let attractor = |number: &usize| {
            let known = &self.known[*number];
            Attractor {
                cell: known.signature.cell,
                start: known.start.clone(),
                number: *number,
                cells: known.cells,
                fraction: known.cells as f64 / all as f64,
            }
        };
        self.order.iter().map(attractor).collect()
    }

    /// Index into [`Self::attractors`] of what a cell, or the computed one nearest to it, leads to. The outer `None`:
    /// nothing is known yet; the inner: its motion cannot be integrated.
    pub fn shown(&self, column: usize, row: usize) -> Option<Option<usize>> {
        let group = self.chart.group(column, row)?;
        Some(group.checked_sub(1).map(|number| self.rank[number]))
    }

    fn sort(&mut self) {
        self.order = (0..self.known.len()).collect();
        // Stable: of equals the one found first stays first.
        self.order.sort_by_key(|number| std::cmp::Reverse(self.known[*number].cells));
        self.rank = vec![0; self.known.len()];
        for (rank, number) in self.order.iter().enumerate() {
            self.rank[*number] = rank;
        }
    }
}

/// Number of the motion of `signature` among those `known`, added when it is new; `start` gives a start for it when
/// the motion itself has none.
fn recognise(
    known: &mut Vec<Known>,
    recogniser: &Recogniser,
    signature: Signature,
    start: impl FnOnce() -> Vec<f64>,
) -> usize {
    if let Some(number) = known.iter().position(|known| recogniser.same(&known.signature, &signature)) {
        known[number].cells += 1;
        return number;
    }
    let start = signature.states.first().cloned().unwrap_or_else(start);
    known.push(Known { signature, start, cells: 1 });
    known.len() - 1
}

impl Study for Basin {
    fn next(&mut self) -> Option<(usize, Work)> {
        self.chart.next()
    }

    fn take(&mut self, ticket: usize, finding: Result<Finding, String>) {
        let Self { question, chart, recogniser, initial, known, .. } = self;
        chart.settle(ticket, finding, |signature, place| {
            let Some(signature) = signature else { return 0 };
            let start = || {
                let mut start = initial.clone();
                (start[question.x.0], start[question.y.0]) = (place[0], place[1]);
                start
            };
            recognise(known, recogniser, signature, start) + 1
        });
        self.sort();
    }

    fn progress(&self) -> f64 {
        self.chart.progress()
    }

    fn finished(&self) -> bool {
        self.chart.finished()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Motion;

    fn signature(motion: Motion) -> Signature {
        let (v_rms, power, tip) = (0.0, 0.0, (0.0, 0.0));
        Signature { cell: Cell { motion, v_rms, power, tip, v_peak: 0.0, slope: 0.0 }, states: Vec::new() }
    }

    #[test]
    fn attractors_keep_their_numbers_while_their_order_changes() {
        let question = BasinQuestion::first_mode(Scenario::default(), (24, 24)).expect("a plane");
        let mut basin = Basin::new(question).expect("valid");
        let mut answer = |pick: fn(usize) -> Option<Motion>| {
            let (ticket, work) = basin.next().expect("work");
            let Work::Motions { places, .. } = work else { panic!("motions are asked for") };
            let found = (0..places.len()).map(|i| pick(i).map(signature)).collect();
            basin.take(ticket, Ok(Finding::Motions(found)));
            basin.attractors()
        };
        let first = answer(|i| Some(if i == 0 { Motion::Chaotic } else { Motion::Escape { time: 1.0 } }));
        assert_eq!(first.iter().map(|found| found.number).collect::<Vec<_>>(), [1, 0]);
        // An ended motion has a start of the plane, the first that leads to it.
        let place = basin_place(1);
        assert_eq!((first[0].start[0], first[0].start[2]), (place[0], place[1]));
        let mut last = Vec::new();
        for _ in 0..2 {
            last = answer(|i| (i > 0).then_some(Motion::Chaotic));
        }
        assert_eq!(last.iter().map(|found| found.number).collect::<Vec<_>>(), [0, 1]);
        assert_eq!(basin.shown(0, 0), Some(Some(0)));
        assert!((last.iter().map(|found| found.fraction).sum::<f64>() - 1.0).abs() < 1e-12);
    }

    /// The second place that a chart of 24 x 24 cells asks for.
    fn basin_place(index: usize) -> [f64; 2] {
        let question = BasinQuestion::first_mode(Scenario::default(), (24, 24)).expect("a plane");
        let Some((_, Work::Motions { places, .. })) = Basin::new(question).expect("valid").next() else {
            panic!("motions are asked for")
        };
        places[index]
    }
}
