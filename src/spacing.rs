//! Values spread over a range.

/// The value at `index` among `count` >= 2 equally spaced ones, the first and the last of which are the ends of the range.
pub fn between((low, high): (f64, f64), index: usize, count: usize) -> f64 {
    low + (high - low) * index as f64 / (count - 1) as f64
}

/// All of them.
pub fn equally_spaced(range: (f64, f64), count: usize) -> impl DoubleEndedIterator<Item = f64> + Clone {
    (0..count).map(move |index| between(range, index, count))
}

/// The same, equally spaced on a logarithmic scale where `logarithmic`: both ends are positive then.
pub fn spread(
    (low, high): (f64, f64),
    logarithmic: bool,
    count: usize,
) -> impl DoubleEndedIterator<Item = f64> + Clone {
    let range = if logarithmic { (low.ln(), high.ln()) } else { (low, high) };
    // Rounding leads out of no range.
    equally_spaced(range, count)
        .map(move |place| if logarithmic { place.exp().max(low).min(high) } else { place })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_spread_as_their_scale_is_and_stay_in_the_range() {
        assert_eq!(spread((1.0, 3.0), false, 3).collect::<Vec<_>>(), [1.0, 2.0, 3.0]);
        let decades: Vec<f64> = spread((0.1, 100.0), true, 4).collect();
        for (found, expected) in decades.iter().zip([0.1, 1.0, 10.0, 100.0]) {
            assert!((found / expected - 1.0).abs() < 1e-14, "{decades:?}");
        }
        assert!(decades.iter().all(|value| (0.1..=100.0).contains(value)), "{decades:?}");
    }
}
