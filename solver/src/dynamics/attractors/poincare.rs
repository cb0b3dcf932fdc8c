//! The Poincare map: the state once an excitation period, at t = 2 pi k / omega, and whether it recurs.

use serde::Serialize;

/// Points that [`recurrence`] compares; twice as many are needed.
const COMPARED: usize = 24;
/// Longest period looked for, in excitation periods.
const LONGEST: usize = 8;
/// Relative defect below which points count as repeating while they still settle.
const SETTLING: f64 = 2e-2;
/// Relative defect below which they count as settled.
const SETTLED: f64 = 1e-4;

/// Voltage and its rate at one instant.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PhasePoint {
    /// v (V).
    pub v: f64,
    /// dv/dt (V per dimensionless time).
    pub dv_dt: f64,
}

/// What the last stroboscopic points of a run say about its motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Recurrence {
    /// The motion repeats after this many excitation periods; `None` when it does not within eight.
    pub period: Option<usize>,
    /// Largest distance between points that should coincide, relative to the motion's amplitude.
    pub defect: f64,
    /// Whether the defect is small enough to call the transient gone.
    pub settled: bool,
}

/// Looks for the shortest period with which the last of `points` repeat.
///
/// `voltage` and `rate` are the amplitudes of v and dv/dt that distances are measured by. A period is accepted
/// when the points repeat to 2 % and the distance does not grow, which a slow transient and a slowly modulated
/// motion both satisfy: read [`Recurrence::settled`] beside it. `None` when there are too few points.
pub fn recurrence(points: &[PhasePoint], voltage: f64, rate: f64) -> Option<Recurrence> {
    if points.len() < 2 * COMPARED + LONGEST || !(voltage > 0.0 && rate > 0.0) {
        return None;
    }
    let defect = |period: usize, end: usize| {
        (end - COMPARED..end)
            .map(|k| {
                let (a, b) = (points[k], points[k - period]);
                ((a.v - b.v) / voltage).hypot((a.dv_dt - b.dv_dt) / rate)
            })
            .fold(0.0, f64::max)
    };
    let end = points.len();
    for period in 1..=LONGEST {
        let now = defect(period, end);
        let growing = now > defect(period, end - COMPARED);
        if now < SETTLED || (now < SETTLING && !growing) {
            return Some(Recurrence { period: Some(period), defect: now, settled: now < SETTLED });
        }
    }
    Some(Recurrence { period: None, defect: defect(1, end), settled: false })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(count: usize, value: impl Fn(usize) -> f64) -> Vec<PhasePoint> {
        (0..count).map(|k| PhasePoint { v: value(k), dv_dt: 2.0 * value(k) }).collect()
    }

    fn period(points: &[PhasePoint]) -> Option<usize> {
        recurrence(points, 1.0, 2.0).and_then(|found| found.period)
    }

    #[test]
    fn periods_are_recognised_while_and_after_they_settle() {
        assert_eq!(period(&points(100, |_| 0.7)), Some(1));
        assert_eq!(period(&points(100, |k| if k % 2 == 0 { 0.7 } else { -0.3 })), Some(2));
        assert_eq!(period(&points(100, |k| (k % 3) as f64)), Some(3));
        let settling = points(200, |k| 0.7 + 0.5 * (-0.02 * k as f64).exp() * (0.9 * k as f64).cos());
        let found = recurrence(&settling, 1.0, 2.0);
        assert!(found.is_some_and(|found| found.period == Some(1) && !found.settled));
    }

    #[test]
    fn a_torus_does_not_repeat() {
        assert_eq!(period(&points(200, |k| (0.161 * std::f64::consts::TAU * k as f64).sin())), None);
    }

    #[test]
    fn a_growing_motion_is_not_called_periodic() {
        assert_eq!(period(&points(200, |k| 1e-3 * (0.02 * k as f64).exp() * (0.9 * k as f64).cos())), None);
    }

    #[test]
    fn few_points_say_nothing() {
        assert_eq!(recurrence(&points(20, |_| 0.7), 1.0, 2.0), None);
    }
}
