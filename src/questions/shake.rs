//! A device shaken by anything: a chirp, noise, a record; beside it the same device without its magnets under the same shaking.

use std::sync::Arc;

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

use super::checks::count;
use super::design::{DesignError, Plant};
use super::error::RequestError;
use super::question::Question;
use super::spectrogram::Spectrogram;
use crate::dynamics::Outcome;
use crate::dynamics::integration::Shaken;
use crate::dynamics::integration::shaken::{PARTS, Part};
use crate::model::base_motion::{BaseMotion, Signal};
use crate::model::{ReducedSystem, STANDARD_GRAVITY, Units};
use crate::scenario::{Forgotten, Scenario};
use crate::scheduler::{Budget, Failure, Piece, Table, complete_within};
use crate::theory::spectrum::eigenvalues;

/// Numbers of realisations that may be asked for.
pub const REALISATIONS: (usize, usize) = (1, 200);
/// Numbers of points of the voltage over time.
const POINTS: (usize, usize) = (2, 100_000);
/// After so many times the slowest vibration's time of decay the start is forgotten: 0.1 % of it is left.
const FORGOTTEN_AFTER: f64 = 7.0;
/// Most of a run that is left out for its start.
const MOST_LEFT_OUT: f64 = 0.25;
/// Times of decay that a batch takes at least, so that batches hardly know of one another.
const BATCH: f64 = 5.0;
/// Fewest batches whose scatter says anything.
const LEAST_BATCHES: usize = 4;

/// The device under a motion of its base; its own excitation, beta and omega, plays no role.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Shake {
    /// How the base moves.
    pub excitation: BaseMotion,
    /// How many times, where it is noise: each is another noise of the same spectrum.
    #[serde(default = "Shake::default_realisations")]
    pub realisations: usize,
    /// About how many points of the voltage over time are given.
    #[serde(default = "Shake::default_points")]
    pub points: usize,
}

/// What was measured under the shaking, in SI units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, SerBin, DeBin)]
pub struct Harvested {
    /// Root mean square of the voltage (V).
    pub v_rms: f64,
    /// Largest |v| (V).
    pub v_peak: f64,
    /// Mean power in the load (W).
    pub power: f64,
    /// Standard error of that mean (W), by batches over all realisations; absent where the run is no sample of a longer one,
    /// or too short.
    pub power_error: Option<f64>,
    /// Lowest and highest displacement of the tip (mm).
    pub tip: (f64, f64),
    /// Largest |slope| at the tip (rad).
    pub slope: f64,
    /// Mean power that the base puts in (W).
    pub input: f64,
}

/// The answer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ShakeAnswer {
    /// Times (s) of the first realisation's voltage: in equal parts of the run those of the lowest and the highest.
    pub time: Vec<f64>,
    /// The voltage (V) there.
    pub voltage: Vec<f64>,
    /// Means and extremes; absent where every run ended early. Means leave out the first `from` seconds.
    #[serde(flatten)]
    pub measured: Option<Harvested>,
    /// Time (s) from which means are taken: under noise the start is to be forgotten.
    pub from: f64,
    /// "completed", "escaped" or "contact" of the first run that did not end as it should.
    pub outcome: &'static str,
    /// Time (s) at which that was.
    pub t_outcome: f64,
    /// How many of the realisations were completed; means are over these alone.
    pub completed: usize,
    /// Root mean square of the base's acceleration (g) over all realisations.
    pub acceleration_rms: f64,
    /// Mean of the base's acceleration (g): more than rounding in a record that is not centred.
    pub acceleration_mean: f64,
    /// The same device without magnets.
    pub linear: Option<Harvested>,
    /// power / linear.power.
    pub gain: Option<f64>,
    /// Its standard error; both devices feel the same shaking, so it is smaller than those of the powers suggest.
    pub gain_error: Option<f64>,
}

impl Shake {
    const fn default_realisations() -> usize {
        1
    }

    const fn default_points() -> usize {
        2000
    }

    /// The runs: of each realisation the device and the linear one, in turn.
    ///
    /// # Errors
    /// [`RequestError`] naming what is out of range.
    pub fn runs(&self, scenario: &Scenario) -> Result<Table<ShakenRun>, RequestError> {
        let realisations = if self.excitation.is_stationary() { REALISATIONS } else { (1, 1) };
        count("realisations", self.realisations, realisations)?;
        count("points", self.points, POINTS)?;
        scenario.validate()?;
        let scenario = scenario.forgetting(&[Forgotten::Duration]);
        let run = |i: usize| ShakenRun {
            scenario: scenario.clone(),
            excitation: self.excitation.clone(),
            realisation: (i / 2) as u64,
            magnets: i.is_multiple_of(2),
            points: self.points,
        };
        Ok(Table::new((0..2 * self.realisations).map(run).collect()))
    }

