//! A map of any objective of the design bench over two of the device's numbers or dimensions, from coarse to fine.

use serde::{Deserialize, Serialize};

use super::checks::count;
use super::design::space::{DesignSpace, Evaluation, Objective, Variable};
use super::error::{RequestError, failed};
use super::find::{Evaluate, held};
use super::motions::Coordinate;
use super::question::Question;
use crate::model::{Limits, ModelError, Shaking};
use crate::scenario::{Scenario, counted};
use crate::scheduler::mosaic::{Mosaic, Place};
use crate::scheduler::{Asked, Budget, Failure, Order, Study, complete_within};
use crate::spacing::between;

/// Columns and rows a map may have.
pub const SIZES: (usize, usize) = (2, 256);

/// Cells that a map may have.
const CELLS: (usize, usize) = (4, 16_384);

/// An objective over two variables.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Map {
    /// What goes from column to column.
    pub x: Side,
    /// What goes from row to row.
    pub y: Side,
    /// What is mapped.
    #[serde(default = "default_objective")]
    pub objective: Objective,
    /// What must be kept; the voltage by the ceramic where none is given.
    #[serde(default)]
    pub limits: Limits,
    /// What of the base's motion cells have in common.
    #[serde(default)]
    pub hold: Shaking,
}

/// A side of the map.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Side {
    /// One of the ten numbers, or a dimension of the device such as `resistance`.
    pub name: String,
    /// Its lowest value.
    pub from: f64,
    /// Its highest value.
    pub to: f64,
    /// How many values.
    #[serde(default = "Side::default_count")]
    pub count: usize,
    /// Whether they are equally spaced on a logarithmic scale.
    #[serde(default)]
    pub logarithmic: bool,
}

impl Side {
    const fn default_count() -> usize {
        21
    }

    fn variable(&self, side: &str, modes: usize) -> Result<Variable, RequestError> {
        let coordinate = Coordinate::named(&self.name, modes).ok_or_else(|| RequestError::Field {
            field: format!("{side}.name"),
            problem: format!(
                "`{}` is not available: allowed are the ten numbers and the device's dimensions",
                self.name
            ),
        })?;
        Ok(Variable { coordinate, range: (self.from, self.to), logarithmic: self.logarithmic })
    }
}

/// An objective over two variables.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MapAnswer {
    /// Values of the columns.
    pub x: Vec<f64>,
    /// Values of the rows.
    pub y: Vec<f64>,
    /// The objective in its unit, row by row; null without a device or a lasting motion.
    pub values: Vec<Vec<Option<f64>>>,
    /// By how much limits are violated, in the same way; 0 where all are kept, 1000 without a motion to judge.
    pub violation: Vec<Vec<Option<f64>>>,
    /// The best cell that keeps the limits.
    pub best: Option<BestCell>,
}

/// A cell of the map.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BestCell {
    /// Its value of `x`.
    pub x: f64,
    /// Its value of `y`.
    pub y: f64,
    /// What is known of it.
    pub evaluation: Evaluation,
}

const fn default_objective() -> Objective {
    Objective::Power
}

impl Question for Map {
    const TASK: &'static str = "map";
    const TAKES: &'static [&'static str] = &["initial", "t_end"];
    const COUNTS_LOSS: bool = true;
    type Answer = MapAnswer;

    fn answer(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<MapAnswer, RequestError> {
        scenario.validate()?;
        let (columns, rows) = (self.x.count, self.y.count);
        count("cells of the map", columns.saturating_mul(rows), CELLS)?;
        let modes = scenario.model.modes;
        let variables = vec![self.x.variable("x", modes)?, self.y.variable("y", modes)?];
        let acceleration = held(self.hold, &scenario);
        let (objective, limits) = (self.objective, self.limits);
        let space = DesignSpace { scenario, variables, objective, limits, acceleration };
        let mut map = DesignMap::new(space, (columns, rows))?;
        complete_within(&mut map, budget);
        failed(map.failure())?;
        let table = |part: &dyn Fn(&Evaluation) -> Option<f64>| {
            let row = |row| (0..columns).map(|column| map.cell((column, row)).and_then(part)).collect();
            (0..rows).map(row).collect()
        };
        Ok(MapAnswer {
            x: (0..columns).map(|column| map.values((column, 0))[0]).collect(),
            y: (0..rows).map(|row| map.values((0, row))[1]).collect(),
            values: table(&|cell| cell.value),
            violation: table(&|cell| Some(cell.violation)),
            best: map.best().map(|(place, evaluation)| {
                let [x, y] = map.values(place);
                BestCell { x, y, evaluation }
            }),
        })
    }
}

