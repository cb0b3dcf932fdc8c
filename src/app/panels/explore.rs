//! The Explore tab: the verdict and the four linked plots.

use egui::Ui;

use super::grid::GAP;
use super::{Context, plots, verdict};

/// Draws verdict and plots.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    verdict::show(context, ui);
    ui.add_space(GAP);
    plots::cards(context, ui);
}
