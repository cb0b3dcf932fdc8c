//! The tab as a whole.

use egui::{Ui, vec2};

use super::controls;
use crate::app::panels::design::shaking;
use crate::app::panels::grid::{GAP, LEAST_HEIGHT, TWO_COLUMNS, place};
use crate::app::panels::spec::Place;
use crate::app::panels::{Context, list, plots, verdict};

/// Share of the height that the first panel takes.
const FIRST: f32 = 0.42;

/// Draws the tab: the first panel as wide as the page, the others below it, side by side.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    if context.view.shaken().is_some() {
        shaking::while_live(context, ui);
    } else {
        verdict::show(context, ui);
    }
    ui.add_space(GAP - ui.spacing().item_spacing.y);
    controls::show(context, ui);
    ui.add_space(GAP);
    let (panels, width) = (list::at(Place::of(context.view)), ui.available_width());
    let alone = plots::alone(context, &panels).is_some();
    // Where one of them stays on top there are none below.
    let beside = !alone && width >= TWO_COLUMNS && context.on_top.is_none();
    let Some((first, others)) = panels.split_first().filter(|_| beside) else {
        return plots::cards(context, ui);
    };
    let height = ui.available_height() - GAP;
    let top = (FIRST * height).floor().max(LEAST_HEIGHT - 30.0);
    place(ui, width, top, &mut |ui| plots::draw(context, ui, *first));
    ui.add_space(GAP - ui.spacing().item_spacing.y);
    let count = others.len().max(1) as f32;
    let (bottom, share) = ((height - top).max(LEAST_HEIGHT), ((width - GAP * (count - 1.0)) / count).floor());
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing = vec2(GAP, 0.0);
        for panel in others {
            place(ui, share, bottom, &mut |ui| plots::draw(context, ui, *panel));
        }
    });
}
