//! Legends: a sample of each kind of curve, with its name.

use egui::{Color32, Response, RichText, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2};

use super::explanation::explained;
use super::recorder;
use super::row::{self, row};
use super::series::Series;
use crate::app::fonts;
use crate::app::theme;
use crate::export::Pen;

/// Width of a sample with the space beside it, points; and where there is little room.
const SAMPLE: f32 = 25.0;
const SHORT_SAMPLE: f32 = 18.0;

/// A sample of the curve and its name.
pub fn legend_entry(ui: &mut Ui, series: Series, label: &str) -> Response {
    recorder::name(ui.ctx(), series, label);
    let tokens = theme::tokens(ui);
    let sample = if row::is_low(ui.ctx()) { SHORT_SAMPLE } else { SAMPLE };
    let galley =
        ui.painter().layout_no_wrap(label.to_owned(), fonts::regular(theme::size::SMALL), tokens.text_weak);
    let (rect, response) = ui.allocate_exact_size(vec2(sample + galley.size().x, 18.0), Sense::CLICK);
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Label, enabled, label));
    let (left, right) =
        (pos2(rect.left() + 1.0, rect.center().y), pos2(rect.left() + sample - 7.0, rect.center().y));
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
    let at = pos2(rect.left() + sample - 1.0, rect.center().y - 0.5 * galley.size().y);
    ui.painter().galley(at, galley, tokens.text_weak);
    explained(response, label)
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

/// A row of samples.
pub fn legend(ui: &mut Ui, entries: &[(Series, &str)]) {
    legend_with(ui, entries, None);
}

/// The same with words about the last of them.
pub fn legend_with(ui: &mut Ui, entries: &[(Series, &str)], note: Option<&str>) {
    row(ui, |ui| {
        ui.spacing_mut().item_spacing = vec2(if row::is_low(ui.ctx()) { 4.0 } else { 10.0 }, 0.0);
        for (series, label) in entries {
            legend_entry(ui, *series, label);
        }
        if let Some(note) = note {
            let font = fonts::regular(theme::size::SMALL);
            ui.label(RichText::new(note).font(font).color(theme::tokens(ui).text_weak));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::widgets::harness::Harness;

    #[test]
    fn entries_are_labelled() {
        let mut harness = Harness::new(400.0, 100.0);
        harness
            .settle(|ui| legend(ui, &[(Series::Theory, "first-order theory"), (Series::Coupled, "coupled")]));
        harness.find(egui::Role::Label, "first-order theory");
    }
}
