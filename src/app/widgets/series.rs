//! The kinds of curves the app draws, and how each looks, in plots and legends alike.

use egui::Color32;

use crate::app::theme::Tokens;
use crate::export::Pen;

/// What a curve or a set of points stands for. Each kind has its colour, and a line style that tells it apart
/// without colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Series {
    /// Computed trajectory: a solid line.
    Numeric,
    /// First-order theory: dots.
    Theory,
    /// Published boundary: fine dots.
    Published,
    /// Coupled-mode boundary: dashes.
    Coupled,
    /// Boundary from Floquet multipliers: a thick solid line.
    Exact,
    /// Poincaré points.
    Poincare,
    /// Boundary of a torus: long dashes.
    Torus,
    /// Boundary of a period doubling beyond which the motion jumps: short dashes.
    Subcritical,
    /// The same of a torus: wide dots.
    SubcriticalTorus,
    /// Curve of folds: fine dots.
    Fold,
    /// A single point of the theory: a ring around what it predicts.
    TheoryPoint,
    /// Multipliers of the forced motion: large discs.
    Forced,
    /// Multipliers of the motion reached: large rings.
    Reached,
    /// Motions from rest: diamonds.
    FromRest,
    /// The best that there is: very long dashes.
    Best,
    /// Reached by a sweep upwards: rings, within which the others show.
    Up,
    /// Reached by a sweep downwards: small discs.
    Down,
    /// What a sweep has not settled at: hollow diamonds.
    Unsettled,
    /// A stable branch: a solid line.
    Stable,
    /// An unstable branch: short dashes.
    Unstable,
    /// The device without its magnets: long grey dashes.
    Linear,
    /// What is measured: small squares.
    Measured,
    /// A limit: a solid line.
    Limit,
    /// Beyond a limit: crosses.
    Beyond,
    /// Pinned for comparison: a thin grey line, or crosses.
    Ghost,
    /// A pinned design, by its number from 0: dashes or dots of four kinds.
    Variant(u8),
}

impl Series {
    /// The colour in this theme.
    pub fn colour(self, tokens: &Tokens) -> Color32 {
        match self {
            Self::Numeric => tokens.numeric,
            Self::Theory | Self::TheoryPoint => tokens.theory,
            Self::Published => tokens.published,
            Self::Coupled => tokens.coupled,
            Self::Exact | Self::Subcritical => tokens.exact,
            Self::Poincare => tokens.poincare,
            Self::Torus | Self::SubcriticalTorus => tokens.poincare,
            Self::Fold => tokens.warning,
            Self::Forced | Self::Best => tokens.exact,
            Self::Reached => tokens.numeric,
            Self::FromRest => tokens.poincare,
            Self::Up => tokens.numeric,
            Self::Down => tokens.warning,
            Self::Unsettled => tokens.danger,
            Self::Stable | Self::Unstable => tokens.ok,
            Self::Linear => tokens.text_weak,
            Self::Measured => tokens.theory,
            Self::Limit | Self::Beyond => tokens.danger,
            Self::Ghost => tokens.ghost,
            Self::Variant(0) => tokens.numeric,
            Self::Variant(1) => tokens.theory,
            Self::Variant(2) => tokens.poincare,
            Self::Variant(_) => tokens.exact,
        }
    }

    /// The line style.
    pub fn pen(self) -> Pen {
        match self {
            Self::Numeric => Pen::Line(2.0),
            Self::Theory => Pen::Dots(2.6, 11.0),
            Self::Published => Pen::Dots(1.7, 7.0),
            Self::Coupled => Pen::Dashes(1.8, 9.0),
            Self::Exact => Pen::Line(3.0),
            Self::Poincare => Pen::Points(3.5),
            Self::Torus => Pen::Dashes(2.2, 14.0),
            Self::Subcritical => Pen::Dashes(2.6, 6.0),
            Self::SubcriticalTorus => Pen::Dots(2.4, 14.0),
            Self::Fold => Pen::Dots(1.8, 7.0),
            Self::TheoryPoint => Pen::Rings(6.0),
            Self::Forced => Pen::Points(4.5),
            Self::Reached => Pen::Rings(6.5),
            Self::FromRest => Pen::Diamonds(4.0),
            Self::Best => Pen::Dashes(2.4, 20.0),
            Self::Up => Pen::Rings(3.8),
            Self::Down => Pen::Points(1.7),
            Self::Unsettled => Pen::HollowDiamonds(4.0),
            Self::Stable => Pen::Line(2.4),
            Self::Unstable => Pen::Dashes(1.5, 5.0),
            Self::Linear => Pen::Dashes(1.8, 10.0),
            Self::Measured => Pen::Squares(2.0),
            Self::Limit => Pen::Line(1.6),
            Self::Beyond => Pen::Crosses(4.5),
            Self::Ghost => Pen::Line(1.0),
            Self::Variant(0) => Pen::Dashes(2.2, 16.0),
            Self::Variant(1) => Pen::Dots(2.4, 13.0),
            Self::Variant(2) => Pen::Dashes(2.2, 6.0),
            Self::Variant(_) => Pen::Dots(1.9, 6.0),
        }
    }

    /// The mark where single points are drawn.
    pub fn mark(self) -> Pen {
        match self.pen() {
            _ if self == Self::Ghost => Pen::Crosses(3.0),
            Pen::Line(_) | Pen::Dashes(..) | Pen::Dots(..) => Pen::Points(2.6),
            mark => mark,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boundaries_differ_without_colour() {
        let pens = [Series::Published, Series::Coupled, Series::Exact, Series::Ghost].map(Series::pen);
        for (index, pen) in pens.iter().enumerate() {
            assert!(!pens[index + 1..].contains(pen));
        }
    }
}
