//! What can be wrong with a file of measured data.

/// What is wrong with a file, by line (from 1) and content.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeasuredError {
    /// There is nothing in it.
    #[error("the file is empty")]
    Empty,
    /// In an encoding that is not read.
    #[error("it is UTF-16 text: save it as UTF-8")]
    Utf16,
    /// No text at all.
    #[error("it is no text: byte {place} is no character of one")]
    Binary {
        /// Which byte, from 1.
        place: usize,
    },
    /// Too much to hold.
    #[error("it is larger than {megabytes} MB")]
    Large {
        /// What is allowed (MB).
        megabytes: usize,
    },
    /// No line of a table is so long.
    #[error("line {line} is longer than {characters} characters")]
    LongLine {
        /// Line.
        line: usize,
        /// What is allowed.
        characters: usize,
    },
    /// No two columns of numbers.
    #[error("no row with at least two numbers in the first {lines} lines; line 1 is \"{first}\"")]
    NoNumbers {
        /// Lines looked at.
        lines: usize,
        /// The first line.
        first: String,
    },
    /// A unit or a column that cannot be.
    #[error("{field} = {value} is not available: {allowed}")]
    Choice {
        /// Which field of [`super::measured::Columns`].
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        allowed: String,
    },
    /// A row is too short.
    #[error("line {line} has {fields} fields, column {column} is missing: \"{content}\"")]
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
    #[error("line {line}, column {column}: \"{content}\" is not a finite number")]
    Number {
        /// Line.
        line: u64,
        /// Column, from 1.
        column: usize,
        /// The field.
        content: String,
    },
    /// The text itself cannot be split.
    #[error("line {line} cannot be read: {problem}")]
    Text {
        /// Line.
        line: u64,
        /// The reader's own reason.
        problem: String,
    },
}
