//! Numbers read from links.

use crate::export::number::shortest;
use crate::sentence::{Sentence, allowed, said};

/// A finite number within a range; otherwise what is wrong with it, `allowed` being how the range is told by its ends.
pub(super) fn read(
    text: &str,
    (minimum, maximum): (f64, f64),
    allowed: &dyn Fn(&str, &str) -> Sentence,
) -> Result<f64, Sentence> {
    let allowed = || allowed(&shortest(minimum), &shortest(maximum));
    match text.trim().parse::<f64>() {
        Ok(value) if (minimum..=maximum).contains(&value) => Ok(value),
        Ok(_) => Err(allowed()),
        Err(_) => Err(said("not a number; {allowed}", &[("allowed", &allowed())])),
    }
}

/// How a range is told whose numbers have this unit, if any.
pub(super) fn range(unit: &str) -> impl Fn(&str, &str) -> Sentence {
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    move |from, to| allowed(&from, &format!("{to}{unit}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_read_back() {
        for (value, text) in [
            (1e-4, "1e-4"),
            (0.01, "0.01"),
            (600.0, "600"),
            (0.005, "0.005"),
            (5000.0, "5000"),
            (-0.15, "-0.15"),
            (1e15, "1e15"),
            (0.1 + 0.2, "0.30000000000000004"),
            (0.0, "0"),
        ] {
            assert_eq!(shortest(value), text);
            assert_eq!(text.parse(), Ok(value));
        }
        for wrong in ["", "x", "1,5", "nan", "inf", "-1e999", "1.0000001"] {
            assert!(read(wrong, (0.0, 1.0), &range("")).is_err(), "{wrong}");
        }
        let metres = |text| read(text, (0.0, 0.1), &range("m")).map_err(|reason| reason.to_string());
        assert_eq!(metres("7"), Err("allowed are 0 to 0.1 m".to_owned()));
        assert_eq!(metres("x"), Err("not a number; allowed are 0 to 0.1 m".to_owned()));
        assert_eq!(metres(" 0.1 "), Ok(0.1));
    }
}
