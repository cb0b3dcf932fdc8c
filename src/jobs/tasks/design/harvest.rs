//! Harvest requests: what a device delivers at its excitation, and over frequency.

use serde::{Deserialize, Serialize};

use super::failed;
use crate::dynamics::attractors::sweep::Dwell;
use crate::jobs::RequestError;
use crate::jobs::budget::Budget;
use crate::jobs::design::band::{half_power, total, usable};
use crate::jobs::design::linear::LinearCurve;
use crate::jobs::design::point::powers;
use crate::jobs::design::{Bounds, HarvestPoint, Interval, Operating, Plant, operating};
use crate::jobs::study::complete_within;
use crate::jobs::study::harvest::{HarvestQuestion, HarvestStudy};
use crate::jobs::study::sweep::Direction;
use crate::jobs::tasks::device::ACCELERATION_UNIT;
use crate::model::{Limits, ModelError, Shaking};
use crate::scenario::Scenario;

/// What the device harvests.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct HarvestTask {
    /// Frequencies of the curves; no curves when absent.
    pub frequency: Option<Hertz>,
    /// What of the base's motion stays over the frequencies.
    pub hold: Shaking,
    /// Power (W) that counts as usable, for the bands; half of the highest of all curves by default.
    pub least: Option<f64>,
    /// What must be kept in the bands within limits; the voltage by the ceramic where none is given.
    pub limits: Limits,
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
    /// What the acceleration counts in.
    pub acceleration_unit: &'static str,
    /// At its own excitation.
    #[serde(flatten)]
    pub operating: Operating,
    /// Over frequency, at its own amplitude of the base or of its acceleration.
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
    /// Why there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub branches_missing: Option<String>,
    /// What is reached from rest at each frequency: class and point, null where it ended.
    pub from_rest: Vec<Option<(String, HarvestPoint)>>,
    /// What a sweep up reaches, null where it ended.
    pub up: Vec<Option<HarvestPoint>>,
    /// What a sweep down reaches, null where it ended.
    pub down: Vec<Option<HarvestPoint>>,
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
    pub(super) fn answer(
        &self,
        scenario: Scenario,
        budget: &Budget<'_>,
    ) -> Result<HarvestAnswer, RequestError> {
        if let Some(least) = self.least {
            ModelError::check("least", least, (0.0, 1e6), " W")?;
        }
        self.limits.validate()?;
        let operating = operating(&scenario)?;
        let curves = self.frequency.map(|frequency| self.curves(scenario, frequency, budget)).transpose()?;
        Ok(HarvestAnswer { acceleration_unit: ACCELERATION_UNIT, operating, curves })
    }

    fn curves(
        &self,
        scenario: Scenario,
        frequency: Hertz,
        budget: &Budget<'_>,
    ) -> Result<Curves, RequestError> {
        let plant = Plant::new(&scenario)?;
        let window = frequency.window(&plant)?;
        let bounds = Bounds::new(&plant, self.limits.completed(&scenario.base()))?;
        let dwell = Dwell::default();
        let mut study = HarvestStudy::new(HarvestQuestion {
            scenario,
            window,
            shaking: self.hold,
            count: frequency.count,
            dwell,
        })?;
        complete_within(&mut study, budget);
        failed(study.failure())?;
        let branches = study.branches().and_then(Result::ok).unwrap_or_default();
        if branches.iter().any(|branch| branch.cut) {
            budget
                .lacks("the branches were not followed to their ends, which would take too long".to_owned());
        }
        let branch = |curve| {
            let (points, stable) = study.branch_points(curve).into_iter().unzip();
            BranchCurve { periods: curve.periods, points, stable }
        };
        let class = |(motion, point)| (super::super::class(motion), point);
        let linear = study.linear().clone();
        let curves = [
            ("linear", vec![study.linear_points()]),
            ("stable", study.stable_pieces()),
            ("from_rest", study.rest_pieces()),
            ("up", study.swept_pieces(Direction::Up)),
            ("down", study.swept_pieces(Direction::Down)),
        ];
        let points = curves.iter().flat_map(|(_, pieces)| pieces.iter().flatten());
        let least = self.least.unwrap_or(0.5 * points.map(|point| point.power).fold(0.0, f64::max));
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
        let bands = curves.map(|(of, pieces)| match of {
            // Its half-power band is known exactly, and it has no magnets to touch.
            "linear" => {
                let band = band(of, bounds.without_magnets(), &pieces);
                Band { half_power: Some(linear.half_power), ..band }
            }
            _ => band(of, bounds, &pieces),
        });
        Ok(Curves {
            branches: branches.iter().map(branch).collect(),
            branches_missing: study.branches().and_then(Result::err).map(str::to_owned),
            from_rest: study.from_rest().iter().map(|start| start.flatten().map(class)).collect(),
            up: study.swept(Direction::Up),
            down: study.swept(Direction::Down),
            bands: bands.to_vec(),
            linear,
        })
    }
}
