//! A recording that shakes the base: what was brought, by what a link knows it, and what was done to it.

use crate::app::view::shake::Recording;
use crate::model::base_motion::{self, Shared};
use crate::model::{ModelError, STANDARD_GRAVITY};

/// An accelerometer's record of the base.
#[derive(Debug, Clone)]
pub(in crate::app) struct BaseRecording {
    /// How a link names it.
    pub recording: Recording,
    /// Times (s).
    pub time: Shared<Vec<f64>>,
    /// Accelerations (g).
    pub acceleration: Shared<Vec<f64>>,
    /// Median interval (s) of the samples.
    pub interval: f64,
    /// Whether the samples are that far apart throughout, so that none were taken anew.
    pub even: bool,
    /// How long it lasts (s), and mean and root mean square about it (g).
    pub duration: f64,
    pub mean: f64,
    pub rms: f64,
}

impl BaseRecording {
    /// Of a file's `points`, in s and m/s^2.
    ///
    /// # Errors
    /// [`ModelError`], naming what of them cannot shake a base.
    pub(super) fn of(name: &str, points: &[[f64; 2]]) -> Result<Self, ModelError> {
        let time: Vec<f64> = points.iter().map(|point| point[0]).collect();
        let acceleration: Vec<f64> = points.iter().map(|point| point[1] / STANDARD_GRAVITY).collect();
        let mut hasher = crc32fast::Hasher::new();
        for value in time.iter().chain(&acceleration) {
            hasher.update(&value.to_le_bytes());
        }
        let recording = Recording::new(name, hasher.finalize());
        let (time, acceleration) = (Shared::new(time), Shared::new(acceleration));
        let written = base_motion::Recorded {
            time: time.clone(),
            acceleration: acceleration.clone(),
            remove_mean: true,
            highest: None,
        };
        let interval = written.median_interval()?;
        let even = written.is_even(interval);
        let signal = written.signal()?;
        let mean = acceleration.iter().sum::<f64>() / acceleration.len() as f64;
        let (duration, rms) = (signal.duration(), signal.rms());
        Ok(Self { recording, time, acceleration, interval, even, duration, mean, rms })
    }

    /// As the model takes it: with or without its mean, and nothing above `highest` (Hz).
    pub(super) fn motion(&self, with_mean: bool, highest: f64) -> base_motion::Recorded {
        base_motion::Recorded {
            time: self.time.clone(),
            acceleration: self.acceleration.clone(),
            remove_mean: !with_mean,
            highest: self.is_limited(highest).then_some(highest),
        }
    }

    /// Whether a limit at `highest` (Hz) takes anything away.
    pub(in crate::app) fn is_limited(&self, highest: f64) -> bool {
        base_motion::reaches_above(highest, self.interval)
    }

    /// As the text of a file: time (s) and acceleration (g).
    pub(in crate::app) fn text(time: &[f64], acceleration: &[f64]) -> String {
        let rows = time.iter().zip(acceleration).map(|(t, a)| format!("{t},{a}\n"));
        "time [s],acceleration [g]\n".to_owned() + &rows.collect::<String>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::bench::measured::Measured;
    use crate::app::bench::shaking::noise_as_recorded;
    use crate::app::view::View;
    use crate::questions::design::measured::Kind;

    #[test]
    fn a_recording_is_read_named_by_its_numbers_and_limited() {
        let mut vibration = Measured::of(Kind::Acceleration);
        let text = noise_as_recorded(&View::default()).expect("a noise");
        vibration.open("noise.csv", text.clone().into_bytes());
        while vibration.work() {}
        assert_eq!(vibration.error, None);
        let recorded = |vibration: &Measured| {
            vibration.file.as_ref().and_then(|file| file.recorded.clone()).expect("a recording")
        };
        let first = recorded(&vibration);
        assert!(first.even && (first.rms / 0.02 - 1.0).abs() < 0.2, "{}", first.rms);
        // The same numbers under another name have the same checksum, others have not.
        vibration.open("other.csv", text.into_bytes());
        while vibration.work() {}
        let again = recorded(&vibration);
        assert_eq!(
            (&again.recording.name[..], again.recording.checksum),
            ("other.csv", first.recording.checksum)
        );
        let metres = "t [s],a [m/s2]\n".to_owned()
            + &(0..60).map(|i| format!("{},{}\n", 0.01 * f64::from(i), f64::from(i % 7))).collect::<String>();
        vibration.open("metres.csv", metres.into_bytes());
        while vibration.work() {}
        let other = recorded(&vibration);
        assert_ne!(other.recording.checksum, first.recording.checksum);
        assert!((other.acceleration[5] - 5.0 / STANDARD_GRAVITY).abs() < 1e-15);
        assert!(other.is_limited(10.0) && !other.is_limited(60.0));
        assert_eq!(other.motion(true, 60.0).highest, None);
        vibration.open("sweep.csv", b"f [Hz],a [g]\n1,0\n2,1\n3,0\n4,1\n5,0\n6,1\n".to_vec());
        assert!(vibration.error.as_ref().is_some_and(|error| error.contains("needs times")));
        assert_eq!(recorded(&vibration).recording, other.recording);
        // Times that go back cannot shake anything: that is said, and the columns stay to be chosen anew.
        vibration.open("back.csv", b"t [s],a [g]\n0,1\n1,2\n2,1\n1,3\n4,1\n5,2\n6,3\n7,1\n".to_vec());
        while vibration.work() {}
        assert!(
            vibration.error.as_ref().is_some_and(|error| error.contains("time[3]")),
            "{:?}",
            vibration.error
        );
        assert!(
            vibration
                .file
                .as_ref()
                .is_some_and(|file| file.recorded.is_none() && file.clock.decreases == Some(3))
        );
    }
}
