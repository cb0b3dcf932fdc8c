//! The tab as a whole.

use egui::{Ui, vec2};

use super::{beam, controls, portrait, scope};
use crate::app::panels::grid::{GAP, LEAST_HEIGHT, TWO_COLUMNS, place};
use crate::app::panels::{Context, plots};
use crate::app::view::Panel;

/// Share of the height that the oscilloscope takes.
const SCOPE: f32 = 0.42;

/// The cards, widest first.
pub(in crate::app) const PANELS: [Panel; 3] = [Panel::Oscilloscope, Panel::LivePortrait, Panel::LiveBeam];

/// Draws the tab.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    controls::show(context, ui);
    ui.add_space(GAP);
    let width = ui.available_width();
    if context.view.enlarged.is_some_and(|panel| PANELS.contains(&panel)) || width < TWO_COLUMNS {
        return plots::cards(context, ui, &PANELS);
    }
    let height = ui.available_height() - GAP;
    let top = (SCOPE * height).floor().max(LEAST_HEIGHT - 30.0);
    place(ui, width, top, &mut |ui| scope::show(context, ui));
    ui.add_space(GAP - ui.spacing().item_spacing.y);
    let (bottom, half) = ((height - top).max(LEAST_HEIGHT), (0.5 * (width - GAP)).floor());
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing = vec2(GAP, 0.0);
        place(ui, half, bottom, &mut |ui| portrait::show(context, ui));
        place(ui, half, bottom, &mut |ui| beam::show(context, ui));
    });
}
