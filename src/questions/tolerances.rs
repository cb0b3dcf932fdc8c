//! Which dimension of a device matters most, and what the scatter of all of them leaves of it.

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

use super::checks::class;
use super::design::space::{DesignSpace, Evaluation, Objective, Variable};
use super::design::tolerance::{
    Distribution, Lean, coordinates, deviates, lean, resonance_frequency, threshold,
};
use super::error::{RequestError, failed};
use super::find::Evaluate;
use super::motions::Coordinate;
use super::question::Question;
use super::subject::ACCELERATION_UNIT;
use crate::model::limits::{Assessment, Standing, sag};
use crate::model::{Limits, ModelError};
use crate::scenario::{Scenario, counted};
use crate::scheduler::{Asked, Budget, Failure, Order, Piece, Study, complete_within};
use crate::theory::Resonance;

/// Relative standard deviations, and samples.
pub const SCATTERS: (f64, f64) = (0.0, 0.3);
const SAMPLES: (usize, usize) = (0, 8192);

/// What scatter does to a device.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Tolerances {
    /// Standard deviation of every dimension, over its value.
    pub deviation: f64,
    /// Other standard deviations of some of them; 0 for one that is exact.
    pub scatter: Vec<Scatter>,
    /// Devices that are looked at.
    pub samples: usize,
    /// What must be kept to be safe; the voltage by the ceramic where none is given.
    pub limits: Limits,
    /// Whose threshold is looked at.
    pub resonance: Resonance,
}

/// How one dimension scatters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scatter {
    /// The dimension.
    pub name: String,
    /// Standard deviation over its value.
    pub deviation: f64,
}

impl Default for Tolerances {
    fn default() -> Self {
        Self {
            deviation: 0.01,
            scatter: Vec::new(),
            samples: 128,
            limits: Limits::default(),
            resonance: Resonance::First,
        }
    }
}

/// What scatter does to a device.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TolerancesAnswer {
    /// What the threshold counts in.
    pub acceleration_unit: &'static str,
    /// The device as it is meant.
    pub nominal: Option<Nominal>,
    /// Per cent per per cent, by descending power.
    pub sensitivities: Vec<NamedLean>,
    /// The dimension that matters most for each.
    pub most: Most,
    /// What the sampled devices give.
    #[serde(rename = "yield")]
    pub spread: Spread,
}

/// The device as it is meant.
#[derive(Debug, Clone, PartialEq, Serialize, SerBin, DeBin)]
pub struct Nominal {
    /// The motion reached.
    pub motion: String,
    /// Its mean power (W).
    pub power: Option<f64>,
    /// First resonance frequency of the linear device with its circuit (Hz).
    pub frequency: Option<f64>,
    /// Lowest acceleration that opens the tongue.
    pub threshold: Option<f64>,
    /// Whether the limits that are known are kept.
    pub within_limits: bool,
    /// Whether it is safe, as the task `limits` says it: the voltage's limit is known, too, and the model is valid.
    pub safe: bool,
}

/// What one dimension does.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NamedLean {
    /// The dimension, or the number of a layer by its place in a request's device.
    pub name: String,
    /// Its value (SI).
    pub value: f64,
    /// Per cent per per cent.
    #[serde(flatten)]
    pub lean: Lean,
}

/// The dimension that matters most.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Most {
    /// For the power.
    pub power: Option<String>,
    /// For the resonance frequency.
    pub frequency: Option<String>,
    /// For the threshold.
    pub threshold: Option<String>,
}

/// What the sampled devices give.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// How many were looked at.
    pub samples: usize,
    /// Share of them whose motion lasts.
    pub lasting: f64,
    /// Share of them that keep the limits that are known.
    pub within_limits: f64,
    /// Share of them that are safe, as the task `limits` says it: that, or none where the voltage's limit is not known or the
    /// model is not valid.
    pub safe: f64,
    /// Whether a limit of the voltage is known.
    pub voltage_checked: bool,
    /// Whether the device as it is meant sags little enough for the model.
    pub model_valid: bool,
    /// Power of those that last.
    pub power: Option<Distribution>,
}

impl Question for Tolerances {
    const TASK: &'static str = "tolerances";
    const TAKES: &'static [&'static str] = &["initial", "t_end"];
    const COUNTS_LOSS: bool = true;
    type Answer = TolerancesAnswer;

    fn answer(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<TolerancesAnswer, RequestError> {
        let modes = scenario.model.modes;
        let mut study = ToleranceStudy::new(scenario, self.clone())?;
        complete_within(&mut study, budget);
        failed(study.failure())?;
        let mut sensitivities: Vec<NamedLean> = study
            .leans()
            .map(|(dimension, value, lean)| NamedLean { name: dimension.name(modes), value, lean: *lean })
            .collect();
        let size = |lean: &NamedLean| lean.lean.power.map_or(-1.0, f64::abs);
        sensitivities.sort_by(|a, b| size(b).total_cmp(&size(a)));
        let most = |of: fn(&Lean) -> Option<f64>| study.most(of).map(|(dimension, _)| dimension.name(modes));
        let most = Most {
            power: most(|lean| lean.power),
            frequency: most(|lean| lean.frequency),
            threshold: most(|lean| lean.threshold),
        };
        Ok(TolerancesAnswer {
            acceleration_unit: ACCELERATION_UNIT,
            nominal: study.nominal().cloned(),
            sensitivities,
            most,
            spread: study.spread(),
        })
    }
}

