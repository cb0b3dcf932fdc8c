//! The four linked plots, as many side by side as the page has room for.

use egui::{Ui, vec2};

use super::{
    Context, basins, chart, curves, evidence, live, multipliers, orbit_diagram, phase_portrait, poincare_map,
    response, spectrum, stability_map, time_history, verdict,
};
use crate::app::view::Panel;

/// Space between cards.
pub(super) const GAP: f32 = 10.0;
/// Least height of a plot's card, and where it stands alone in its row: its choices then take several rows.
pub(super) const LEAST_HEIGHT: f32 = 270.0;
pub(super) const LEAST_HEIGHT_ALONE: f32 = 350.0;
/// Width from which two cards stand side by side.
pub(super) const TWO_COLUMNS: f32 = 640.0;

/// The plots.
pub(in crate::app) const PANELS: [Panel; 4] =
    [Panel::StabilityMap, Panel::PhasePortrait, Panel::PoincareMap, Panel::TimeHistory];

/// Draws verdict and plots.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    verdict::show(context, ui);
    ui.add_space(GAP);
    cards(context, ui, &PANELS);
}

/// These panels side by side, or the one of them that fills the page.
pub(super) fn cards(context: &mut Context<'_>, ui: &mut Ui, panels: &[Panel]) {
    if let Some(panel) = context.view.enlarged.filter(|panel| panels.contains(panel)) {
        let height = ui.available_height().max(LEAST_HEIGHT_ALONE);
        place(ui, ui.available_width(), height, &mut |ui| draw(context, ui, panel));
        return;
    }
    grid(ui, panels, &mut |ui, panel| draw(context, ui, *panel));
}

/// Lays out cards of equal size in one or two columns that fill the page, or more when it is low.
pub(super) fn grid<T>(ui: &mut Ui, cards: &[T], draw: &mut dyn FnMut(&mut Ui, &T)) {
    let columns = if ui.available_width() >= TWO_COLUMNS { 2 } else { 1 };
    let rows = cards.len().div_ceil(columns);
    let width = ((ui.available_width() - GAP * (columns - 1) as f32) / columns as f32).floor();
    let least = if columns == 1 { LEAST_HEIGHT_ALONE } else { LEAST_HEIGHT };
    let height = ((ui.available_height() - GAP * (rows - 1) as f32) / rows as f32).floor().max(least);
    for (index, row) in cards.chunks(columns).enumerate() {
        if index > 0 {
            ui.add_space(GAP - ui.spacing().item_spacing.y);
        }
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing = vec2(GAP, 0.0);
            for card in row {
                place(ui, width, height, &mut |ui| draw(ui, card));
            }
        });
    }
}

/// A place of this size.
pub(super) fn place(ui: &mut Ui, width: f32, height: f32, draw: &mut dyn FnMut(&mut Ui)) {
    ui.allocate_ui(vec2(width, height), |ui| {
        ui.set_min_size(vec2(width, height));
        ui.set_max_size(vec2(width, height));
        draw(ui);
    });
}

/// One of the plots that stand in such grids.
pub(super) fn draw(context: &mut Context<'_>, ui: &mut Ui, panel: Panel) {
    match panel {
        Panel::StabilityMap => stability_map::show(context, ui),
        Panel::PhasePortrait => phase_portrait::show(context, ui),
        Panel::PoincareMap => poincare_map::show(context, ui),
        Panel::TimeHistory => time_history::show(context, ui),
        Panel::Chart => chart::show(context, ui),
        Panel::Multipliers => multipliers::show(context, ui),
        Panel::OrbitDiagram => orbit_diagram::show(context, ui),
        Panel::Response => response::show(context, ui),
        Panel::Curves => curves::show(context, ui),
        Panel::Spectrum => spectrum::show(context, ui),
        Panel::Evidence => evidence::show(context, ui),
        Panel::Basins => basins::show(context, ui),
        // These have pages of their own on the Design tab.
        Panel::Harvest | Panel::Load | Panel::MagnetForce | Panel::DesignMap | Panel::Measured => {}
        Panel::Oscilloscope => live::scope::show(context, ui),
        Panel::LivePortrait => live::portrait::show(context, ui),
        Panel::LiveBeam => live::beam::show(context, ui),
    }
}
