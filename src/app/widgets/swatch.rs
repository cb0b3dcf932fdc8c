//! Legends of charts: what a colour stands for.

use egui::{Color32, Mesh, Rect, Response, Sense, Shape, Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2};

use super::explanation::explained;
use super::recorder;
use super::row::row;
use crate::app::text::fill;
use crate::app::{fonts, theme};
use crate::export::figure::Key;

const SIDE: f32 = 12.0;

/// What a square of a legend is filled with.
#[derive(Clone, Copy)]
pub enum Filling {
    /// A colour.
    Plain(Color32),
    /// The hatching of what is beyond a limit.
    Hatching,
}

/// A row of filled squares with their meaning.
pub fn swatches(ui: &mut Ui, entries: &[(Filling, &str)]) {
    row(ui, |ui| {
        ui.spacing_mut().item_spacing = vec2(12.0, 0.0);
        let danger = theme::tokens(ui).danger;
        for (filling, meaning) in entries {
            let colour = if let Filling::Plain(colour) = filling { *colour } else { danger };
            recorder::key(ui.ctx(), &mut || Key::Swatch(recorder::rgba(colour), (*meaning).to_owned()));
            swatch(ui, *filling, meaning);
        }
    });
}

fn swatch(ui: &mut Ui, filling: Filling, meaning: &str) -> Response {
    let tokens = theme::tokens(ui);
    let font = fonts::regular(theme::size::SMALL);
    let galley = ui.painter().layout_no_wrap(meaning.to_owned(), font, tokens.text_weak);
    let size = vec2(SIDE + 6.0 + galley.size().x, 18.0);
    let (rect, response) = ui.allocate_exact_size(size, Sense::CLICK);
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Label, enabled, meaning));
    let square = Rect::from_center_size(pos2(rect.left() + 0.5 * SIDE, rect.center().y), vec2(SIDE, SIDE));
    match filling {
        Filling::Plain(colour) => {
            ui.painter().rect_filled(square, 3, colour);
        }
        Filling::Hatching => hatch(ui, square),
    }
    let at = pos2(rect.left() + SIDE + 6.0, rect.center().y - 0.5 * galley.size().y);
    ui.painter().galley(at, galley, tokens.text_weak);
    explained(response, meaning)
}

fn hatch(ui: &Ui, square: Rect) {
    let stroke = Stroke::new(2.0, theme::tokens(ui).danger);
    let painter = ui.painter().with_clip_rect(square.intersect(ui.clip_rect()));
    for across in [-0.5, 0.0, 0.5] {
        let middle = square.center() + vec2(across * SIDE, across * SIDE);
        painter.line_segment([middle + vec2(-SIDE, SIDE), middle + vec2(SIDE, -SIDE)], stroke);
    }
    ui.painter().rect_stroke(square, 1, Stroke::new(1.0, stroke.color), StrokeKind::Inside);
}

/// A bar of the colours from 0 to 1 between the texts for both ends.
pub fn colour_bar(ui: &mut Ui, low: &str, high: &str, colour: &dyn Fn(f64) -> Color32) {
    const WIDTH: f32 = 110.0;
    const PARTS: u32 = 24;
    let tokens = theme::tokens(ui);
    recorder::key(ui.ctx(), &mut || {
        let colours = (0..=PARTS).map(|part| recorder::rgba(colour(f64::from(part) / f64::from(PARTS))));
        Key::Scale(colours.collect(), low.to_owned(), high.to_owned())
    });
    ui.spacing_mut().item_spacing.x = 6.0;
    let text = |text: &str| egui::RichText::new(text).small().color(tokens.text_weak);
    ui.label(text(low));
    let (rect, _) = ui.allocate_exact_size(vec2(WIDTH, 18.0), Sense::hover());
    let bar = rect.shrink2(vec2(0.0, 4.0));
    let mut mesh = Mesh::default();
    for part in 0..=PARTS {
        let share = f64::from(part) / f64::from(PARTS);
        let x = bar.left() + bar.width() * share as f32;
        mesh.colored_vertex(pos2(x, bar.top()), colour(share));
        mesh.colored_vertex(pos2(x, bar.bottom()), colour(share));
        if part > 0 {
            let last = 2 * part;
            mesh.add_triangle(last - 2, last - 1, last);
            mesh.add_triangle(last - 1, last, last + 1);
        }
    }
    ui.painter().add(Shape::mesh(mesh));
    ui.label(text(high));
}

/// A row that can be clicked: a coloured square, a name, and a quiet number at the right.
pub fn attractor_row(ui: &mut Ui, colour: Color32, name: &str, number: &str) -> Response {
    recorder::key(ui.ctx(), &mut || Key::Swatch(recorder::rgba(colour), format!("{name} ({number})")));
    let tokens = theme::tokens(ui);
    let size = vec2(ui.available_width(), 24.0);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let enabled = ui.is_enabled();
    response.widget_info(|| {
        WidgetInfo::labeled(
            egui::Role::Button,
            enabled,
            fill("Start on {name}, {number}", &[("name", &name), ("number", &number)]),
        )
    });
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, theme::radius::CONTROL, tokens.hover);
    }
    let middle = rect.center().y;
    let square = Rect::from_center_size(pos2(rect.left() + 10.0, middle), vec2(SIDE, SIDE));
    ui.painter().rect_filled(square, 3, colour);
    let font = fonts::regular(theme::size::SMALL);
    let number = ui.painter().text(
        pos2(rect.right() - 4.0, middle),
        egui::Align2::RIGHT_CENTER,
        number,
        font.clone(),
        tokens.text_weak,
    );
    let mut job = egui::text::LayoutJob::simple_singleline(name.to_owned(), font, tokens.text);
    let left = square.right() + 6.0;
    job.wrap = egui::text::TextWrapping::truncate_at_width((number.left() - 6.0 - left).max(10.0));
    let galley = ui.painter().layout_job(job);
    ui.painter().galley(pos2(left, middle - 0.5 * galley.size().y), galley, tokens.text);
    response.on_hover_cursor(egui::CursorIcon::PointingHand)
}
