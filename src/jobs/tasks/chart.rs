//! Chart requests: one quantity over frequency and amplitude of the excitation.

use serde::{Deserialize, Serialize};

use super::{Answer, Span, class, state};
use crate::dynamics::attractors::motion::Cell;
use crate::jobs::RequestError;
use crate::jobs::budget::Budget;
use crate::jobs::study::complete_within;
use crate::jobs::study::motion_chart::{Coordinate, MotionChart, MotionQuestion, SIZES};
use crate::jobs::study::multiplier_chart::{self, MultiplierChart, MultiplierQuestion};
use crate::model::{ModelError, Parameter, ParameterSet};
use crate::scenario::{END_TIME, ModelChoice, Scenario};

/// A chart.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChartRequest {
    /// The ten numbers; beta and omega play no role.
    #[serde(default)]
    pub parameters: ParameterSet,
    /// Modes and force law.
    #[serde(default)]
    pub model: ModelChoice,
    /// Frequencies, one a column.
    pub omega: Span,
    /// Amplitudes, one a row.
    pub beta: Span,
    /// What is charted.
    pub quantity: Quantity,
    /// Allowed, and without effect: a start is followed until its motion is known.
    #[serde(default = "ChartRequest::default_end")]
    pub t_end: f64,
    /// The start (length 2N + 1), rest when absent.
    #[serde(default)]
    pub initial: Option<Vec<f64>>,
}

/// What a chart shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// The largest Floquet multiplier of the forced motion.
    Multiplier,
    /// The class of the motion reached.
    Motion,
    /// Root mean square of its voltage (V).
    VRms,
    /// Its mean electrical power kappa v^2 (dimensionless).
    Power,
}

/// A chart.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChartAnswer {
    /// Frequencies of the columns (dimensionless).
    pub omega: Vec<f64>,
    /// Amplitudes of the rows (dimensionless), ascending.
    pub beta: Vec<f64>,
    /// One row an amplitude, one value a frequency.
    pub values: Values,
    /// For a multiplier, its absolute argument (radians) in the same way.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub argument: Option<Vec<Vec<Option<f64>>>>,
}

/// The values of a chart, row by row; null where the quantity is not defined.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Values {
    /// Moduli, voltages or powers.
    Numbers(Vec<Vec<Option<f64>>>),
    /// Classes such as "period 1".
    Classes(Vec<Vec<Option<String>>>),
}

impl ChartRequest {
    const fn default_end() -> f64 {
        600.0
    }

    /// Computes the answer.
    ///
    /// # Errors
    /// [`RequestError`] when a number is out of range, or a part of the chart cannot be computed.
    pub fn answer(&self, budget: &Budget<'_>) -> Result<Answer, RequestError> {
        let multipliers = self.quantity == Quantity::Multiplier;
        let most = if multipliers { multiplier_chart::SIZES.1 } else { SIZES.1 };
        self.omega.check(Parameter::Omega, most)?;
        self.beta.check(Parameter::Beta, most)?;
        ModelError::check("t_end", self.t_end, END_TIME, "")?;
        let system = self.model.system(self.parameters)?;
        state("initial", self.initial.as_ref(), system.dimension())?;
        let scenario = Scenario {
            parameters: self.parameters,
            model: self.model,
            initial: self.initial.clone(),
            ..Scenario::default()
        };
        Ok(Answer::Chart(if multipliers {
            self.multipliers(scenario, budget)?
        } else {
            self.motions(scenario, budget)?
        }))
    }

    fn size(&self) -> (usize, usize) {
        (self.omega.count, self.beta.count)
    }

    fn multipliers(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<ChartAnswer, RequestError> {
        let (omega, beta) = (self.omega.range(), self.beta.range());
        let question = MultiplierQuestion { scenario, omega, beta, size: self.size() };
        question.validate()?;
        let mut chart = MultiplierChart::new(question);
        complete_within(&mut chart, budget);
        if let Some(message) = chart.failure() {
            return Err(RequestError::Study(message.to_owned()));
        }
        let question = chart.question();
        let rows = chart.rows();
        Ok(ChartAnswer {
            omega: (0..question.size.0).map(|column| question.omega_at(column)).collect(),
            beta: (0..question.size.1).map(|row| question.beta_at(row)).collect(),
            argument: Some(rows.iter().map(|row| row.argument.clone()).collect()),
            values: Values::Numbers(rows.into_iter().map(|row| row.modulus).collect()),
        })
    }

    fn motions(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<ChartAnswer, RequestError> {
        let question = MotionQuestion {
            scenario,
            x: (Coordinate::Parameter(Parameter::Omega), self.omega.range()),
            y: (Coordinate::Parameter(Parameter::Beta), self.beta.range()),
            size: self.size(),
        };
        question.validate()?;
        let mut chart = MotionChart::new(question);
        complete_within(&mut chart, budget);
        if let Some(message) = chart.failure() {
            return Err(RequestError::Study(message.to_owned()));
        }
        let (columns, rows) = chart.question().size;
        let values = match self.quantity {
            Quantity::Motion => Values::Classes(cells(&chart, |cell| Some(class(cell.motion)))),
            Quantity::Power => Values::Numbers(cells(&chart, |cell| cell.lasts().then_some(cell.power))),
            _ => Values::Numbers(cells(&chart, |cell| cell.lasts().then_some(cell.v_rms))),
        };
        Ok(ChartAnswer {
            omega: (0..columns).map(|column| chart.question().place((column, 0))[0]).collect(),
            beta: (0..rows).map(|row| chart.question().place((0, row))[1]).collect(),
            values,
            argument: None,
        })
    }
}

/// What `read` makes of each cell, row by row.
fn cells<T>(chart: &MotionChart, read: impl Fn(&Cell) -> Option<T>) -> Vec<Vec<Option<T>>> {
    let (columns, rows) = chart.question().size;
    let cell = |column, row| chart.cell(column, row).flatten().and_then(|cell| read(&cell));
    (0..rows).map(|row| (0..columns).map(|column| cell(column, row)).collect()).collect()
}
