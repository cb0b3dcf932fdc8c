//! How a text file of numbers is written: encoding, delimiter, decimal comma, preamble, header, where times come from, and which
//! columns to begin with: nothing is taken for a voltage that may be another thing.

use std::borrow::Cow;

use super::columns::{Columns, Kind};
use super::measured_error::MeasuredError;
use crate::questions::input;

/// Lines that are looked at to find out how a file is written.
const LOOKED_AT: usize = 400;
/// What may stand between fields, in the order of trial; blanks may be several.
const DELIMITERS: [u8; 5] = [b',', b';', b'\t', b'|', b' '];
/// Characters of a field that a message quotes.
const QUOTED: usize = 40;
/// Rows that are shown before anything is read.
const SHOWN: usize = 4;
/// Beyond this a number is an instrument's mark of over-range (9.9e37 of Keysight and others).
const OVER_RANGE: f64 = 9e36;
/// Words that mark the same.
const OVER_WORDS: [&str; 10] =
    ["ol", "+ol", "-ol", "over", "overload", "ovld", "1.#inf", "-1.#inf", "+1.#inf", "####"];

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

/// How a file is written.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// What stands between fields.
    pub delimiter: u8,
    /// Whether numbers have a decimal comma.
    pub decimal_comma: bool,
    /// Whether commas stand between fields and within numbers: two fields are one number.
    pub joined: bool,
    /// Whether that is not known: every field is a whole number.
    pub unsure: bool,
    /// What begins a comment.
    pub comment: u8,
    /// Lines before the first row of numbers.
    pub preamble: usize,
    /// Names of the columns, with their units where these stand in a line of their own.
    pub header: Option<Vec<String>>,
    /// Number of columns.
    pub columns: usize,
    /// Those of them, from 0, that hold numbers.
    pub filled: Vec<usize>,
    /// Where times come from when the rows have none.
    pub sampling: Option<Sampling>,
    /// The first rows, field by field.
    pub rows: Vec<Vec<String>>,
}

/// Times that stand in the head of a file only.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampling {
    /// Time of sample 0 (s).
    pub start: f64,
    /// Time between samples (s).
    pub increment: f64,
    /// The column that counts the samples; they are counted from 0 where there is none.
    pub count: Option<usize>,
}

/// Bytes at the beginning of a file by which it is judged before the rest is read.
pub const FIRST: usize = 1 << 16;
/// Longest line (bytes).
const LONGEST_LINE: usize = 1 << 16;
/// Largest file (MB): some three million rows.
const LARGEST: usize = 64;

/// Looks whether a file of `size` bytes, of which these are the `first`, can be measured data at all, so that what
/// cannot need not be read.
///
/// # Errors
/// [`MeasuredError::Large`], [`MeasuredError::Binary`] and [`MeasuredError::LongLine`].
pub fn look(first: &[u8], size: usize) -> Result<(), MeasuredError> {
    let first = &first[..first.len().min(FIRST)];
    let wide = input::is_utf16(first);
    let decoded = decode(first);
    // A form feed, the end mark of old systems and colours of a terminal do occur in texts.
    let strange = |byte: &u8| *byte < b' ' && !b"\t\n\r\x0c\x1a\x1b".contains(byte);
    if let Some(place) = decoded.iter().position(strange) {
        return Err(MeasuredError::Binary { place: if wide { 2 * place + 1 } else { place + 1 } });
    }
    if size > LARGEST << 20 {
        return Err(MeasuredError::Large { megabytes: LARGEST });
    }
    let broken = || decoded.iter().any(|byte| b"\r\n".contains(byte));
    if size > first.len() && first.len() >= LONGEST_LINE && !broken() {
        return Err(MeasuredError::LongLine { line: 1, characters: LONGEST_LINE });
    }
    Ok(())
}