    /// What the runs found so far say; `None` before the first is there.
    pub fn summary(&self, runs: &[&Found]) -> Option<ShakeAnswer> {
        let (own, mut linear): (Vec<&Found>, Vec<&Found>) = runs.iter().copied().partition(|run| run.magnets);
        linear.retain(|run| run.completed);
        let first = own.iter().min_by_key(|run| run.realisation)?;
        let ended = own.iter().find(|run| !run.completed).unwrap_or(first);
        let completed: Vec<&Found> = own.iter().copied().filter(|run| run.completed).collect();
        let stationary = self.excitation.is_stationary();
        let (time, voltage) = first.trace.iter().copied().unzip();
        let pairs: Vec<(&Found, &Found)> = completed
            .iter()
            .filter_map(|run| {
                Some((*run, *linear.iter().find(|other| other.realisation == run.realisation)?))
            })
            .collect();
        let ratio = gain(&pairs, stationary);
        let count = own.len() as f64;
        Some(ShakeAnswer {
            time,
            voltage,
            measured: measured(&completed, stationary),
            from: first.from,
            outcome: ended.outcome(),
            t_outcome: ended.end,
            completed: completed.len(),
            acceleration_rms: (own.iter().map(|run| run.acceleration_rms.powi(2)).sum::<f64>() / count)
                .sqrt(),
            acceleration_mean: own.iter().map(|run| run.acceleration_mean).sum::<f64>() / count,
            linear: measured(&linear, stationary),
            gain: ratio.map(|(gain, _)| gain),
            gain_error: ratio.and_then(|(_, error)| error),
        })
    }
}

impl Question for Shake {
    const TASK: &'static str = "shake";
    const TAKES: &'static [&'static str] = &["initial"];
    type Answer = ShakeAnswer;

    fn answer(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<ShakeAnswer, RequestError> {
        let mut runs = self.runs(&scenario)?;
        self.excitation.signal(0)?;
        complete_within(&mut runs, budget);
        let found: Result<Vec<&Found>, &Failure> = runs.found().flatten().collect();
        let found = found.map_err(|failure| RequestError::Study(failure.to_string()))?;
        self.summary(&found).ok_or_else(|| {
            RequestError::Study("the budget was spent before the first run was done".to_owned())
        })
    }
}

/// What the device gives at one level of the shaking, and the same without magnets.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct AtLevel {
    /// The device.
    pub scenario: Scenario,
    /// How its base moves.
    pub excitation: BaseMotion,
    /// How many times.
    pub realisations: usize,
}

/// What was found at a level.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Level {
    /// The device; absent where every run ended early.
    pub own: Option<Harvested>,
    /// The device without magnets.
    pub linear: Option<Harvested>,
    /// How many realisations were completed.
    pub completed: usize,
}

impl Piece for AtLevel {
    const NAME: &'static str = "shake_level";
    type Found = Level;

    fn carry_out(&self) -> Result<Level, Failure> {
        let Self { scenario, excitation, realisations } = self.clone();
        let points = POINTS.0;
        let run = |i: usize| ShakenRun {
            scenario: scenario.clone(),
            excitation: excitation.clone(),
            realisation: (i / 2) as u64,
            magnets: i.is_multiple_of(2),
            points,
        };
        let runs: Vec<Found> = (0..2 * realisations).map(|i| run(i).run()).collect::<Result<_, _>>()?;
        let summary = Shake { excitation: self.excitation.clone(), realisations, points }
            .summary(&runs.iter().collect::<Vec<_>>());
        let (own, linear, completed) =
            summary.map_or((None, None, 0), |found| (found.measured, found.linear, found.completed));
        Ok(Level { own, linear, completed })
    }
}

/// One run.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct ShakenRun {
    /// The device, and its start.
    pub scenario: Scenario,
    /// How its base moves.
    pub excitation: BaseMotion,
    /// Which noise, from 0.
    pub realisation: u64,
    /// With its magnets or without.
    pub magnets: bool,
    /// Points of the voltage over time.
    pub points: usize,
}

