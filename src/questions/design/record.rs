//! What is the matter with a record's clock, and its mean square over whole cycles.

/// How the times (or frequencies) of a record go on; places are rows from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Clock {
    /// The first row whose time is before that of the row before.
    pub decreases: Option<usize>,
    /// The first row with the time of the row before.
    pub repeats: Option<usize>,
    /// The first row from which on steps are a thousand times as long, or as short: another unit.
    pub unit_changes: Option<usize>,
}

/// Factor between steps that is another unit rather than another rate: a thousand, within a few per cent.
const OTHER_UNIT: f64 = 1000.0;
const WITHIN: f64 = 0.05;

impl Clock {
    /// Of `points` (x, value) in the file's order.
    pub fn of(points: &[[f64; 2]]) -> Self {
        let mut clock = Self::default();
        let steps = || points.windows(2).map(|pair| pair[1][0] - pair[0][0]).enumerate();
        clock.decreases = steps().find(|(_, step)| *step < 0.0).map(|(i, _)| i + 1);
        clock.repeats = steps().find(|(_, step)| *step == 0.0).map(|(i, _)| i + 1);
        // A step of the old kind, one across, then steps of the new kind.
        let other = |ratio: f64| (ratio / OTHER_UNIT - 1.0).abs() < WITHIN;
        let known: Vec<f64> = steps().map(|(_, step)| step.abs()).collect();
        let change = (1..known.len().saturating_sub(2)).find(|i| {
            let ratio = known[i + 1] / known[i - 1];
            let stays = (known[i + 2] / known[i + 1] - 1.0).abs() < WITHIN;
            stays && (other(ratio) || other(1.0 / ratio))
        });
        clock.unit_changes = change.map(|i| i + 1);
        clock
    }

    /// Whether sorting helps.
    pub fn is_unsorted(&self) -> bool {
        self.decreases.is_some()
    }
}

/// The points by ascending x; those of the same x stay in their order.
pub fn sorted(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    points
}

/// A record's mean, and root mean square and largest distance about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Level {
    /// Mean.
    pub mean: f64,
    /// Root mean square about it.
    pub rms: f64,
    /// Largest distance from it.
    pub peak: f64,
    /// Whole cycles over which these are taken; 0 where there are none and the whole record is.
    pub cycles: usize,
}

/// Part of the largest distance from the mean that a value must fall below before it can rise through it again: noise
/// makes no cycles.
const BELOW: f64 = 0.25;

impl Level {
    /// Of `points` (time, value) with ascending times: integrals over time between the first and the last upward passage
    /// through the mean. `None` without points, or with a time that does not ascend.
    pub fn of(points: &[[f64; 2]]) -> Option<Self> {
        let whole = Self::between(points, 0)?;
        let mut passages: Vec<(usize, f64)> = Vec::new();
        let mut armed = false;
        for (i, pair) in points.windows(2).enumerate() {
            let (a, b) = (pair[0][1] - whole.mean, pair[1][1] - whole.mean);
            armed |= a < -BELOW * whole.peak;
            if armed && a < 0.0 && b >= 0.0 {
                passages.push((i, pair[0][0] + (pair[1][0] - pair[0][0]) * a / (a - b)));
                armed = false;
            }
        }
        let (Some(first), Some(last)) = (passages.first(), passages.last()) else { return Some(whole) };
        if passages.len() < 2 {
            return Some(whole);
        }
        let mut cut = vec![[first.1, whole.mean]];
        cut.extend_from_slice(&points[first.0 + 1..=last.0]);
        cut.push([last.1, whole.mean]);
        Self::between(&cut, passages.len() - 1)
    }

    fn between(points: &[[f64; 2]], cycles: usize) -> Option<Self> {
        let span = points.last()?[0] - points.first()?[0];
        if !(span > 0.0) || points.windows(2).any(|pair| pair[1][0] < pair[0][0]) {
            return None;
        }
        let integral = |of: &dyn Fn(f64, f64) -> f64| {
            let pairs = points.windows(2).map(|pair| (pair[1][0] - pair[0][0]) * of(pair[0][1], pair[1][1]));
            pairs.sum::<f64>() / span
        };
        let mean = integral(&|a, b| 0.5 * (a + b));
        // Of the straight line between two values.
        let square = integral(&|a, b| {
            let (a, b) = (a - mean, b - mean);
            (a * a + a * b + b * b) / 3.0
        });
        let peak = points.iter().map(|point| (point[1] - mean).abs()).fold(0.0, f64::max);
        Some(Self { mean, rms: square.sqrt(), peak, cycles })
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_1_SQRT_2, TAU};

    use super::*;

    #[test]
    fn a_sine_has_its_root_mean_square_whatever_part_of_a_cycle_hangs_over() {
        // Upward passages through the mean at 0.936, 1.936, ..: phase 0.4 before whole cycles.
        for (span, cycles) in [(2.0, 1), (2.3, 1), (7.77, 6), (1.3, 0)] {
            let place = |i: usize| span * i as f64 / 4000.0;
            let points: Vec<[f64; 2]> =
                (0..=4000).map(|i| [place(i), 3.0 + 2.0 * (TAU * place(i) + 0.4).sin()]).collect();
            let level = Level::of(&points).expect("a record");
            assert_eq!(level.cycles, cycles, "{level:?}");
            if level.cycles > 0 {
                assert!((level.rms / (2.0 * FRAC_1_SQRT_2) - 1.0).abs() < 2e-3, "{span}: {level:?}");
            }
        }
        assert_eq!(Level::of(&[[0.0, 1.0], [1.0, 2.0]]).expect("a record").cycles, 0);
        assert_eq!(Level::of(&[[0.0, 1.0], [1.0, 2.0], [0.5, 1.0]]), None);
    }

    #[test]
    fn what_is_the_matter_with_times_is_told_by_row() {
        let clock = |times: &[f64]| Clock::of(&times.iter().map(|t| [*t, 0.0]).collect::<Vec<_>>());
        assert_eq!(clock(&[0.0, 1.0, 2.0, 3.0, 4.0]), Clock::default());
        assert_eq!(clock(&[0.0, 1.0, 0.5, 3.0]).decreases, Some(2));
        assert_eq!(clock(&[0.0, 1.0, 1.0, 3.0]).repeats, Some(2));
        let milliseconds = clock(&[0.997, 0.998, 0.999, 1000.0, 1001.0, 1002.0]);
        assert_eq!((milliseconds.unit_changes, milliseconds.decreases), (Some(3), None));
        assert_eq!(sorted(vec![[2.0, 0.0], [1.0, 1.0]]), [[1.0, 1.0], [2.0, 0.0]]);
    }
}
