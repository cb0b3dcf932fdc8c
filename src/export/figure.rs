//! What a plot shows, independent of where it is drawn.

use super::Axis;

/// Red, green, blue and opacity, 0 to 255.
pub type Rgba = [u8; 4];

/// How the pen moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pen {
    /// A line of this width, points.
    Line(f32),
    /// Dashes of this width and length, points.
    Dashes(f32, f32),
    /// Dots of this radius and spacing, points.
    Dots(f32, f32),
    /// Points of this radius where the data are, points.
    Points(f32),
    /// Rings of this radius where the data are, points.
    Rings(f32),
    /// Crosses that fit into such rings.
    Crosses(f32),
    /// Diamonds.
    Diamonds(f32),
    /// Diamonds that are not filled.
    HollowDiamonds(f32),
    /// Squares.
    Squares(f32),
}

impl Pen {
    /// The word for it in tables.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Line(_) => "line",
            Self::Dashes(..) => "dashed line",
            Self::Dots(..) => "dotted line",
            Self::Points(_) => "points",
            Self::Rings(_) => "rings",
            Self::Crosses(_) => "crosses",
            Self::Diamonds(_) => "diamonds",
            Self::HollowDiamonds(_) => "hollow diamonds",
            Self::Squares(_) => "squares",
        }
    }

    /// The radius of marks; none of lines.
    pub const fn mark(self) -> Option<f32> {
        match self {
            Self::Line(_) | Self::Dashes(..) | Self::Dots(..) => None,
            Self::Points(radius)
            | Self::Rings(radius)
            | Self::Crosses(radius)
            | Self::Diamonds(radius)
            | Self::HollowDiamonds(radius)
            | Self::Squares(radius) => Some(radius),
        }
    }
}

/// Which part of a text stands at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// Its middle.
    Middle,
    /// Its lower left corner.
    Left,
}

/// The values of a coloured chart, for tables.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Cells {
    /// What they measure, with its unit.
    pub name: String,
    /// Columns and rows.
    pub size: (usize, usize),
    /// Middles of the first and the last column and row, in coordinates.
    pub ranges: [(f64, f64); 2],
    /// Row by row from the lowest: a number, a word, or nothing.
    pub values: Vec<String>,
}

/// One thing that is drawn. Places are coordinates of the axes.
#[derive(Debug, Clone, PartialEq)]
pub enum Layer {
    /// A picture over the rectangle from its lower left to its upper right corner.
    Picture {
        /// Columns and rows of pixels.
        size: (usize, usize),
        /// Row by row from the top, as egui keeps them.
        pixels: Vec<Rgba>,
        /// Left and right, bottom and top, in coordinates.
        place: [(f64, f64); 2],
        /// 0 to 1.
        opacity: f32,
    },
    /// A region between two curves over the same places.
    Band {
        /// Name for tables; without one it is a mere tint.
        name: String,
        /// Name in the legend; empty for none.
        key: String,
        /// Its fill.
        fill: Rgba,
        /// Colour of its edges; fully transparent for none.
        edge: Rgba,
        /// Place, lower and upper end.
        points: Vec<[f64; 3]>,
    },
    /// A curve or points; what is not finite leaves a gap.
    Curve {
        /// Name for tables; without one it is a mere help to the eye.
        name: String,
        /// Name in the legend; empty for none.
        key: String,
        /// Its colour.
        colour: Rgba,
        /// Its style.
        pen: Pen,
        /// Places.
        points: Vec<[f64; 2]>,
    },
    /// A line across the whole plot.
    Rule {
        /// What it marks; empty when it is no more than a help.
        name: String,
        /// Its colour.
        colour: Rgba,
        /// Its style.
        pen: Pen,
        /// Whether it is upright.
        upright: bool,
        /// Its value on the axis it crosses.
        at: f64,
    },
    /// A text.
    Text {
        /// What it says.
        text: String,
        /// Its colour.
        colour: Rgba,
        /// Its place, in the units of the axes.
        place: [f64; 2],
        /// What of it stands there.
        anchor: Anchor,
    },
    /// A place of its own: a diamond with its name.
    Special {
        /// Its name.
        name: String,
        /// Its place, in the units of the axes.
        place: [f64; 2],
    },
    /// The operating point, as on the page.
    Here {
        /// Its name in the legend.
        name: String,
        /// Its place, in the units of the axes.
        place: [f64; 2],
    },
}

/// A legend beside curves: colours of areas, or a scale of colours.
#[derive(Debug, Clone, PartialEq)]
pub enum Key {
    /// A colour and what it stands for.
    Swatch(Rgba, String),
    /// Colours from low to high, with the texts at both ends.
    Scale(Vec<Rgba>, String, String),
}

/// A plot.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Figure {
    /// What it shows.
    pub title: String,
    /// Across and up.
    pub axes: Option<[Axis; 2]>,
    /// What of the axes is in view: lowest and highest coordinate.
    pub ranges: [(f64, f64); 2],
    /// Height of the plot over its width.
    pub aspect: f64,
    /// Whether a unit is as long across as up.
    pub equal_scale: bool,
    /// What is drawn, in this order.
    pub layers: Vec<Layer>,
    /// What colours stand for.
    pub keys: Vec<Key>,
    /// Values of coloured charts.
    pub cells: Vec<Cells>,
}

impl Figure {
    /// Whether anything is in view.
    pub fn is_usable(&self) -> bool {
        let sound = |(low, high): (f64, f64)| low.is_finite() && high.is_finite() && high > low;
        self.axes.is_some() && self.ranges.iter().all(|range| sound(*range)) && !self.layers.is_empty()
    }
}

/// The stretches of a curve without points that are not finite.
pub fn finite_runs(points: &[[f64; 2]]) -> Vec<&[[f64; 2]]> {
    let finite = |point: &[f64; 2]| point.iter().all(|value| value.is_finite());
    points.split(|point| !finite(point)).filter(|run| !run.is_empty()).collect()
}
