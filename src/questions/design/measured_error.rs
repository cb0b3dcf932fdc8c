//! What can be wrong with a file of measured data.

use crate::sentence::{Say, Sentence, not_available, said};

/// What is wrong with a file, by line (from 1) and content.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", self.say())]
pub enum MeasuredError {
    /// There is nothing in it.
    Empty,
    /// Nobody has said what its commas are.
    Commas,
    /// No text at all.
    Binary {
        /// Which byte, from 1.
        place: usize,
    },
    /// Too much to hold.
    Large {
        /// What is allowed (MB).
        megabytes: usize,
    },
    /// No line of a table is so long.
    LongLine {
        /// Line.
        line: usize,
        /// What is allowed.
        characters: usize,
    },
    /// No two columns of numbers.
    NoNumbers {
        /// Lines looked at.
        lines: usize,
        /// The first line.
        first: String,
    },
    /// There is no such column.
    Column {
        /// Which field of [`super::measured::Columns`].
        field: &'static str,
        /// Its value.
        value: usize,
        /// The last column.
        last: usize,
    },
    /// No unit can be so.
    Unit {
        /// Which field of [`super::measured::Columns`].
        field: &'static str,
        /// Its value.
        value: f64,
    },
    /// A row is too short.
    Missing {
        /// Line.
        line: u64,
        /// How many fields it has.
        fields: usize,
        /// The column, from 1.
        column: usize,
        /// The line's beginning.
        content: String,
    },
    /// A field is not a number.
    Number {
        /// Line.
        line: u64,
        /// Column, from 1.
        column: usize,
        /// The field.
        content: String,
    },
    /// The text itself cannot be split.
    Text {
        /// Line.
        line: u64,
        /// The reader's own reason.
        problem: String,
    },
}

impl Say for MeasuredError {
    fn say(&self) -> Sentence {
        match self {
            Self::Empty => said("the file is empty", &[]),
            Self::Commas => said("its commas may be decimal commas or stand between columns: say which", &[]),
            Self::Binary { place } => {
                said("it is not text: byte {place} belongs to no character", &[("place", place)])
            }
            Self::Large { megabytes } => {
                said("it is larger than {megabytes} MB", &[("megabytes", megabytes)])
            }
            Self::LongLine { line, characters } => said(
                "line {line} is longer than {characters} characters",
                &[("line", line), ("characters", characters)],
            ),
            Self::NoNumbers { lines, first } => said(
                "no row with at least two numbers in the first {lines} lines; line 1 is \"{first}\"",
                &[("lines", lines), ("first", first)],
            ),
            Self::Column { field, value, last } => not_available(field, value, (&0, last)),
            Self::Unit { field, value } => said(
                "{field} = {value} is not available: {allowed}",
                &[
                    ("field", field),
                    ("value", value),
                    ("allowed", &said("allowed are finite numbers other than 0", &[])),
                ],
            ),
            Self::Missing { line, fields, column, content } => said(
                "line {line} has {fields} fields, column {column} is missing: \"{content}\"",
                &[("line", line), ("fields", fields), ("column", column), ("content", content)],
            ),
            Self::Number { line, column, content } => said(
                "line {line}, column {column}: \"{content}\" is not a finite number",
                &[("line", line), ("column", column), ("content", content)],
            ),
            Self::Text { line, problem } => {
                said("line {line} cannot be read: {problem}", &[("line", line), ("problem", problem)])
            }
        }
    }
}