/// A map being computed, first where limits begin to be violated or a motion changes its class.
#[derive(Debug, Clone)]
pub struct DesignMap {
    space: DesignSpace,
    size: (usize, usize),
    tiles: Mosaic<Evaluation>,
    failure: Option<Failure>,
    version: u64,
}

impl DesignMap {
    /// An empty map: the first of the space's two variables goes from column to column, the second from row to row.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range, or when there are not two variables.
    pub fn new(space: DesignSpace, size: (usize, usize)) -> Result<Self, ModelError> {
        space.validate()?;
        counted("variables", space.variables.len(), (2, 2))?;
        counted("columns", size.0, SIZES)?;
        counted("rows", size.1, SIZES)?;
        let tiles = Mosaic::new(size.0, size.1);
        Ok(Self { space, size, tiles, failure: None, version: 0 })
    }

    /// Columns and rows.
    pub fn size(&self) -> (usize, usize) {
        self.size
    }

    /// The two variables' values at a cell.
    pub fn values(&self, (column, row): Place) -> [f64; 2] {
        let share = |index: usize, count: usize| between((0.0, 1.0), index, count);
        let [x, y] = [0, 1].map(|axis| self.space.variables[axis]);
        [x.at(share(column, self.size.0)), y.at(share(row, self.size.1))]
    }

    /// The cell, or the computed one nearest to it; `None` while nothing is known.
    pub fn shown(&self, place: Place) -> Option<&Evaluation> {
        self.tiles.shown(place)
    }

    /// The cell itself; `None` until it is known.
    pub fn cell(&self, place: Place) -> Option<&Evaluation> {
        self.tiles.get(place)
    }

    /// The best cell known that keeps the limits.
    pub fn best(&self) -> Option<(Place, Evaluation)> {
        let (columns, rows) = self.size;
        let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        let rank = |evaluation: &Evaluation| evaluation.rank(&self.space.objective).1;
        places
            .filter_map(|place| self.cell(place).map(|evaluation| (place, *evaluation)))
            .filter(|(_, evaluation)| evaluation.violation == 0.0 && evaluation.value.is_some())
            .max_by(|(_, a), (_, b)| rank(a).total_cmp(&rank(b)))
    }

    /// Grows with every change, so that a picture knows when it is old.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Why the map is incomplete, if it is and will stay so.
    pub fn failure(&self) -> Option<&Failure> {
        self.failure.as_ref()
    }
}

/// Whether two cells lie on different sides of a border.
fn differ(a: &Evaluation, b: &Evaluation) -> bool {
    let alike = match (&a.motion, &b.motion) {
        (Some(a), Some(b)) => a.same_class(b),
        (None, None) => a.value.is_some() == b.value.is_some(),
        _ => false,
    };
    !alike || (a.violation == 0.0) != (b.violation == 0.0)
}

impl Asked for DesignMap {
    type Question = DesignSpace;

    fn asked(&self) -> &Self::Question {
        &self.space
    }
}

impl Study for DesignMap {
    fn next(&mut self) -> Option<Order<Self>> {
        if self.failure.is_some() {
            return None;
        }
        let place = *self.tiles.hand_out(1, differ).first()?;
        let piece = Evaluate { space: self.space.clone(), values: self.values(place).to_vec() };
        Some(Order::new(piece, move |map: &mut Self, found| {
            map.version += 1;
            match found {
                Ok(evaluation) => map.tiles.put(place, evaluation),
                Err(message) => map.failure = Some(message),
            }
        }))
    }

    fn progress(&self) -> f64 {
        self.tiles.progress()
    }

    fn finished(&self) -> bool {
        self.failure.is_some() || self.tiles.progress() == 1.0
    }
}
