//! Sweeps: the motion at one value of a parameter after another, the state carried from value to value, and the branches of
//! periodic motions there.

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

use super::checks::{check_ends, count, system};
use super::continuation::Response;
use super::error::{RequestError, failed};
use super::question::Question;
use super::response::{ResponseCurve, response};
use crate::dynamics::attractors::sweep::{Dwell, SweepCourse, SweepPoint, sweep};
use crate::model::{Along, Parameter};
use crate::scenario::Scenario;
use crate::scheduler::{Asked, Budget, Failure, Order, Piece, Study, complete_within};
use crate::spacing::spread;

/// Numbers of values a sweep may have.
pub const COUNTS: (usize, usize) = (2, 2000);
/// Values of a piece of work.
const PER_PIECE: usize = 8;
/// Most stroboscopic voltages of an answer.
const MOST_STROBES: usize = 200_000;

/// Which way a sweep goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    /// From the lowest value to the highest.
    #[default]
    Up,
    /// From the highest value to the lowest.
    Down,
}

/// A sweep; the scenario's own value of the parameter swept plays no role.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sweep {
    /// What is swept.
    pub parameter: Parameter,
    /// Its lowest value.
    pub from: f64,
    /// Its highest value.
    pub to: f64,
    /// Number of equally spaced values.
    #[serde(default = "default_count")]
    pub count: usize,
    /// Which end the sweep starts from.
    #[serde(default)]
    pub direction: Direction,
    /// Excitation periods thrown away at each value.
    #[serde(default = "default_transient")]
    pub transient: usize,
    /// Excitation periods kept at each value.
    #[serde(default = "default_kept")]
    pub kept: usize,
    /// Whether the branches of periodic motions are followed too.
    #[serde(default)]
    pub branches: bool,
    /// What follows the frequency meanwhile; requests leave it as it is.
    #[serde(skip)]
    pub along: Along,
    /// Whether the values are equally spaced on a logarithmic scale, between positive ends; requests leave it as it is.
    #[serde(skip)]
    pub logarithmic: bool,
}

const fn default_count() -> usize {
    101
}

fn default_transient() -> usize {
    Dwell::default().discarded
}

fn default_kept() -> usize {
    Dwell::default().kept
}

impl Sweep {
    /// Its lowest and highest value.
    pub fn range(&self) -> (f64, f64) {
        (self.from, self.to)
    }

    /// How long each value is held.
    pub fn dwell(&self) -> Dwell {
        Dwell { discarded: self.transient, kept: self.kept }
    }

    /// The branches of periodic motions over its range; no start leads to them.
    pub fn response(&self, scenario: &Scenario) -> Response {
        Response::forced(scenario, self.parameter, self.along.shaking, self.range())
    }

    /// The values in the order of `direction`.
    pub fn values(&self, direction: Direction) -> Vec<f64> {
        let values = spread(self.range(), self.logarithmic, self.count);
        match direction {
            Direction::Up => values.collect(),
            Direction::Down => values.rev().collect(),
        }
    }

    /// Checks its fields.
    ///
    /// # Errors
    /// [`RequestError`] naming what is out of range.
    pub fn check(&self) -> Result<(), RequestError> {
        check_ends(self.parameter.field(), self.range(), self.parameter.range())?;
        count("count", self.count, COUNTS)?;
        count("transient", self.transient, Dwell::DISCARDED)?;
        count("kept", self.kept, Dwell::KEPT)
    }
}

/// A sweep.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SweepAnswer {
    /// One a value, in the order in which they were visited.
    pub points: Vec<SweepPoint>,
    /// The forced motion and the doubled ones that leave it, stable or not, when they were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub branches: Option<Vec<ResponseCurve>>,
}

impl Question for Sweep {
    const TASK: &'static str = "sweep";
    const TAKES: &'static [&'static str] = &["initial"];
    type Answer = SweepAnswer;

    fn answer(&self, mut scenario: Scenario, budget: &Budget<'_>) -> Result<SweepAnswer, RequestError> {
        self.check()?;
        count("count times kept", self.count * self.kept, (1, MOST_STROBES))?;
        *scenario.parameters.get_mut(self.parameter) = self.from;
        system(&scenario)?;
        let mut study = SweepStudy::new(scenario.clone(), self.clone(), &[self.direction]);
        complete_within(&mut study, budget);
        failed(study.failure())?;
        let follow = || response(&scenario, (self.parameter, self.along), self.range());
        let branches = self.branches.then(|| budget.piece(follow)).flatten().transpose()?;
        if branches.iter().flatten().any(|branch| branch.cut) {
            budget
                .lacks("the branches were not followed to their ends, which would take too long".to_owned());
        }
        Ok(SweepAnswer { points: study.points(self.direction).to_vec(), branches })
    }
}

