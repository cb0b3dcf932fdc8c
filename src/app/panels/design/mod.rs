//! The Design tab: what a device delivers in volts, watts and hertz, within which limits, and what would be better.

mod alignment;
mod bands;
mod best_load;
mod force;
mod going;
pub(super) mod harvest;
mod limits;
mod load;
mod materials;
mod measure;
pub(super) mod measured;
mod optimum;
pub(in crate::app) mod safety;
mod search;
mod summary;
#[cfg(test)]
mod tests;
mod trust;

use egui::Ui;

use super::{Context, grid};
use crate::app::text::tr;
use crate::app::view::Panel;
use crate::app::view::design::Page;
use crate::app::widgets::tabs;

/// Width from which a page has a column beside its plot, that column's width, and least height of a plot's card.
const BESIDE: f32 = 860.0;
const ASIDE: f32 = 340.0;
const LEAST_HEIGHT: f32 = 400.0;

/// Draws the tab.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    choose(context, ui);
    ui.add_space(4.0);
    summary::show(context, ui);
    ui.add_space(grid::GAP);
    match context.view.design.page {
        Page::Harvest => beside(context, ui, Panel::Harvest, harvest::show, bands::show),
        Page::Load => beside(context, ui, Panel::Load, load::show, best_load::cards),
        Page::Materials => materials::show(context, ui),
        Page::Trust => trust::show(context, ui),
        Page::Search => beside(context, ui, Panel::DesignMap, search::show, search::cards),
        Page::Measured => beside(context, ui, Panel::Measured, measured::show, measured::cards),
    }
}

/// One of its plots where there is nothing else of the tab.
pub(in crate::app) fn plot_alone(context: &mut Context<'_>, ui: &mut Ui, panel: Panel) {
    match panel {
        Panel::Load => load::show(context, ui),
        Panel::MagnetForce => force::show(context, ui),
        _ => harvest::show(context, ui),
    }
}

fn choose(context: &mut Context<'_>, ui: &mut Ui) {
    let pages = [
        (Page::Harvest, tr("Harvest")),
        (Page::Load, tr("Load")),
        (Page::Materials, tr("Materials")),
        (Page::Trust, tr("Trust")),
        (Page::Search, tr("Search")),
        (Page::Measured, tr("Measured")),
    ];
    let mut page = context.view.design.page;
    if tabs(ui, &mut page, &pages) {
        context.redesign(|design| design.page = page);
    }
}

/// What draws a part of a page.
type Draw = fn(&mut Context<'_>, &mut Ui);

/// A plot, with cards beside it where there is room, else below it. The plot alone when it is made large.
fn beside(context: &mut Context<'_>, ui: &mut Ui, panel: Panel, plot: Draw, cards: Draw) {
    let room = ui.available_size();
    let alone = context.view.enlarged == Some(panel);
    let wide = room.x >= BESIDE && !alone;
    let width = if wide { room.x - ASIDE - grid::GAP } else { room.x };
    let height = room.y.max(LEAST_HEIGHT);
    let draw_plot = |context: &mut Context<'_>, ui: &mut Ui| {
        grid::place(ui, width, height, &mut |ui| plot(context, ui));
    };
    if wide {
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = grid::GAP;
            draw_plot(context, ui);
            ui.vertical(|ui| {
                ui.spacing_mut().item_spacing.x = 8.0;
                ui.set_max_width(ASIDE);
                cards(context, ui);
            });
        });
    } else {
        draw_plot(context, ui);
        if !alone {
            ui.add_space(grid::GAP);
            cards(context, ui);
        }
    }
}
