//! The plots that stand side by side on a tab, each drawn by the panel of its name.

use egui::Ui;

use super::grid::{LEAST_HEIGHT_ALONE, grid, place};
use super::{
    Context, basins, chart, curves, evidence, live, multipliers, orbit_diagram, phase_portrait, poincare_map,
    response, spectrum, stability_map, time_history,
};
use crate::app::view::Panel;

/// These panels side by side, or the one of them that fills the page.
pub(super) fn cards(context: &mut Context<'_>, ui: &mut Ui, panels: &[Panel]) {
    if let Some(panel) = context.view.enlarged.filter(|panel| panels.contains(panel)) {
        let height = ui.available_height().max(LEAST_HEIGHT_ALONE);
        place(ui, ui.available_width(), height, &mut |ui| draw(context, ui, panel));
        return;
    }
    grid(ui, panels, &mut |ui, panel| draw(context, ui, *panel));
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
