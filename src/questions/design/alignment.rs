//! Where in a computed run a measured record fits best: their clocks know nothing of each other.

/// Shifts that are tried first, and halvings of the distance between them afterwards.
const TRIED: usize = 600;
const HALVINGS: usize = 40;

/// How a record is shifted to fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Alignment {
    /// How much earlier than its end the run is when the record ends (the record's unit of time).
    pub shift: f64,
    /// Root mean square of what is left between the two once their means are taken out (the record's unit of value).
    pub left: f64,
}

/// Root mean square of differences once their mean is taken out; NaN when there are none.
pub fn left(differences: impl Iterator<Item = f64>) -> f64 {
    let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for difference in differences {
        count += 1.0;
        sum += difference;
        squares += difference * difference;
    }
    let mean: f64 = sum / count;
    let square = squares / count - mean * mean;
    // Rounding may leave it below 0; `max` would make 0 of NaN.
    if square < 0.0 { 0.0 } else { square.sqrt() }
}

/// The shift in `[0, reach]` at which the `record`, pairs of time (0 at its end) and value, is closest to
/// `computed(time - shift)` in the mean square. Means play no part: amplifiers often take them out.
///
/// None for a record without finite pairs.
pub fn align(record: &[[f64; 2]], reach: f64, computed: &dyn Fn(f64) -> f64) -> Option<Alignment> {
    let left = |shift: f64| left(record.iter().map(|[time, value]| value - computed(time - shift)));
    let spacing = reach / (TRIED - 1) as f64;
    let tried = (0..TRIED).map(|i| i as f64 * spacing).map(|shift| (shift, left(shift)));
    let best = tried.filter(|(_, left)| left.is_finite()).min_by(|a, b| a.1.total_cmp(&b.1))?;
    let (mut shift, mut least, mut step) = (best.0, best.1, spacing);
    for _ in 0..HALVINGS {
        for next in [shift - step, shift + step] {
            let value = left(next.clamp(0.0, reach));
            if value < least {
                (shift, least) = (next.clamp(0.0, reach), value);
            }
        }
        step *= 0.5;
    }
    Some(Alignment { shift, left: least })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_is_put_where_it_was_taken() {
        let signal = |time: f64| (3.0 * time).sin() + 0.4 * (1.5 * time + 0.2).cos();
        let reach = std::f64::consts::TAU / 1.5;
        for shift in [0.0, 0.7, 3.1] {
            let record: Vec<[f64; 2]> =
                (0..200).map(|i| -0.05 * f64::from(i)).map(|t| [t, 2.5 + signal(t - shift)]).collect();
            let found = align(&record, reach, &signal).expect("a fit");
            assert!((found.shift - shift).abs() < 1e-6 && found.left < 1e-6, "{shift}: {found:?}");
        }
    }

    #[test]
    fn what_does_not_fit_is_told_by_what_is_left() {
        let record: Vec<[f64; 2]> = (0..400)
            .map(|i| -0.05 * f64::from(i))
            .map(|t| [t, (3.0 * t).sin() + 0.1 * (7.0 * t).sin()])
            .collect();
        let found = align(&record, 2.0, &|time| (3.0 * time).sin()).expect("a fit");
        assert!((found.left - 0.1 / 2.0_f64.sqrt()).abs() < 2e-3, "{found:?}");
        assert_eq!(align(&[], 1.0, &|time| time), None);
    }
}
