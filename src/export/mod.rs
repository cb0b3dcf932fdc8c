//! What leaves the page to be kept: plots as SVG and CSV, a report as one HTML file, a question as a program.
//!
//! A [`Figure`] says what a plot shows; drawings and tables are made from it alone, so that they cannot disagree.
//! [`Provenance`] says what it was computed from; it stands in every file.

pub mod axis;
pub mod figure;
pub mod provenance;
pub mod report;
pub mod snippet;
pub mod svg;
pub mod table;

mod markup;
mod picture;

/// What a plot can be saved as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// A picture with twice the pixels of the drawing.
    Png,
    /// The drawing.
    Svg,
    /// Its data.
    Csv,
}

impl Format {
    /// All, with their names.
    pub const ALL: [(Self, &'static str); 3] = [(Self::Png, "PNG"), (Self::Svg, "SVG"), (Self::Csv, "CSV")];
}

pub use harvester_solver::number;

pub use axis::Axis;
pub use figure::{Figure, Layer, Pen, Rgba};
pub use provenance::Provenance;
