//! The list of keys.

use egui::{RichText, Ui};

use super::greeting;
use crate::app::text::{marked, tr};
use crate::app::widgets::{Icon, Overlay, icon_button};
use crate::app::{fonts, theme};

/// The list.
pub(in crate::app) const SHEET: Overlay = Overlay::new("shortcuts", 420.0);

/// Keys and what they do.
const KEYS: [(&str, &str); 24] = [
    (marked("1 2 3 …"), marked("open a tab")),
    (marked("Tab, Shift+Tab"), marked("go to the next or the previous control")),
    (marked("Enter, Space"), marked("press it")),
    (marked("← →"), marked("move a slider; with Shift in small steps")),
    (marked("Shift + drag"), marked("move a slider finely")),
    (marked("Page Up, Page Down"), marked("move a slider in large steps")),
    (marked("Ctrl+← →"), marked("move a slider to its next mark")),
    (marked("Home, End"), marked("move a slider to its ends")),
    (marked("Page Up, Page Down"), marked("in a lesson or among the figures: the previous or next one")),
    (marked("Ctrl + wheel"), marked("zoom a plot")),
    (marked("← ↑ ↓ →"), marked("move the point in a map")),
    (marked("F"), marked("fill the page with one plot after another")),
    (marked("Shift+F"), marked("fill the screen with the page")),
    (marked("Escape"), marked("show all plots; close; leave a field")),
    (marked("P"), marked("pin the curves, or drop them; on Design: pin the design")),
    (marked("B"), marked("let the beam move, or hold it")),
    (marked("Space"), marked("on Live: run or pause")),
    (marked(". ,"), marked("on Live: go on for a period, for a frame")),
    (marked("K J R C S"), marked("on Live: kick up, down; from rest; clear; sound")),
    (marked("D, L"), marked("dark or light; large type")),
    (marked("Ctrl+Z, Ctrl+Shift+Z"), marked("undo; redo")),
    (marked("Ctrl+S, Ctrl+O"), marked("save or open a file")),
    (marked("Escape, then Tab"), marked("go to the text controls")),
    (marked("?"), marked("this list")),
];

/// The button that shows it.
pub(super) fn button(ui: &mut Ui) {
    if icon_button(ui, Icon::Help, tr("Keys (?)")).clicked() {
        SHEET.open(ui.ctx());
    }
}

/// Draws it over the page until Escape, a click or its button.
pub(in crate::app) fn show(ui: &Ui) {
    let tokens = theme::tokens(ui);
    SHEET.show(ui, |ui| {
        let title = RichText::new(tr("Keys")).font(fonts::semibold(theme::size::HEADING));
        ui.label(title.color(tokens.text_strong));
        Overlay::scrolled(ui, 160.0, |ui| {
            egui::Grid::new("keys").num_columns(2).spacing([18.0, 5.0]).show(ui, |ui| {
                for (keys, effect) in KEYS {
                    ui.label(RichText::new(tr(keys)).color(tokens.text_strong));
                    ui.add(egui::Label::new(RichText::new(tr(effect)).color(tokens.text)).wrap());
                    ui.end_row();
                }
            });
        });
        ui.add_space(6.0);
        ui.horizontal(|ui| {
            let greet = ui.button(tr("What is this?")).clicked();
            if greet {
                greeting::SHEET.open(ui.ctx());
            }
            ui.button(tr("Close")).clicked() || greet
        })
        .inner
    });
}
