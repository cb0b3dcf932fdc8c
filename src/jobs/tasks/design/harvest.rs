//! Harvest requests: what a device delivers at its excitation, and over frequency.

use serde::{Deserialize, Serialize};

use super::failed;
use crate::dynamics::sweep::Dwell;
use crate::jobs::RequestError;
use crate::jobs::design::band::{half_power, total, usable};
use crate::jobs::design::linear::LinearCurve;
use crate::jobs::design::{Interval, Operating, Plant, operating};
use crate::jobs::study::complete;
use crate::jobs::study::harvest::{HarvestPoint, HarvestQuestion, HarvestStudy};
use crate::jobs::study::sweep::Direction;
use crate::model::ModelError;
use crate::scenario::Scenario;

/// What the device harvests.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct HarvestTask {
    /// Frequencies of the curves; no curves when absent.
    pub frequency: Option<Hertz>,
    /// Power (W) that counts as usable, for the bands.
    pub least: Option<f64>,
}

/// Equally spaced frequencies.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hertz {
    /// The lowest (Hz).
    pub from: f64,
    /// The highest (Hz).
    pub to: f64,
    /// How many.
    #[serde(default = "Hertz::default_count")]
    pub count: usize,
}

impl Hertz {
    const fn default_count() -> usize {
        41
    }

    /// As dimensionless angular frequencies of `plant`.
    ///
    /// # Errors
    /// [`ModelError`] unless both are positive and ascending.
    pub(super) fn window(&self, plant: &Plant) -> Result<(f64, f64), ModelError> {
        let lowest = plant.units.hertz(0.1);
        let highest = plant.units.hertz(500.0);
        let from = ModelError::check("frequency.from", self.from, (lowest, highest), " Hz")?;
        let to = ModelError::check("frequency.to", self.to, (from, highest), " Hz")?;
        Ok((plant.units.omega(from), plant.units.omega(to)))
    }
}

/// What the device harvests.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HarvestAnswer {
    /// At its own excitation.
    #[serde(flatten)]
    pub operating: Operating,
    /// Over frequency, at its own amplitude of the base.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub curves: Option<Curves>,
}

/// Power over frequency.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Curves {
    /// The device without magnets.
    pub linear: LinearCurve,
    /// The forced motion and the doubled ones that leave it.
    pub branches: Vec<BranchCurve>,
    /// What is reached from rest at each frequency: class and point, null where it ended.
    pub from_rest: Vec<Option<(String, HarvestPoint)>>,
    /// What a sweep up reaches.
    pub up: Vec<HarvestPoint>,
    /// What a sweep down reaches.
    pub down: Vec<HarvestPoint>,
    /// Bands of these curves.
    pub bands: Vec<Band>,
}

/// A branch of periodic motions.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BranchCurve {
    /// Period in excitation periods.
    pub periods: usize,
    /// Its points.
    pub points: Vec<HarvestPoint>,
    /// Whether each is stable.
    pub stable: Vec<bool>,
}

/// The bands of a curve.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Band {
    /// Which curve.
    pub of: &'static str,
    /// About its highest point, where at least half of its power is reached.
    pub half_power: Option<Interval>,
    /// Where at least `least` is reached.
    pub usable: Vec<Interval>,
    /// Width of these together (Hz).
    pub total: f64,
}

impl HarvestTask {
    pub(super) fn answer(&self, scenario: Scenario) -> Result<HarvestAnswer, RequestError> {
        let operating = operating(&scenario)?;
        let curves = self.frequency.map(|frequency| self.curves(scenario, frequency)).transpose()?;
        Ok(HarvestAnswer { operating, curves })
    }

    fn curves(&self, scenario: Scenario, frequency: Hertz) -> Result<Curves, RequestError> {
        let window = frequency.window(&Plant::new(&scenario)?)?;
        let dwell = Dwell::default();
        let mut study =
            HarvestStudy::new(HarvestQuestion { scenario, window, count: frequency.count, dwell })?;
        complete(&mut study);
        failed(study.failure())?;
        let branches = study.branches().and_then(Result::ok).unwrap_or_default();
        let branch = |curve| {
            let (points, stable) = study.branch_points(curve).into_iter().unzip();
            BranchCurve { periods: curve.periods, points, stable }
        };
        let class = |(motion, point)| (super::super::class(motion), point);
        let linear = study.linear().clone();
        let least = self.least.unwrap_or(0.5 * linear.peak[1]);
        let band = |of, curves: Vec<Vec<[f64; 2]>>| {
            let usable = usable(&curves, least);
            Band { of, half_power: half_power(&curves), total: total(&usable), usable }
        };
        let power = linear.points.iter().map(|point| [point[0], point[2]]).collect();
        let bands = vec![
            Band { half_power: Some(linear.half_power), ..band("linear", vec![power]) },
            band("stable", study.stable_power()),
            band("from_rest", study.rest_power()),
            band("up", study.swept_power(Direction::Up)),
            band("down", study.swept_power(Direction::Down)),
        ];
        Ok(Curves {
            branches: branches.iter().map(branch).collect(),
            from_rest: study.from_rest().iter().map(|start| start.flatten().map(class)).collect(),
            up: study.swept(Direction::Up),
            down: study.swept(Direction::Down),
            bands,
            linear,
        })
    }
}
