//! Harvest requests: what a device delivers at its excitation, and over frequency.

use serde::{Deserialize, Serialize};

use super::{ChosenLimits, failed};
use crate::dynamics::sweep::Dwell;
use crate::jobs::RequestError;
use crate::jobs::design::band::{half_power, total, usable};
use crate::jobs::design::linear::LinearCurve;
use crate::jobs::design::point::powers;
use crate::jobs::design::{Bounds, HarvestPoint, Interval, Operating, Plant, operating};
use crate::jobs::study::complete;
use crate::jobs::study::harvest::{HarvestQuestion, HarvestStudy};
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
    /// What must be kept in the bands within limits.
    pub limits: ChosenLimits,
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
    /// The parts of these where the limits are kept.
    pub within_limits: Vec<Interval>,
    /// Width of those together (Hz).
    pub total_within_limits: f64,
}

impl HarvestTask {
    pub(super) fn answer(&self, scenario: Scenario) -> Result<HarvestAnswer, RequestError> {
        let operating = operating(&scenario)?;
        let curves = self.frequency.map(|frequency| self.curves(scenario, frequency)).transpose()?;
        Ok(HarvestAnswer { operating, curves })
    }

    fn curves(&self, scenario: Scenario, frequency: Hertz) -> Result<Curves, RequestError> {
        let plant = Plant::new(&scenario)?;
        let window = frequency.window(&plant)?;
        let bounds = Bounds::new(&plant, self.limits.complete(&scenario)?)?;
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
        let band = |of, bounds: Bounds, pieces: &[Vec<HarvestPoint>]| {
            let curves = powers(pieces);
            let within_limits = usable(&bounds.powers_within(pieces), least);
            let usable = usable(&curves, least);
            Band {
                of,
                half_power: half_power(&curves),
                total: total(&usable),
                usable,
                total_within_limits: total(&within_limits),
                within_limits,
            }
        };
        let bare = band("linear", bounds.without_magnets(), &[study.linear_points()]);
        let bands = vec![
            Band { half_power: Some(linear.half_power), ..bare },
            band("stable", bounds, &study.stable_pieces()),
            band("from_rest", bounds, &study.rest_pieces()),
            band("up", bounds, &study.swept_pieces(Direction::Up)),
            band("down", bounds, &study.swept_pieces(Direction::Down)),
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
