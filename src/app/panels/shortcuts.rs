//! The list of keys.

use egui::{Context, Id, Modal, RichText, Ui};

use crate::app::widgets::{Icon, icon_button};
use crate::app::{fonts, theme};

/// Width of the list, points.
const WIDTH: f32 = 420.0;

/// Keys and what they do.
const KEYS: [(&str, &str); 20] = [
    ("1 2 3 …", "open a tab"),
    ("Tab, Shift+Tab", "go to the next or last control"),
    ("Enter, Space", "press it"),
    ("← →", "move a slider; with Shift in small steps"),
    ("Page Up, Page Down", "move it in large steps"),
    ("Ctrl+← →", "go to its next mark"),
    ("Home, End", "go to its ends"),
    ("← ↑ ↓ →", "move the point in a map"),
    ("F", "fill the page with one plot after another"),
    ("Escape", "show all plots; close; leave a field"),
    ("P", "pin the curves, or drop them"),
    ("B", "let the beam move, or hold it"),
    ("Space", "on Live: run or pause"),
    (". ,", "on Live: go on for a period, for a frame"),
    ("K J R C S", "on Live: kick up, down; from rest; clear; sound"),
    ("D, L", "dark or light; large type"),
    ("Ctrl+Z, Ctrl+Shift+Z", "undo; redo"),
    ("Ctrl+S, Ctrl+O", "save or open a file"),
    ("Escape, then Tab", "go to the text controls"),
    ("?", "this list"),
];

fn id() -> Id {
    Id::unique("shortcuts")
}

/// Whether the list is shown.
pub(in crate::app) fn is_open(context: &Context) -> bool {
    context.data(|data| data.get_temp(id())).unwrap_or(false)
}

/// Shows it.
pub(in crate::app) fn open(context: &Context) {
    context.data_mut(|data| data.insert_temp(id(), true));
    context.request_repaint();
}

/// The button that shows it.
pub(super) fn button(ui: &mut Ui) {
    if icon_button(ui, Icon::Help, "Keys (?)").clicked() {
        open(ui.ctx());
    }
}

/// Draws it over the page until Escape, a click or its button.
pub(in crate::app) fn show(ui: &Ui) {
    if !is_open(ui.ctx()) {
        return;
    }
    let tokens = theme::tokens(ui);
    let page = ui.ctx().content_rect().size();
    let frame = egui::Frame::popup(ui.style()).inner_margin(20);
    let shown = Modal::new(id()).frame(frame).show(ui.ctx(), |ui| {
        ui.set_width(WIDTH.min(page.x - 64.0));
        let title = RichText::new("Keys").font(fonts::semibold(theme::size::HEADING));
        ui.label(title.color(tokens.text_strong));
        egui::ScrollArea::vertical().max_height(page.y - 160.0).show(ui, |ui| {
            egui::Grid::new("keys").num_columns(2).spacing([18.0, 5.0]).show(ui, |ui| {
                for (keys, effect) in KEYS {
                    ui.label(RichText::new(keys).color(tokens.text_strong));
                    ui.add(egui::Label::new(RichText::new(effect).color(tokens.text)).wrap());
                    ui.end_row();
                }
            });
        });
        ui.add_space(6.0);
        ui.button("Close").clicked()
    });
    if shown.inner || shown.should_close() {
        ui.data_mut(|data| data.insert_temp(id(), false));
    }
}
