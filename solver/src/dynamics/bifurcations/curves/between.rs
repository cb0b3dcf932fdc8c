//! What a test function may do between two stations: whether it can vanish there unseen, because it comes back.

use super::curve::SpecialKind;
use super::station::Station;

/// Places at which a course is looked at.
const SAMPLES: usize = 16;
/// Part of what the ends of a step contradict each other by, or a straight line, that a course may be wrong by in its
/// middle.
const DISTRUST: f64 = 0.5;

/// A function between two stations, from 0 to 1: a cubic by its values and slopes, and how wrong that may be.
#[derive(Debug, Clone, Copy)]
pub(super) struct TestCourse {
    start: (f64, f64),
    end: (f64, f64),
    /// Bound on the error in the middle; at the ends there is none.
    error: f64,
}

impl TestCourse {
    /// The course of the test for `kind` between two stations, the one `before` being known. `None` where one of the two
    /// has no such test.
    pub(super) fn of(
        kind: SpecialKind,
        before: Option<&Station>,
        here: &Station,
        next: &Station,
    ) -> Option<Self> {
        let (a, b) = (here.test(kind)?, next.test(kind)?);
        let length = (&next.place - &here.place).norm();
        let slope = |station: &Station| station.slope(kind).map(|slope| slope * length);
        if let Some((start, end)) = slope(here).zip(slope(next)) {
            return Some(Self::known((a, start), (b, end)));
        }
        if kind == SpecialKind::Cusp {
            return Some(Self::with_mean(a, b, here.advance(next)? / length));
        }
        let earlier = before.and_then(|before| Some((before.test(kind)?, before)));
        Some(match earlier {
            Some((value, before)) => Self::after(a, b, value, (&here.place - &before.place).norm() / length),
            None => Self { start: (a, b - a), end: (b, b - a), error: 0.0 },
        })
    }

    /// By values and slopes at both ends. A cubic cannot have slopes whose mean is not the rise unless its third
    /// derivative is not zero; a fourth one is expected to matter no more.
    fn known(start: (f64, f64), end: (f64, f64)) -> Self {
        let error = DISTRUST * (end.0 - start.0 - 0.5 * (start.1 + end.1)).abs();
        Self { start, end, error }
    }

    /// The parabola through the values at both ends with this `mean`.
    fn with_mean(a: f64, b: f64, mean: f64) -> Self {
        let (rise, bend) = (b - a, 3.0 * (a + b - 2.0 * mean));
        Self { start: (a, rise - bend), end: (b, rise + bend), error: 0.0 }
    }

    /// The parabola through the values at both ends and an earlier `value` at `distance` before the first.
    fn after(a: f64, b: f64, value: f64, distance: f64) -> Self {
        let (rise, earlier) = (b - a, (a - value) / distance);
        let bend = (rise - earlier) / (1.0 + distance);
        Self { start: (a, rise - bend), end: (b, rise + bend), error: DISTRUST * (rise - earlier).abs() }
    }

    /// Whether the ends have opposite signs.
    pub(super) fn changes_sign(&self) -> bool {
        (self.start.0 < 0.0) != (self.end.0 < 0.0)
    }

    fn at(&self, t: f64) -> f64 {
        let ((a, rise), (b, climb)) = (self.start, self.end);
        let u = 1.0 - t;
        u * u * ((1.0 + 2.0 * t) * a + t * rise) + t * t * ((1.0 + 2.0 * u) * b - u * climb)
    }

    /// Where the function may vanish beyond the sign change that the ends show, if it may.
    pub(super) fn doubt(&self) -> Option<f64> {
        let side = if self.start.0 < 0.0 { -1.0 } else { 1.0 };
        let sample = |i: usize| {
            let t = i as f64 / SAMPLES as f64;
            let error = 16.0 * self.error * (t * (1.0 - t)).powi(2);
            (t, side * self.at(t), error)
        };
        let samples = (1..SAMPLES).map(sample);
        if self.changes_sign() {
            // It may come back before its last crossing: then it is on the first side after one on the other.
            let mut crossed = false;
            for (t, value, _) in samples {
                crossed |= value < 0.0;
                if crossed && value > 0.0 {
                    return Some(t);
                }
            }
            return None;
        }
        let lowest = samples.clone().min_by(|a, b| a.1.total_cmp(&b.1))?;
        let least_sure = samples.min_by(|a, b| (a.1 - a.2).total_cmp(&(b.1 - b.2)))?;
        [lowest, least_sure]
            .iter()
            .find(|(_, value, _)| *value < 0.0)
            .map_or_else(|| (least_sure.1 < least_sure.2).then_some(least_sure.0), |(t, _, _)| Some(*t))
    }

    /// The cubic's zero between ends of opposite signs.
    pub(super) fn zero(&self) -> f64 {
        let side = if self.start.0 < 0.0 { -1.0 } else { 1.0 };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if side * self.at(middle) < 0.0 { high = middle } else { low = middle }
        }
        0.5 * (low + high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The course of `f` between 0 and 1 by its values and slopes.
    fn course(f: impl Fn(f64) -> f64) -> TestCourse {
        let slope = |t: f64| (f(t + 1e-6) - f(t - 1e-6)) / 2e-6;
        TestCourse::known((f(0.0), slope(0.0)), (f(1.0), slope(1.0)))
    }

    #[test]
    fn two_zeros_within_a_step_are_suspected() {
        for (a, b) in [(0.4, 0.6), (0.05, 0.2), (0.499, 0.501)] {
            for side in [1.0, -1.0] {
                let doubt = course(|t| side * (t - a) * (t - b) * (1.5 - t)).doubt();
                let doubt = doubt.expect("doubt");
                assert!((a - 0.1..=b + 0.1).contains(&doubt), "{a} {b}: {doubt}");
            }
        }
        // Also beside one that shows.
        assert!(course(|t| (t - 0.3) * (t - 0.5) * (t - 0.9)).doubt().is_some());
        // And where it is no cubic.
        assert!(course(|t| (t - 0.6).powi(4) - 0.01).doubt().is_some());
    }

    #[test]
    fn a_smooth_function_away_from_zero_is_not() {
        for f in [|t: f64| 1.0 + t, |t: f64| (t - 2.0).powi(3), |t: f64| (0.5 * t).cos(), |t: f64| 0.3 - t] {
            assert!(course(f).doubt().is_none());
        }
    }

    #[test]
    fn parabolas_follow_from_a_mean_and_from_an_earlier_value() {
        let f = |t: f64| 0.7 - 1.3 * t + 2.1 * t * t;
        let mean = 0.7 - 0.65 + 0.7;
        for course in
            [TestCourse::with_mean(f(0.0), f(1.0), mean), TestCourse::after(f(0.0), f(1.0), f(-0.4), 0.4)]
        {
            for t in [0.0, 0.3, 0.8] {
                assert!((course.at(t) - f(t)).abs() < 1e-12, "{t}");
            }
        }
        let crossing = TestCourse::with_mean(1.0, -2.0, -0.5);
        assert!((crossing.zero() - 1.0 / 3.0).abs() < 1e-9);
    }
}