/// The text of a file without a byte order mark, as UTF-8 where it was UTF-16; other encodings stay as they are, since
/// numbers are the same in them.
pub fn decode(bytes: &[u8]) -> Cow<'_, [u8]> {
    if !input::is_utf16(bytes) {
        return Cow::Borrowed(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes));
    }
    let big = bytes.starts_with(b"\xfe\xff") || bytes.first() == Some(&0);
    let bytes = bytes.strip_prefix(b"\xfe\xff").or(bytes.strip_prefix(b"\xff\xfe")).unwrap_or(bytes);
    let units = bytes.chunks_exact(2).map(|pair| {
        let pair = [pair[0], pair[1]];
        if big { u16::from_be_bytes(pair) } else { u16::from_le_bytes(pair) }
    });
    let text: String =
        char::decode_utf16(units).map(|letter| letter.unwrap_or(char::REPLACEMENT_CHARACTER)).collect();
    Cow::Owned(text.into_bytes())
}

/// Finds out how `text`, which is decoded, is written.
///
/// # Errors
/// [`MeasuredError::Empty`] and [`MeasuredError::NoNumbers`], those of [`look`], and [`MeasuredError::LongLine`] for any
/// of its lines.
pub fn detect(text: &[u8]) -> Result<Layout, MeasuredError> {
    detect_with(text, None)
}

/// The same where it was said whether commas are decimal ones between others, or only stand between fields.
///
/// # Errors
/// As [`detect`].
pub fn detect_with(text: &[u8], commas: Option<bool>) -> Result<Layout, MeasuredError> {
    look(text, text.len())?;
    let too_long = |line: &[u8]| line.len() > LONGEST_LINE;
    if let Some(place) = text.split(|byte| b"\r\n".contains(byte)).position(too_long) {
        // A line break of two bytes counts once.
        let before = text.split(|byte| b"\r\n".contains(byte)).take(place).map(|line| line.len() + 1).sum();
        let line = 1 + text[..before].iter().filter(|byte| **byte == b'\n').count();
        return Err(MeasuredError::LongLine { line, characters: LONGEST_LINE });
    }
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    // Blanks and tabs at the beginning may stand for empty fields.
    let lines: Vec<String> = text
        .split(|byte| *byte == b'\n')
        .take(LOOKED_AT)
        .map(|line| String::from_utf8_lossy(line).trim_end_matches(['\r', '\x1a']).to_owned())
        .collect();
    let Some(first) = lines.iter().find(|line| !line.trim().is_empty()) else {
        return Err(MeasuredError::Empty);
    };
    // The earliest row of numbers wins, then the way in which the head has times, then the one that finds most columns.
    let mut best: Option<Layout> = None;
    for (delimiter, decimal_comma, joined) in writings(commas) {
        let found = layout(&lines, &Writing { delimiter, decimal_comma, joined });
        let rank =
            |layout: &Layout| (layout.preamble, layout.sampling.is_none(), usize::MAX - layout.columns);
        let better = |layout: &Layout| best.as_ref().is_none_or(|best| rank(layout) < rank(best));
        if found.as_ref().is_some_and(better) {
            best = found;
        }
    }
    let mut best =
        best.ok_or_else(|| MeasuredError::NoNumbers { lines: lines.len(), first: quoted(first.trim()) })?;
    best.unsure = commas.is_none() && best.may_be_joined();
    Ok(best)
}

/// The ways of writing that are tried: delimiter, decimal comma, both.
fn writings(commas: Option<bool>) -> Vec<(u8, bool, bool)> {
    if commas == Some(true) {
        return vec![(b',', false, true)];
    }
    let all = DELIMITERS.iter().flat_map(|delimiter| [(*delimiter, false, false), (*delimiter, true, false)]);
    all.filter(|(delimiter, decimal_comma, _)| !(*decimal_comma && *delimiter == b',')).collect()
}

/// How many fields a row of numbers has, and which of them are filled.
type Filled = (usize, Vec<usize>);

/// How lines are split and numbers are read.
struct Writing {
    delimiter: u8,
    decimal_comma: bool,
    joined: bool,
}

impl Writing {
    fn fields(&self, line: &str) -> Vec<String> {
        let fields = split(line, self.delimiter).into_iter().map(str::to_owned);
        if !self.joined {
            return fields.collect();
        }
        let fields: Vec<String> = fields.collect();
        fields.chunks(2).map(|pair| pair.join(".")).collect()
    }

    /// How many fields a row has and which of them are numbers, if all others are empty.
    fn numbers(&self, line: &str, least: usize) -> Option<Filled> {
        let fields = self.fields(line);
        let is_number = |field: &String| reading(field, self.decimal_comma).is_some();
        let all = fields.iter().all(|field| field.is_empty() || is_number(field));
        let filled: Vec<usize> = (0..fields.len()).filter(|i| !fields[*i].is_empty()).collect();
        (all && filled.len() >= least).then_some((fields.len(), filled))
    }
}

