//! A design question for an optimiser: what to change within which ranges, what to make large, within which limits; and
//! the evaluation of one candidate.

use serde::{Deserialize, Serialize};

use super::band::{total, usable};
use super::harvest::{Lasting, lasting};
use super::materials::lowest_threshold;
use super::{DesignError, Plant};
use crate::dynamics::Motion;
use crate::dynamics::bifurcations::tongue::Window;
use crate::model::limits::Standing;
use crate::model::{Limits, ModelError};
use crate::questions::motions::{Coordinate, at_place};
use crate::scenario::{Scenario, counted};
use crate::spacing::equally_spaced;
use crate::theory::Resonance;

/// Violation of a candidate without any motion to judge: worse than any that has one.
const NO_MOTION: f64 = 1e3;
/// Numbers of frequencies of a band.
const BAND_COUNTS: (usize, usize) = (2, 64);

/// What is changed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Variable {
    /// Which number or dimension.
    pub coordinate: Coordinate,
    /// Lowest and highest value.
    pub range: (f64, f64),
    /// Whether it is varied on a logarithmic scale; needs positive values.
    #[serde(default)]
    pub logarithmic: bool,
}

impl Variable {
    /// The value at `share` (0 to 1) of the range.
    pub fn at(&self, share: f64) -> f64 {
        let (low, high) = self.range;
        // The ends themselves are kept to the last digit.
        match share {
            share if share <= 0.0 => low,
            share if share >= 1.0 => high,
            share if self.logarithmic => low * (high / low).powf(share),
            share => low + share * (high - low),
        }
    }
}

/// What is to be good.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
#[serde(rename_all = "snake_case")]
pub enum Objective {
    /// Mean power of the motion reached (W).
    Power,
    /// The same over the square of the peak of the base's acceleration (W/g^2).
    PowerPerG2,
    /// Root mean square of its voltage (V).
    Voltage,
    /// Width (Hz) in which at least `least` (W) is reached from the start, of `count` frequencies from `from` to `to`
    /// (Hz).
    Band {
        /// Power (W).
        least: f64,
        /// Lowest frequency (Hz).
        from: f64,
        /// Highest frequency (Hz).
        to: f64,
        /// Number of frequencies, 2 to 64.
        count: usize,
    },
    /// Lowest beta of a resonance's tongue, the lower the better (dimensionless).
    Threshold(Resonance),
}

/// The question.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct FindQuestion {
    /// The device and everything that is not varied.
    pub scenario: Scenario,
    /// What is varied.
    pub variables: Vec<Variable>,
    /// What is to be good.
    pub objective: Objective,
    /// What must be kept; where no voltage is given it is the one that a candidate's own ceramic bears.
    pub limits: Limits,
}

/// Largest number of variables.
const MOST_VARIABLES: usize = 8;

impl FindQuestion {
    /// Checks ranges and limits.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range.
    pub fn validate(&self) -> Result<(), ModelError> {
        self.scenario.validate()?;
        counted("variables", self.variables.len(), (1, MOST_VARIABLES))?;
        let modes = self.scenario.model.modes;
        for (i, Variable { coordinate, range, logarithmic }) in self.variables.iter().enumerate() {
            coordinate.check(modes, *range)?;
            if *logarithmic {
                let most = coordinate.limits(modes).1;
                ModelError::check(&coordinate.name(modes), range.0, (f64::MIN_POSITIVE, most), "")?;
            }
            if self.variables[..i].iter().any(|other| other.coordinate == *coordinate) {
                return Err(ModelError::SameSides { field: coordinate.name(modes) });
            }
        }
        if let Objective::Band { least, from, to, count } = self.objective {
            ModelError::check("least", least, (0.0, 1e6), " W")?;
            ModelError::check("from", from, (1e-6, 1e9), " Hz")?;
            ModelError::check("to", to, (from, 1e9), " Hz")?;
            counted("count", count, BAND_COUNTS)?;
        }
        self.limits.validate()
    }
}

/// What is known of a candidate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Evaluation {
    /// The objective in its unit; `None` without a device or a lasting motion.
    pub value: Option<f64>,
    /// By how much limits are violated, the parts beyond each summed (dimensionless); 0 when all are kept.
    pub violation: f64,
    /// The motion reached at the scenario's own frequency, where it was asked for.
    pub motion: Option<Motion>,
}