/// The device as it is meant.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Meant {
    /// The device, with its limits.
    pub space: DesignSpace,
    /// Whose threshold.
    pub resonance: Resonance,
}

impl Piece for Meant {
    const NAME: &'static str = "nominal";
    type Found = Nominal;

    fn carry_out(&self) -> Result<Nominal, Failure> {
        let scenario = &self.space.scenario;
        let none = DesignSpace { variables: Vec::new(), ..self.space.clone() };
        let found = Evaluate { space: none, values: Vec::new() }.carry_out()?;
        let within_limits = found.value.is_some() && found.violation == 0.0;
        Ok(Nominal {
            motion: found.motion.map_or_else(|| "none".to_owned(), class),
            power: found.value,
            frequency: resonance_frequency(scenario)?,
            threshold: threshold(scenario, self.resonance).ok().flatten(),
            within_limits,
            safe: within_limits && safe_if_kept(scenario, &self.space.limits)?,
        })
    }
}

/// Whether the device of `scenario` is safe where it keeps the limits that are known.
fn safe_if_kept(scenario: &Scenario, limits: &Limits) -> Result<bool, ModelError> {
    let limits = limits.completed(&scenario.base());
    Ok(Assessment::of_kept(&limits, &sag(&scenario.device()?)) == Assessment::WithinLimits)
}

/// What one dimension does.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Leaning {
    /// The device.
    pub scenario: Scenario,
    /// The dimension, or the number of a layer.
    pub dimension: Coordinate,
    /// Whose threshold.
    pub resonance: Resonance,
}

impl Piece for Leaning {
    const NAME: &'static str = "sensitivity";
    type Found = Lean;

    fn carry_out(&self) -> Result<Lean, Failure> {
        Ok(lean(&self.scenario, self.dimension, self.resonance)?)
    }
}

/// Sensitivities and samples being computed.
#[derive(Debug, Clone)]
pub struct ToleranceStudy {
    asked: (Scenario, Tolerances),
    dimensions: Vec<(Coordinate, f64)>,
    /// Standard deviations over the values, one a dimension.
    deviations: Vec<f64>,
    space: DesignSpace,
    nominal_handed: bool,
    nominal: Option<Nominal>,
    leans_handed: usize,
    leans: Vec<Option<Lean>>,
    samples_handed: usize,
    samples: Vec<Option<Evaluation>>,
    failure: Option<Failure>,
}

impl ToleranceStudy {
    /// A study of the device of `scenario`, not yet begun.
    ///
    /// # Errors
    /// [`RequestError`] naming what is out of range.
    pub fn new(scenario: Scenario, asked: Tolerances) -> Result<Self, RequestError> {
        scenario.validate()?;
        asked.limits.validate()?;
        ModelError::check("deviation", asked.deviation, SCATTERS, "")?;
        counted("samples", asked.samples, SAMPLES)?;
        let dimensions = coordinates(&scenario)?;
        let modes = scenario.model.modes;
        let mut deviations = vec![asked.deviation; dimensions.len()];
        for (i, scatter) in asked.scatter.iter().enumerate() {
            let field = || format!("scatter[{i}]");
            ModelError::check(&format!("{}.deviation", field()), scatter.deviation, SCATTERS, "")?;
            let known = dimensions.iter().position(|(dimension, _)| dimension.name(modes) == scatter.name);
            let place = known.ok_or_else(|| {
                let names: Vec<String> =
                    dimensions.iter().map(|(dimension, _)| dimension.name(modes)).collect();
                RequestError::Field {
                    field: format!("{}.name", field()),
                    problem: format!("`{}` is not available: allowed are {}", scatter.name, names.join(", ")),
                }
            })?;
            deviations[place] = scatter.deviation;
        }
        // Ranges play no role in an evaluation.
        let variable = |(dimension, value): &(Coordinate, f64)| Variable {
            coordinate: *dimension,
            range: (*value, *value),
            logarithmic: false,
        };
        let space = DesignSpace {
            scenario: scenario.clone(),
            variables: dimensions.iter().map(variable).collect(),
            objective: Objective::Power,
            limits: asked.limits,
            acceleration: None,
        };
        Ok(Self {
            nominal_handed: false,
            nominal: None,
            leans_handed: 0,
            leans: vec![None; dimensions.len()],
            samples_handed: 0,
            samples: vec![None; asked.samples],
            asked: (scenario, asked),
            dimensions,
            deviations,
            space,
            failure: None,
        })
    }

    /// The device as it is meant, once it is known.
    pub fn nominal(&self) -> Option<&Nominal> {
        self.nominal.as_ref()
    }

