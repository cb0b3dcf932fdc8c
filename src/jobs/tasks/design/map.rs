//! Map requests: an objective over two of the device's numbers or dimensions.

use serde::{Deserialize, Serialize};

use super::failed;
use crate::jobs::RequestError;
use crate::jobs::budget::Budget;
use crate::jobs::design::find::{Evaluation, FindQuestion, Objective, Variable};
use crate::jobs::motions::Coordinate;
use crate::jobs::study::complete_within;
use crate::jobs::study::map::DesignMap;
use crate::jobs::tasks::count;
use crate::model::Limits;
use crate::scenario::Scenario;

/// Cells that a map may have.
const CELLS: (usize, usize) = (4, 16_384);

/// An objective over two variables.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MapTask {
    /// What goes from column to column.
    pub x: Side,
    /// What goes from row to row.
    pub y: Side,
    /// What is mapped.
    #[serde(default = "MapTask::default_objective")]
    pub objective: Objective,
    /// What must be kept; the voltage by the ceramic where none is given.
    #[serde(default)]
    pub limits: Limits,
}

/// A side of the map.
#[derive(Debug, Clone, PartialEq, Deserialize)]
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

impl MapTask {
    const fn default_objective() -> Objective {
        Objective::Power
    }

    pub(super) fn answer(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<MapAnswer, RequestError> {
        let (columns, rows) = (self.x.count, self.y.count);
        count("cells of the map", columns.saturating_mul(rows), CELLS)?;
        let modes = scenario.model.modes;
        let variables = vec![self.x.variable("x", modes)?, self.y.variable("y", modes)?];
        let question = FindQuestion { scenario, variables, objective: self.objective, limits: self.limits };
        let mut map = DesignMap::new(question, (columns, rows))?;
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
