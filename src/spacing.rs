//! Equally spaced values.

/// The value at `index` among `count` >= 2 equally spaced ones, the first and the last of which are the ends of the range.
pub fn between((low, high): (f64, f64), index: usize, count: usize) -> f64 {
    low + (high - low) * index as f64 / (count - 1) as f64
}

/// All of them.
pub fn equally_spaced(range: (f64, f64), count: usize) -> impl DoubleEndedIterator<Item = f64> + Clone {
    (0..count).map(move |index| between(range, index, count))
}
