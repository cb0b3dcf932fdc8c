//! What a live run leaves behind: samples at a fixed spacing in the excitation's phase, Poincaré points, means.

use std::collections::VecDeque;

use super::run::{LiveRun, Reading};
use crate::app::view::live::WINDOWS;

/// Samples of an excitation period; a power of two, so that their places are exact.
const PER_TURN: u64 = 64;
/// Samples kept: two of the longest windows, the present one and the one before.
const KEPT: usize = (2 * WINDOWS.1 + 1) * PER_TURN as usize;
/// Poincaré points kept.
const POINTS: usize = 3000;
/// Kicks kept.
const KICKS: usize = 100;
/// Periods that means cover; even, as are most periods of motions.
const MEAN_PERIODS: usize = 8;
/// Periods that the extremes of the tip cover.
const SWINGS: usize = 4;
/// A scale is kept until the motion takes less than this part of it.
const LEAST_USED: f64 = 0.5;
/// Room above the motion on a scale, as a factor.
const ROOM: f64 = 1.04;

/// The run at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::app) struct Sample {
    /// Excitation periods done.
    pub turns: f64,
    /// Time (dimensionless).
    pub time: f64,
    /// Voltage, its rate, tip displacement, tip velocity.
    pub values: Reading,
}

impl Sample {
    pub(super) fn of(run: &LiveRun) -> Self {
        Self { turns: run.turns(), time: run.time(), values: run.reading() }
    }
}

/// Integrals of v^2 and of the power kappa v^2 over a time.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    square: f64,
    energy: f64,
    time: f64,
}

/// The states at which the tip is lowest and highest in a period.
#[derive(Debug, Clone, Default)]
struct Swing {
    low: Option<(f64, Vec<f64>)>,
    high: Option<(f64, Vec<f64>)>,
}

/// The record of a live run.
#[derive(Debug, Default)]
pub(in crate::app) struct Trail {
    /// Number of the next sample.
    next: u64,
    /// The last samples, oldest first.
    pub samples: VecDeque<Sample>,
    /// Those at phase 0: the Poincaré points.
    pub strobe: VecDeque<Sample>,
    /// Where the tip was kicked, as long as that is in sight.
    pub kicks: VecDeque<Sample>,
    /// Under a signal: the time (dimensionless) reached in it at the end of each turn, and the largest |v| of the turn.
    pub peaks: VecDeque<(f64, f64)>,
    peak: f64,
    /// Turns at which the numbers changed last.
    pub changed: f64,
    /// Half heights of the scales of the four values.
    pub scales: Reading,
    last: Option<Sample>,
    /// Since the last whole period, once there was one.
    sums: Option<Sums>,
    whole: VecDeque<Sums>,
    swing: Swing,
    swings: VecDeque<Swing>,
}

impl Trail {
    /// An empty record of a run that begins at `turns`.
    pub(super) fn begin(turns: f64) -> Self {
        Self { next: (turns * PER_TURN as f64).ceil() as u64, changed: turns, ..Self::default() }
    }

    /// Where the next sample is due, in turns.
    pub(super) fn due(&self) -> f64 {
        self.next as f64 / PER_TURN as f64
    }

    /// Takes the sample that was due.
    pub(super) fn take(&mut self, run: &LiveRun) {
        let sample = Sample::of(run);
        self.add(sample, run.system().parameters.kappa);
        self.peak = self.peak.max(sample.values[0].abs());
        self.swing.see(sample.values[2], run.state());
        if self.next.is_multiple_of(PER_TURN) {
            keep(&mut self.strobe, sample, POINTS);
            if let Some(sums) = self.sums.replace(Sums::default()) {
                keep(&mut self.whole, sums, MEAN_PERIODS);
            }
            let peak = std::mem::take(&mut self.peak);
            if let Some((_, place)) = run.signal() {
                keep(&mut self.peaks, (place, peak), POINTS);
            }
            keep(&mut self.swings, std::mem::take(&mut self.swing), SWINGS);
        }
        keep(&mut self.samples, sample, KEPT);
        self.next += 1;
    }

    /// By the trapezoidal rule, which is exact for the harmonics of a period that the samples resolve.
    fn add(&mut self, sample: Sample, kappa: f64) {
        let before = self.last.replace(sample);
        if let (Some(before), Some(sums)) = (before, &mut self.sums) {
            let time = sample.time - before.time;
            let square = 0.5 * (before.values[0].powi(2) + sample.values[0].powi(2)) * time;
            sums.square += square;
            sums.energy += kappa * square;
            sums.time += time;
        }
    }

    /// Root mean square of the voltage (V), mean power kappa v^2 (dimensionless) and the number of whole periods covered.
    pub(in crate::app) fn means(&self) -> Option<(f64, f64, usize)> {
        let sum = |part: fn(&Sums) -> f64| self.whole.iter().map(part).sum::<f64>();
        let time = sum(|sums| sums.time);
        (time > 0.0).then(|| {
            ((sum(|sums| sums.square) / time).sqrt(), sum(|sums| sums.energy) / time, self.whole.len())
        })
    }

