//! Basins of attraction: which motion each start of a plane leads to, and how many there are.

use serde::{Deserialize, Serialize};

use super::checks::{check_ends, class, count, system};
use super::error::{RequestError, failed};
use super::motion_chart::MotionChart;
use super::motions::{Coordinate, MotionPlane, SIZES};
use super::question::Question;
use crate::dynamics::attractors::motion::Cell;
use crate::dynamics::attractors::signature::{Recogniser, Signature};
use crate::model::{ReducedSystem, state_dimension};
use crate::scenario::Scenario;
use crate::scheduler::{Asked, Budget, Order, Study, complete_within};

/// A plane of starts, displacement and velocity of the first mode unless it says otherwise; the scenario's start gives the
/// other components. A start is followed until its motion is known, whatever the scenario's duration.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Basin {
    /// The component of the start that changes along a row; q1 when absent, up to a tip displacement of the gap either way,
    /// which is contact on one side.
    pub x: Option<Side>,
    /// The one that changes from row to row; dq1/dt when absent, up to the velocity of a free vibration that far.
    pub y: Option<Side>,
    /// Numbers of columns and rows where a side does not say; 41 when absent.
    pub count: Option<usize>,
}

/// A side of the plane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "an object such as {\"component\":\"q1\",\"from\":-0.1,\"to\":0.1,\"count\":41}"
)]
pub struct Side {
    /// Name of the component: q1.., dq1/dt.., v.
    pub component: String,
    /// Its lowest value.
    pub from: f64,
    /// Its highest value.
    pub to: f64,
    /// How many; the request's count when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<usize>,
}

/// Basins of attraction.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BasinAnswer {
    /// The component along a row, and its values.
    pub x: Axis,
    /// The component from row to row, and its values, ascending.
    pub y: Axis,
    /// The motions reached, by descending share.
    pub attractors: Vec<AttractorAnswer>,
    /// Row by row an index into them; null where a motion cannot be integrated.
    pub cells: Vec<Vec<Option<usize>>>,
}

/// A side of the plane.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Axis {
    /// Name of the component.
    pub component: String,
    /// Its values.
    pub values: Vec<f64>,
}

/// A motion that starts lead to.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AttractorAnswer {
    /// Its class, such as "period 2"; escapes count as one, contacts and undecided ones too.
    pub motion: String,
    /// Root mean square of the voltage (V); null when it ends.
    pub v_rms: Option<f64>,
    /// Mean electrical power kappa v^2 (dimensionless); null when it ends.
    pub power: Option<f64>,
    /// Lowest and highest tip displacement, in beam lengths; null when it ends.
    pub tip: Option<(f64, f64)>,
    /// A start (length 2N + 1) that leads to it, on it if it is periodic.
    pub start: Vec<f64>,
    /// Cells that lead to it.
    pub cells: usize,
    /// Their share of the cells that lead anywhere, 0 to 1.
    pub fraction: f64,
}

impl AttractorAnswer {
    fn new(attractor: Attractor) -> Self {
        let cell = attractor.cell;
        let measures = cell.lasts().then_some(cell.measures);
        Self {
            motion: class(cell.motion),
            v_rms: measures.map(|measures| measures.v_rms),
            power: measures.map(|measures| measures.power),
            tip: measures.map(|measures| measures.tip),
            start: attractor.start,
            cells: attractor.cells,
            fraction: attractor.fraction,
        }
    }
}

/// Columns and rows that are not given.
const COUNT: usize = 41;

impl Basin {
    fn plane(&self, scenario: Scenario, system: &ReducedSystem) -> Result<MotionPlane, RequestError> {
        let both = self.count.unwrap_or(COUNT);
        count("count", both, SIZES)?;
        let modes = scenario.model.modes;
        let gap = system.equilibrium.gap;
        let omega = system.modes.iter().next().map_or(1.0, |mode| mode.omega);
        let given = |field, side: &Option<Side>, index, most: f64| match side {
            Some(side) => side.coordinate(field, modes).map(|found| (found, side.count.unwrap_or(both))),
            None => Ok(((Coordinate::Start(index), (-most, most)), both)),
        };
        let (x, columns) = given("x", &self.x, 0, gap)?;
        let (y, rows) = given("y", &self.y, modes, omega * gap)?;
        Ok(MotionPlane { scenario, x, y, size: (columns, rows) })
    }
}

impl Side {
    /// The component and its range.
    fn coordinate(&self, field: &str, modes: usize) -> Result<(Coordinate, (f64, f64)), RequestError> {
        let named = Coordinate::named(&self.component, modes);
        let Some(coordinate @ Coordinate::Start(_)) = named else {
            let names: Vec<String> =
                (0..state_dimension(modes)).map(|i| Coordinate::Start(i).name(modes)).collect();
            let problem = format!("`{}` is not available: allowed are {}", self.component, names.join(", "));
            return Err(RequestError::Field { field: format!("{field}.component"), problem });
        };
        let range = (self.from, self.to);
        check_ends(field, range, coordinate.limits(modes))?;
        if let Some(number) = self.count {
            count(&format!("{field}.count"), number, SIZES)?;
        }
        Ok((coordinate, range))
    }
}

