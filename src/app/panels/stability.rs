//! The Stability tab: where the forced motion is stable, how it stops being so, and what else there is.

use egui::Ui;

use super::{Context, grid, plots, verdict};
use crate::app::view::Panel;

/// The plots.
pub(in crate::app) const PANELS: [Panel; 6] =
    [Panel::Chart, Panel::Multipliers, Panel::Curves, Panel::Basins, Panel::Spectrum, Panel::Evidence];

/// Draws the tab.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    verdict::show(context, ui);
    ui.add_space(grid::GAP);
    plots::cards(context, ui, &PANELS);
}
