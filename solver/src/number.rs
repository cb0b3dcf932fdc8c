//! Numbers as people write and read them.

/// Reads a decimal number: `1e-4`, `0.0081`, `8,0969`, `−3` with a typographic minus, blanks around it.
///
/// Returns `None` for anything else, and for numbers that are not finite.
pub fn parse(text: &str) -> Option<f64> {
    let mut plain: String = text.trim().replace('−', "-").replace(['\u{a0}', '\u{202f}'], "");
    // One comma and no point is a decimal comma; anything else with commas is ambiguous and refused below.
    if plain.matches(',').count() == 1 && !plain.contains('.') {
        plain = plain.replace(',', ".");
    }
    let looks_numeric = plain.chars().all(|c| c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | 'e' | 'E'));
    plain.parse().ok().filter(|value: &f64| looks_numeric && value.is_finite())
}

/// All digits of `value`, short: what a text field holds while it is edited. Reading it back gives `value`.
pub fn exact(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let magnitude = value.abs();
    if (1e-3..1e6).contains(&magnitude) { format!("{value}") } else { format!("{value:e}") }
}

/// The shortest text that reads back as `value`: `1e-4`, `0.005`, `8.096928443820915`. Scientific where that saves more
/// than one character.
pub fn shortest(value: f64) -> String {
    let (plain, scientific) = (value.to_string(), format!("{value:e}"));
    if scientific.len() + 1 < plain.len() { scientific } else { plain }
}

/// At most six significant digits, for messages of machines: `5.63338`, `1e-15`. Read back it is near `value`.
pub fn six_digits(value: f64) -> String {
    let rounded = round_significant(value, 6);
    let plain = rounded == 0.0 || !rounded.is_finite() || (1e-4..1e7).contains(&rounded.abs());
    if plain { rounded.to_string() } else { format!("{rounded:e}") }
}

/// `value` with three to five significant digits: `0.0100`, `8.0969`, `1.00e−4`, `−100`, `0`.
pub fn display(value: f64) -> String {
    display_within(value, 5)
}

/// The same with at most `most` significant digits, three at least.
pub fn display_within(value: f64, most: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return "–".to_owned();
    }
    let (mantissa, exponent) = decompose(value);
    let digits = mantissa.trim_end_matches('0').len().clamp(3, most.max(3));
    let text = if (-3..6).contains(&exponent) {
        let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
        format!("{value:.decimals$}")
    } else {
        format!("{value:.*e}", digits - 1)
    };
    typographic(&text)
}

/// `value` with `digits` significant digits, for readouts: `14.2`, `−0.0081`, `2.64e−5`.
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return "–".to_owned();
    }
    let digits = digits.max(1);
    let rounded: f64 = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    let exponent = rounded.abs().log10().floor() as i32;
    let text = if (-4..6).contains(&exponent) {
        let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
        format!("{rounded:.decimals$}")
    } else {
        format!("{rounded:.*e}", digits - 1)
    };
    typographic(&text)
}

/// With three of them.
pub fn short(value: f64) -> String {
    significant(value, 3)
}

/// Three significant digits of `value` and no zero in place of a digit, for sentences: `14.2`, `12345`, `1.50e−9`.
pub fn in_sentence(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{value:.2e}");
    let exponent = scientific.split_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0);
    let text = if (-4..=4).contains(&exponent) {
        format!("{value:.*}", usize::try_from(2 - exponent).unwrap_or(0))
    } else {
        scientific
    };
    typographic(&text)
}

/// The factor and the sign of the SI prefix that makes `value` readable: 1.3e-5 counts in `(1e6, "µ")`.
pub fn prefix(value: f64) -> (f64, &'static str) {
    const PREFIXES: [(f64, &str); 8] =
        [(1e-9, "G"), (1e-6, "M"), (1e-3, "k"), (1.0, ""), (1e3, "m"), (1e6, "µ"), (1e9, "n"), (1e12, "p")];
    let readable = |(factor, _): &&(f64, &str)| value.abs() * factor >= 0.9995;
    let smallest = if value == 0.0 { PREFIXES[3] } else { PREFIXES[7] };
    if value.is_finite() { PREFIXES.iter().find(readable).copied().unwrap_or(smallest) } else { PREFIXES[3] }
}

