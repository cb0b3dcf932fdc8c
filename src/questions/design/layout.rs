//! How a text file of numbers is written: delimiter, decimal comma, preamble and header.

use serde::{Deserialize, Serialize};

use super::measured_error::MeasuredError;
use crate::questions::input;

/// Lines that are looked at to find out how a file is written.
const LOOKED_AT: usize = 100;
/// What may stand between fields, in the order of trial; blanks may be several.
const DELIMITERS: [u8; 5] = [b',', b';', b'\t', b'|', b' '];
/// Characters of a field that a message quotes.
const QUOTED: usize = 40;

/// How a file is written.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Layout {
    /// What stands between fields.
    pub delimiter: u8,
    /// Whether numbers have a decimal comma.
    pub decimal_comma: bool,
    /// Lines before the first row of numbers.
    pub preamble: usize,
    /// Names of the columns, where the last line before the numbers has as many fields as they.
    pub header: Option<Vec<String>>,
    /// Number of columns.
    pub columns: usize,
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
/// [`MeasuredError::Large`], [`MeasuredError::Utf16`], [`MeasuredError::Binary`] and [`MeasuredError::LongLine`].
pub fn look(first: &[u8], size: usize) -> Result<(), MeasuredError> {
    let first = &first[..first.len().min(FIRST)];
    if input::is_utf16(first) {
        return Err(MeasuredError::Utf16);
    }
    // A form feed, the end mark of old systems and colours of a terminal do occur in texts.
    let strange = |byte: &u8| *byte < b' ' && !b"\t\n\r\x0c\x1a\x1b".contains(byte);
    if let Some(place) = first.iter().position(strange) {
        return Err(MeasuredError::Binary { place: place + 1 });
    }
    if size > LARGEST << 20 {
        return Err(MeasuredError::Large { megabytes: LARGEST });
    }
    if size > first.len() && first.len() >= LONGEST_LINE && !first.iter().any(|byte| b"\r\n".contains(byte)) {
        return Err(MeasuredError::LongLine { line: 1, characters: LONGEST_LINE });
    }
    Ok(())
}

/// Finds out how `text` is written.
///
/// # Errors
/// [`MeasuredError::Empty`] and [`MeasuredError::NoNumbers`], those of [`look`], and [`MeasuredError::LongLine`] for any
/// of its lines.
pub fn detect(text: &[u8]) -> Result<Layout, MeasuredError> {
    look(text, text.len())?;
    let too_long = |line: &[u8]| line.len() > LONGEST_LINE;
    if let Some(place) = text.split(|byte| b"\r\n".contains(byte)).position(too_long) {
        // A line break of two bytes counts once.
        let before = text.split(|byte| b"\r\n".contains(byte)).take(place).map(|line| line.len() + 1).sum();
        let line = 1 + text[..before].iter().filter(|byte| **byte == b'\n').count();
        return Err(MeasuredError::LongLine { line, characters: LONGEST_LINE });
    }
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    let lines: Vec<String> = text
        .split(|byte| *byte == b'\n')
        .take(LOOKED_AT)
        .map(|line| String::from_utf8_lossy(line).trim().to_owned())
        .collect();
    let Some(first) = lines.iter().find(|line| !line.is_empty()) else { return Err(MeasuredError::Empty) };
    // The earliest row of numbers wins, then the way that finds most columns.
    let mut best: Option<Layout> = None;
    for delimiter in DELIMITERS {
        for decimal_comma in [false, true] {
            if decimal_comma && delimiter == b',' {
                continue;
            }
            let found = layout(&lines, delimiter, decimal_comma);
            let better = |layout: &Layout| {
                best.as_ref()
                    .is_none_or(|best| (layout.preamble, best.columns) < (best.preamble, layout.columns))
            };
            if found.as_ref().is_some_and(better) {
                best = found;
            }
        }
    }
    best.ok_or_else(|| MeasuredError::NoNumbers { lines: lines.len(), first: quoted(first) })
}

/// The layout with the first row of at least two numbers, which the next row must confirm.
fn layout(lines: &[String], delimiter: u8, decimal_comma: bool) -> Option<Layout> {
    let numbers = |line: &String| {
        let fields = split(line, delimiter);
        let all = fields.iter().all(|field| field.is_empty() || number(field, decimal_comma).is_some());
        let count = fields.iter().filter(|field| !field.is_empty()).count();
        (all && count >= 2).then_some(fields.len())
    };
    let rows: Vec<(usize, Option<usize>)> = lines
        .iter()
        .enumerate()
        .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
        .map(|(i, line)| (i, numbers(line)))
        .collect();
    let place = (0..rows.len())
        .find(|k| rows[*k].1.is_some() && rows.get(k + 1).is_none_or(|next| next.1 == rows[*k].1))?;
    let (preamble, columns) = (rows[place].0, rows[place].1?);
    let above = lines[..preamble].iter().rev().find(|line| !line.is_empty());
    let names = above.map(|line| split(line.trim_start_matches('#').trim(), delimiter));
    let header = names
        .filter(|names| names.len() == columns)
        .map(|names| names.into_iter().map(|name| name.trim_matches('"').trim().to_owned()).collect());
    Some(Layout { delimiter, decimal_comma, preamble, header, columns })
}

fn split(line: &str, delimiter: u8) -> Vec<&str> {
    let fields = line.split(char::from(delimiter)).map(str::trim);
    fields.filter(|field| delimiter != b' ' || !field.is_empty()).collect()
}

/// A finite number, as it stands in a field.
pub(super) fn number(field: &str, decimal_comma: bool) -> Option<f64> {
    let field = field.trim().trim_matches('"').trim();
    let value: f64 = match decimal_comma && field.contains(',') {
        true => field.replacen(',', ".", 1).parse().ok()?,
        false => field.parse().ok()?,
    };
    value.is_finite().then_some(value)
}

/// The beginning of a text, for a message.
pub(super) fn quoted(text: &str) -> String {
    text.chars().take(QUOTED).collect()
}
