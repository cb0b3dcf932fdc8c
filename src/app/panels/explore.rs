//! The Explore tab: the verdict and the four linked plots.

use egui::Ui;

use super::grid::GAP;
use super::{Context, plots, verdict};
use crate::app::view::Panel;

/// The plots.
pub(in crate::app) const PANELS: [Panel; 4] =
    [Panel::StabilityMap, Panel::PhasePortrait, Panel::PoincareMap, Panel::TimeHistory];

/// Draws verdict and plots.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    verdict::show(context, ui);
    ui.add_space(GAP);
    plots::cards(context, ui, &PANELS);
}
