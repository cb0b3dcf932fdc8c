//! Numbers as people type them, with a unit or a prefix of one: `5 g`, `0,5`, `30.4k`, `12 cm`.

use super::super::number;

/// What stands before a unit, and its factor.
const PREFIXES: [(char, f64); 9] = [
    ('G', 1e9),
    ('M', 1e6),
    ('k', 1e3),
    ('d', 1e-1),
    ('c', 1e-2),
    ('m', 1e-3),
    ('µ', 1e-6),
    ('n', 1e-9),
    ('p', 1e-12),
];

/// The number in `unit`; none where the text is no number, or its unit is of another kind.
pub(super) fn parse(text: &str, unit: &str) -> Option<f64> {
    let text = text.trim();
    if let Some(value) = number::parse(text) {
        return Some(value);
    }
    let ends = text.char_indices().map(|(end, _)| end).rev();
    let (value, suffix) =
        ends.filter_map(|end| Some((number::parse(&text[..end])?, text[end..].trim()))).next()?;
    let value = value * factor(&usual(suffix), unit)?;
    // What the factor adds at the sixteenth digit was not typed.
    value.is_finite().then(|| number::round_significant(value, 15))
}

/// The unit as it is written here.
fn usual(unit: &str) -> String {
    let unit = unit.replace("Ohm", "Ω").replace("ohm", "Ω").replace('\u{2126}', "Ω").replace('\u{3bc}', "µ");
    let unit = unit.replace('^', "").replace('2', "²").replace('4', "⁴").replace('·', " ");
    unit.strip_prefix('u').map_or(unit.clone(), |rest| format!("µ{rest}"))
}

/// How many of `unit` one of `typed` is.
fn factor(typed: &str, unit: &str) -> Option<f64> {
    if typed == unit {
        return Some(1.0);
    }
    if typed == "g" && unit == "m/s²" {
        return Some(crate::model::STANDARD_GRAVITY);
    }
    for (own, base) in readings(unit) {
        for (other, kind) in readings(typed) {
            if base == kind {
                return Some((other / own).powi(power(base)));
            }
        }
    }
    // A prefix alone takes the place of the unit's own.
    let mut letters = typed.chars();
    let (letter, rest) = (letters.next()?, letters.as_str());
    let (_, alone) = PREFIXES.iter().find(|(sign, _)| *sign == letter && rest.is_empty())?;
    let (own, base) = readings(unit).last()?;
    Some((alone / own).powi(power(base)))
}

/// A unit without a prefix, and as one with a prefix where it can be read so: the prefix's factor, and the rest.
fn readings(unit: &str) -> impl Iterator<Item = (f64, &str)> {
    let prefixed = PREFIXES.iter().filter_map(move |(sign, factor)| {
        let rest = unit.strip_prefix(*sign)?;
        (!rest.is_empty() && !rest.starts_with('/')).then_some((*factor, rest))
    });
    std::iter::once((1.0, unit)).chain(prefixed)
}

/// To which power a prefix counts.
fn power(base: &str) -> i32 {
    match base.chars().last() {
        Some('²') if !base.contains('/') => 2,
        Some('⁴') if !base.contains('/') => 4,
        _ => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn units_are_understood_and_other_kinds_of_them_refused() {
        for (text, unit, value) in [
            ("0,5", "mm", 0.5),
            ("5 g", "g", 5.0),
            ("0.5 mm", "mm", 0.5),
            ("0.012 m", "mm", 12.0),
            ("1,2cm", "mm", 12.0),
            ("2 kg", "g", 2000.0),
            ("30.4k", "MΩ", 0.0304),
            ("30.4 kOhm", "MΩ", 0.0304),
            ("30.4 kΩ", "MΩ", 0.0304),
            ("30.4k", "", 30400.0),
            ("2m", "", 0.002),
            ("-3 um", "mm", -0.003),
            ("2 cm^2", "mm²", 200.0),
            ("1 cm4", "mm⁴", 10000.0),
            ("0.5 g", "m/s²", 4.903_325),
            ("12 kHz", "Hz", 12000.0),
            ("1e-3 nF", "nF", 1e-3),
            ("1500 kPa s", "MPa s", 1.5),
            ("3 %", "%", 3.0),
        ] {
            assert_eq!(parse(text, unit), Some(value), "{text} in {unit}");
        }
        for (text, unit) in
            [("5 g", "mm"), ("5 Hz", "MΩ"), ("fast", ""), ("k", "MΩ"), ("5 mm", ""), ("1e", ""), ("5 5", "g")]
        {
            assert_eq!(parse(text, unit), None, "{text} in {unit}");
        }
    }
}
