//! A chart of the motion reached, over any two numbers of the device, its excitation and its start.

use super::motions::{MotionPlane, Motions};
use crate::dynamics::attractors::motion::{Cell, Motion};
use crate::dynamics::attractors::signature::Signature;
use crate::scheduler::mosaic::{Mosaic, Place};
use crate::scheduler::{Asked, Failure, Order, Study};

/// Cells of a piece of work where most motions are periodic or end (1.5 ms each with two modes), and where most are
/// tori or chaotic (15 to 25 ms): some 50 ms either way in the browser, little enough to drop when the question changes,
/// long enough not to spend it on messages.
const QUICK_PIECE: usize = 24;
const SLOW_PIECE: usize = 3;

/// A cell and the group it belongs to: neighbours of different groups are refined first.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Tile {
    cell: Option<Cell>,
    group: usize,
}

impl Tile {
    fn differs(&self, other: &Self) -> bool {
        let alike = match (&self.cell, &other.cell) {
            (Some(a), Some(b)) => a.motion.same_class(&b.motion),
            (None, None) => true,
            _ => false,
        };
        self.group != other.group || !alike
    }
}

/// A chart being computed from coarse to fine, first where classes differ.
#[derive(Debug, Clone)]
pub struct MotionChart {
    question: MotionPlane,
    tiles: Mosaic<Tile>,
    /// Cells of the next piece.
    piece: usize,
    /// Whether most motions of the last one were slow.
    is_slow: bool,
    failure: Option<Failure>,
    version: u64,
}

impl MotionChart {
    /// An empty chart; the question must be valid.
    pub fn new(question: MotionPlane) -> Self {
        let (columns, rows) = question.size;
        let tiles = Mosaic::new(columns, rows);
        Self { tiles, question, piece: SLOW_PIECE, is_slow: false, failure: None, version: 0 }
    }

    /// Grows with every change, so that a picture knows when it is old.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Why the chart is incomplete, if it is and will stay so.
    pub fn failure(&self) -> Option<&Failure> {
        self.failure.as_ref()
    }

    /// What is shown at a cell: its own motion, or that of the computed one nearest to it. The outer `None`: nothing is
    /// known yet; the inner: there is no device, or its motion cannot be integrated.
    pub fn shown(&self, column: usize, row: usize) -> Option<Option<Cell>> {
        self.tiles.shown((column, row)).map(|tile| tile.cell)
    }

    /// The cell itself, in the same way; the outer `None` until it is known.
    pub fn cell(&self, column: usize, row: usize) -> Option<Option<Cell>> {
        self.tiles.get((column, row)).map(|tile| tile.cell)
    }

    /// The group of the cell shown.
    pub(super) fn group(&self, column: usize, row: usize) -> Option<usize> {
        self.tiles.shown((column, row)).map(|tile| tile.group)
    }

    /// The next piece, with the cells that it is about.
    pub(super) fn hand_out(&mut self) -> Option<(Motions, Vec<Place>)> {
        if self.failure.is_some() {
            return None;
        }
        let cells = self.tiles.hand_out(self.piece, Tile::differs);
        let places: Vec<[f64; 2]> = cells.iter().map(|cell| self.question.place(*cell)).collect();
        (!places.is_empty()).then(|| (Motions { plane: self.question.clone(), places }, cells))
    }

    /// Takes what was found in `places`; `group` puts each motion, known with its place, into a group.
    pub(super) fn settle(
        &mut self,
        places: Vec<Place>,
        found: Result<Vec<Option<Signature>>, Failure>,
        mut group: impl FnMut(Option<Signature>, [f64; 2]) -> usize,
    ) {
        self.version += 1;
        match found {
            Ok(found) => {
                let slow = found.iter().flatten().filter(|signature| is_slow(&signature.cell)).count();
                self.is_slow = 2 * slow > found.len();
                self.piece = if self.is_slow { SLOW_PIECE } else { QUICK_PIECE };
                for (place, signature) in places.into_iter().zip(found) {
                    let cell = signature.as_ref().map(|signature| signature.cell);
                    let group = group(signature, self.question.place(place));
                    self.tiles.put(place, Tile { cell, group });
                }
            }
            Err(message) => self.failure = Some(message),
        }
    }
}

/// Whether a cell was followed for its Lyapunov exponent.
fn is_slow(cell: &Cell) -> bool {
    cell.lasts() && !matches!(cell.motion, Motion::Periodic { .. })
}

impl Asked for MotionChart {
    type Question = MotionPlane;

    fn asked(&self) -> &Self::Question {
        &self.question
    }
}

impl Study for MotionChart {
    fn next(&mut self) -> Option<Order<Self>> {
        let (motions, places) = self.hand_out()?;
        Some(Order::new(motions, |chart: &mut Self, found| chart.settle(places, found, |_, _| 0)))
    }

    fn progress(&self) -> f64 {
        self.tiles.progress()
    }