/// The layout with the first row of numbers, which the next row must confirm.
fn layout(lines: &[String], writing: &Writing) -> Option<Layout> {
    let sampling = sampling(lines, writing);
    let least = if sampling.is_some() { 1 } else { 2 };
    let rows: Vec<(usize, Option<Filled>)> = lines
        .iter()
        .enumerate()
        .filter(|(_, line)| !line.trim().is_empty() && !is_comment(line))
        .map(|(i, line)| (i, writing.numbers(line, least)))
        .collect();
    let same = |a: &Option<Filled>, b: &Option<Filled>| match (a, b) {
        (Some(a), Some(b)) => a.0 == b.0,
        _ => false,
    };
    let place = (0..rows.len())
        .find(|k| rows[*k].1.is_some() && rows.get(k + 1).is_none_or(|next| same(&next.1, &rows[*k].1)))?;
    let mut preamble = rows[place].0;
    let (columns, filled) = rows[place].1.clone()?;
    // Words may stand in columns of their own beside the first rows, as Tektronix writes them.
    for (line, _) in rows[..place].iter().rev() {
        let fields = writing.fields(&lines[*line]);
        let is_number =
            |i: &usize| fields.get(*i).is_some_and(|f| reading(f, writing.decimal_comma).is_some());
        if filled.first() == Some(&0) || fields.len() != columns || !filled.iter().all(is_number) {
            break;
        }
        preamble = *line;
    }
    let sampling = sampling.filter(|sampling| sampling.count.is_none_or(|count| filled.contains(&count)));
    let shown = lines[preamble..].iter().filter(|line| !line.trim().is_empty() && !is_comment(line));
    Some(Layout {
        delimiter: writing.delimiter,
        decimal_comma: writing.decimal_comma,
        joined: writing.joined,
        unsure: false,
        comment: lines
            .iter()
            .find(|line| is_comment(line))
            .map_or(b'#', |line| line.trim_start().as_bytes()[0]),
        preamble,
        header: header(&lines[..preamble], writing, columns),
        columns,
        filled,
        sampling,
        rows: shown.take(SHOWN).map(|line| writing.fields(line)).collect(),
    })
}

fn is_comment(line: &str) -> bool {
    line.trim_start().starts_with(['#', '%'])
}

/// The names above the numbers, in the last line that has as many fields as they; units may stand between.
fn header(above: &[String], writing: &Writing, columns: usize) -> Option<Vec<String>> {
    let mut lines = above.iter().rev().filter(|line| !line.trim().is_empty());
    let names = |line: &String| {
        let bare = line.trim_start_matches(['#', '%', '\u{feff}']);
        let comment = bare.len() < line.len();
        let bare = if comment { bare.trim() } else { bare };
        let mut names: Vec<String> = match (writing.delimiter, writing.joined) {
            // Names may hold single blanks.
            (b' ', _) => {
                let wide: Vec<String> =
                    bare.split("  ").map(str::trim).filter(|n| !n.is_empty()).map(str::to_owned).collect();
                if wide.len() == columns { wide } else { writing.fields(bare) }
            }
            (delimiter, true) => split(bare, delimiter).into_iter().map(str::to_owned).collect(),
            _ => writing.fields(bare),
        };
        names.iter_mut().for_each(|name| *name = name.trim_matches('"').trim().to_owned());
        // Rows may end before their names do: an empty one, or that of comments which nobody made (LabVIEW).
        let spare = |name: &String| name.is_empty() || name.eq_ignore_ascii_case("comment");
        while names.len() > columns && names.last().is_some_and(spare) {
            names.pop();
        }
        (names.len() == columns).then_some(names)
    };
    let last = names(lines.next()?)?;
    let is_unit = |name: &String| {
        name.is_empty() || number(name, writing.decimal_comma).is_some() || Kind::of_unit(name).is_some()
    };
    if !last.iter().all(is_unit) {
        return Some(last);
    }
    let Some(upper) = lines.next().and_then(names) else { return Some(last) };
    let with_unit = |(name, unit): (String, String)| match unit.as_str() {
        "" => name,
        unit => format!("{name} ({})", unit.trim_matches(['(', ')', '[', ']'])),
    };
    Some(upper.into_iter().zip(last).map(with_unit).collect())
}

