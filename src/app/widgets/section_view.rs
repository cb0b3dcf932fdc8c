//! A beam cut across: its layers with their thicknesses to scale.

use egui::{Align2, Color32, Rect, Response, Sense, Shape, Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2};

use super::number::short;
use crate::app::text::fill;
use crate::app::{fonts, theme};

/// Height of the stack and of the note below it, and room for the labels at its right, points.
const STACK: f32 = 84.0;
const NOTE: f32 = 32.0;
const LABELS: f32 = 134.0;
/// Widest stack, and least distance of two labels, points.
const WIDEST: f32 = 300.0;
const LINE: f32 = 15.0;

/// A layer.
pub struct Drawn<'a> {
    /// Thickness (mm).
    pub thickness: f64,
    /// Its colour.
    pub colour: Color32,
    /// What it is.
    pub name: &'a str,
}

/// Draws `layers` from the bottom to the top, of a beam of `width` (mm), with its neutral axis at `axis` (mm over the lower
/// face).
pub fn section_view(ui: &mut Ui, layers: &[Drawn<'_>], width: f64, axis: f64) -> Response {
    let tokens = theme::tokens(ui);
    let room = vec2(ui.available_width(), STACK + NOTE);
    let (rect, response) = ui.allocate_exact_size(room, Sense::hover());
    let height: f64 = layers.iter().map(|layer| layer.thickness).sum();
    if !(height > 0.0 && width > 0.0) {
        return response;
    }
    let across = (rect.width() - LABELS).clamp(40.0, WIDEST);
    let stack = Rect::from_min_size(rect.min + vec2(0.0, 4.0), vec2(across, STACK - 8.0));
    let level = |at: f64| stack.bottom() - stack.height() * (at / height) as f32;
    let painter = ui.painter();
    let small = fonts::regular(theme::size::SMALL);
    let (mut from, mut lowest) = (0.0, f32::INFINITY);
    let mut told = Vec::new();
    for layer in layers {
        let to = from + layer.thickness;
        let part = Rect::from_min_max(pos2(stack.left(), level(to)), pos2(stack.right(), level(from)));
        painter.rect(part, 0.0, layer.colour, Stroke::new(1.0, tokens.card), StrokeKind::Inside);
        let text = format!("{} {} mm", layer.name, short(layer.thickness));
        // From below upwards, none over another.
        let at = part.center().y.min(lowest - LINE);
        lowest = at;
        painter.line_segment(
            [pos2(stack.right() + 2.0, part.center().y), pos2(stack.right() + 8.0, at)],
            Stroke::new(1.0, tokens.outline),
        );
        let place = pos2(stack.right() + 11.0, at);
        painter.text(place, Align2::LEFT_CENTER, &text, small.clone(), tokens.text);
        told.push(text);
        from = to;
    }
    let line = [pos2(stack.left() - 2.0, level(axis)), pos2(stack.right() + 2.0, level(axis))];
    painter.extend(Shape::dashed_line(&line, Stroke::new(1.2, tokens.text_strong), 5.0, 4.0));
    // How much the thickness is drawn larger than the width.
    let factor = (f64::from(stack.height()) / height) / (f64::from(across) / width);
    let note = fill(
        "{width} mm wide; thicknesses drawn {factor} times as large; dashed: neutral axis",
        &[
            ("width", &short(width)),
            ("factor", &short(crate::app::widgets::number::round_significant(factor, 2))),
        ],
    );
    let galley = painter.layout(note.clone(), small, tokens.text_weak, rect.width());
    painter.galley(pos2(rect.left(), stack.bottom() + 3.0), galley, tokens.text_weak);
    told.reverse();
    let told = format!("{}. {note}", told.join(", "));
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, &told));
    response
}
