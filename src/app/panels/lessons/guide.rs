//! The running lesson beside the plots: what is said, asked and to be done in the step in view. It stands at the right of
//! a wide page and below a narrower one, where it can be folded.

mod buttons;
mod contents;
mod heading;
mod shown;

use egui::{Align, Frame, Id, Layout, Margin, Panel, Ui};

use self::contents::{asked, said};
use self::heading::{heading, heading_in_row};
use self::shown::Shown;
use super::super::Context;
use crate::app::text::tr;
use crate::app::theme;
use crate::app::widgets::icon::BUTTON_SIDE;
use crate::app::widgets::touch::scroll_area;
use crate::app::widgets::{Icon, icon_button};

/// Width of the guide beside the plots, and of the page from which it stands there.
const SIDE: f32 = 308.0;
const WIDE: f32 = 1200.0;
/// Width from which what is said and what is to be done stand side by side in the guide below.
const TWO_COLUMNS: f32 = 700.0;
/// Highest part of the page that the guide below takes, with two columns and with one.
const LOW: f32 = 0.28;
const HIGH: f32 = 0.3;
/// Space between the guide's row of buttons and its text.
const SPACE: f32 = 8.0;

/// Draws the guide when a lesson runs.
pub(in crate::app) fn guide(context: &mut Context<'_>, ui: &mut Ui) {
    let Some((id, shown)) = Shown::of(context) else { return };
    let tokens = theme::tokens(ui);
    let frame = Frame::new().fill(tokens.bar).inner_margin(Margin::symmetric(14, 10));
    let place = Id::unique("guide").with((id.number(), shown.number));
    if ui.available_width() >= WIDE {
        let panel = Panel::right("guide").exact_size(SIDE).resizable(false);
        panel.show_separator_line(false).frame(frame).show(ui, |ui| {
            heading(context, ui, shown);
            ui.add_space(8.0);
            let height = ui.available_height() - 40.0;
            scroll_area(ui.ctx()).id_salt(place).auto_shrink([false, true]).max_height(height).show(
                ui,
                |ui| {
                    ui.set_max_width(ui.available_width() - 4.0);
                    said(ui, shown);
                    ui.add_space(10.0);
                    asked(context, ui, shown);
                },
            );
            ui.add_space(8.0);
            ui.horizontal(|ui| buttons::walk(context, ui, shown));
        });
        return;
    }
    below(context, ui, shown, frame, place);
}

/// What is remembered of the guide below: whether it is folded in this step, and how tall its text was in the last
/// frame.
#[derive(Clone, Copy, Default)]
struct Memory {
    folded: Option<Id>,
    height: Option<f32>,
}

fn below(context: &mut Context<'_>, ui: &mut Ui, shown: Shown, frame: Frame, place: Id) {
    let columns = ui.available_width() >= TWO_COLUMNS;
    let highest = ui.ctx().content_rect().height() * if columns { LOW } else { HIGH };
    let id = Id::unique("guide below");
    let Memory { folded, height } = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    let mut folded = folded == Some(place);
    let text = if folded { 0.0 } else { height.unwrap_or(highest).min(highest) + SPACE };
    let mut full = None;
    let panel = Panel::bottom("guide").exact_size(text + BUTTON_SIDE + frame.total_margin().sum().y);
    panel.resizable(false).show_separator_line(false).frame(frame).show(ui, |ui| {
        ui.horizontal(|ui| {
            let (icon, label) = if folded {
                (Icon::ChevronRight, tr("Unfold the lesson"))
            } else {
                (Icon::ChevronDown, tr("Fold the lesson"))
            };
            if icon_button(ui, icon, label).clicked() {
                folded = !folded;
            }
            heading_in_row(context, ui, shown);
        });
        if text == 0.0 {
            return;
        }
        let area = scroll_area(ui.ctx()).id_salt(place).auto_shrink(false).show(ui, |ui| {
            ui.set_max_width(ui.available_width() - 8.0);
            if columns {
                side_by_side(context, ui, shown);
            } else {
                said(ui, shown);
                ui.add_space(8.0);
                asked(context, ui, shown);
            }
        });
        full = Some(area.content_size.y);
    });
    if full != height {
        ui.ctx().request_repaint();
    }
    ui.data_mut(|data| data.insert_temp(id, Memory { folded: folded.then_some(place), height: full }));
}

fn side_by_side(context: &mut Context<'_>, ui: &mut Ui, shown: Shown) {
    let usual = std::mem::replace(&mut ui.spacing_mut().item_spacing.x, 28.0);
    ui.columns(2, |columns| {
        for (index, column) in columns.iter_mut().enumerate() {
            column.spacing_mut().item_spacing.x = usual;
            column.with_layout(Layout::top_down(Align::Min), |ui| match index {
                0 => said(ui, shown),
                _ => asked(context, ui, shown),
            });
        }
    });
}
