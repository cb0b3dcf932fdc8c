//! The largest Lyapunov exponents of a motion, with an honest error: whether it is attracted to a periodic motion
//! (negative), moves on a torus (zero) or diverges from its neighbours (positive).
//!
//! The exponents are those of the stroboscopic map over an excitation period, per dimensionless time. They are
//! averages of the growth of tangent vectors, one value a period, taken with the weight exp(-1/(x (1 - x))) of the
//! weighted Birkhoff average (Das, Saiki, Sander & Yorke, Nonlinearity 30, 2017, 4111-4140): where the growth is
//! periodic or quasiperiodic in time, on periodic motions and tori, its error falls faster than any power of the
//! number of periods; on a chaotic motion it falls like that of every average, as the inverse root.
//!
//! The first quarter of the record, in which the vectors turn into their directions, is left out. The rest is cut
//! into four blocks, each averaged in the same way. The half width of the 95 % confidence interval is Student's
//! factor times the standard error of their mean, or the distance between the averages of the two halves when that
//! is larger, which shows a drift. The blocks are averages over a quarter of the record, so that on regular motions
//! the interval is much wider than the error; more and shorter blocks would make it wider still.
//!
//! What no finite record can show: two exponents whose difference times its length is small are not told apart, so the
//! largest may come out as the next one, with a narrow interval; one smaller than about a hundredth over its length
//! counts as zero; and a chaotic transient that outlives it counts as chaotic.

use serde::{Deserialize, Serialize};

use super::rotation::weighted_average;
use super::tangent::Tangents;
use crate::dynamics::integration::{Collocation, IntegrationError, Outcome, Settings};
use crate::dynamics::orbits::Orbit;
use crate::model::ReducedSystem;

/// Blocks the record is cut into.
const BLOCKS: usize = 4;
/// Student's factor of a 95 % confidence interval from four values.
const STUDENT: f64 = 3.1824;
/// Part of the record left to the alignment of the vectors.
const ALIGNMENT: usize = 4;
/// Periods in a block at least.
const LEAST_BLOCK: usize = 32;
/// Periods that [`Exponent`] needs at least.
pub const LEAST_PERIODS: usize = BLOCKS * LEAST_BLOCK * ALIGNMENT / (ALIGNMENT - 1) + 2;
/// Growth over the whole record below which a vector has not changed its length.
const NEUTRAL: f64 = 0.01;
/// Largest half width, relative to the exponent, at which the exponent itself is known and not its sign only.
pub(super) const KNOWN: f64 = 0.2;
/// Difference of two exponents, times the record, beyond which the vectors have separated.
const SEPARATED: f64 = 10.0;
/// Largest relative difference between an exponent and that of the multipliers, beside the interval.
const SAME: f64 = 0.02;
/// Largest half width about zero, relative to the second exponent, that is small against it.
const APART: f64 = 0.1;

/// Where a Lyapunov exponent lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sign {
    /// Below zero beyond its error.
    Negative,
    /// Zero within its error, which is small against the length of the record or the second exponent.
    Zero,
    /// Above zero beyond its error.
    Positive,
    /// The record is too short to say.
    Open,
}

/// The two largest Lyapunov exponents of the stroboscopic map.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Exponent {
    /// The largest exponent, per dimensionless time.
    pub value: f64,
    /// Half the width of its 95 % confidence interval, per dimensionless time.
    pub half_width: f64,
    /// The second largest exponent, per dimensionless time.
    pub second: f64,
    /// Half the width of the second's interval.
    pub second_half_width: f64,
    /// Excitation periods that were averaged.
    pub periods: usize,
    /// Length of that record (dimensionless time).
    pub duration: f64,
    /// Whether the largest exponent is known: its half width is a fifth of it at most, or it is zero.
    pub converged: bool,
}

impl Exponent {
    /// From the logarithms of growth per period of length `period`; `None` below [`LEAST_PERIODS`].
    pub(super) fn from_growth(growth: &[Vec<f64>; 2], period: f64) -> Option<Self> {
        let [first, second] = growth;
        if first.len() < LEAST_PERIODS {
            return None;
        }
        let start = first.len() / ALIGNMENT;
        let duration = period * (first.len() - start) as f64;
        let (value, half_width) = interval(&first[start..], period);
        let (second, second_half_width) = interval(&second[start..], period);
        let mut exponent = Self {
            value,
            half_width,
            second,
            second_half_width,
            periods: first.len() - start,
            duration,
            converged: false,
        };
        exponent.converged = match exponent.sign() {
            Sign::Zero => true,
            Sign::Open => false,
            Sign::Negative | Sign::Positive => half_width <= KNOWN * value.abs(),
        };
        Some(exponent)
    }

    /// The sign of the largest exponent.
    pub fn sign(&self) -> Sign {
        let sign = sign(self.value, self.half_width, self.duration);
        // On a torus the second exponent is that of the attraction to it; far below the interval about zero, it shows
        // that nothing in the interval is the decay of a transient, whose slowest rates come in pairs.
        let apart = self.half_width <= APART * -(self.second + self.second_half_width);
        if sign == Sign::Open && self.value.abs() <= self.half_width && apart { Sign::Zero } else { sign }
    }

