//! The Stability tab: where the forced motion is stable, how it stops being so, and what else there is.

use egui::Ui;

use super::{Context, grid, plots, verdict};

/// Draws the tab.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    verdict::show(context, ui);
    ui.add_space(grid::GAP);
    plots::cards(context, ui);
}
