//! A sine whose frequency changes steadily.

use std::f64::consts::{PI, TAU};

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

use super::{ACCELERATIONS, FREQUENCIES, Signal, samples};
use crate::model::ModelError;

/// Samples of a period at the highest frequency: 5e-7 of the amplitude is lost between them.
const PER_PERIOD: f64 = 30.0;

/// A chirp: acceleration x sin(phase), where the phase's rate goes from one frequency to another.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, SerBin, DeBin)]
#[serde(deny_unknown_fields)]
pub struct Chirp {
    /// Frequency at the beginning (Hz).
    pub from: f64,
    /// Frequency at the end (Hz); below `from` it goes down.
    pub to: f64,
    /// How long it takes (s), there and back together.
    pub duration: f64,
    /// Peak of the acceleration (g).
    pub acceleration: f64,
    /// How the frequency changes.
    #[serde(default)]
    pub scale: ChirpScale,
    /// Whether it comes back the same way, in the second half.
    #[serde(default)]
    pub and_back: bool,
}

/// How the frequency of a chirp changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, SerBin, DeBin)]
#[serde(rename_all = "lowercase")]
pub enum ChirpScale {
    /// By as many Hz a second throughout.
    #[default]
    Linear,
    /// By as many octaves a second throughout.
    Logarithmic,
}

impl Chirp {
    /// The acceleration over time (s, g).
    ///
    /// # Errors
    /// [`ModelError`], naming what is out of range.
    pub fn signal(&self) -> Result<Signal, ModelError> {
        ModelError::check("from", self.from, FREQUENCIES, " Hz")?;
        ModelError::check("to", self.to, FREQUENCIES, " Hz")?;
        ModelError::check("acceleration", self.acceleration, ACCELERATIONS, " g")?;
        let count = samples(self.duration, PER_PERIOD * self.from.max(self.to))?;
        let interval = self.duration / count as f64;
        let wave = |i| self.acceleration * self.phase(interval * i as f64).sin();
        Signal::new(interval, (0..=count).map(wave).collect())
    }

    /// Duration of one way (s).
    fn one_way(&self) -> f64 {
        if self.and_back { 0.5 * self.duration } else { self.duration }
    }

    /// Frequency (Hz) at `time` (s).
    pub fn frequency(&self, time: f64) -> f64 {
        let there = time.min(2.0 * self.one_way() - time).max(0.0) / self.one_way();
        match self.scale {
            ChirpScale::Linear => self.from + (self.to - self.from) * there,
            ChirpScale::Logarithmic => self.from * (self.to / self.from).powf(there),
        }
    }

    /// Integral of the frequency up to `time` (radians); what comes back retraces the way there.
    fn phase(&self, time: f64) -> f64 {
        let way = self.one_way();
        let there = |time: f64| {
            let log = (self.to / self.from).ln();
            match self.scale {
                // Where the frequency hardly changes both are the same.
                ChirpScale::Logarithmic if log.abs() > 1e-6 => {
                    TAU * self.from * way / log * (log * time / way).exp_m1()
                }
                _ => TAU * self.from * time + PI * (self.to - self.from) * time * time / way,
            }
        };
        if time <= way { there(time) } else { 2.0 * there(way) - there(2.0 * way - time) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_phase_is_the_integral_of_the_frequency() -> Result<(), ModelError> {
        for scale in [ChirpScale::Linear, ChirpScale::Logarithmic] {
            for and_back in [false, true] {
                let chirp = Chirp { from: 8.0, to: 3.0, duration: 10.0, acceleration: 0.5, scale, and_back };
                let (mut sum, parts) = (0.0, 100_000);
                for i in 0..parts {
                    let step = 10.0 / parts as f64;
                    sum += TAU * step * chirp.frequency((i as f64 + 0.5) * step);
                }
                assert!((sum - chirp.phase(10.0)).abs() < 1e-6, "{scale:?} {and_back}: {sum}");
                let signal = chirp.signal()?;
                assert!((signal.at(1.234) - 0.5 * chirp.phase(1.234).sin()).abs() < 1e-6);
                assert!((signal.duration() - 10.0).abs() < 1e-12);
            }
        }
        Ok(())
    }

    #[test]
    fn too_long_a_chirp_names_the_longest() {
        let long = Chirp {
            from: 1.0,
            to: 1e3,
            duration: 1e4,
            acceleration: 1.0,
            scale: ChirpScale::Linear,
            and_back: false,
        };
        let text = long.signal().expect_err("too many samples").to_string();
        assert!(text.contains("duration = 10000 is out of range") && text.contains(" s"), "{text}");
    }
}
