//! What columns of a file may hold, as far as their names and units say so.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::model::units::STANDARD_GRAVITY;

/// Which columns are meant, counted from 0, and what turns their numbers into SI units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Columns {
    /// Column of time or frequency; of no effect where times stand in the file's head.
    pub x: usize,
    /// Seconds or Hz per unit of it, such as 1e-3 for milliseconds.
    pub x_unit: f64,
    /// Column of the voltage, or of another quantity that is asked for.
    pub y: usize,
    /// Volts (SI units) per unit of it.
    pub y_unit: f64,
}

impl Default for Columns {
    /// The first two, in SI units.
    fn default() -> Self {
        Self { x: 0, x_unit: 1.0, y: 1, y_unit: 1.0 }
    }
}

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Seconds.
    Time,
    /// Hertz.
    Frequency,
    /// Volts.
    Voltage,
    /// Metres per second squared.
    Acceleration,
    /// Something else that has a name of its own: a displacement, a current, a number of the sample.
    Other,
    /// Nothing is said of it.
    Unknown,
}

/// Units as they are written, in small letters, and what they measure.
const UNITS: [(&str, Kind, f64); 34] = [
    ("s", Kind::Time, 1.0),
    ("sec", Kind::Time, 1.0),
    ("second", Kind::Time, 1.0),
    ("seconds", Kind::Time, 1.0),
    ("ms", Kind::Time, 1e-3),
    ("us", Kind::Time, 1e-6),
    ("µs", Kind::Time, 1e-6),
    ("μs", Kind::Time, 1e-6),
    ("ns", Kind::Time, 1e-9),
    ("hz", Kind::Frequency, 1.0),
    ("khz", Kind::Frequency, 1e3),
    ("rad/s", Kind::Frequency, 1.0 / TAU),
    ("v", Kind::Voltage, 1.0),
    ("volt", Kind::Voltage, 1.0),
    ("volts", Kind::Voltage, 1.0),
    ("mv", Kind::Voltage, 1e-3),
    ("uv", Kind::Voltage, 1e-6),
    ("µv", Kind::Voltage, 1e-6),
    ("kv", Kind::Voltage, 1e3),
    ("g", Kind::Acceleration, STANDARD_GRAVITY),
    ("mg", Kind::Acceleration, 1e-3 * STANDARD_GRAVITY),
    ("m/s2", Kind::Acceleration, 1.0),
    ("m/s^2", Kind::Acceleration, 1.0),
    ("m/s²", Kind::Acceleration, 1.0),
    ("m/s/s", Kind::Acceleration, 1.0),
    ("mm/s2", Kind::Acceleration, 1e-3),
    ("sequence", Kind::Other, 1.0),
    ("a", Kind::Other, 1.0),
    ("ma", Kind::Other, 1e-3),
    ("m", Kind::Other, 1.0),
    ("mm", Kind::Other, 1e-3),
    ("um", Kind::Other, 1e-6),
    ("m/s", Kind::Other, 1.0),
    ("mm/s", Kind::Other, 1e-3),
];

/// Parts of names that say what is measured, in small letters.
const NAMES: [(&str, Kind); 20] = [
    ("acc", Kind::Acceleration),
    ("beschl", Kind::Acceleration),
    ("加速", Kind::Acceleration),
    ("freq", Kind::Frequency),
    ("频率", Kind::Frequency),
    ("time", Kind::Time),
    ("zeit", Kind::Time),
    ("时间", Kind::Time),
    ("x_value", Kind::Time),
    ("volt", Kind::Voltage),
    ("spannung", Kind::Voltage),
    ("电压", Kind::Voltage),
    ("displ", Kind::Other),
    ("veloc", Kind::Other),
    ("current", Kind::Other),
    ("sample", Kind::Other),
    ("sequence", Kind::Other),
    ("phase", Kind::Other),
    ("temp", Kind::Other),
    ("comment", Kind::Other),
];

/// Whole names of one letter or two that are usual.
const LETTERS: [(&str, Kind); 5] = [
    ("t", Kind::Time),
    ("f", Kind::Frequency),
    ("u", Kind::Voltage),
    ("v", Kind::Voltage),
    ("n", Kind::Other),
];

impl Kind {
    /// What a unit measures, and its SI value; `None` when it is none that is known.
    pub fn of_unit(unit: &str) -> Option<(Self, f64)> {
        let unit = unit.trim().trim_matches(['(', ')', '[', ']']).trim().to_lowercase();
        UNITS.iter().find(|(name, ..)| *name == unit).map(|(_, kind, factor)| (*kind, *factor))
    }

    /// What a column of this name holds, and the SI value of its unit: what stands in brackets, then what the name says.
    pub fn of_name(name: &str) -> (Self, f64) {
        let lower = name.to_lowercase();
        let in_brackets = lower
            .split(['(', '[', '{'])
            .skip(1)
            .filter_map(|part| Self::of_unit(part.split([')', ']', '}']).next().unwrap_or_default()));
        let behind = lower.rsplit([' ', ',', '/', '_']).next().filter(|word| *word != lower);
        let unit = in_brackets.last().or_else(|| behind.and_then(Self::of_unit));
        let says = NAMES.iter().find(|(part, _)| lower.contains(part)).map(|(_, kind)| *kind);
        let bare = lower.split(['(', '[']).next().unwrap_or_default().trim().trim_matches('"');
        let letter = LETTERS.iter().find(|(letter, _)| *letter == bare).map(|(_, kind)| *kind);
        match (says.or(letter), unit) {
            // A name and a unit that do not agree say nothing that could be relied on, but for what a voltage stands for.
            (Some(kind), Some((of, factor))) if kind == of => (kind, factor),
            (Some(Kind::Acceleration), _) => (Kind::Acceleration, 1.0),
            (Some(_), Some((Kind::Acceleration, factor))) => (Kind::Acceleration, factor),
            (_, Some((kind, factor))) => (kind, factor),
            (Some(kind), None) => (kind, 1.0),
            (None, None) => (Kind::Unknown, 1.0),
        }
    }
}