/// What a run found, in SI units.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Found {
    /// Which noise.
    pub realisation: u64,
    /// With magnets or without.
    pub magnets: bool,
    /// Whether it came to its end, or touched, or else escaped.
    pub completed: bool,
    /// Whether it touched.
    pub touched: bool,
    /// When it ended (s).
    pub end: f64,
    /// Time (s) from which means are taken.
    pub from: f64,
    /// Time (s) in which a vibration decays by a factor e, the slowest one; infinite without damping.
    pub decay: f64,
    /// Equal parts of the run: duration (s), mean power in the load (W), mean power of the base (W).
    pub parts: Vec<(f64, f64, f64)>,
    /// Watts of a mean square voltage of 1 V^2.
    pub watts: f64,
    /// Largest |v| (V), displacements of the tip (mm), largest slope (rad).
    pub v_peak: f64,
    /// Lowest and highest displacement of the tip (mm).
    pub tip: (f64, f64),
    /// Largest |slope| at the tip (rad).
    pub slope: f64,
    /// Time (s) and voltage (V) for a plot.
    pub trace: Vec<(f64, f64)>,
    /// Of the voltage; of the first run only.
    pub spectrogram: Option<Spectrogram>,
    /// Of the base (g).
    pub acceleration_rms: f64,
    /// Of the base (g).
    pub acceleration_mean: f64,
}

impl Found {
    fn outcome(&self) -> &'static str {
        match (self.completed, self.touched) {
            (true, _) => "completed",
            (false, true) => "contact",
            (false, false) => "escaped",
        }
    }

    /// Its parts from which means are taken.
    fn counted(&self) -> &[(f64, f64, f64)] {
        let part = self.end / PARTS as f64;
        &self.parts[((self.from / part).round() as usize).min(PARTS - 1)..]
    }

    /// Duration (s), energy in the load (J) and work of the base (J) in batches that hardly know of one another.
    fn batches(&self) -> Vec<[f64; 3]> {
        let counted = self.counted();
        let part = self.end / PARTS as f64;
        let length = (BATCH * self.decay / part).ceil().clamp(1.0, counted.len() as f64) as usize;
        let whole = counted.len() / length;
        let sum = |parts: &[(f64, f64, f64)]| {
            parts.iter().fold([0.0; 3], |[duration, power, input], (t, p, i)| {
                [duration + t, power + t * p, input + t * i]
            })
        };
        // What is left over goes to the last one.
        (0..whole)
            .map(|i| sum(&counted[i * length..if i + 1 == whole { counted.len() } else { (i + 1) * length }]))
            .collect()
    }
}

impl Piece for ShakenRun {
    const NAME: &'static str = "shake";
    type Found = Found;

    fn carry_out(&self) -> Result<Found, Failure> {
        Ok(self.run()?)
    }
}

impl ShakenRun {
    fn run(&self) -> Result<Found, DesignError> {
        let (plant, system) = self.device()?;
        let shaking = self.excitation.signal(self.realisation)?;
        let signal = dimensionless(&shaking, &plant.units);
        let initial = self.scenario.initial.clone().unwrap_or_else(|| vec![0.0; system.dimension()]);
        let decay = slowest_decay(&system)?;
        let spectral = self.magnets && self.realisation == 0;
        let shown = Spectrogram::highest(&self.excitation, &system, &plant.units);
        let every = (1.0 / (4.0 * shown * shaking.interval())).floor().max(1.0) as usize;
        let mut run = Shaken::new(&system, Arc::new(signal), &initial, (self.points, every))?;
        let outcome = loop {
            if let Some(outcome) = run.advance(usize::MAX)? {
                break outcome;
            }
        };
        let seconds = plant.units.time;
        let measures = plant.in_si(&run.measures().unwrap_or_default());
        let part = |part: &Part| {
            let mean = |sum: f64| if part.duration > 0.0 { sum / part.duration } else { 0.0 };
            let power = plant.units.watts(plant.load * mean(part.square));
            (part.duration * seconds, power, plant.units.watts(mean(part.input)))
        };
        let duration = shaking.duration();
        let left_out = (FORGOTTEN_AFTER * decay * seconds).min(MOST_LEFT_OUT * duration);
        let whole = (left_out / duration * PARTS as f64).ceil() / PARTS as f64 * duration;
        Ok(Found {
            realisation: self.realisation,
            magnets: self.magnets,
            completed: outcome == Outcome::Completed,
            touched: matches!(outcome, Outcome::Contact { .. }),
            end: run.time() * seconds,
            from: if self.excitation.is_stationary() { whole } else { 0.0 },
            decay: decay * seconds,
            parts: run.parts().iter().map(part).collect(),
            watts: plant.units.watts(plant.load),
            v_peak: measures.v_peak,
            tip: measures.tip,
            slope: measures.slope,
            trace: run.trace().into_iter().map(|(time, voltage)| (time * seconds, voltage)).collect(),
            spectrogram: spectral
                .then(|| Spectrogram::new(run.voltages(), every as f64 * shaking.interval(), shown)),
            acceleration_rms: shaking.rms(),
            acceleration_mean: shaking.mean(),
        })
    }