/// `value` with three significant digits and its unit under a prefix: `13.2 µW`.
pub fn with_unit(value: f64, unit: &str) -> String {
    let (factor, sign) = prefix(value);
    format!("{} {sign}{unit}", significant(factor * value, 3))
}

/// `value` rounded to `digits` significant decimal digits.
pub fn round_significant(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value)
}

/// A tick label for a grid of spacing `step`: as many decimals as the step needs, never `−0`.
pub fn tick(value: f64, step: f64) -> String {
    if value.abs() < 1e-9 * step.abs() || value == 0.0 {
        return "0".to_owned();
    }
    if !(1e-4..1e6).contains(&value.abs().max(step.abs())) {
        return significant(value, 2);
    }
    let decimals = (-(step.abs().log10() + 1e-9).floor()).clamp(0.0, 9.0) as usize;
    typographic(&format!("{value:.decimals$}"))
}

/// A power of ten as `10⁻³`.
pub fn power_of_ten(exponent: i32) -> String {
    let raise = |sign: char| match sign {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => digit.to_digit(10).and_then(|d| char::from_u32(0x2070 + d)).unwrap_or(digit),
    };
    format!("10{}", exponent.to_string().chars().map(raise).collect::<String>())
}

/// The text with true minus signs.
pub fn typographic(text: &str) -> String {
    text.replace('-', "−")
}

/// Five significant digits of `value` without a point, and the decimal exponent of the first.
fn decompose(value: f64) -> (String, i32) {
    let scientific = format!("{:.4e}", value.abs());
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    (mantissa.replace('.', ""), exponent.parse().unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_people_type() {
        assert_eq!(parse(" 1e-4 "), Some(1e-4));
        assert_eq!(parse("0.0081"), Some(0.0081));
        assert_eq!(parse("8,0969"), Some(8.0969));
        assert_eq!(parse("−3.5"), Some(-3.5));
        for nonsense in ["", "abc", "1,000,000", "1,5.2", "NaN", "inf", "1e999", "--2"] {
            assert_eq!(parse(nonsense), None, "{nonsense}");
        }
    }

    #[test]
    fn writes_short_and_exactly() {
        assert_eq!(display(0.01), "0.0100");
        assert_eq!(display(8.0969), "8.0969");
        assert_eq!(display(1e-4), "1.00e−4");
        assert_eq!(display(-100.0), "−100");
        assert_eq!(display(-0.0), "0");
        assert_eq!(significant(14.234, 3), "14.2");
        assert_eq!(significant(9.996, 3), "10.0");
        assert_eq!(with_unit(1.32e-5, "W"), "13.2 µW");
        assert_eq!(with_unit(7_631_732.0, "Ω"), "7.63 MΩ");
        assert_eq!(with_unit(0.999_96, "V"), "1.00 V");
        assert_eq!(with_unit(0.0, "V"), "0 V");
        assert_eq!(tick(-1e-18, 0.1), "0");
        assert_eq!(tick(0.014, 0.002), "0.014");
        assert_eq!(tick(-100.0, 50.0), "−100");
        assert_eq!(power_of_ten(-3), "10⁻³");
        assert_eq!(power_of_ten(14), "10¹⁴");
        for value in [1e-4, 8.096_941_6, 0.1 + 0.2, -123_456.7, 1e9] {
            assert_eq!(parse(&exact(value)), Some(value));
        }
    }

    #[test]
    fn numbers_have_three_significant_digits() {
        for (value, text) in
            [(0.0, "0"), (14.178, "14.2"), (-0.0079727, "−0.00797"), (1.5e-9, "1.50e−9"), (12345.0, "12345")]
        {
            assert_eq!(in_sentence(value), text);
        }
    }
}