    /// Whether the largest exponent is that of the multipliers of `orbit`, where an excitation period lasts `period`.
    ///
    /// Exponents whose difference has not separated the tangent vectors within the record are not told apart: it may be
    /// any of those close to the largest.
    pub fn fits(&self, orbit: &Orbit, period: f64) -> bool {
        let exponents = orbit.multipliers.iter().map(|mu| mu.norm().ln() / (period * orbit.periods as f64));
        let Some(largest) = exponents.clone().next() else { return false };
        let close = exponents.filter(|exponent| (largest - exponent) * self.duration < SEPARATED);
        let lowest = close.fold(largest, f64::min);
        let room = self.half_width + SAME * largest.abs();
        (lowest - room..=largest + room).contains(&self.value)
    }

    /// The sign of the second largest exponent.
    pub fn second_sign(&self) -> Sign {
        sign(self.second, self.second_half_width, self.duration)
    }
}

fn sign(value: f64, half_width: f64, duration: f64) -> Sign {
    let neutral = NEUTRAL / duration;
    if value.abs() > half_width.max(neutral) {
        if value > 0.0 { Sign::Positive } else { Sign::Negative }
    } else if half_width <= 10.0 * neutral {
        Sign::Zero
    } else {
        Sign::Open
    }
}

/// The weighted average of `growth` per time, and half the width of its confidence interval.
fn interval(growth: &[f64], period: f64) -> (f64, f64) {
    let length = growth.len() / BLOCKS;
    let blocks: Vec<f64> = growth.chunks_exact(length).take(BLOCKS).map(weighted_average).collect();
    let mean = blocks.iter().sum::<f64>() / BLOCKS as f64;
    let square: f64 = blocks.iter().map(|block| (block - mean) * (block - mean)).sum();
    let error = STUDENT * (square / (BLOCKS * (BLOCKS - 1)) as f64).sqrt();
    let (early, late) = growth.split_at(growth.len() / 2);
    let drift = (weighted_average(late) - weighted_average(early)).abs();
    (weighted_average(growth) / period, error.max(drift) / period)
}

/// What a record of a motion says of its exponents.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Record {
    /// The exponents; `None` when it is shorter than [`LEAST_PERIODS`].
    Exponents(Option<Exponent>),
    /// Nothing: the motion escaped or touched; its time counts from the start of the record.
    Ended(Outcome),
    /// Nothing: a step of the motion is too long for its derivative.
    Unresolved,
}

/// The exponents of the motion of `system` from `state` (length 2N + 1) at a stroboscopic instant t = 2 pi k / omega,
/// best one whose transient has gone. The record grows `by` excitation periods at a time until they are `known`, or until
/// it has `most`.
///
/// # Errors
/// [`IntegrationError::InitialState`], and as [`Collocation::advance`].
pub fn exponents(
    system: &ReducedSystem,
    state: &[f64],
    (by, most): (usize, usize),
    known: &dyn Fn(&Exponent) -> bool,
) -> Result<Record, IntegrationError> {
    let mut integrator = Collocation::new(system, state, Settings::default())?;
    let mut tangents = Tangents::new(system);
    let mut periods = 0;
    loop {
        periods = most.min(periods + by.max(1));
        while tangents.growth()[0].len() < periods {
            if let Some(outcome) = integrator.advance(f64::INFINITY, 1, &mut |step| tangents.record(step))? {
                return Ok(Record::Ended(outcome));
            }
        }
        if !tangents.resolved() {
            return Ok(Record::Unresolved);
        }
        let found = Exponent::from_growth(tangents.growth(), system.parameters.period());
        if periods == most || found.as_ref().is_some_and(known) {
            return Ok(Record::Exponents(found));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weighted_average_of_a_quasiperiodic_record_converges_fast() {
        let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
        let record: Vec<f64> =
            (0..1000).map(|k| 0.3 + (std::f64::consts::TAU * golden * f64::from(k)).sin()).collect();
        let plain = record.iter().sum::<f64>() / 1000.0;
        assert!((weighted_average(&record) - 0.3).abs() < 1e-12);
        assert!((plain - 0.3).abs() > 1e-5);
    }

    #[test]
    fn too_few_periods_say_nothing() {
        let record = vec![0.1; LEAST_PERIODS - 1];
        assert_eq!(Exponent::from_growth(&[record.clone(), record], 1.0), None);
    }

    #[test]
    fn a_drifting_record_is_not_converged() {
        let record: Vec<f64> = (0..800).map(|k| 1e-3 * (f64::from(k) / 800.0 - 0.55)).collect();
        let exponent = Exponent::from_growth(&[record.clone(), record], 1.0).expect("long enough");
        assert_eq!((exponent.sign(), exponent.converged), (Sign::Open, false));
    }

    /// The interval must hold the mean of independent values about 95 times in a hundred.
    #[test]
    fn the_interval_covers_the_mean_of_noise() {
        let mut seed = 1_u64;
        let mut uniform = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        let covered = (0..1000)
            .filter(|_| {
                let record: Vec<f64> = (0..256).map(|_| uniform() + uniform() - 1.0).collect();
                let (value, half_width) = interval(&record, 1.0);
                value.abs() <= half_width
            })
            .count();
        assert!((930..=995).contains(&covered), "{covered}");
    }
}