    /// The states at which the tip was lowest and highest lately.
    pub(in crate::app) fn extremes(&self) -> [Option<&[f64]>; 2] {
        let swings = || self.swings.iter().chain([&self.swing]);
        let low = swings().filter_map(|swing| swing.low.as_ref()).min_by(|a, b| a.0.total_cmp(&b.0));
        let high = swings().filter_map(|swing| swing.high.as_ref()).max_by(|a, b| a.0.total_cmp(&b.0));
        [low, high].map(|found| found.map(|(_, state)| &state[..]))
    }

    /// The last samples that are not older than `turns`.
    pub(in crate::app) fn since(&self, turns: f64) -> impl Iterator<Item = &Sample> {
        let from = self.samples.partition_point(|sample| sample.turns < turns);
        self.samples.range(from..)
    }

    /// Fits the scales to the samples since `turns`: they grow at once, and shrink when little of them is used.
    pub(super) fn fit(&mut self, turns: f64) {
        let mut largest = [0.0_f64; 4];
        for sample in self.since(turns) {
            for (largest, value) in largest.iter_mut().zip(sample.values) {
                *largest = largest.max(value.abs());
            }
        }
        for (scale, largest) in self.scales.iter_mut().zip(largest) {
            let wanted = ROOM * largest;
            if !(wanted <= *scale) || wanted < LEAST_USED * *scale {
                *scale = round_up(wanted);
            }
        }
    }

    /// Notes that the numbers have changed; modes may have come or gone.
    pub(super) fn change(&mut self, turns: f64, dimension: usize) {
        self.changed = turns;
        let fits =
            |part: &Option<(f64, Vec<f64>)>| part.as_ref().is_none_or(|part| part.1.len() == dimension);
        if !(fits(&self.swing.low) && self.swings.iter().all(|swing| fits(&swing.low))) {
            (self.swing, self.swings) = Default::default();
        }
    }

    /// Forgets curves and points, but not the means.
    pub(super) fn clear(&mut self) {
        self.samples.clear();
        self.strobe.clear();
        self.kicks.clear();
        self.peaks.clear();
    }

    /// Notes that the tip was kicked.
    pub(super) fn kick(&mut self, run: &LiveRun) {
        keep(&mut self.kicks, Sample::of(run), KICKS);
    }

    /// Forgets samples whose tip is farther off than `limit` beam lengths: of an escape nothing else would be seen.
    pub(super) fn cut(&mut self, limit: f64) {
        self.samples.retain(|sample| sample.values[2].abs() <= limit);
        self.strobe.retain(|sample| sample.values[2].abs() <= limit);
    }
}

impl Swing {
    fn see(&mut self, tip: f64, state: &[f64]) {
        if self.low.as_ref().is_none_or(|low| tip < low.0) {
            self.low = Some((tip, state.to_vec()));
        }
        if self.high.as_ref().is_none_or(|high| tip > high.0) {
            self.high = Some((tip, state.to_vec()));
        }
    }
}

/// Adds a value at the end of at most `most`.
fn keep<T>(values: &mut VecDeque<T>, value: T, most: usize) {
    if values.len() == most {
        values.pop_front();
    }
    values.push_back(value);
}

/// The next larger of ten round values a decade, as the ranges of an instrument; a small one for zero.
fn round_up(value: f64) -> f64 {
    const ROUND: [f64; 10] = [1.0, 1.25, 1.6, 2.0, 2.5, 3.2, 4.0, 5.0, 6.4, 8.0];
    const LEAST: f64 = 1e-6;
    let value = if value.is_finite() { value.max(LEAST) } else { 1.0 };
    let decade = 10.0_f64.powf(value.log10().floor());
    let round = ROUND.iter().map(|round| round * decade).find(|round| *round >= value);
    round.unwrap_or(10.0 * decade)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_round_and_never_too_small() {
        for exponent in -500..500 {
            let value = 10.0_f64.powf(0.01 * f64::from(exponent));
            let scale = round_up(value);
            assert!((value..1.3 * value).contains(&scale), "{value}: {scale}");
        }
        assert_eq!((round_up(0.0), round_up(f64::NAN), round_up(9.0)), (1e-6, 1.0, 10.0));
    }

    #[test]
    fn a_scale_holds_still_until_little_of_it_is_used() {
        let mut trail = Trail::default();
        let mut put = |turns: f64, value: f64| {
            let values = [value; 4];
            trail.samples.push_back(Sample { turns, time: turns, values });
            trail.fit(turns);
            trail.scales[0]
        };
        assert_eq!([put(0.0, 1.9), put(1.0, 1.1), put(2.0, 0.9), put(3.0, 3.0)], [2.0, 2.0, 1.0, 3.2]);
    }
}
