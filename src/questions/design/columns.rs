//! What the columns of a file hold, as far as their names say so: nothing is taken for a voltage that may be another thing.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::layout::Layout;
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

/// What has to be said by whoever brings the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ask {
    /// Whether commas are decimal ones or stand between columns.
    Commas,
    /// Which column is meant.
    Column,
}

/// The columns to begin with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Choice {
    /// The columns; a guess where something is to be asked.
    pub columns: Columns,
    /// What the first of them holds: time or frequency.
    pub x: Kind,
    /// What is to be asked before anything is read.
    pub ask: Option<Ask>,
}

impl Layout {
    /// What each column holds, and the SI value of its unit.
    pub fn kinds(&self) -> Vec<(Kind, f64)> {
        let named = |i: usize| self.header.as_ref().and_then(|names| names.get(i));
        (0..self.columns).map(|i| named(i).map_or((Kind::Unknown, 1.0), |name| Kind::of_name(name))).collect()
    }

    /// Which columns hold time or frequency, and the `wanted` quantity: what names say, and where they say nothing the only
    /// one there is. Of several that it may be, and of one that is named as another quantity, none is taken by itself.
    pub fn choose(&self, wanted: Kind) -> Choice {
        let kinds = self.kinds();
        let clock = |i: &usize| matches!(kinds[*i].0, Kind::Time | Kind::Frequency);
        let counted = self.sampling.map(|sampling| sampling.count);
        let x = match counted {
            Some(count) => count,
            None => self.filled.iter().copied().find(clock).or(self.filled.first().copied()),
        };
        let values: Vec<usize> = self.filled.iter().copied().filter(|i| Some(*i) != x).collect();
        let suits: Vec<usize> = values.iter().copied().filter(|i| kinds[*i].0 == wanted).collect();
        let (y, sure) = match (suits[..].first(), suits.len(), &values[..]) {
            (Some(one), 1, _) => (*one, true),
            (_, 0, [one]) => (*one, kinds[*one].0 == Kind::Unknown),
            (first, _, _) => (first.or(values.first()).copied().unwrap_or(0), false),
        };
        let kind = match x {
            Some(x) if counted.is_none() && kinds[x].0 == Kind::Frequency => Kind::Frequency,
            _ => Kind::Time,
        };
        let x = x.unwrap_or(0);
        let x_unit = if counted.is_none() && clock(&x) { kinds[x].1 } else { 1.0 };
        let y_unit = if kinds[y].0 == wanted { kinds[y].1 } else { 1.0 };
        let ask = if self.unsure { Some(Ask::Commas) } else { (!sure).then_some(Ask::Column) };
        Choice { columns: Columns { x, x_unit, y, y_unit }, x: kind, ask }
    }
}