impl Evaluation {
    const NOTHING: Self = Self { value: None, violation: NO_MOTION, motion: None };

    /// What the optimiser compares, larger is better: kept limits before violated ones, then the objective, or the
    /// smaller violation.
    pub fn rank(&self, objective: &Objective) -> (f64, f64) {
        let sign = if matches!(objective, Objective::Threshold(_)) { -1.0 } else { 1.0 };
        (-self.violation, self.value.map_or(f64::NEG_INFINITY, |value| sign * value))
    }
}

/// Evaluates one candidate, a value for each variable of `question`.
///
/// # Errors
/// [`DesignError`] when the question itself cannot be asked; a candidate without a device, or whose motion cannot be
/// followed, is an answer.
pub fn evaluate(question: &FindQuestion, values: &[f64]) -> Result<Evaluation, DesignError> {
    let coordinates: Vec<_> = question.variables.iter().map(|variable| variable.coordinate).collect();
    let Ok(scenario) = at_place(&question.scenario, &coordinates, values) else {
        return Ok(Evaluation::NOTHING);
    };
    let Ok(plant) = Plant::new(&scenario) else { return Ok(Evaluation::NOTHING) };
    match question.objective {
        Objective::Band { least, from, to, count } => band(question, &plant, least, (from, to), count),
        Objective::Threshold(resonance) => threshold(&plant, resonance),
        Objective::Power | Objective::PowerPerG2 | Objective::Voltage => {
            let Some((found, violation)) = lasting_at(question, &plant, plant.scenario.parameters.omega)
            else {
                return Ok(Evaluation::NOTHING);
            };
            let value = found.harvest.and_then(|harvest| match question.objective {
                Objective::Voltage => Some(harvest.measures.v_rms),
                Objective::PowerPerG2 => harvest.power_per_g2,
                _ => Some(harvest.measures.power),
            });
            Ok(Evaluation { value, violation, motion: Some(found.motion) })
        }
    }
}

/// The motion reached at a frequency and how much it violates; `None` when there is none to be had.
fn lasting_at(question: &FindQuestion, plant: &Plant, omega: f64) -> Option<(Lasting, f64)> {
    let mut scenario = plant.scenario.clone();
    scenario.parameters.omega = omega;
    let (system, initial) = scenario.validate().ok()?;
    let found = lasting(plant, &system, &initial).ok()?;
    let violation = match found.harvest {
        None => NO_MOTION,
        Some(harvest) => {
            let limits = question.limits.completed(&scenario.base());
            let checks = limits.checks(&harvest.demand, Plant::gap(&system));
            let beyond = checks.iter().filter(|check| check.standing != Standing::Within);
            // What is just met, or is no number, counts as well.
            let parts =
                beyond.map(|check| if check.margin < 0.0 { -check.margin } else { f64::MIN_POSITIVE });
            // The sum of nothing would be -0.
            parts.fold(0.0, |sum, part| sum + part)
        }
    };
    Some((found, violation))
}

fn band(
    question: &FindQuestion,
    plant: &Plant,
    least: f64,
    range: (f64, f64),
    count: usize,
) -> Result<Evaluation, DesignError> {
    let (mut curve, mut violation) = (Vec::with_capacity(count), 0.0_f64);
    for frequency in equally_spaced(range, count) {
        let Some((found, violated)) = lasting_at(question, plant, plant.units.omega(frequency)) else {
            return Ok(Evaluation::NOTHING);
        };
        violation = violation.max(violated);
        curve.push([frequency, found.harvest.map_or(0.0, |harvest| harvest.measures.power)]);
    }
    Ok(Evaluation { value: Some(total(&usable(&[curve], least))), violation, motion: None })
}

fn threshold(plant: &Plant, resonance: Resonance) -> Result<Evaluation, DesignError> {
    let Ok(system) = plant.system() else { return Ok(Evaluation::NOTHING) };
    let limit = Window::default().limit;
    let Ok(tip) = lowest_threshold(&system, resonance, limit) else { return Ok(Evaluation::NOTHING) };
    // The excitation plays no role, nor then do the limits of a motion.
    Ok(Evaluation { value: tip.map(|tip| tip.beta), violation: 0.0, motion: None })
}
