//! The Floquet multipliers and the unit circle.

use egui::Ui;

use super::Context;
use crate::app::view::Panel;

/// Draws the card.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    context.plot_card(ui, Panel::Multipliers, "Floquet multipliers", "", |_, _| ());
}
