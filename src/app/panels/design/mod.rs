//! The Design tab: what a device delivers in volts, watts and hertz, within which limits, and what would be better.

pub(super) mod alignment;
mod answer;
pub(super) mod bands;
mod beside;
mod best_load;
pub(super) mod columns;
pub(super) mod fitting;
pub(super) mod going;
mod held;
mod known;
mod limits;
mod materials;
pub(super) mod measure;
pub(super) mod optimum;
pub(in crate::app) mod safety;
pub(super) mod search;
pub(super) mod shaken_by;
pub(in crate::app) mod shaking;
mod store;
mod summary;
#[cfg(test)]
mod tests;
mod tolerances;
mod trust;
pub(in crate::app) mod variants;

use egui::Ui;

use self::beside::beside;
use super::{Context, grid, measured, plots};
use crate::app::bench::questions;
use crate::app::crew::Studies;
use crate::app::text::tr;
use crate::app::view::View;
use crate::app::view::design::Page;
use crate::app::widgets::tabs;

/// Draws the tab.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    choose(context, ui);
    ui.add_space(4.0);
    // It is about the sine.
    if context.view.design.page != Page::Shake {
        summary::show(context, ui);
        ui.add_space(grid::GAP);
    }
    match context.view.design.page {
        Page::Harvest => beside(context, ui, bands::show),
        Page::Load => beside(context, ui, best_load::cards),
        Page::Materials => materials::show(context, ui),
        Page::Trust => trust::show(context, ui),
        Page::Search => beside(context, ui, search::cards),
        Page::Tolerances => beside(context, ui, tolerances::cards),
        Page::Measured => beside(context, ui, measured::cards),
        Page::Variants => variants::show(context, ui),
        Page::Shake => {
            shaking::show(context, ui);
            ui.add_space(grid::GAP);
            plots::cards(context, ui);
        }
    }
}

/// Asks for what the tab shows beside its panels.
pub(in crate::app) fn ask(studies: &mut Studies, view: &View) {
    studies.deliver(&view.scenario);
    match view.design.page {
        Page::Harvest | Page::Variants => studies.load(view),
        Page::Materials => studies.tabulate(questions::materials(view)),
        Page::Trust => studies.tabulate(questions::trust(view)),
        Page::Load | Page::Search | Page::Tolerances | Page::Measured | Page::Shake => {}
    }
}

fn choose(context: &mut Context<'_>, ui: &mut Ui) {
    let pages = [
        (Page::Harvest, tr("Harvest")),
        (Page::Load, tr("Load")),
        (Page::Materials, tr("Materials")),
        (Page::Trust, tr("Trust")),
        (Page::Search, tr("Search")),
        (Page::Tolerances, tr("Tolerances")),
        (Page::Measured, tr("Measured")),
        (Page::Shake, tr("Shake")),
        (Page::Variants, tr("Variants")),
    ];
    let mut page = context.view.design.page;
    if tabs(ui, &mut page, &pages) {
        context.redesign(|design| design.page = page);
    }
}
