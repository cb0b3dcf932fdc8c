//! The Design tab: what a device delivers in volts, watts and hertz, within which limits, and what would be better.

mod alignment;
mod bands;
mod beside;
mod best_load;
mod force;
mod going;
pub(super) mod harvest;
mod held;
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

use self::beside::beside;
use super::{Context, grid};
use crate::app::text::tr;
use crate::app::view::Panel;
use crate::app::view::design::Page;
use crate::app::widgets::tabs;

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
