//! Measured data: two columns of numbers from a text file, time or frequency and any quantity, a slice at a time.
//!
//! `decode`, then `detect` how it is written, then `choose` the columns of the quantity wanted, as far as their names say
//! which these are ([`super::layout`], by [`super::columns`]); [`super::record`] says what is the matter with the times.

use std::io::Cursor;

use csv::{ByteRecord, Reader, ReaderBuilder};

pub use super::columns::{Columns, Kind};
pub use super::layout::{Ask, Choice, FIRST, Layout, Sampling, decode, detect, detect_with, look};
use super::layout::{Reading, quoted, reading};
pub use super::measured_error::MeasuredError;

/// A file being read.
#[derive(Debug)]
pub struct Import {
    reader: Reader<Cursor<Vec<u8>>>,
    layout: Layout,
    columns: Columns,
    /// Where the rows begin.
    start: usize,
    length: u64,
    points: Vec<[f64; 2]>,
    /// Rows read, and how many of them were left out because a value was out of the instrument's range.
    rows: usize,
    over_range: usize,
    record: ByteRecord,
}

impl Import {
    /// Begins to read `text`, written as `layout` says.
    ///
    /// # Errors
    /// [`MeasuredError::Commas`] when it is not known what commas are, [`MeasuredError::Column`] when a column does not
    /// exist, [`MeasuredError::Unit`] when a unit is no number or 0.
    pub fn new(text: Vec<u8>, layout: Layout, columns: Columns) -> Result<Self, MeasuredError> {
        if layout.unsure {
            return Err(MeasuredError::Commas);
        }
        for (field, value) in [("x", columns.x), ("y", columns.y)] {
            if value >= layout.columns {
                return Err(MeasuredError::Column { field, value, last: layout.columns - 1 });
            }
        }
        for (field, value) in [("x_unit", columns.x_unit), ("y_unit", columns.y_unit)] {
            if !(value.is_finite() && value != 0.0) {
                return Err(MeasuredError::Unit { field, value });
            }
        }
        let breaks = text.iter().enumerate().filter(|(_, byte)| **byte == b'\n').map(|(i, _)| i + 1);
        let start = std::iter::once(0).chain(breaks).nth(layout.preamble).unwrap_or(text.len());
        let length = text.len() as u64;
        let mut cursor = Cursor::new(text);
        cursor.set_position(start as u64);
        let reader = ReaderBuilder::new()
            .delimiter(layout.delimiter)
            .has_headers(false)
            .flexible(true)
            .comment(Some(layout.comment))
            .from_reader(cursor);
        Ok(Self {
            reader,
            layout,
            columns,
            start,
            length,
            points: Vec::new(),
            rows: 0,
            over_range: 0,
            record: ByteRecord::new(),
        })
    }

    /// Reads up to `rows` further rows; whether the end is reached.
    ///
    /// # Errors
    /// [`MeasuredError`] for the first row that is wrong.
    pub fn advance(&mut self, rows: usize) -> Result<bool, MeasuredError> {
        for _ in 0..rows {
            let more = self
                .reader
                .read_byte_record(&mut self.record)
                .map_err(|error| MeasuredError::Text { line: self.line(), problem: error.to_string() })?;
            if !more {
                return Ok(true);
            }
            // A row of delimiters only, as spreadsheets leave them.
            if self.record.iter().all(<[u8]>::is_empty) {
                continue;
            }
            let Columns { x, x_unit, y, y_unit } = self.columns;
            let x = match self.layout.sampling {
                Some(Sampling { start, increment, count: None }) => {
                    Some(start + increment * self.rows as f64)
                }
                Some(Sampling { start, increment, count: Some(count) }) => {
                    self.field(count)?.map(|count| start + increment * count)
                }
                None => self.field(x)?.map(|x| x * x_unit),
            };
            self.rows += 1;
            match (x, self.field(y)?) {
                (Some(x), Some(y)) => self.points.push([x, y * y_unit]),
                _ => self.over_range += 1,
            }
        }
        Ok(false)
    }

    /// Read part, 0 to 1.
    pub fn progress(&self) -> f64 {
        if self.length == 0 { 1.0 } else { self.reader.get_ref().position() as f64 / self.length as f64 }
    }

    /// The points read so far, in the file's order: seconds or Hz, and volts.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// How many rows were left out because the instrument marked them as out of its range.
    pub fn over_range(&self) -> usize {
        self.over_range
    }

    /// The points, when nothing more is to be read.
    pub fn into_points(self) -> Vec<[f64; 2]> {
        self.points
    }

    /// Line of the present record, for a message: blank lines and comments before it are skipped by the reader, but
    /// counted by whoever looks for it.
    fn line(&self) -> u64 {
        let text = self.reader.get_ref().get_ref().as_slice();
        let place = self.record.position().map_or(0, csv::Position::byte) as usize + self.start;
        let (before, rest) = text.split_at(place.min(text.len()));
        let skipped = rest.split_inclusive(|byte| *byte == b'\n').take_while(|line| {
            line.first() == Some(&self.layout.comment) || line.iter().all(|byte| b"\r\n".contains(byte))
        });
        let breaks = before.iter().filter(|byte| **byte == b'\n').count();
        (1 + breaks + skipped.count()) as u64
    }

    /// The number in a column; `None` where it was out of range.
    fn field(&self, column: usize) -> Result<Option<f64>, MeasuredError> {
        let place = if self.layout.joined { 2 * column } else { column };
        let fields = || self.record.iter().filter(|field| self.layout.delimiter != b' ' || !field.is_empty());
        let Some(bytes) = fields().nth(place) else {
            let delimiter = [self.layout.delimiter];
            let content = self.record.iter().collect::<Vec<_>>().join(&delimiter[..]);
            return Err(MeasuredError::Missing {
                line: self.line(),
                fields: self.record.len(),
                column: column + 1,
                content: quoted(&String::from_utf8_lossy(&content)),
            });
        };
        let mut text = String::from_utf8_lossy(bytes).into_owned();
        if let (true, Some(decimals)) = (self.layout.joined, fields().nth(place + 1)) {
            text = format!("{}.{}", text.trim(), String::from_utf8_lossy(decimals).trim());
        }
        match reading(&text, self.layout.decimal_comma) {
            Some(Reading::Number(value)) => Ok(Some(value)),
            Some(Reading::OverRange) => Ok(None),
            None => {
                Err(MeasuredError::Number { line: self.line(), column: column + 1, content: quoted(&text) })
            }
        }
    }
}
