//! Between a value and its place on the track.

use std::ops::RangeInclusive;

/// Share of the track that a logarithmic slider reserves for exact zero.
const ZERO_STOP: f64 = 0.06;

/// How values are spread over the track.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Mapping {
    range: RangeInclusive<f64>,
    /// The smallest positive value of a logarithmic track.
    floor: Option<f64>,
}

impl Mapping {
    /// Equal steps of value for equal steps of place.
    pub(super) fn linear(range: RangeInclusive<f64>) -> Self {
        Self { range, floor: None }
    }

    /// Equal ratios for equal steps of place. When the range starts at zero the track ends at `floor`, with a stop
    /// for zero to its left.
    pub(super) fn logarithmic(range: RangeInclusive<f64>, floor: Option<f64>) -> Self {
        let start = *range.start();
        let floor = if start > 0.0 { start } else { floor.unwrap_or(range.end() * 1e-4) };
        Self { range, floor: Some(floor) }
    }

    /// The allowed values.
    pub(super) fn range(&self) -> &RangeInclusive<f64> {
        &self.range
    }

    fn zero_stop(&self) -> f64 {
        if self.floor.is_some() && *self.range.start() <= 0.0 { ZERO_STOP } else { 0.0 }
    }

    /// Place of `value` on the track, from 0 to 1.
    pub(super) fn fraction(&self, value: f64) -> f64 {
        let (start, end) = (*self.range.start(), *self.range.end());
        let fraction = match self.floor {
            None => (value - start) / (end - start),
            Some(_) if value <= 0.0 => 0.0,
            Some(floor) => {
                let stop = self.zero_stop();
                stop + (1.0 - stop) * ((value / floor).ln() / (end / floor).ln()).max(0.0)
            }
        };
        if fraction.is_finite() { fraction.clamp(0.0, 1.0) } else { 0.0 }
    }

    /// The value at a place of the track, unrounded.
    pub(super) fn value(&self, fraction: f64) -> f64 {
        let fraction = fraction.clamp(0.0, 1.0);
        let (start, end) = (*self.range.start(), *self.range.end());
        let value = match self.floor {
            None => start + fraction * (end - start),
            Some(floor) => {
                let stop = self.zero_stop();
                if stop > 0.0 && fraction < 0.5 * stop {
                    return 0.0;
                }
                floor * (((fraction - stop) / (1.0 - stop)).max(0.0) * (end / floor).ln()).exp()
            }
        };
        value.clamp(start, end)
    }

    /// The value at a place, rounded to what the track can resolve, so that dragging leaves short numbers; `fine` for a
    /// tenth of that.
    pub(super) fn rounded_value(&self, fraction: f64, fine: bool) -> f64 {
        let value = self.value(fraction);
        let rounded = if self.floor.is_some() {
            super::super::number::round_significant(value, if fine { 4 } else { 3 })
        } else {
            let step = ((self.range.end() - self.range.start()) / 1000.0).log10().floor();
            let resolution = 10_f64.powf(step - f64::from(u8::from(fine)));
            let decimals = usize::try_from((-resolution.log10()).round() as i64).unwrap_or(0);
            format!("{:.decimals$}", (value / resolution).round() * resolution).parse().unwrap_or(value)
        };
        rounded.clamp(*self.range.start(), *self.range.end())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        let mappings = [
            Mapping::linear(1.0..=40.0),
            Mapping::logarithmic(1e-5..=1e-1, None),
            Mapping::logarithmic(0.0..=0.1, Some(1e-5)),
        ];
        for mapping in mappings {
            for step in 7..=100 {
                let fraction = f64::from(step) / 100.0;
                assert!((mapping.fraction(mapping.value(fraction)) - fraction).abs() < 1e-12);
            }
            assert_eq!(mapping.value(1.0), *mapping.range().end());
            assert_eq!(mapping.value(0.0), *mapping.range().start());
        }
    }

    #[test]
    fn zero_is_reachable_on_a_logarithmic_track() {
        let mapping = Mapping::logarithmic(0.0..=0.1, Some(1e-5));
        assert_eq!(mapping.value(0.02), 0.0);
        assert_eq!(mapping.fraction(0.0), 0.0);
        assert!((mapping.value(0.05) - 1e-5).abs() < 1e-18);
    }

    #[test]
    fn dragging_leaves_short_numbers() {
        assert_eq!(Mapping::linear(1.0..=40.0).rounded_value(0.182_345, false), 8.11);
        assert_eq!(Mapping::logarithmic(1e-4..=1e-1, None).rounded_value(0.5, false), 3.16e-3);
        assert_eq!(Mapping::linear(1.0..=40.0).rounded_value(0.182_345, true), 8.111);
    }
}
