//! The devices among which `find`, `map` and `tolerances` look: what may change within which ranges, what is to be good, within
//! which limits; and the evaluation of one candidate.

use serde::{Deserialize, Serialize};

use super::band::{total, usable};
use super::harvest::{Lasting, sampled};
use super::materials::lowest_threshold;
use super::{DesignError, Plant};
use crate::dynamics::Motion;
use crate::dynamics::bifurcations::tongue::Window;
use crate::model::limits::Standing;
use crate::model::{Dimension, Limits, ModelError, Parameter};
use crate::questions::motions::{Coordinate, at_place};
use crate::scenario::{Scenario, counted};
use crate::spacing::equally_spaced;
use crate::theory::Resonance;

/// Violation of a candidate without any motion to judge: worse than any that has one.
const NO_MOTION: f64 = 1e3;
/// Halvings of the distance of two frequencies that locate the border of a band between them.
const BORDER_HALVINGS: usize = 6;
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
    /// Width (Hz) in which at least `least` (W) is reached from the start, of `count` frequencies from `from` to `to` (Hz); its
    /// borders between them are located to a sixty-fourth of their distance.
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

/// The devices among which is looked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct DesignSpace {
    /// The device and everything that is not varied.
    pub scenario: Scenario,
    /// What is varied.
    pub variables: Vec<Variable>,
    /// What is to be good.
    pub objective: Objective,
    /// What must be kept; where no voltage is given it is the one that a candidate's own ceramic bears.
    pub limits: Limits,
    /// The peak of the base's acceleration (g) with which every candidate is shaken; with the scenario's amplitude when
    /// absent, or where the amplitude itself is varied.
    pub acceleration: Option<f64>,
}

/// Largest number of variables.
const MOST_VARIABLES: usize = 8;

