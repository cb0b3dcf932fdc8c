//! Where a plot is drawn, and the size and colour of what is written about it.

use crate::export::Rgba;
use crate::export::markup::short;

/// What is kept free left and right of a plot, in pixels.
pub(super) const LEFT: f64 = 76.0;
pub(super) const RIGHT: f64 = 20.0;
/// Size of texts.
pub(super) const TEXT: f64 = 12.0;
pub(super) const INK: Rgba = [20, 26, 32, 255];

/// Where a plot is drawn.
pub(super) struct Frame {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) ranges: [(f64, f64); 2],
}

impl Frame {
    pub(super) fn x(&self, x: f64) -> f64 {
        let (low, high) = self.ranges[0];
        // Far outside, drawings lose their precision; the clipping does not see the difference.
        self.left + self.width * ((x - low) / (high - low)).clamp(-20.0, 20.0)
    }

    pub(super) fn y(&self, y: f64) -> f64 {
        let (low, high) = self.ranges[1];
        self.top + self.height * (1.0 - ((y - low) / (high - low)).clamp(-20.0, 20.0))
    }

    pub(super) fn place(&self, [x, y]: [f64; 2]) -> String {
        format!("{} {}", short(self.x(x)), short(self.y(y)))
    }
}
