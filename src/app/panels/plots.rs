//! The panels as cards, side by side or alone.

use egui::Ui;

use super::grid::{GAP, LEAST_HEIGHT_ALONE, grid, place};
use super::spec::Place;
use super::{Context, list, verdict};
use crate::app::command::Command;
use crate::app::text::tr;
use crate::app::view::{Panel, Tab};
use crate::app::widgets::{Card, Icon};

/// The verdict and the plots of the place in view.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    verdict::show(context, ui);
    ui.add_space(GAP);
    cards(context, ui);
}

/// The panels of the place in view side by side, or the one of them that fills the page.
pub(super) fn cards(context: &mut Context<'_>, ui: &mut Ui) {
    let panels = list::at(Place::of(context.view));
    if let Some(panel) = alone(context, &panels) {
        let height = ui.available_height().max(LEAST_HEIGHT_ALONE);
        place(ui, ui.available_width(), height, &mut |ui| draw(context, ui, panel));
        return;
    }
    grid(ui, &panels, &mut |ui, panel| draw(context, ui, *panel));
}

/// The panels of the place in view below each other, each at least `least` high, or the one of them that is made large.
pub(super) fn column(context: &mut Context<'_>, ui: &mut Ui, [width, height]: [f32; 2], least: f32) {
    let panels = list::at(Place::of(context.view));
    let panels = alone(context, &panels).map_or(panels, |panel| vec![panel]);
    let count = panels.len().max(1) as f32;
    let height = ((height - GAP * (count - 1.0)) / count).max(least);
    for (index, panel) in panels.into_iter().enumerate() {
        if index > 0 {
            ui.add_space(GAP);
        }
        place(ui, width, height, &mut |ui| draw(context, ui, panel));
    }
}

/// The one of these panels that is made large.
pub(super) fn alone(context: &Context<'_>, panels: &[Panel]) -> Option<Panel> {
    context.view.enlarged.filter(|panel| panels.contains(panel))
}

/// The card of a panel; a press of one of its buttons is carried out.
pub(super) fn draw(context: &mut Context<'_>, ui: &mut Ui, panel: Panel) {
    let spec = list::spec(panel);
    let large = context.view.enlarged == Some(panel);
    let (icon, label) =
        if large { (Icon::Shrink, tr("Show all plots")) } else { (Icon::Enlarge, tr("Enlarge")) };
    let (title, hint) = ((spec.title)(context.view), (spec.hint)(context));
    let card = Card::new(title).hint(&hint);
    let card = if spec.exports { card.exports() } else { card };
    let shown = card.button(icon, label).show(ui, |ui| {
        if context.is_stale() && context.view.tab != Tab::Live {
            ui.multiply_opacity(0.55);
        }
        (spec.contents)(context, ui);
    });
    context.export(title, shown.export);
    if shown.pressed.is_some() {
        context.commands.push(Command::Enlarge((!large).then_some(panel)));
    }
}