    fn finished(&self) -> bool {
        self.failure.is_some() || self.tiles.progress() == 1.0
    }

    fn sketches(&self) -> bool {
        // A first picture of slow motions is for the background.
        self.failure.is_none() && !self.is_slow && self.tiles.sketches()
    }

    fn is_replaceable(&self) -> bool {
        self.finished() || self.is_slow || self.tiles.is_sketched()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::{Effort, reach};
    use crate::model::{Parameter, ParameterSet};
    use crate::questions::motions::Coordinate;
    use crate::scenario::Scenario;
    use crate::scheduler::complete;

    fn question(size: (usize, usize)) -> MotionPlane {
        let parameters = ParameterSet { alpha: 1e-4, ..Default::default() };
        MotionPlane {
            scenario: Scenario { parameters, ..Default::default() },
            x: (Coordinate::Parameter(Parameter::Omega), (7.9, 8.3)),
            y: (Coordinate::Parameter(Parameter::Beta), (1e-4, 4e-3)),
            size,
        }
    }

    #[test]
    fn every_cell_is_what_its_start_leads_to() {
        let question = question((9, 7));
        question.validate().expect("a valid chart");
        let mut chart = MotionChart::new(question.clone());
        complete(&mut chart);
        assert!(chart.finished() && chart.failure().is_none() && chart.progress() == 1.0);
        let mut doubled = 0;
        for (column, row) in (0..7).flat_map(|row| (0..9).map(move |column| (column, row))) {
            let [omega, beta] = question.place((column, row));
            let set = ParameterSet { omega, beta, ..question.scenario.parameters };
            let system = question.scenario.model.system(set).expect("a device");
            let expected = reach(&system, &[0.0; 5], Effort::cell()).expect("a motion").cell();
            let shown = chart.shown(column, row).flatten().expect("known");
            assert!(shown.motion.same_class(&expected.motion), "{column} {row}: {shown:?}");
            // Found near a neighbour's motion, it is the same up to where Newton's iteration stops.
            let (a, b) = (shown.measures.v_rms, expected.measures.v_rms);
            assert!((a - b).abs() <= 1e-8 * b, "{column} {row}: {a} {b}");
            doubled += usize::from(expected.motion == Motion::Periodic { periods: 2 });
        }
        // The tongue of the first subharmonic is in the picture.
        assert!((5..58).contains(&doubled), "{doubled}");
    }

    #[test]
    fn a_first_picture_is_drawn_before_anything_else_and_is_enough_for_a_newer_question() {
        let mut chart = MotionChart::new(question((80, 60)));
        let mut cells = 0;
        while chart.sketches() {
            assert!(!chart.is_replaceable());
            let order = chart.next().expect("work");
            cells += order.piece::<Motions>().expect("motions are asked for").places.len();
            let found = order.carry_out();
            order.found(&mut chart, found);
        }
        assert!(chart.is_replaceable() && !chart.finished());
        // Every fourth column and row, and what fills the last piece.
        assert!((300..300 + QUICK_PIECE).contains(&cells), "{cells}");
        assert!((0..60).all(|row| (0..80).all(|column| chart.shown(column, row).is_some())));
    }

    #[test]
    fn a_place_without_a_device_is_an_empty_cell_of_a_whole_chart() {
        let parameters = ParameterSet { c0: -0.5, d: 1.5, ..Default::default() };
        let scenario = Scenario { parameters, ..Default::default() };
        let (x, y) = (Coordinate::Parameter(Parameter::D), Coordinate::Start(0));
        let question = MotionPlane { scenario, x: (x, (0.05, 1.5)), y: (y, (0.0, 0.01)), size: (5, 2) };
        let mut chart = MotionChart::new(question);
        complete(&mut chart);
        assert!(chart.finished() && chart.failure().is_none());
        assert_eq!(chart.cell(0, 0), Some(None));
        assert!(matches!(chart.cell(4, 0), Some(Some(_))));
    }

    #[test]
    fn sides_and_sizes_are_checked() {
        assert!(question((16, 16)).validate().is_ok());
        assert!(question((1, 16)).validate().is_err());
        assert!(question((16, 513)).validate().is_err());
        let side = question((16, 16)).x;
        let same = MotionPlane { y: side, ..question((16, 16)) }.validate();
        let message = "both sides of the chart are omega: they must differ";
        assert_eq!(same.map_err(|error| error.to_string()), Err(message.to_owned()));
        let start = (Coordinate::Start(5), (0.0, 1.0));
        assert!(MotionPlane { y: start, ..question((16, 16)) }.validate().is_err());
    }

    #[test]
    fn a_failed_piece_ends_the_chart() {
        let mut chart = MotionChart::new(question((16, 16)));
        let order = chart.next().expect("work");
        order.found(&mut chart, Err(Failure::Verbatim("no".to_owned())));
        assert!(chart.finished() && chart.next().is_none());
        assert_eq!(chart.failure().map(ToString::to_string).as_deref(), Some("no"));
    }
}
