//! Chart requests: one quantity over frequency and amplitude of the excitation.

use serde::{Deserialize, Serialize};

use super::checks::{self, Span, class};
use super::error::{RequestError, failed};
use super::motion_chart::MotionChart;
use super::motions::{Coordinate, MotionPlane, SIZES};
use super::multiplier_chart::{self, MultiplierChart};
use super::question::Question;
use crate::dynamics::attractors::motion::Cell;
use crate::model::Parameter;
use crate::scenario::Scenario;
use crate::scheduler::{Asked as _, Budget, complete_within};
use crate::spacing::equally_spaced;

/// A chart; the scenario's beta and omega play no role. A start is followed until its motion is known, whatever the
/// scenario's duration.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Chart {
    /// Frequencies, one a column.
    pub omega: Span,
    /// Amplitudes, one a row.
    pub beta: Span,
    /// What is charted.
    pub quantity: Quantity,
}

/// What a chart shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// The largest Floquet multiplier of the forced motion.
    #[default]
    Multiplier,
    /// The class of the motion reached.
    Motion,
    /// Root mean square of its voltage (V); `voltage` in old links.
    #[serde(alias = "voltage")]
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

impl Chart {
    /// Checks ranges and numbers.
    ///
    /// # Errors
    /// [`RequestError`] naming what is out of range.
    pub fn check(&self) -> Result<(), RequestError> {
        let most = if self.quantity == Quantity::Multiplier { multiplier_chart::SIZES.1 } else { SIZES.1 };
        self.omega.check(Parameter::Omega, most)?;
        self.beta.check(Parameter::Beta, most)
    }

    /// The plane of the motions reached.
    pub fn plane(&self, scenario: Scenario) -> MotionPlane {
        MotionPlane {
            scenario,
            x: (Coordinate::Parameter(Parameter::Omega), self.omega.range()),
            y: (Coordinate::Parameter(Parameter::Beta), self.beta.range()),
            size: (self.omega.count, self.beta.count),
        }
    }

    fn motions(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<Values, RequestError> {
        let plane = self.plane(scenario);
        plane.validate()?;
        let mut chart = MotionChart::new(plane);
        complete_within(&mut chart, budget);
        failed(chart.failure())?;
        Ok(match self.quantity {
            Quantity::Motion => Values::Classes(cells(&chart, |cell| Some(class(cell.motion)))),
            Quantity::Power => {
                Values::Numbers(cells(&chart, |cell| cell.lasts().then_some(cell.measures.power)))
            }
            _ => Values::Numbers(cells(&chart, |cell| cell.lasts().then_some(cell.measures.v_rms))),
        })
    }
}

impl Question for Chart {
    const TASK: &'static str = "chart";
    const TAKES: &'static [&'static str] = &["initial", "t_end"];
    type Answer = ChartAnswer;

    fn answer(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<ChartAnswer, RequestError> {
        self.check()?;
        checks::system(&scenario)?;
        let (values, argument) = if self.quantity == Quantity::Multiplier {
            let mut chart = MultiplierChart::new(scenario, self.omega, self.beta);
            complete_within(&mut chart, budget);
            failed(chart.failure())?;
            let (values, argument) = chart.rows().into_iter().map(|row| (row.modulus, row.argument)).unzip();
            (Values::Numbers(values), Some(argument))
        } else {
            (self.motions(scenario, budget)?, None)
        };
        let places = |span: &Span| equally_spaced(span.range(), span.count).collect();
        Ok(ChartAnswer { omega: places(&self.omega), beta: places(&self.beta), values, argument })
    }
}

/// What `read` makes of each cell, row by row.
fn cells<T>(chart: &MotionChart, read: impl Fn(&Cell) -> Option<T>) -> Vec<Vec<Option<T>>> {
    let (columns, rows) = chart.asked().size;
    let cell = |column, row| chart.cell(column, row).flatten().and_then(|cell| read(&cell));
    (0..rows).map(|row| (0..columns).map(|column| cell(column, row)).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_ranges_are_checked() {
        let chart = |(from, to), count| Chart {
            omega: Span { from, to, count },
            beta: Span { from: 0.0, to: 0.01, count: 16 },
            quantity: Quantity::Multiplier,
        };
        assert!(chart((5.0, 6.0), 16).check().is_ok());
        assert!(chart((5.0, 4.0), 16).check().is_err());
        assert!(chart((5.0, 600.0), 16).check().is_err());
        assert!(chart((5.0, 6.0), 1).check().is_err());
    }
}
