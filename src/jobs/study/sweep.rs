//! A sweep up and down, the state carried from value to value.

use serde::{Deserialize, Serialize};

use super::Study;
use crate::dynamics::attractors::sweep::{Dwell, SweepPoint};
use crate::jobs::response::check_range;
use crate::jobs::work::{Finding, Work};
use crate::model::{ModelError, Parameter, Shaking};
use crate::scenario::Scenario;
use crate::spacing::equally_spaced;

/// Numbers of values a sweep may have.
pub const COUNTS: (usize, usize) = (2, 2000);
/// Values of a piece of work.
const PER_PIECE: usize = 8;

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

/// What is swept.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SweepQuestion {
    /// The device, and the state from which the first value starts.
    pub scenario: Scenario,
    /// What changes.
    pub parameter: Parameter,
    /// How the base is shaken meanwhile.
    #[serde(default)]
    pub shaking: Shaking,
    /// Its lowest and highest value.
    pub range: (f64, f64),
    /// Number of equally spaced values.
    pub count: usize,
    /// How long each is held.
    pub dwell: Dwell,
}

impl SweepQuestion {
    /// Checks everything that is not checked value by value.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range.
    pub fn validate(&self) -> Result<(), ModelError> {
        self.scenario.validate()?;
        check_range(self.parameter, self.range)?;
        let (minimum, maximum) = COUNTS;
        if !(minimum..=maximum).contains(&self.count) {
            return Err(ModelError::Count { field: "count", value: self.count, minimum, maximum });
        }
        self.dwell.validate()
    }

    /// The values in the order of `direction`.
    pub fn values(&self, direction: Direction) -> Vec<f64> {
        let values = equally_spaced(self.range, self.count);
        match direction {
            Direction::Up => values.collect(),
            Direction::Down => values.rev().collect(),
        }
    }
}

/// One way of a sweep.
#[derive(Debug, Clone)]
struct Way {
    direction: Direction,
    values: Vec<f64>,
    points: Vec<SweepPoint>,
    state: Option<Vec<f64>>,
    under_way: bool,
}

/// A sweep being computed, both ways at once: each starts from the scenario's own state.
#[derive(Debug, Clone)]
pub struct SweepStudy {
    question: SweepQuestion,
    ways: Vec<Way>,
    failure: Option<String>,
}

impl SweepStudy {
    /// A sweep in the `directions` given; the question must be valid.
    pub fn new(question: SweepQuestion, directions: &[Direction]) -> Self {
        let way = |direction: &Direction| Way {
            direction: *direction,
            values: question.values(*direction),
            points: Vec::new(),
            state: None,
            under_way: false,
        };
        Self { ways: directions.iter().map(way).collect(), question, failure: None }
    }

    /// What is swept.
    pub fn question(&self) -> &SweepQuestion {
        &self.question
    }

    /// The points so far, in the order in which they were visited.
    pub fn points(&self, direction: Direction) -> &[SweepPoint] {
        self.ways.iter().find(|way| way.direction == direction).map_or(&[], |way| &way.points)
    }

    /// Why the sweep ended early, if it did.
    pub fn failure(&self) -> Option<&str> {
        self.failure.as_deref()
    }
}

impl Study for SweepStudy {
    fn next(&mut self) -> Option<(usize, Work)> {
        if self.failure.is_some() {
            return None;
        }
        let idle = |way: &Way| !way.under_way && way.points.len() < way.values.len();
        let ticket = self.ways.iter().position(idle)?;
        let way = &mut self.ways[ticket];
        way.under_way = true;
        let values = way.values.iter().skip(way.points.len()).take(PER_PIECE).copied().collect();
        let work = Work::Sweep {
            scenario: self.question.scenario.clone(),
            parameter: self.question.parameter,
            shaking: self.question.shaking,
            values,
            state: way.state.clone(),
            dwell: self.question.dwell,
        };
        Some((ticket, work))
    }

    fn take(&mut self, ticket: usize, finding: Result<Finding, String>) {
        let Some(way) = self.ways.get_mut(ticket) else { return };
        way.under_way = false;
        match finding {
            Ok(Finding::Sweep { points, state }) => {
                way.points.extend(points);
                way.state = state;
            }
            Ok(_) => {}
            Err(message) => self.failure = Some(message),
        }
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
