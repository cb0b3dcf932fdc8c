//! Recorded vibration.

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

use super::{ACCELERATIONS, DERIVATIVES, DURATIONS, MOST_SAMPLES, Signal};
use crate::model::ModelError;

/// Differences of the intervals, relative to their median, that count as the clock's rounding.
const JITTER: f64 = 1e-3;
/// Longest interval, in medians, over which is interpolated.
const LONGEST_GAP: f64 = 10.0;

/// A record of the base's acceleration.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, SerBin, DeBin)]
#[serde(default, deny_unknown_fields)]
pub struct Recorded {
    /// Ascending times (s).
    pub time: Vec<f64>,
    /// The acceleration at each (g).
    pub acceleration: Vec<f64>,
    /// Whether its mean is taken away, which an accelerometer shows where there is none.
    pub remove_mean: bool,
}

impl Recorded {
    /// The acceleration over time (s, g), which begins with its first sample. Where the samples are not equally spaced they are
    /// taken anew, at their median interval.
    ///
    /// # Errors
    /// [`ModelError`], naming the entry that is out of range or too many or few of them.
    pub fn signal(&self) -> Result<Signal, ModelError> {
        let Self { time, acceleration, .. } = self;
        let (value, maximum) = (time.len(), MOST_SAMPLES);
        if !(DERIVATIVES..=maximum).contains(&value) {
            return Err(ModelError::Count { field: "numbers in time", value, minimum: DERIVATIVES, maximum });
        }
        if acceleration.len() != value {
            return Err(ModelError::Count {
                field: "numbers in acceleration",
                value: acceleration.len(),
                minimum: value,
                maximum: value,
            });
        }
        for (i, a) in acceleration.iter().enumerate() {
            let (_, most) = ACCELERATIONS;
            ModelError::check(&format!("acceleration[{i}]"), *a, (-most, most), " g")?;
        }
        let interval = self.median_interval()?;
        let mean = if self.remove_mean { acceleration.iter().sum::<f64>() / value as f64 } else { 0.0 };
        if !self.is_even(interval) {
            return Signal::new(interval, self.resampled(interval, mean));
        }
        let even = (time[value - 1] - time[0]) / (value - 1) as f64;
        Signal::new(even, acceleration.iter().map(|a| a - mean).collect())
    }

    /// Whether the samples are equally spaced, but for the clock's rounding.
    pub fn is_even(&self, interval: f64) -> bool {
        let begin = self.time[0];
        let places = self.time.iter().enumerate();
        let even = (self.time[self.time.len() - 1] - begin) / (self.time.len() - 1) as f64;
        (even / interval - 1.0).abs() < JITTER
            && places.into_iter().all(|(i, t)| (t - begin - even * i as f64).abs() < 0.05 * interval)
    }

    /// The median of the intervals (s), all of which must be positive and none much longer.
    ///
    /// # Errors
    /// [`ModelError::OutOfRange`], naming the first time that does not ascend, or leaves a gap.
    pub fn median_interval(&self) -> Result<f64, ModelError> {
        let mut lowest = -DURATIONS.1;
        for (i, t) in self.time.iter().enumerate() {
            ModelError::check(&format!("time[{i}]"), *t, (lowest, DURATIONS.1), " s")?;
            lowest = t.next_up();
        }
        let mut intervals: Vec<f64> = self.time.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let middle = intervals.len() / 2;
        let (_, median, _) = intervals.select_nth_unstable_by(middle, f64::total_cmp);
        let median = *median;
        for (i, pair) in self.time.windows(2).enumerate() {
            let most = pair[0] + LONGEST_GAP * median;
            ModelError::check(&format!("time[{}]", i + 1), pair[1], (pair[0], most), " s")?;
        }
        let span = self.time[self.time.len() - 1] - self.time[0];
        let most = median * MOST_SAMPLES as f64;
        ModelError::check(
            &format!("time[{}]", self.time.len() - 1),
            self.time[0] + span,
            (-DURATIONS.1, self.time[0] + most),
            " s",
        )?;
        Ok(median)
    }

    /// Samples so far apart, by the cubic through the four given ones about each, less their `mean`.
    fn resampled(&self, interval: f64, mean: f64) -> Vec<f64> {
        let Self { time, acceleration, .. } = self;
        let (begin, last) = (time[0], time.len() - 1);
        let count = ((time[last] - begin) / interval * (1.0 + 1e-12)).floor() as usize;
        let at = |t: f64| {
            let next = time.partition_point(|given| *given <= t).clamp(2, last - 1);
            let nodes = next - 2..next + 2;
            let cardinal = |i: usize| -> f64 {
                let others = nodes.clone().filter(|j| *j != i);
                others.map(|j| (t - time[j]) / (time[i] - time[j])).product()
            };
            nodes.clone().map(|i| acceleration[i] * cardinal(i)).sum::<f64>() - mean
        };
        (0..=count.max(DERIVATIVES)).map(|i| at((begin + interval * i as f64).min(time[last]))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(times: impl Iterator<Item = f64>) -> Recorded {
        let time: Vec<f64> = times.collect();
        let acceleration = time.iter().map(|t| 0.2 + (3.0 * t).sin()).collect();
        Recorded { time, acceleration, remove_mean: false }
    }

    #[test]
    fn equally_spaced_samples_are_taken_as_they_are() -> Result<(), ModelError> {
        // Times as a file rounds them, and beginning at any time.
        let even = record((0..200).map(|i| (1e4 * (5.0 + 0.0333 * i as f64)).round() / 1e4));
        let signal = even.signal()?;
        assert_eq!(signal.samples(), even.acceleration);
        assert!((signal.interval() - 0.0333).abs() < 1e-6);
        let centred = Recorded { remove_mean: true, ..even }.signal()?;
        assert!(centred.mean().abs() < 1e-12 && signal.mean() > 0.1);
        Ok(())
    }

    #[test]
    fn uneven_samples_are_taken_anew() -> Result<(), ModelError> {
        let uneven = record((0..400).map(|i| 0.02 * i as f64 + 0.006 * (1.7 * i as f64).sin()));
        let signal = uneven.signal()?;
        let begin = uneven.time[0];
        for t in [0.5, 1.234, 4.2] {
            let expected = 0.2 + (3.0 * (begin + t)).sin();
            assert!((signal.at(t) - expected).abs() < 1e-5, "{t}: {} {expected}", signal.at(t));
        }
        Ok(())
    }

    #[test]
    fn times_that_do_not_ascend_and_gaps_are_named() {
        let refused =
            |times: &[f64]| record(times.iter().copied()).signal().expect_err("refused").to_string();
        assert!(refused(&[0.0, 1.0, 2.0, 2.0, 3.0, 4.0]).starts_with("time[3] = 2"));
        assert!(refused(&[0.0, 1.0, 2.0, 3.0, 4.0, 50.0]).starts_with("time[5] = 50"));
        assert!(refused(&[0.0, 1.0]).starts_with("numbers in time = 2"));
        let short = Recorded { acceleration: vec![0.0; 5], ..record((0..6).map(f64::from)) };
        assert!(short.signal().expect_err("refused").to_string().starts_with("numbers in acceleration = 5"));
    }
}
