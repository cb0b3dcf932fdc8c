//! What runs under shaking say together: means with standard errors from batches of each.
//!
//! Reference: Law & Kelton, "Simulation Modeling and Analysis", section 9.5.3, batch means.

use nanoserde::{DeBin, SerBin};
use serde::Serialize;

use super::shaken_run::Found;
use crate::dynamics::integration::shaken::PARTS;

/// Times of decay that a batch takes at least, so that batches hardly know of one another.
const BATCH: f64 = 5.0;
/// Fewest batches whose scatter says anything.
const LEAST_BATCHES: usize = 4;
/// Fewest into which batches are put together to see whether they know of one another.
const LEAST_BLOCKS: usize = 12;

/// What was measured under the shaking, in SI units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, SerBin, DeBin)]
pub struct Harvested {
    /// Root mean square of the voltage (V).
    pub v_rms: f64,
    /// Largest |v| (V).
    pub v_peak: f64,
    /// Mean power in the load (W).
    pub power: f64,
    /// Standard error of that mean (W), by batches over all realisations; absent where the run is no sample of a longer one,
    /// or too short.
    pub power_error: Option<f64>,
    /// Lowest and highest displacement of the tip (mm).
    pub tip: (f64, f64),
    /// Largest |slope| at the tip (rad).
    pub slope: f64,
    /// Mean power that the base puts in (W).
    pub input: f64,
}

/// Duration (s), integral of the voltage's square (V^2 s) and work of the base (J) of a run in batches that hardly know of one
/// another.
fn batches(run: &Found) -> Vec<[f64; 3]> {
    let counted = run.counted();
    let part = run.end / PARTS as f64;
    let length = (BATCH * run.decay / part).ceil().clamp(1.0, counted.len() as f64) as usize;
    let whole = counted.len() / length;
    let sum = |parts: &[(f64, f64, f64)]| {
        parts.iter().fold([0.0; 3], |[duration, square, input], (t, s, i)| {
            [duration + t, square + t * s, input + t * i]
        })
    };
    // What is left over goes to the last one.
    (0..whole)
        .map(|i| sum(&counted[i * length..if i + 1 == whole { counted.len() } else { (i + 1) * length }]))
        .collect()
}

/// Means and extremes of runs; `None` of none.
pub fn measured(runs: &[&Found], stationary: bool) -> Option<Harvested> {
    let first = runs.first()?;
    let batches: Vec<[f64; 3]> = runs.iter().flat_map(|run| batches(run)).collect();
    let [duration, square, work] =
        batches.iter().fold([0.0; 3], |sum, batch| [0, 1, 2].map(|i| sum[i] + batch[i]));
    let (power, watts) = (first.watts * square / duration, first.watts);
    let extreme = |of: fn(&Found) -> f64| runs.iter().map(|run| of(run)).fold(f64::NEG_INFINITY, f64::max);
    Some(Harvested {
        v_rms: (square / duration).sqrt(),
        v_peak: extreme(|run| run.v_peak),
        power,
        power_error: ratio_error(
            &batches.iter().map(|batch| (watts * batch[1], batch[0])).collect::<Vec<_>>(),
            stationary,
        ),
        tip: (-extreme(|run| -run.tip.0), extreme(|run| run.tip.1)),
        slope: extreme(|run| run.slope),
        input: work / duration,
    })
}

/// Power of the first over that of the second of each pair, and its standard error; both felt the same.
pub fn gain(pairs: &[(&Found, &Found)], stationary: bool) -> Option<(f64, Option<f64>)> {
    let mut both = Vec::new();
    for (own, linear) in pairs {
        // Batches of the same times: as long as the longer of the two asks for.
        let longer = if own.decay >= linear.decay { own } else { linear };
        let count = batches(longer).len();
        let split = |run: &Found| -> Vec<f64> {
            let counted =
                &run.counted()[run.counted().len() - longer.counted().len().min(run.counted().len())..];
            let length = counted.len() / count;
            let end = |i: usize| if i + 1 == count { counted.len() } else { (i + 1) * length };
            let square = |i: usize| counted[i * length..end(i)].iter().map(|(t, s, _)| t * s).sum();
            (0..count).map(square).collect()
        };
        both.extend(split(own).into_iter().zip(split(linear)));
    }
    let (own, linear) = both.iter().fold((0.0, 0.0), |sum, pair| (sum.0 + pair.0, sum.1 + pair.1));
    let delivers = pairs.iter().all(|(own, _)| own.watts > 0.0);
    (delivers && linear > 0.0).then(|| (own / linear, ratio_error(&both, stationary)))
}