/// Neighbouring values of a sweep.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Stretch {
    /// The device, and the start when `state` is absent.
    pub scenario: Scenario,
    /// What is swept.
    pub parameter: Parameter,
    /// What follows the frequency meanwhile.
    pub along: Along,
    /// Its values in the order in which they are visited.
    pub values: Vec<f64>,
    /// State carried over from the value before (length 2N + 1).
    pub state: Option<Vec<f64>>,
    /// How long each value is held.
    pub dwell: Dwell,
}

/// The motions at the values of a stretch.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Swept {
    /// One a value.
    pub points: Vec<SweepPoint>,
    /// State to go on from (length 2N + 1); absent when the motion ended early.
    pub state: Option<Vec<f64>>,
}

impl Piece for Stretch {
    const NAME: &'static str = "sweep";
    type Found = Swept;

    fn carry_out(&self) -> Result<Swept, Failure> {
        let (_, start) = self.scenario.validate()?;
        let course = SweepCourse {
            set: &self.scenario.parameters,
            model: self.scenario.model,
            parameter: self.parameter,
            along: self.along,
            start: &start,
            dwell: self.dwell,
        };
        let (points, state) = sweep(course, &self.values, self.state.as_deref())?;
        Ok(Swept { points, state })
    }
}

/// One way of a sweep.
#[derive(Debug, Clone)]
struct Way {
    direction: Direction,
    values: Vec<f64>,
    points: Vec<SweepPoint>,
    state: Option<Vec<f64>>,
    /// How many values were done, and the state to go on from, at each piece.
    begun: Vec<(usize, Option<Vec<f64>>)>,
    under_way: bool,
}

/// A sweep being computed, both ways at once: each starts from the scenario's own state.
#[derive(Debug, Clone)]
pub struct SweepStudy {
    /// With the device, and the state from which the first value starts.
    asked: (Scenario, Sweep),
    ways: Vec<Way>,
    failure: Option<Failure>,
}

impl SweepStudy {
    /// A sweep in the `directions` given, whatever the question's own; the question must be valid.
    pub fn new(scenario: Scenario, question: Sweep, directions: &[Direction]) -> Self {
        let way = |direction: &Direction| Way {
            direction: *direction,
            values: question.values(*direction),
            points: Vec::new(),
            state: None,
            begun: Vec::new(),
            under_way: false,
        };
        Self { ways: directions.iter().map(way).collect(), asked: (scenario, question), failure: None }
    }

    /// What is swept.
    pub fn question(&self) -> &Sweep {
        &self.asked.1
    }

    /// The points so far, in the order in which they were visited.
    pub fn points(&self, direction: Direction) -> &[SweepPoint] {
        self.ways.iter().find(|way| way.direction == direction).map_or(&[], |way| &way.points)
    }

    /// The beginning of the piece in which a value (by its index) was visited, and the state (length 2N + 1) there; rest when
    /// absent.
    pub(super) fn begun(&self, direction: Direction, index: usize) -> Option<&(usize, Option<Vec<f64>>)> {
        let way = self.ways.iter().find(|way| way.direction == direction)?;
        way.begun.iter().rev().find(|(begin, _)| *begin <= index)
    }

    /// Why the sweep ended early, if it did.
    pub fn failure(&self) -> Option<&Failure> {
        self.failure.as_ref()
    }
}

impl Asked for SweepStudy {
    type Question = (Scenario, Sweep);

    fn asked(&self) -> &Self::Question {
        &self.asked
    }
}

impl Study for SweepStudy {
    fn next(&mut self) -> Option<Order<Self>> {
        if self.failure.is_some() {
            return None;
        }
        let idle = |way: &Way| !way.under_way && way.points.len() < way.values.len();
        let number = self.ways.iter().position(idle)?;
        let way = &mut self.ways[number];
        way.under_way = true;
        way.begun.push((way.points.len(), way.state.clone()));
        let values = way.values.iter().skip(way.points.len()).take(PER_PIECE).copied().collect();
        let (scenario, question) = &self.asked;
        let stretch = Stretch {
            scenario: scenario.clone(),
            parameter: question.parameter,
            along: question.along,
            values,
            state: way.state.clone(),
            dwell: question.dwell(),
        };
        Some(Order::new(stretch, move |study: &mut Self, found| match found {
            Ok(found) => {
                let way = &mut study.ways[number];
                way.under_way = false;
                way.points.extend(found.points);
                way.state = found.state;
            }
            Err(message) => study.failure = Some(message),
        }))
    }

    fn progress(&self) -> f64 {
        let (done, all) = self
            .ways
            .iter()
            .fold((0, 0), |(done, all), way| (done + way.points.len(), all + way.values.len()));
        done as f64 / all.max(1) as f64
    }

    fn finished(&self) -> bool {
        self.failure.is_some() || self.ways.iter().all(|way| way.points.len() == way.values.len())
    }
}
