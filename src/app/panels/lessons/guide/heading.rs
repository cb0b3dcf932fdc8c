//! What stands above the guide's text: title, place in the lesson, and the way out.

use egui::{Align, Layout, Rect, RichText, Sense, Ui, pos2, vec2};

use super::buttons;
use super::shown::Shown;
use crate::app::panels::Context;
use crate::app::text::fill;
use crate::app::{fonts, theme};

/// Width below which the place in the lesson is given in figures.
const PHONE: f32 = 480.0;

/// Title, place in the lesson, and the way out.
pub(super) fn heading(context: &mut Context<'_>, ui: &mut Ui, shown: Shown) {
    let tokens = theme::tokens(ui);
    ui.horizontal_top(|ui| {
        let title = RichText::new(shown.lesson.title.get()).font(fonts::semibold(theme::size::TITLE));
        let width = ui.available_width() - 34.0;
        ui.allocate_ui(vec2(width, 0.0), |ui| {
            ui.set_min_width(width);
            ui.add(egui::Label::new(title.color(tokens.text_strong)).wrap());
        });
        buttons::leave(context, ui);
    });
    track(ui, shown);
    ui.label(RichText::new(place_in_words(shown)).small().color(tokens.text_weak));
}

/// The same with the buttons in one row, for the guide below.
pub(super) fn heading_in_row(context: &mut Context<'_>, ui: &mut Ui, shown: Shown) {
    let tokens = theme::tokens(ui);
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        buttons::leave(context, ui);
        buttons::next(context, ui, shown);
        buttons::back(context, ui, shown);
        buttons::restart(context, ui, shown);
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            let phone = ui.ctx().content_rect().width() < PHONE;
            let place = if phone {
                format!("{}/{}", shown.number, shown.lesson.steps.len())
            } else {
                place_in_words(shown)
            };
            ui.label(RichText::new(place).small().color(tokens.text_weak));
            let title = RichText::new(shown.lesson.title.get()).font(fonts::semibold(theme::size::TITLE));
            ui.add(egui::Label::new(title.color(tokens.text_strong)).truncate());
        });
    });
}

fn place_in_words(shown: Shown) -> String {
    fill("Step {number} of {count}", &[("number", &shown.number), ("count", &shown.lesson.steps.len())])
}

/// A bar a step, filled up to the one in view.
fn track(ui: &mut Ui, shown: Shown) {
    let tokens = theme::tokens(ui);
    let count = shown.lesson.steps.len();
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 6.0), Sense::hover());
    let gap = 4.0;
    let width = (rect.width() - gap * (count - 1) as f32) / count as f32;
    for index in 0..count {
        let left = rect.left() + index as f32 * (width + gap);
        let bar = Rect::from_min_size(pos2(left, rect.center().y - 1.5), vec2(width, 3.0));
        let colour = if index < shown.number { tokens.accent } else { tokens.track };
        ui.painter().rect_filled(bar, 1, colour);
    }
}