    /// The plant with the dielectric loss at its first own frequency, under which it vibrates most, and the system of this run.
    fn device(&self) -> Result<(Plant, ReducedSystem), DesignError> {
        let mut scenario = self.scenario.clone();
        if !self.magnets {
            scenario.parameters.c0 = 0.0;
        }
        let system = scenario.model.system(scenario.parameters)?;
        scenario.parameters.omega = system.modes.iter().map(|mode| mode.omega).fold(f64::INFINITY, f64::min);
        let plant = Plant::new(&scenario)?;
        let system = plant.system()?;
        Ok((plant, system))
    }
}

/// A signal in s and g as the model takes it.
pub fn dimensionless(signal: &Signal, units: &Units) -> Signal {
    signal.scaled(1.0 / units.time, STANDARD_GRAVITY * units.time * units.time / units.length)
}

/// Time in which the slowest vibration of the linear system decays by a factor e (dimensionless), infinite without damping.
fn slowest_decay(system: &ReducedSystem) -> Result<f64, DesignError> {
    let vibrations = eigenvalues(system)?.into_iter().filter(|value| value.im > 0.0);
    Ok(1.0 / vibrations.map(|value| -value.re).fold(f64::INFINITY, f64::min).max(0.0))
}

/// Means and extremes of runs; `None` of none.
fn measured(runs: &[&Found], stationary: bool) -> Option<Harvested> {
    let first = runs.first()?;
    let batches: Vec<[f64; 3]> = runs.iter().flat_map(|run| run.batches()).collect();
    let [duration, energy, work] =
        batches.iter().fold([0.0; 3], |sum, batch| [0, 1, 2].map(|i| sum[i] + batch[i]));
    let power = energy / duration;
    let extreme = |of: fn(&Found) -> f64| runs.iter().map(|run| of(run)).fold(f64::NEG_INFINITY, f64::max);
    Some(Harvested {
        v_rms: (power / first.watts).sqrt(),
        v_peak: extreme(|run| run.v_peak),
        power,
        power_error: ratio_error(
            &batches.iter().map(|batch| (batch[1], batch[0])).collect::<Vec<_>>(),
            stationary,
        ),
        tip: (-extreme(|run| -run.tip.0), extreme(|run| run.tip.1)),
        slope: extreme(|run| run.slope),
        input: work / duration,
    })
}

/// Power of the first over that of the second of each pair, and its standard error; both felt the same.
fn gain(pairs: &[(&Found, &Found)], stationary: bool) -> Option<(f64, Option<f64>)> {
    let mut batches = Vec::new();
    for (own, linear) in pairs {
        // Batches of the same times: as long as the longer of the two asks for.
        let longer = if own.decay >= linear.decay { own } else { linear };
        let count = longer.batches().len();
        let split = |run: &Found| -> Vec<f64> {
            let counted =
                &run.counted()[run.counted().len() - longer.counted().len().min(run.counted().len())..];
            let length = counted.len() / count;
            let end = |i: usize| if i + 1 == count { counted.len() } else { (i + 1) * length };
            let energy = |i: usize| counted[i * length..end(i)].iter().map(|(t, p, _)| t * p).sum();
            (0..count).map(energy).collect()
        };
        batches.extend(split(own).into_iter().zip(split(linear)));
    }
    let (own, linear) = batches.iter().fold((0.0, 0.0), |sum, pair| (sum.0 + pair.0, sum.1 + pair.1));
    (linear > 0.0).then(|| (own / linear, ratio_error(&batches, stationary)))
}

/// Standard error of the sum of the first over the sum of the second of each pair, from the scatter about it.
///
/// Reference: Cochran, "Sampling Techniques" (1977), section 6.4, ratio estimate.
fn ratio_error(pairs: &[(f64, f64)], stationary: bool) -> Option<f64> {
    let count = pairs.len() as f64;
    let (above, below) = pairs.iter().fold((0.0, 0.0), |sum, pair| (sum.0 + pair.0, sum.1 + pair.1));
    if !stationary || pairs.len() < LEAST_BATCHES || !(below > 0.0) {
        return None;
    }
    let ratio = above / below;
    let scatter = pairs.iter().map(|(a, b)| (a - ratio * b).powi(2)).sum::<f64>();
    Some((scatter * count / (count - 1.0)).sqrt() / below)
}