impl DesignSpace {
    /// The scenario of a candidate, a value for each variable.
    ///
    /// # Errors
    /// [`ModelError`] when it is no device.
    pub fn candidate(&self, values: &[f64]) -> Result<Scenario, ModelError> {
        let coordinates: Vec<_> = self.variables.iter().map(|variable| variable.coordinate).collect();
        let mut scenario = at_place(&self.scenario, &coordinates, values)?;
        let shaking =
            [Coordinate::Parameter(Parameter::Beta), Coordinate::Dimension(Dimension::BaseAmplitude)];
        let wanted = self.acceleration.filter(|_| !coordinates.iter().any(|one| shaking.contains(one)));
        let p = scenario.parameters;
        let present = scenario.units().acceleration(p.beta, p.omega);
        if let Some(wanted) = wanted.filter(|_| present > 0.0) {
            scenario.parameters.beta *= wanted / present;
        }
        Ok(scenario)
    }

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
        if let Some(acceleration) = self.acceleration {
            ModelError::check("acceleration", acceleration, (0.0, 1e9), " g")?;
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

/// Evaluates one candidate, a value for each variable of `space`.
///
/// # Errors
/// [`DesignError`] when the space itself is none; a candidate without a device, or whose motion cannot be
/// followed, is an answer.
pub fn evaluate(space: &DesignSpace, values: &[f64]) -> Result<Evaluation, DesignError> {
    let Ok(scenario) = space.candidate(values) else { return Ok(Evaluation::NOTHING) };
    let Ok(plant) = Plant::new(&scenario) else { return Ok(Evaluation::NOTHING) };
    match space.objective {
        Objective::Band { least, from, to, count } => band(space, &plant, least, (from, to), count),
        Objective::Threshold(resonance) => threshold(&plant, resonance),
        Objective::Power | Objective::PowerPerG2 | Objective::Voltage => {
            let Some((found, violation)) = lasting_at(space, &plant, plant.scenario.parameters.omega) else {
                return Ok(Evaluation::NOTHING);
            };
            let value = found.harvest.and_then(|harvest| match space.objective {
                Objective::Voltage => Some(harvest.measures.v_rms),
                Objective::PowerPerG2 => harvest.power_per_g2,
                _ => Some(harvest.measures.power),
            });
            Ok(Evaluation { value, violation, motion: Some(found.motion) })
        }
    }
}

/// The motion reached at a frequency and how much it violates; `None` when there is none to be had.
fn lasting_at(space: &DesignSpace, plant: &Plant, omega: f64) -> Option<(Lasting, f64)> {
    let mut scenario = plant.scenario.clone();
    if space.acceleration.is_some() {
        scenario.parameters.beta *= (scenario.parameters.omega / omega).powi(2);
    }
    scenario.parameters.omega = omega;
    let (system, initial) = scenario.validate().ok()?;
    let found = sampled(plant, &system, &initial).ok()?;
    let violation = match found.harvest {
        None => NO_MOTION,
        Some(harvest) => {
            let limits = space.limits.completed(&scenario.base());
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
    space: &DesignSpace,
    plant: &Plant,
    least: f64,
    range: (f64, f64),
    count: usize,
) -> Result<Evaluation, DesignError> {
    let mut violation = 0.0_f64;
    let mut point = |frequency: f64| {
        let (found, violated) = lasting_at(space, plant, plant.units.omega(frequency))?;
        violation = violation.max(violated);
        Some([frequency, found.harvest.map_or(0.0, |harvest| harvest.measures.power)])
    };
    let Some(samples) = equally_spaced(range, count).map(&mut point).collect::<Option<Vec<_>>>() else {
        return Ok(Evaluation::NOTHING);
    };
    let reaches = |point: [f64; 2]| point[1] >= least;
    let mut curve = Vec::with_capacity(4 * count);
    for pair in samples.windows(2) {
        let (mut low, mut high) = (pair[0], pair[1]);
        // A line across a jump of the motion would put the border anywhere.
        for _ in 0..if reaches(low) == reaches(high) { 0 } else { BORDER_HALVINGS } {
            let Some(middle) = point(0.5 * (low[0] + high[0])) else { return Ok(Evaluation::NOTHING) };
            if reaches(middle) == reaches(low) { low = middle } else { high = middle }
        }
        curve.extend([pair[0], low, high, pair[1]]);
    }
    Ok(Evaluation { value: Some(total(&usable(&[curve], least))), violation, motion: None })
}

fn threshold(plant: &Plant, resonance: Resonance) -> Result<Evaluation, DesignError> {
    let system = plant.in_tongue(resonance).and_then(|plant| Ok(plant.system()?));
    let Ok(system) = system else { return Ok(Evaluation::NOTHING) };
    let limit = Window::default().limit;
    let Ok(tip) = lowest_threshold(&system, resonance, limit) else { return Ok(Evaluation::NOTHING) };
    // The excitation plays no role, nor then do the limits of a motion.
    Ok(Evaluation { value: tip.map(|tip| tip.beta), violation: 0.0, motion: None })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::questions::design::operating;

    fn space(acceleration: Option<f64>) -> DesignSpace {
        let range = (2.7, 3.3);
        let coordinate = Coordinate::Dimension(Dimension::Frequency);
        let variables = vec![Variable { coordinate, range, logarithmic: false }];
        let (objective, limits) = (Objective::Power, Limits::default());
        DesignSpace { scenario: Scenario::default(), variables, objective, limits, acceleration }
    }

    #[test]
    fn candidates_are_shaken_with_the_acceleration_that_is_held() {
        for frequency in [2.7, 3.0, 3.3] {
            let held = space(Some(0.03)).candidate(&[frequency]).expect("a device").device().expect("one");
            assert!((held.acceleration() / 0.03 - 1.0).abs() < 1e-12, "{}", held.acceleration());
            let free = space(None).candidate(&[frequency]).expect("a device").device().expect("one");
            let own = Scenario::default().device().expect("one").base_amplitude;
            assert!((free.base_amplitude / own - 1.0).abs() < 1e-12);
            // What is found is what the bench says of that very device.
            let mut scenario = Scenario::default();
            let device = scenario.device().expect("one");
            let device = crate::model::Device { frequency, ..device }.with_acceleration(0.03);
            scenario.set_device(device, scenario.scaling).expect("a device");
            let said = operating(&scenario).expect("a device").reached.harvest.expect("it lasts");
            let found = evaluate(&space(Some(0.03)), &[frequency]).expect("an answer").value.expect("one");
            assert!((found / said.measures.power - 1.0).abs() < 1e-9, "{found} {}", said.measures.power);
        }
        // Where the amplitude itself is varied, nothing else decides it.
        let coordinate = Coordinate::Dimension(Dimension::BaseAmplitude);
        let variables = vec![Variable { coordinate, range: (1e-4, 1e-3), logarithmic: false }];
        let varied = DesignSpace { variables, ..space(Some(0.03)) };
        let device = varied.candidate(&[7e-4]).expect("a device").device().expect("one");
        assert!((device.base_amplitude / 7e-4 - 1.0).abs() < 1e-12);
    }
}
