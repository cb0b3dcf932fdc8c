//! The kinds of curves the app draws, and how each looks, in plots and legends alike.

use egui::{Color32, Response, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2};

use super::recorder;
use crate::app::fonts;
use crate::app::theme::{self, Tokens};
pub use crate::export::Pen;

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
    /// Reached by a sweep upwards: small discs.
    Up,
    /// Reached by a sweep downwards: small rings.
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
            Self::Up => Pen::Points(2.6),
            Self::Down => Pen::Rings(3.2),
            Self::Unsettled => Pen::HollowDiamonds(4.0),
            Self::Stable => Pen::Line(2.4),
            Self::Unstable => Pen::Dashes(1.5, 5.0),
            Self::Linear => Pen::Dashes(1.8, 10.0),
            Self::Measured => Pen::Squares(2.0),
            Self::Limit => Pen::Line(1.6),
            Self::Beyond => Pen::Crosses(4.5),
            Self::Ghost => Pen::Line(1.0),
        }
    }
}

impl Series {
    /// The mark where single points are drawn.
    pub fn mark(self) -> Pen {
        match self.pen() {
            _ if self == Self::Ghost => Pen::Crosses(3.0),
            Pen::Line(_) | Pen::Dashes(..) | Pen::Dots(..) => Pen::Points(2.6),
            mark => mark,
        }
    }
}

/// A sample of the curve and its name.
pub fn legend_entry(ui: &mut Ui, series: Series, label: &str) -> Response {
    recorder::name(ui.ctx(), series, label);
    let tokens = theme::tokens(ui);
    let galley =
        ui.painter().layout_no_wrap(label.to_owned(), fonts::regular(theme::size::SMALL), tokens.text_weak);
    let (rect, response) = ui.allocate_exact_size(vec2(28.0 + galley.size().x, 18.0), Sense::hover());
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Label, enabled, label));
    let (left, right) = (pos2(rect.left() + 1.0, rect.center().y), pos2(rect.left() + 21.0, rect.center().y));
    let colour = series.colour(tokens);
    match series.pen() {
        Pen::Line(width) => {
            ui.painter().line_segment([left, right], Stroke::new(width, colour));
        }
        Pen::Dashes(width, length) => {
            // Long ones are cut, so that they end within the sample.
            let (length, gap) = (length.min(13.0), (0.6 * length).min(4.0));
            ui.painter().extend(Shape::dashed_line(&[left, right], Stroke::new(width, colour), length, gap));
        }
        Pen::Dots(radius, _) => {
            for step in 0..3 {
                let at = left.lerp(right, 0.14 + 0.36 * step as f32);
                ui.painter().circle_filled(at, radius, colour);
            }
        }
        pen => paint_mark(ui, left.lerp(right, 0.5), pen, colour),
    }
    let at = pos2(rect.left() + 27.0, rect.center().y - 0.5 * galley.size().y);
    ui.painter().galley(at, galley, tokens.text_weak);
    response
}

/// A mark as plots draw it.
fn paint_mark(ui: &Ui, at: egui::Pos2, pen: Pen, colour: Color32) {
    let stroke = Stroke::new(1.2, colour);
    let radius = pen.mark().unwrap_or_default();
    let corner = |x: f32, y: f32| at + vec2(x, y) * radius;
    match pen {
        Pen::Rings(_) => {
            ui.painter().circle_stroke(at, radius, stroke);
        }
        Pen::Crosses(_) => {
            ui.painter().line_segment([corner(-0.8, -0.8), corner(0.8, 0.8)], stroke);
            ui.painter().line_segment([corner(-0.8, 0.8), corner(0.8, -0.8)], stroke);
        }
        Pen::Diamonds(_) | Pen::HollowDiamonds(_) => {
            let corners = vec![corner(0.0, -1.0), corner(1.0, 0.0), corner(0.0, 1.0), corner(-1.0, 0.0)];
            ui.painter().add(match pen {
                Pen::Diamonds(_) => Shape::convex_polygon(corners, colour, Stroke::NONE),
                _ => Shape::closed_line(corners, stroke),
            });
        }
        Pen::Squares(_) => {
            ui.painter().rect_filled(
                egui::Rect::from_center_size(at, egui::Vec2::splat(2.0 * radius)),
                0,
                colour,
            );
        }
        _ => {
            ui.painter().circle_filled(at, radius, colour);
        }
    }
}

/// A row of samples; it breaks where it is too narrow.
pub fn legend(ui: &mut Ui, entries: &[(Series, &str)]) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(14.0, 0.0);
        for (series, label) in entries {
            legend_entry(ui, *series, label);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::widgets::harness::Harness;

    #[test]
    fn boundaries_differ_without_colour() {
        let pens = [Series::Published, Series::Coupled, Series::Exact, Series::Ghost].map(Series::pen);
        for (index, pen) in pens.iter().enumerate() {
            assert!(!pens[index + 1..].contains(pen));
        }
    }

    #[test]
    fn entries_are_labelled() {
        let mut harness = Harness::new(400.0, 100.0);
        harness
            .settle(|ui| legend(ui, &[(Series::Theory, "first-order theory"), (Series::Coupled, "coupled")]));
        harness.find(egui::Role::Label, "first-order theory");
    }
}