/// Standard error of the mean of batches of equal length, one after the other in one motion; `None` of too few.
pub(super) fn mean_error(means: &[f64]) -> Option<f64> {
    ratio_error(&means.iter().map(|mean| (*mean, 1.0)).collect::<Vec<_>>(), true)
}

/// Standard error of the sum of the first over the sum of the second of each pair, from the scatter about it. Batches that do
/// know of one another, as where a motion changes wells or swells slowly, scatter less than they should: so neighbours are put
/// together, again and again, and the largest error counts.
///
/// Reference: Cochran, "Sampling Techniques" (1977), section 6.4, ratio estimate; Flyvbjerg & Petersen, J. Chem. Phys. 91, 461
/// (1989), blocks.
fn ratio_error(pairs: &[(f64, f64)], stationary: bool) -> Option<f64> {
    if !stationary || pairs.len() < LEAST_BATCHES {
        return None;
    }
    let mut pairs = pairs.to_vec();
    let mut largest = scatter(&pairs)?;
    while pairs.len() >= 2 * LEAST_BLOCKS {
        pairs =
            pairs.chunks(2).map(|two| two.iter().fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1))).collect();
        largest = largest.max(scatter(&pairs)?);
    }
    Some(largest)
}

/// That error, where the pairs know of their neighbours at most.
fn scatter(pairs: &[(f64, f64)]) -> Option<f64> {
    let count = pairs.len() as f64;
    let (above, below) = pairs.iter().fold((0.0, 0.0), |sum, pair| (sum.0 + pair.0, sum.1 + pair.1));
    if !(below > 0.0) {
        return None;
    }
    let ratio = above / below;
    let left: Vec<f64> = pairs.iter().map(|(a, b)| a - ratio * b).collect();
    let square = left.iter().map(|left| left * left).sum::<f64>();
    let neighbours = left.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>();
    // What is left adds up to nothing, which hides a part of what neighbours know of one another (Kendall, Biometrika 41, 403
    // (1954)). A few batches tell nothing of that.
    let known = if pairs.len() >= LEAST_BLOCKS && square > 0.0 {
        ((count * neighbours / square + 1.0) / (count - 3.0)).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let factor = 1.0 + 2.0 * known;
    Some((square * factor * count / (count - factor)).sqrt() / below)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_memory_makes_the_error_as_large_as_it_is() {
        // Each value keeps 0.8 of the one before: the mean of n has the variance sigma^2 (1 + 0.8)/(1 - 0.8)/n.
        let mut random = fastrand::Rng::with_seed(3);
        let (count, kept) = (8192, 0.8_f64);
        let mut value = 0.0;
        let pairs: Vec<(f64, f64)> = (0..count)
            .map(|_| {
                value = kept * value + random.f64() - 0.5;
                (10.0 + value, 1.0)
            })
            .collect();
        let variance = 1.0 / 12.0 / (1.0 - kept * kept);
        let expected = (variance * (1.0 + kept) / (1.0 - kept) / f64::from(count)).sqrt();
        let found = ratio_error(&pairs, true).expect("an error");
        assert!((0.8..1.7).contains(&(found / expected)), "{found} {expected}");
        assert!(scatter(&pairs).is_some_and(|naive| naive < 0.6 * expected));
        assert_eq!(ratio_error(&pairs, false), None);
        assert_eq!(ratio_error(&pairs[..LEAST_BATCHES - 1], true), None);
        assert_eq!(ratio_error(&[(1.0, 0.0); 8], true), None);
    }

    #[test]
    fn a_dozen_batches_that_know_of_their_neighbours_are_known_as_well_as_they_are() {
        // As above with 0.4 kept; the mean of twelve has the variance sigma^2/12 (1 + 2 sum (1 - k/12) 0.4^k).
        let mut random = fastrand::Rng::with_seed(5);
        let (kept, count) = (0.4_f64, 12);
        let mut value = 0.0;
        let claimed: f64 = (0..4000)
            .map(|_| {
                let means: Vec<f64> = (0..count)
                    .map(|_| {
                        value = kept * value + random.f64() - 0.5;
                        10.0 + value
                    })
                    .collect();
                mean_error(&means).expect("an error").powi(2)
            })
            .sum::<f64>()
            / 4000.0;
        let variance = 1.0 / 12.0 / (1.0 - kept * kept);
        let n = f64::from(count);
        let sum: f64 = (1..count).map(|k| (1.0 - f64::from(k) / n) * kept.powi(k)).sum();
        let expected = variance / n * (1.0 + 2.0 * sum);
        assert!((0.75..1.25).contains(&(claimed / expected)), "{claimed} {expected}");
    }
}
