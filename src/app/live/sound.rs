//! The voltage as sound: uniform samples at the speed of the run, brought to one loudness.

/// Samples a second.
pub(in crate::app) const RATE: f64 = 24_000.0;
/// Samples handed over at once, 25 ms.
const CHUNK: usize = 600;
/// How loud a steady peak is, of 1.
const LOUDNESS: f64 = 0.25;
/// What no sample is louder than.
const LOUDEST: f64 = 0.6;
/// Voltage (V) that is not made louder than that: below it, silence is silence.
const LEAST: f64 = 0.05;
/// Part of the way to a louder and to a softer level that is gone in a sample: about 10 ms and 3 s.
const LOUDER: f64 = 1.0 / (0.01 * RATE);
const SOFTER: f64 = 1.0 / (3.0 * RATE);

/// The sound of a run.
#[derive(Debug)]
pub(super) struct Sound {
    /// Turns at which the next sample is due, and between samples.
    pub due: f64,
    spacing: f64,
    leveller: Leveller,
    ready: Vec<f32>,
}

impl Sound {
    /// Silence until the run goes on from `turns`, with peaks of about `peak` volts so far.
    pub(super) fn new(turns: f64, peak: f64) -> Self {
        Self { due: turns, spacing: 1.0, leveller: Leveller { level: peak.max(LEAST) }, ready: Vec::new() }
    }

    /// Goes on from `turns` at least, at `speed` excitation periods a second.
    pub(super) fn tune(&mut self, turns: f64, speed: f64) {
        self.spacing = speed / RATE;
        // After a rest, or at another run.
        if !(turns..=turns + 2.0 * self.spacing).contains(&self.due) {
            self.due = turns;
        }
    }

    /// Takes the sample that was due.
    pub(super) fn take(&mut self, voltage: f64) {
        self.ready.push(self.leveller.level(voltage));
        self.due += self.spacing;
    }

    /// What is ready to be heard, once it is enough.
    pub(super) fn chunk(&mut self) -> Option<Vec<f32>> {
        (self.ready.len() >= CHUNK).then(|| std::mem::take(&mut self.ready))
    }
}

/// Follows the peaks of the voltage and divides by them, slowly enough not to be heard.
#[derive(Debug)]
struct Leveller {
    /// Present peak (V).
    level: f64,
}

impl Leveller {
    /// A sample between plus and minus [`LOUDEST`].
    fn level(&mut self, voltage: f64) -> f32 {
        let size = if voltage.is_finite() { voltage.abs() } else { 0.0 };
        let rate = if size > self.level { LOUDER } else { SOFTER };
        self.level += rate * (size.max(LEAST) - self.level);
        // Peaks above the level, such as those of a kick, are bent, not cut.
        let sample = if voltage.is_finite() { LOUDNESS * voltage / self.level } else { 0.0 };
        (LOUDEST * (sample / LOUDEST).tanh()) as f32
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::app::live::run::{Drive, LiveRun};
    use crate::dynamics::{Reach, Settings, Trajectory};
    use crate::model::{ForceLaw, ParameterSet, Parameters, ReducedSystem};

    #[test]
    fn samples_are_the_voltage_of_the_dense_output_at_equal_distances() {
        let set = ParameterSet { alpha: 1e-4, beta: 1e-2, omega: 8.0969, ..Default::default() };
        let system = Parameters::new(set).and_then(|p| ReducedSystem::new(p, 2, ForceLaw::Exact));
        let system = system.expect("a valid device");
        let whole = Trajectory::compute(&system, &[0.0; 5], 10.0, Settings::default()).expect("a run");
        let period = system.parameters.period();
        let mut run = LiveRun::begin(system, Drive::Sine, vec![0.0; 5], 0.0, 0.0).expect("from rest");
        let (mut sound, mut expected) = (Sound::new(0.0, 0.0), Leveller { level: LEAST });
        let speed = 110.0;
        sound.tune(0.0, speed);
        for k in 0..2000 {
            while run.go_to(sound.due) != Ok(Reach::There) {}
            sound.take(run.reading()[0]);
            let time = k as f64 * speed / RATE * period;
            let exact = expected.level(whole.state_at(time)[4]);
            assert!((sound.ready[k] - exact).abs() < 1e-6, "sample {k}: {} {exact}", sound.ready[k]);
        }
        assert!(sound.ready.iter().any(|sample| sample.abs() > 0.1));
    }

    #[test]
    fn every_voltage_ends_at_one_loudness_and_none_is_too_loud() {
        for peak in [0.2, 14.0, 300.0] {
            let mut leveller = Leveller { level: LEAST };
            let samples: Vec<f32> =
                (0..480_000).map(|k| leveller.level(peak * (TAU * 0.01 * f64::from(k)).sin())).collect();
            let loudest = |part: &[f32]| part.iter().fold(0.0_f32, |most, sample| most.max(sample.abs()));
            assert!(loudest(&samples) <= LOUDEST as f32);
            let late = loudest(&samples[400_000..]);
            assert!((0.2..0.4).contains(&late), "{peak} V: {late}");
        }
        let mut leveller = Leveller { level: LEAST };
        assert!((0..100_000).all(|_| leveller.level(1e-6).abs() < 1e-4));
        assert_eq!(leveller.level(f64::NAN), 0.0);
    }

    #[test]
    fn a_rest_leaves_no_samples_to_be_made_up_for() {
        let mut sound = Sound::new(0.0, 14.0);
        sound.tune(0.0, 100.0);
        sound.take(1.0);
        let due = sound.due;
        sound.tune(0.5 * due, 100.0);
        assert_eq!(sound.due, due);
        sound.tune(7.0, 100.0);
        assert_eq!(sound.due, 7.0);
    }
}