impl Question for Basin {
    const TASK: &'static str = "basin";
    const TAKES: &'static [&'static str] = &["initial", "t_end"];
    type Answer = BasinAnswer;

    fn answer(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<BasinAnswer, RequestError> {
        let mut study = BasinStudy::new(scenario, self.clone())?;
        complete_within(&mut study, budget);
        failed(study.chart().failure())?;
        let plane = study.chart().asked();
        let (columns, rows) = plane.size;
        let name = |(coordinate, _): (Coordinate, _)| coordinate.name(plane.scenario.model.modes);
        let row = |row| (0..columns).map(|column| study.shown(column, row).flatten()).collect();
        Ok(BasinAnswer {
            x: Axis {
                component: name(plane.x),
                values: (0..columns).map(|column| plane.place((column, 0))[0]).collect(),
            },
            y: Axis {
                component: name(plane.y),
                values: (0..rows).map(|row| plane.place((0, row))[1]).collect(),
            },
            attractors: study.attractors().into_iter().map(AttractorAnswer::new).collect(),
            cells: (0..rows).map(row).collect(),
        })
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
pub struct BasinStudy {
    asked: (Scenario, Basin),
    chart: MotionChart,
    recogniser: Recogniser,
    /// The start of the scenario, length 2N + 1.
    initial: Vec<f64>,
    known: Vec<Known>,
    /// Numbers of the attractors by descending number of cells, and the place of each number in that list.
    order: Vec<usize>,
    rank: Vec<usize>,
}

impl BasinStudy {
    /// Nothing yet of what `question` asks about `scenario`.
    ///
    /// # Errors
    /// [`RequestError`] naming what is out of range.
    pub fn new(scenario: Scenario, question: Basin) -> Result<Self, RequestError> {
        let system = system(&scenario)?;
        let plane = question.plane(scenario.clone(), &system)?;
        plane.validate()?;
        let initial = scenario.initial.clone().unwrap_or_else(|| vec![0.0; system.dimension()]);
        Ok(Self {
            asked: (scenario, question),
            chart: MotionChart::new(plane),
            recogniser: Recogniser::new(&system),
            initial,
            known: Vec::new(),
            order: Vec::new(),
            rank: Vec::new(),
        })
    }

    /// Indices of the components (q_1..q_N, dq_1/dt.., v) that change from column to column and from row to row, each with
    /// its lowest and highest value.
    pub fn sides(&self) -> [(usize, (f64, f64)); 2] {
        let plane = self.chart.asked();
        [plane.x, plane.y].map(|(coordinate, range)| match coordinate {
            Coordinate::Start(index) => (index, range),
            _ => (0, range),
        })
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

impl Asked for BasinStudy {
    type Question = (Scenario, Basin);

    fn asked(&self) -> &Self::Question {
        &self.asked
    }
}

impl Study for BasinStudy {
    fn next(&mut self) -> Option<Order<Self>> {
        let (motions, places) = self.chart.hand_out()?;
        Some(Order::new(motions, move |study: &mut Self, found| {
            let sides = study.sides();
            let Self { chart, recogniser, initial, known, .. } = study;
            chart.settle(places, found, |signature, place| {
                let Some(signature) = signature else { return 0 };
                let start = || {
                    let mut start = initial.clone();
                    for ((index, _), value) in sides.into_iter().zip(place) {
                        start[index] = value;
                    }
                    start
                };
                recognise(known, recogniser, signature, start) + 1
            });
            study.sort();
        }))
    }

    fn progress(&self) -> f64 {
        self.chart.progress()
    }

    fn finished(&self) -> bool {
        self.chart.finished()
    }

    fn sketches(&self) -> bool {
        self.chart.sketches()
    }

    fn is_replaceable(&self) -> bool {
        self.chart.is_replaceable()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Motion;
    use crate::questions::motions::Motions;
    use crate::scheduler::Finding;

    fn signature(motion: Motion) -> Signature {
        Signature { cell: Cell::new(motion, None), states: Vec::new() }
    }

    #[test]
    fn attractors_keep_their_numbers_while_their_order_changes() {
        let mut basin = basin();
        let mut answer = |pick: fn(usize) -> Option<Motion>| {
            let order = basin.next().expect("work");
            let places = order.piece::<Motions>().expect("motions are asked for").places.len();
            let found: Vec<_> = (0..places).map(|i| pick(i).map(signature)).collect();
            order.found(&mut basin, Ok(Finding::Here(Box::new(found))));
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

    fn basin() -> BasinStudy {
        let question = Basin { count: Some(24), ..Basin::default() };
        BasinStudy::new(Scenario::default(), question).expect("a plane")
    }

    /// The second place that a chart of 24 x 24 cells asks for.
    fn basin_place(index: usize) -> [f64; 2] {
        let order = basin().next().expect("work");
        order.piece::<Motions>().expect("motions are asked for").places[index]
    }
}
