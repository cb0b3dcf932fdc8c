//! Numbers read from links.

use crate::export::number::shortest;

/// A finite number within `allowed`; otherwise what is wrong with it. `unit` has a leading blank or is empty.
pub(super) fn read(text: &str, (minimum, maximum): (f64, f64), unit: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if (minimum..=maximum).contains(&value) => Ok(value),
        Ok(_) => Err(format!("allowed are {} to {}{unit}", shortest(minimum), shortest(maximum))),
        Err(_) => {
            Err(format!("not a number; allowed are {} to {}{unit}", shortest(minimum), shortest(maximum)))
        }
    }
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
            assert!(read(wrong, (0.0, 1.0), "").is_err(), "{wrong}");
        }
        assert_eq!(read("7", (0.0, 0.1), " m"), Err("allowed are 0 to 0.1 m".to_owned()));
        assert_eq!(read(" 0.1 ", (0.0, 0.1), " m"), Ok(0.1));
    }
}
