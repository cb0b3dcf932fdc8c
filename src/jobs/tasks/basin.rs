//! Basin requests: which motions the starts of a plane lead to.

use serde::{Deserialize, Serialize};

use super::{Answer, check_ends, class, count, state};
use crate::jobs::RequestError;
use crate::jobs::budget::Budget;
use crate::jobs::study::basin::{Attractor, Basin, BasinQuestion};
use crate::jobs::study::complete_within;
use crate::jobs::study::motion_chart::{Coordinate, SIZES};
use crate::model::{ModelError, ParameterSet, state_dimension};
use crate::scenario::{END_TIME, ModelChoice, Scenario};

/// A plane of starts.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BasinRequest {
    /// The ten numbers; missing ones are the paper's.
    pub parameters: ParameterSet,
    /// Modes and force law.
    pub model: ModelChoice,
    /// The component of the start that changes along a row; q1 when absent.
    pub x: Option<Side>,
    /// The one that changes from row to row; dq1/dt when absent.
    pub y: Option<Side>,
    /// The other components of the start (length 2N + 1), rest when absent.
    pub initial: Option<Vec<f64>>,
    /// Allowed, and without effect: a start is followed until its motion is known.
    pub t_end: Option<f64>,
    /// Numbers of columns and rows where a side does not say; 41 when absent.
    pub count: Option<usize>,
}

/// A side of the plane.
#[derive(Debug, Clone, PartialEq, Deserialize)]
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
    #[serde(default)]
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
#[derive(Debug, Clone, PartialEq, Serialize, nanoserde::SerBin, nanoserde::DeBin)]
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
    pub tip: Option<[f64; 2]>,
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
        let lasts = cell.lasts();
        Self {
            motion: class(cell.motion),
            v_rms: lasts.then_some(cell.v_rms),
            power: lasts.then_some(cell.power),
            tip: lasts.then_some([cell.tip.0, cell.tip.1]),
            start: attractor.start,
            cells: attractor.cells,
            fraction: attractor.fraction,
        }
    }
}

impl BasinRequest {
    const COUNT: usize = 41;

    /// Computes the answer.
    ///
    /// # Errors
    /// [`RequestError`] when a number is out of range, or a part of the plane cannot be computed.
    pub fn answer(&self, budget: &Budget<'_>) -> Result<Answer, RequestError> {
        if let Some(t_end) = self.t_end {
            ModelError::check("t_end", t_end, END_TIME, "")?;
        }
        let system = self.model.system(self.parameters)?;
        state("initial", self.initial.as_ref(), system.dimension())?;
        let both = self.count.unwrap_or(Self::COUNT);
        count("count", both, SIZES)?;
        let (parameters, model, initial) = (self.parameters, self.model, self.initial.clone());
        let scenario = Scenario { parameters, model, initial, ..Scenario::default() };
        let mut question = BasinQuestion::first_mode(scenario, (both, both))?;
        if let Some(side) = &self.x {
            question.x = self.side("x", side)?;
            question.size.0 = side.count.unwrap_or(both);
        }
        if let Some(side) = &self.y {
            question.y = self.side("y", side)?;
            question.size.1 = side.count.unwrap_or(both);
        }
        let mut basin = Basin::new(question)?;
        complete_within(&mut basin, budget);
        if let Some(message) = basin.chart().failure() {
            return Err(RequestError::Study(message.to_owned()));
        }
        Ok(Answer::Basin(self.read(&basin)))
    }

    /// A side of the plane: the index of its component, and its range.
    fn side(&self, field: &str, side: &Side) -> Result<(usize, (f64, f64)), RequestError> {
        let modes = self.model.modes;
        let named = Coordinate::named(&side.component, modes);
        let Some(coordinate @ Coordinate::Start(index)) = named else {
            let names: Vec<String> =
                (0..state_dimension(modes)).map(|i| Coordinate::Start(i).name(modes)).collect();
            let problem = format!("`{}` is not available: allowed are {}", side.component, names.join(", "));
            return Err(RequestError::Field { field: format!("{field}.component"), problem });
        };
        let range = (side.from, side.to);
        check_ends(field, range, coordinate.limits(modes))?;
        if let Some(number) = side.count {
            count(&format!("{field}.count"), number, SIZES)?;
        }
        Ok((index, range))
    }

    fn read(&self, basin: &Basin) -> BasinAnswer {
        let question = basin.question();
        let (columns, rows) = question.size;
        let place = |place| question.motions().place(place);
        let name = |index| Coordinate::Start(index).name(self.model.modes);
        let row = |row| (0..columns).map(|column| basin.shown(column, row).flatten()).collect();
        BasinAnswer {
            x: Axis {
                component: name(question.x.0),
                values: (0..columns).map(|column| place((column, 0))[0]).collect(),
            },
            y: Axis {
                component: name(question.y.0),
                values: (0..rows).map(|row| place((0, row))[1]).collect(),
            },
            attractors: basin.attractors().into_iter().map(AttractorAnswer::new).collect(),
            cells: (0..rows).map(row).collect(),
        }
    }
}
