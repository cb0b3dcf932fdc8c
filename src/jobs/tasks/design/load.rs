//! Load requests: power against the load resistance.

use serde::{Deserialize, Serialize};

use super::failed;
use super::harvest::Hertz;
use crate::jobs::RequestError;
use crate::jobs::budget::Budget;
use crate::jobs::design::load::{BestFrequency, LoadPoint, best};
use crate::jobs::design::{Bounds, Plant};
use crate::jobs::study::complete_within;
use crate::jobs::study::load::{LoadQuestion, LoadStudy};
use crate::model::{Limits, ModelError, Parameter, Shaking};
use crate::scenario::Scenario;

/// Highest resistance of a curve (ohm).
const MOST_OHMS: f64 = 1e15;

/// Power against the load.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LoadTask {
    /// Lowest resistance (ohm); by default three decades below the device's own.
    pub from: Option<f64>,
    /// Highest resistance (ohm); by default six decades above the lowest.
    pub to: Option<f64>,
    /// Loads a decade.
    pub per_decade: usize,
    /// Frequencies (Hz) among which the best one is looked for under each load; their number plays no role.
    pub window: Option<Hertz>,
    /// What of the base's motion stays at the best frequency.
    pub hold: Shaking,
    /// What must be kept; the voltage by the ceramic where none is given.
    pub limits: Limits,
}

impl Default for LoadTask {
    fn default() -> Self {
        Self {
            from: None,
            to: None,
            per_decade: 10,
            window: None,
            hold: Shaking::Amplitude,
            limits: Limits::default(),
        }
    }
}

/// Power against the load.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoadAnswer {
    /// The linear device at the own frequency: (ohm, W).
    pub linear: Vec<[f64; 2]>,
    /// Its best load (ohm) and power (W).
    pub linear_best: [f64; 2],
    /// The forced motion, stable or not; null where it is lost.
    pub forced: Vec<Option<LoadPoint>>,
    /// The motion reached, carried from the own load to both sides.
    pub reached: Vec<Option<LoadPoint>>,
    /// The best of these that lasts.
    pub reached_best: Option<LoadPoint>,
    /// The best of these that keeps the limits.
    pub reached_best_within_limits: Option<LoadPoint>,
    /// The best frequency for each load, where a window was given.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub best_frequency: Vec<Option<BestFrequency>>,
}

impl LoadTask {
    pub(super) fn answer(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<LoadAnswer, RequestError> {
        self.limits.validate()?;
        let plant = Plant::new(&scenario)?;
        let window = self.window.map(|window| window.window(&plant)).transpose()?;
        let about = LoadQuestion::about(scenario, window)?;
        let low = self.from.unwrap_or(about.range.0);
        let range = (low, self.to.unwrap_or(if self.from.is_some() { 1e6 * low } else { about.range.1 }));
        // The study does not know how the request names these. The largest conductance taken ends the range.
        let lowest = 1.0 / (plant.units.power * Parameter::Kappa.range().1);
        ModelError::check("from", range.0, (lowest, MOST_OHMS), " ohm")?;
        ModelError::check("to", range.1, (range.0 * (1.0 + 1e-9), MOST_OHMS), " ohm")?;
        let limits = self.limits.completed(&about.scenario.base());
        let bounds = Bounds::new(&plant, limits)?;
        let mut study = LoadStudy::new(LoadQuestion {
            range,
            per_decade: self.per_decade,
            shaking: self.hold,
            limits,
            ..about
        })?;
        complete_within(&mut study, budget);
        failed(study.failure())?;
        let cut = study.best_frequencies().iter().flatten().filter(|best| best.cut).count();
        if cut > 0 {
            let count = study.best_frequencies().len();
            budget.lacks(format!(
                "under {cut} of {count} loads the branches were not followed to their ends, which would take too long \
                 (\"cut\"): a better frequency may be among the rest; a narrower window shows more of them"
            ));
        }
        let reached = || study.reached().iter().flatten().copied();
        Ok(LoadAnswer {
            linear: study.linear().to_vec(),
            linear_best: study.linear_best(),
            forced: study.forced().unwrap_or_default().to_vec(),
            reached: study.reached().to_vec(),
            reached_best: best(reached()),
            reached_best_within_limits: best(reached().filter(|point| bounds.allows(&point.asked()))),
            best_frequency: study.best_frequencies().to_vec(),
        })
    }
}