/// Times that stand in the head: `Start` and `Increment` above their values (Rigol), `t0 = .., tInc = ..` (Rigol as well),
/// or `X0` and `Delta_X` where `X_Columns` is `No` (LabVIEW).
fn sampling(lines: &[String], writing: &Writing) -> Option<Sampling> {
    let value = |text: &str| number(text, writing.decimal_comma).or_else(|| number(text, true));
    let (mut start, mut increment, mut without) = (None, None, false);
    for (i, line) in lines.iter().enumerate() {
        let fields: Vec<String> = writing.fields(line).iter().map(|field| field.to_lowercase()).collect();
        let at = |name: &str| fields.iter().position(|field| field.trim_matches('"') == name);
        if let (Some(a), Some(b)) = (at("start"), at("increment"))
            && let Some(values) = lines.get(i + 1).map(|line| writing.fields(line))
            && let (Some(start), Some(increment)) =
                (values.get(a).and_then(|v| value(v)), values.get(b).and_then(|v| value(v)))
        {
            let count = at("x").or_else(|| at("sequence")).or_else(|| at("sample"));
            return Some(Sampling { start, increment, count });
        }
        let after = |name: &str| {
            let field = fields.iter().find_map(|field| field.strip_prefix(name))?;
            value(field.trim_start().strip_prefix('=')?.trim().trim_end_matches('s'))
        };
        if let (Some(start), Some(increment)) = (after("t0"), after("tinc")) {
            return Some(Sampling { start, increment, count: None });
        }
        match (fields.first().map(String::as_str), fields.get(1)) {
            (Some("x_columns"), Some(word)) => without = word == "no",
            (Some("x0"), Some(text)) => start = value(text),
            (Some("delta_x"), Some(text)) => increment = value(text),
            _ => {}
        }
    }
    let (start, increment) = (start?, increment?);
    without.then_some(Sampling { start, increment, count: None })
}

impl Layout {
    /// Whether commas between whole numbers may as well be decimal ones.
    fn may_be_joined(&self) -> bool {
        let whole = |field: &String| {
            let digits = field.trim_start_matches(['+', '-']);
            !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())
        };
        let pairs = |row: &Vec<String>| {
            row.len() >= 4
                && row.len().is_multiple_of(2)
                && row.iter().all(whole)
                && row.iter().skip(1).step_by(2).all(|field| !field.starts_with(['+', '-']))
        };
        let named = self.header.as_ref().is_some_and(|names| names.iter().all(|name| !name.is_empty()));
        self.delimiter == b',' && !named && self.rows.len() > 1 && self.rows.iter().all(pairs)
    }

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

pub(super) fn split(line: &str, delimiter: u8) -> Vec<&str> {
    let fields = line.split(char::from(delimiter)).map(str::trim);
    fields.filter(|field| delimiter != b' ' || !field.is_empty()).collect()
}

/// What stands in a field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Reading {
    /// A finite number.
    Number(f64),
    /// A mark that it was out of the instrument's range.
    OverRange,
}

/// A number or a mark, as it stands in a field.
pub(super) fn reading(field: &str, decimal_comma: bool) -> Option<Reading> {
    let field = field.trim().trim_matches('"').trim();
    if OVER_WORDS.iter().any(|word| field.eq_ignore_ascii_case(word)) {
        return Some(Reading::OverRange);
    }
    let value: f64 = match decimal_comma && field.contains(',') {
        true => field.replacen(',', ".", 1).parse().ok()?,
        false => field.parse().ok()?,
    };
    if value.is_nan() {
        return None;
    }
    Some(if value.abs() > OVER_RANGE { Reading::OverRange } else { Reading::Number(value) })
}

/// A finite number, as it stands in a field.
fn number(field: &str, decimal_comma: bool) -> Option<f64> {
    match reading(field, decimal_comma)? {
        Reading::Number(value) => Some(value),
        Reading::OverRange => None,
    }
}

/// The beginning of a text, for a message.
pub(super) fn quoted(text: &str) -> String {
    text.chars().take(QUOTED).collect()
}
