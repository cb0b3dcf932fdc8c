//! Recorded vibration.

use std::f64::consts::PI;

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

use super::{ACCELERATIONS, DERIVATIVES, DURATIONS, FREQUENCIES, MOST_SAMPLES, Shared, Signal};
use crate::model::ModelError;

/// Differences of the intervals, relative to their median, that count as the clock's rounding.
const JITTER: f64 = 1e-3;
/// Longest interval, in medians, over which is interpolated.
const LONGEST_GAP: f64 = 10.0;
/// Samples of a period at the highest frequency that a band-limited record keeps: between them 2e-5 of an amplitude is lost.
const PER_PERIOD: f64 = 16.0;
/// How far the band limit's weights reach, in periods of the highest frequency.
const REACH: f64 = 16.0;

/// A record of the base's acceleration.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, SerBin, DeBin)]
#[serde(default, deny_unknown_fields)]
pub struct Recorded {
    /// Ascending times (s).
    pub time: Shared<Vec<f64>>,
    /// The acceleration at each (g).
    pub acceleration: Shared<Vec<f64>>,
    /// Whether its mean is taken away, which an accelerometer shows where there is none.
    pub remove_mean: bool,
    /// Frequency (Hz) above which everything is taken away, if any: half an amplitude stays at it, all of it up to 0.9 of
    /// it, nothing from 1.1 of it on, each to 0.03 %. Samples closer than a sixteenth of its period are taken anew, that far apart.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub highest: Option<f64>,
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
            entry("acceleration", i, *a, (-most, most), " g")?;
        }
        let interval = self.median_interval()?;
        let mean = if self.remove_mean { acceleration.iter().sum::<f64>() / value as f64 } else { 0.0 };
        let (interval, samples) = if self.is_even(interval) {
            let even = (time[value - 1] - time[0]) / (value - 1) as f64;
            (even, acceleration.iter().map(|a| a - mean).collect())
        } else {
            (interval, self.resampled(interval, mean))
        };
        let Some(highest) = self.highest else { return Signal::new(interval, samples) };
        ModelError::check("highest", highest, FREQUENCIES, " Hz")?;
        let (interval, samples) = limited(interval, samples, highest);
        Signal::new(interval, samples)
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
            entry("time", i, *t, (lowest, DURATIONS.1), " s")?;
            lowest = t.next_up();
        }
        let mut intervals: Vec<f64> = self.time.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let middle = intervals.len() / 2;
        let (_, median, _) = intervals.select_nth_unstable_by(middle, f64::total_cmp);
        let median = *median;
        for (i, pair) in self.time.windows(2).enumerate() {
            let most = pair[0] + LONGEST_GAP * median;
            entry("time", i + 1, pair[1], (pair[0], most), " s")?;
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

/// Checks an entry of a list; its name is made only where it is needed, as there may be millions.
fn entry(
    list: &str,
    i: usize,
    value: f64,
    (low, high): (f64, f64),
    unit: &'static str,
) -> Result<(), ModelError> {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    ModelError::check(&format!("{list}[{i}]"), value, (low, high), unit).map(|_| ())
}

/// Whether samples `interval` (s) apart can hold anything above the frequency `highest` (Hz), so that a limit there takes it away.
pub fn reaches_above(highest: f64, interval: f64) -> bool {
    2.0 * highest * interval < 1.0
}

/// Samples so far apart (s), without what is above `highest` (Hz), and how far apart the new ones are. Samples that hold nothing
/// above it stay as they are.
///
/// Reference: the ideal low-pass filter under Blackman's window; Oppenheim & Schafer, "Discrete-Time Signal Processing",
/// section 7.5.
fn limited(interval: f64, samples: Vec<f64>, highest: f64) -> (f64, Vec<f64>) {
    if !reaches_above(highest, interval) {
        return (interval, samples);
    }
    let last = samples.len() - 1;
    let stride = (1.0 / (PER_PERIOD * highest * interval)).floor().max(1.0) as usize;
    let stride = stride.min(last / (DERIVATIVES - 1)).max(1);
    let reach = ((REACH / (highest * interval)) as usize).min(last);
    let weight = |distance: usize| {
        let angle = 2.0 * PI * highest * interval * distance as f64;
        let sinc = if distance == 0 { 1.0 } else { angle.sin() / angle };
        let part = PI * distance as f64 / (reach as f64 + 1.0);
        sinc * (0.42 + 0.5 * part.cos() + 0.08 * (2.0 * part).cos())
    };
    let weights: Vec<f64> = (0..=reach).map(weight).collect();
    let whole = weights[0] + 2.0 * weights[1..].iter().sum::<f64>();
    let at = |place: usize| {
        if place >= reach && place + reach <= last {
            let sides = samples[place - reach..place].iter().rev().zip(&samples[place + 1..]);
            let pairs = weights[1..].iter().zip(sides);
            let sum = weights[0] * samples[place] + pairs.map(|(w, (a, b))| w * (a + b)).sum::<f64>();
            return sum / whole;
        }
        let near = place.saturating_sub(reach)..=(place + reach).min(last);
        // Over the sum of the weights, so that a constant stays one up to the ends.
        let (sum, all) = near.fold((0.0, 0.0), |(sum, all), i| {
            let weight = weights[i.abs_diff(place)];
            (sum + weight * samples[i], all + weight)
        });
        sum / all
    };
    (stride as f64 * interval, (0..=last / stride).map(|i| at(i * stride)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(times: impl Iterator<Item = f64>) -> Recorded {
        let time: Vec<f64> = times.collect();
        let acceleration = time.iter().map(|t| 0.2 + (3.0 * t).sin()).collect();
        record_of(time, acceleration, None)
    }

    fn record_of(time: Vec<f64>, acceleration: Vec<f64>, highest: Option<f64>) -> Recorded {
        let (time, acceleration) = (Shared::new(time), Shared::new(acceleration));
        Recorded { time, acceleration, remove_mean: false, highest }
    }

    #[test]
    fn equally_spaced_samples_are_taken_as_they_are() -> Result<(), ModelError> {
        // Times as a file rounds them, and beginning at any time.
        let even = record((0..200).map(|i| (1e4 * (5.0 + 0.0333 * i as f64)).round() / 1e4));
        let signal = even.signal()?;
        assert_eq!(signal.samples(), &even.acceleration[..]);
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
    fn a_band_limit_keeps_what_is_below_it_and_nothing_above() -> Result<(), ModelError> {
        use std::f64::consts::TAU;
        // 1 kHz for 8 s, limited to 20 Hz: samples stay at 333 Hz.
        let tone = |hertz: f64| -> Result<Signal, ModelError> {
            let time: Vec<f64> = (0..8000).map(|i| 1e-3 * f64::from(i)).collect();
            let acceleration = time.iter().map(|t| 0.5 + (TAU * hertz * t).sin()).collect();
            record_of(time, acceleration, Some(20.0)).signal()
        };
        for (hertz, kept) in [(3.0, 1.0), (18.0, 1.0), (20.0, 0.5), (22.0, 0.0), (50.0, 0.0), (480.0, 0.0)] {
            let signal = tone(hertz)?;
            assert!((signal.interval() - 3e-3).abs() < 1e-12);
            let inside = (1.0 / 3e-3) as usize..(6.0 / 3e-3) as usize;
            let off = inside.map(|i| {
                let t = 3e-3 * i as f64;
                (signal.samples()[i] - 0.5 - kept * (TAU * hertz * t).sin()).abs()
            });
            let worst = off.fold(0.0, f64::max);
            assert!(worst < 3e-4, "{hertz} Hz: {worst}");
        }
        // A constant is one up to the ends, and what holds nothing above the limit stays as it is.
        let time: Vec<f64> = (0..500).map(|i| 1e-2 * f64::from(i)).collect();
        let constant = record_of(time, vec![0.7; 500], Some(5.0));
        assert!(constant.signal()?.samples().iter().all(|a| (a - 0.7).abs() < 1e-12));
        let wide = Recorded { highest: Some(60.0), ..constant.clone() };
        assert_eq!(wide.signal()?, Recorded { highest: None, ..constant.clone() }.signal()?);
        let refused = Recorded { highest: Some(-1.0), ..constant }.signal().expect_err("refused");
        assert!(refused.to_string().starts_with("highest = -1"));
        Ok(())
    }

    #[test]
    fn times_that_do_not_ascend_and_gaps_are_named() {
        let refused =
            |times: &[f64]| record(times.iter().copied()).signal().expect_err("refused").to_string();
        assert!(refused(&[0.0, 1.0, 2.0, 2.0, 3.0, 4.0]).starts_with("time[3] = 2"));
        assert!(refused(&[0.0, 1.0, 2.0, 3.0, 4.0, 50.0]).starts_with("time[5] = 50"));
        assert!(refused(&[0.0, 1.0]).starts_with("numbers in time = 2"));
        let short = Recorded { acceleration: Shared::new(vec![0.0; 5]), ..record((0..6).map(f64::from)) };
        assert!(short.signal().expect_err("refused").to_string().starts_with("numbers in acceleration = 5"));
    }
}
