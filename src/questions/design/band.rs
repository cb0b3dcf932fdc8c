//! Bands of frequency in which a curve of power is high enough.

use serde::{Deserialize, Serialize};

/// An interval of frequency (Hz).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
pub struct Interval {
    /// Its lower end (Hz).
    pub from: f64,
    /// Its upper end (Hz).
    pub to: f64,
}

/// The intervals in which one of the `curves` is at least `least`, ascending and merged.
///
/// A curve is a chain of points (frequency, power), linear between them; it may turn back, as a branch does at a fold.
pub fn usable(curves: &[Vec<[f64; 2]>], least: f64) -> Vec<Interval> {
    let mut parts: Vec<Interval> = curves
        .iter()
        .flat_map(|curve| curve.windows(2))
        .filter_map(|pair| part_above(pair[0], pair[1], least))
        .collect();
    parts.sort_by(|a, b| a.from.total_cmp(&b.from));
    let mut merged: Vec<Interval> = Vec::new();
    for part in parts {
        match merged.last_mut() {
            Some(last) if part.from <= last.to => last.to = last.to.max(part.to),
            _ => merged.push(part),
        }
    }
    merged
}

/// Their total width (Hz).
pub fn total(intervals: &[Interval]) -> f64 {
    intervals.iter().map(|interval| interval.to - interval.from).fold(0.0, |total, width| total + width)
}

/// The interval about the highest point of the `curves` in which at least half its power is reached; `None` without
/// points. A point alone has no width and does not count.
pub fn half_power(curves: &[Vec<[f64; 2]>]) -> Option<Interval> {
    let chains = curves.iter().filter(|curve| curve.len() > 1);
    let highest = chains.flatten().copied().max_by(|a, b| a[1].total_cmp(&b[1]))?;
    let bands = usable(curves, 0.5 * highest[1]);
    bands.into_iter().find(|band| (band.from..=band.to).contains(&highest[0]))
}

/// The part of the line between two points that is at least `least` high.
fn part_above(a: [f64; 2], b: [f64; 2], least: f64) -> Option<Interval> {
    let crossing = || a[0] + (b[0] - a[0]) * (least - a[1]) / (b[1] - a[1]);
    let (first, second) = match (a[1] >= least, b[1] >= least) {
        (true, true) => (a[0], b[0]),
        (true, false) => (a[0], crossing()),
        (false, true) => (crossing(), b[0]),
        (false, false) => return None,
    };
    Some(Interval { from: first.min(second), to: first.max(second) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_are_cut_at_the_level_and_merged_over_curves() {
        let hill = vec![[1.0, 0.0], [2.0, 2.0], [3.0, 0.0]];
        let other = vec![[2.2, 3.0], [4.0, 3.0], [4.0, 0.0]];
        let far = vec![[6.0, 1.0], [5.0, 1.0]];
        let found = usable(&[hill.clone(), other, far], 1.0);
        let expected = [Interval { from: 1.5, to: 4.0 }, Interval { from: 5.0, to: 6.0 }];
        assert_eq!(found, expected);
        assert_eq!(total(&found), 3.5);
        assert_eq!(half_power(&[hill]), Some(Interval { from: 1.5, to: 2.5 }));
        assert!(usable(&[], 1.0).is_empty() && half_power(&[]).is_none());
    }
}
