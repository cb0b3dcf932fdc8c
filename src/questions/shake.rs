//! A device shaken by anything: a chirp, noise, a record; beside it the same device without its magnets under the same shaking.

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

use super::batch_means::{Harvested, gain, measured};
use super::checks::count;
use super::error::RequestError;
use super::question::Question;
use super::shaken_run::{Found, ShakenRun};
use crate::model::base_motion::BaseMotion;
use crate::scenario::{Forgotten, Scenario};
use crate::scheduler::{Budget, Failure, Piece, Table, Tell, complete_within};

/// Numbers of realisations that may be asked for.
pub const REALISATIONS: (usize, usize) = (1, 200);
/// Numbers of points of the voltage over time.
const POINTS: (usize, usize) = (2, 100_000);
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
        let runs = ShakenRun::pairs(&scenario, &self.excitation, self.realisations, self.points);
        Ok(Table::new(runs.collect()))
    }

    /// What the runs found so far say; `None` before the first is there.
    pub fn summary(&self, runs: &[&Found]) -> Option<ShakeAnswer> {
        let (own, mut linear): (Vec<&Found>, Vec<&Found>) = runs.iter().copied().partition(|run| run.magnets);
        linear.retain(|run| run.completed());
        let first = own.iter().min_by_key(|run| run.realisation)?;
        let ended = own.iter().find(|run| !run.completed()).unwrap_or(first);
        let completed: Vec<&Found> = own.iter().copied().filter(|run| run.completed()).collect();
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
            outcome: ended.outcome.word(),
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
    const COUNTS_LOSS: bool = true;
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
        self.carry_out_telling(&|_| ())
    }

    fn carry_out_telling(&self, tell: Tell<'_>) -> Result<Level, Failure> {
        let Self { scenario, excitation, realisations } = self;
        let (realisations, points) = (*realisations, POINTS.0);
        let runs = ShakenRun::pairs(scenario, excitation, realisations, points);
        let all = 2.0 * realisations as f64;
        let runs = runs.enumerate().map(|(i, run)| run.run(&|part| tell((i as f64 + part) / all)));
        let runs: Vec<Found> = runs.collect::<Result<_, _>>()?;
        let summary = Shake { excitation: excitation.clone(), realisations, points }
            .summary(&runs.iter().collect::<Vec<_>>());
        let (own, linear, completed) =
            summary.map_or((None, None, 0), |found| (found.measured, found.linear, found.completed));
        Ok(Level { own, linear, completed })
    }
}
