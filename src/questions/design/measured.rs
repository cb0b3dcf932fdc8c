//! Measured data: columns of numbers from a text file, (time, voltage) or (frequency, voltage), a slice at a time.
//!
//! Delimiter, decimal comma, header and preamble are found by themselves; which columns are meant, and in which units,
//! is said by [`Columns`].

use std::io::Cursor;

use csv::{ByteRecord, Reader, ReaderBuilder};
use serde::{Deserialize, Serialize};

pub use super::layout::{FIRST, Layout, detect, look};
use super::layout::{number, quoted};
pub use super::measured_error::MeasuredError;

/// Which columns are meant, counted from 0, and what turns their numbers into seconds or Hz, and volts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Columns {
    /// Column of time or frequency.
    pub x: usize,
    /// Seconds or Hz per unit of it, such as 1e-3 for milliseconds.
    pub x_unit: f64,
    /// Column of the voltage.
    pub y: usize,
    /// Volts per unit of it.
    pub y_unit: f64,
}

impl Default for Columns {
    /// The first two, in SI units.
    fn default() -> Self {
        Self { x: 0, x_unit: 1.0, y: 1, y_unit: 1.0 }
    }
}

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
    record: ByteRecord,
}

impl Import {
    /// Begins to read `text`, written as `layout` says.
    ///
    /// # Errors
    /// [`MeasuredError::Column`] when a column does not exist, [`MeasuredError::Unit`] when a unit is no number or 0.
    pub fn new(text: Vec<u8>, layout: Layout, columns: Columns) -> Result<Self, MeasuredError> {
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
            .comment(Some(b'#'))
            .from_reader(cursor);
        Ok(Self { reader, layout, columns, start, length, points: Vec::new(), record: ByteRecord::new() })
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
            let point = [self.field(x)? * x_unit, self.field(y)? * y_unit];
            self.points.push(point);
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

    /// The same, when nothing more is to be read.
    pub fn into_points(self) -> Vec<[f64; 2]> {
        self.points
    }

    /// Line of the present record, for a message: blank lines and comments before it are skipped by the reader, but
    /// counted by whoever looks for it.
    fn line(&self) -> u64 {
        let text = self.reader.get_ref().get_ref().as_slice();
        let place = self.record.position().map_or(0, csv::Position::byte) as usize + self.start;
        let (before, rest) = text.split_at(place.min(text.len()));
        let skipped = rest
            .split_inclusive(|byte| *byte == b'\n')
            .take_while(|line| line.starts_with(b"#") || line.iter().all(|byte| b"\r\n".contains(byte)));
        let breaks = before.iter().filter(|byte| **byte == b'\n').count();
        (1 + breaks + skipped.count()) as u64
    }

    fn field(&self, column: usize) -> Result<f64, MeasuredError> {
        let bytes = if self.layout.delimiter == b' ' {
            self.record.iter().filter(|field| !field.is_empty()).nth(column)
        } else {
            self.record.get(column)
        };
        let delimiter = [self.layout.delimiter];
        let Some(bytes) = bytes else {
            let content = self.record.iter().collect::<Vec<_>>().join(&delimiter[..]);
            return Err(MeasuredError::Missing {
                line: self.line(),
                fields: self.record.len(),
                column: column + 1,
                content: quoted(&String::from_utf8_lossy(&content)),
            });
        };
        let value = std::str::from_utf8(bytes).ok().and_then(|text| number(text, self.layout.decimal_comma));
        value.ok_or_else(|| MeasuredError::Number {
            line: self.line(),
            column: column + 1,
            content: quoted(&String::from_utf8_lossy(bytes)),
        })
    }
}