    /// Dimensions with their values and what is known that they do.
    pub fn leans(&self) -> impl Iterator<Item = (Coordinate, f64, &Lean)> {
        let known = self.dimensions.iter().zip(&self.leans);
        known.filter_map(|((dimension, value), lean)| Some((*dimension, *value, lean.as_ref()?)))
    }

    /// The dimension that does most to something, and how much, of those known.
    pub fn most(&self, of: fn(&Lean) -> Option<f64>) -> Option<(Coordinate, f64)> {
        let known = self.leans().filter_map(|(dimension, _, lean)| Some((dimension, of(lean)?)));
        known.filter(|(_, lean)| *lean != 0.0).max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
    }

    /// Powers (W) of the sampled devices whose motion lasts, ascending.
    pub fn powers(&self) -> Vec<f64> {
        let mut powers: Vec<f64> = self.samples.iter().flatten().filter_map(|sample| sample.value).collect();
        powers.sort_by(f64::total_cmp);
        powers
    }

    /// What the devices sampled so far give.
    pub fn spread(&self) -> Spread {
        let known: Vec<&Evaluation> = self.samples.iter().flatten().collect();
        let share = |of: &dyn Fn(&Evaluation) -> bool| {
            let count = known.iter().filter(|sample| of(sample)).count();
            if known.is_empty() { 0.0 } else { count as f64 / known.len() as f64 }
        };
        let (scenario, limits) = (&self.asked.0, self.asked.1.limits);
        let sags = scenario.device().map(|device| sag(&device).standing);
        let within_limits = share(&|sample| sample.value.is_some() && sample.violation == 0.0);
        Spread {
            samples: known.len(),
            lasting: share(&|sample| sample.value.is_some()),
            within_limits,
            safe: if safe_if_kept(scenario, &limits).unwrap_or(false) { within_limits } else { 0.0 },
            voltage_checked: limits.completed(&scenario.base()).voltage.is_some(),
            model_valid: sags.is_ok_and(|standing| standing == Standing::Within),
            power: Distribution::of(&self.powers()),
        }
    }

    /// Why something is missing, if it is and will stay so.
    pub fn failure(&self) -> Option<&Failure> {
        self.failure.as_ref()
    }

    fn take<T>(&mut self, found: Result<T, Failure>, then: impl FnOnce(&mut Self, T)) {
        match found {
            Ok(found) => then(self, found),
            Err(failure) => self.failure = Some(failure),
        }
    }

    /// The `index`-th device: a value for each dimension.
    fn values(&self, index: usize) -> Vec<f64> {
        let moved = self.deviations.iter().filter(|deviation| **deviation > 0.0).count();
        let mut deviates = deviates(index, moved).into_iter();
        let places = self.dimensions.iter().zip(&self.deviations);
        let value = |((_, value), deviation): (&(Coordinate, f64), &f64)| match *deviation {
            deviation if deviation > 0.0 => value * (1.0 + deviation * deviates.next().unwrap_or(0.0)),
            _ => *value,
        };
        places.map(value).collect()
    }
}

impl Asked for ToleranceStudy {
    type Question = (Scenario, Tolerances);

    fn asked(&self) -> &Self::Question {
        &self.asked
    }
}

impl Study for ToleranceStudy {
    fn next(&mut self) -> Option<Order<Self>> {
        if self.failure.is_some() {
            return None;
        }
        let (scenario, resonance) = (self.asked.0.clone(), self.asked.1.resonance);
        if !std::mem::replace(&mut self.nominal_handed, true) {
            let piece = Meant { space: self.space.clone(), resonance };
            return Some(Order::new(piece, |study: &mut Self, found| {
                study.take(found, |study, nominal| study.nominal = Some(nominal));
            }));
        }
        // By turns, so that both grow.
        let leans_first =
            8 * self.leans_handed <= self.samples_handed || self.samples_handed == self.samples.len();
        if leans_first && let Some((dimension, _)) = self.dimensions.get(self.leans_handed).copied() {
            let index = self.leans_handed;
            self.leans_handed += 1;
            return Some(Order::new(
                Leaning { scenario, dimension, resonance },
                move |study: &mut Self, found| {
                    // A dimension at the end of its range tells nothing; the others do.
                    let nothing = Lean { power: None, frequency: None, threshold: None };
                    study.leans[index] = Some(found.unwrap_or(nothing));
                },
            ));
        }
        if self.samples_handed == self.samples.len() {
            return None;
        }
        let index = self.samples_handed;
        self.samples_handed += 1;
        let piece = Evaluate { space: self.space.clone(), values: self.values(index) };
        Some(Order::new(piece, move |study: &mut Self, found| {
            study.take(found, |study, sample| study.samples[index] = Some(sample));
        }))
    }

    fn progress(&self) -> f64 {
        let done = self.leans.iter().flatten().count() + self.samples.iter().flatten().count();
        (done + usize::from(self.nominal.is_some())) as f64
            / (1 + self.leans.len() + self.samples.len()) as f64
    }

    fn finished(&self) -> bool {
        let whole = self.nominal.is_some()
            && self.leans.iter().all(Option::is_some)
            && self.samples.iter().all(Option::is_some);
        self.failure.is_some() || whole
    }
}
