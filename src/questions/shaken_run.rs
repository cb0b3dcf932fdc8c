//! One run of a device under any shaking, with what is measured of it.

use std::sync::Arc;

use nanoserde::{DeBin, SerBin};

use super::design::{DesignError, Plant};
use super::spectrogram::Spectrogram;
use crate::dynamics::Outcome;
use crate::dynamics::integration::Shaken;
use crate::dynamics::integration::shaken::{PARTS, Part};
use crate::model::base_motion::{BaseMotion, Signal};
use crate::model::{ReducedSystem, STANDARD_GRAVITY, Units};
use crate::scenario::Scenario;
use crate::scheduler::{Failure, Piece, Tell};
use crate::theory::spectrum::eigenvalues;

/// After so many times the slowest vibration's time of decay the start is forgotten: 0.1 % of it is left.
const FORGOTTEN_AFTER: f64 = 7.0;
/// Most of a run that is left out for its start.
const MOST_LEFT_OUT: f64 = 0.25;

/// Steps, milliseconds of them, after which the done part is told.
const STEPS: usize = 4096;

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
    /// How it ended; its times in s.
    pub outcome: Outcome,
    /// When (s).
    pub end: f64,
    /// Time (s) from which means are taken.
    pub from: f64,
    /// Time (s) in which a vibration decays by a factor e, the slowest one; infinite without damping.
    pub decay: f64,
    /// Equal parts of the run: duration (s), mean square of the voltage (V^2), mean power of the base (W).
    pub parts: Vec<(f64, f64, f64)>,
    /// Watts of a mean square voltage of 1 V^2.
    pub watts: f64,
    /// Largest |v| (V).
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
    /// Whether it came to its end.
    pub fn completed(&self) -> bool {
        self.outcome == Outcome::Completed
    }

    /// Its parts from which means are taken.
    pub fn counted(&self) -> &[(f64, f64, f64)] {
        let part = self.end / PARTS as f64;
        &self.parts[((self.from / part).round() as usize).min(PARTS - 1)..]
    }
}

impl Piece for ShakenRun {
    const NAME: &'static str = "shake";
    type Found = Found;

    fn carry_out(&self) -> Result<Found, Failure> {
        Ok(self.run(&|_| ())?)
    }

    fn carry_out_telling(&self, tell: Tell<'_>) -> Result<Found, Failure> {
        Ok(self.run(tell)?)
    }
}

impl ShakenRun {
    /// So many realisations, of each the device and then the one without magnets.
    pub fn pairs(
        scenario: &Scenario,
        excitation: &BaseMotion,
        realisations: usize,
        points: usize,
    ) -> impl Iterator<Item = Self> {
        (0..2 * realisations).map(move |i| Self {
            scenario: scenario.clone(),
            excitation: excitation.clone(),
            realisation: (i / 2) as u64,
            magnets: i.is_multiple_of(2),
            points,
        })
    }

    /// Carries it out, telling how far it is after every so many steps.
    ///
    /// # Errors
    /// [`DesignError`] for a device or a shaking that cannot be.
    pub fn run(&self, tell: Tell<'_>) -> Result<Found, DesignError> {
        let (plant, system) = self.device()?;
        let shaking = self.excitation.signal(self.realisation)?;
        let signal = dimensionless(&shaking, &plant.units);
        let initial = self.scenario.initial.clone().unwrap_or_else(|| vec![0.0; system.dimension()]);
        let decay = slowest_decay(&system)?;
        let spectral = self.magnets && self.realisation == 0;
        let shown = Spectrogram::highest(&self.excitation, &system, &plant.units);
        let every = (1.0 / (4.0 * shown * shaking.interval())).floor().max(1.0) as usize;
        let mut run = Shaken::new(&system, Arc::new(signal), &initial, (self.points, every))?;
        let (seconds, duration) = (plant.units.time, shaking.duration());
        let outcome = loop {
            if let Some(outcome) = run.advance(STEPS)? {
                break outcome;
            }
            tell(run.time() * seconds / duration);
        };
        let measures = plant.in_si(&run.measures().unwrap_or_default());
        let part = |part: &Part| {
            let mean = |sum: f64| if part.duration > 0.0 { sum / part.duration } else { 0.0 };
            (part.duration * seconds, mean(part.square), plant.units.watts(mean(part.input)))
        };
        let left_out = (FORGOTTEN_AFTER * decay * seconds).min(MOST_LEFT_OUT * duration);
        let whole = (left_out / duration * PARTS as f64).ceil() / PARTS as f64 * duration;
        Ok(Found {
            realisation: self.realisation,
            magnets: self.magnets,
            outcome: outcome.retimed(|time| time * seconds),
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

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::*;
    use crate::model::base_motion::Noise;

    #[test]
    fn a_run_tells_how_far_it_is_and_finds_the_same() {
        let noise = Noise {
            from: Some(1.0),
            to: Some(12.0),
            rms: Some(0.02),
            spectrum: None,
            duration: 200.0,
            seed: 0,
        };
        let excitation = BaseMotion::Noise(noise);
        let run = ShakenRun::pairs(&Scenario::default(), &excitation, 1, 20).nth(1).expect("without magnets");
        let parts = RefCell::new(Vec::new());
        let found = run.carry_out_telling(&|part| parts.borrow_mut().push(part)).expect("a run");
        assert_eq!(run.carry_out(), Ok(found));
        let parts = parts.into_inner();
        assert!(parts.len() > 1 && parts.is_sorted_by(|a, b| a < b), "{parts:?}");
        assert!(parts[0] > 0.0 && parts[0] < 0.6 && parts[parts.len() - 1] < 1.0, "{parts:?}");
    }
}
