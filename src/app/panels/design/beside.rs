//! A plot and the cards about it.

use egui::Ui;

use crate::app::panels::{Context, grid};
use crate::app::view::Panel;

/// Width from which a page has a column beside its plot, that column's width, and least height of a plot's card.
const BESIDE: f32 = 860.0;
const ASIDE: f32 = 340.0;
pub(super) const LEAST_HEIGHT: f32 = 400.0;

/// What draws a part of a page.
type Draw = fn(&mut Context<'_>, &mut Ui);

/// A plot, with cards beside it where there is room, else below it. The plot alone when it is made large.
pub(super) fn beside(context: &mut Context<'_>, ui: &mut Ui, panel: Panel, plot: Draw, cards: Draw) {
    let room = ui.available_size();
    let alone = context.view.enlarged == Some(panel);
    let wide = room.x >= BESIDE && !alone;
    let width = if wide { room.x - ASIDE - grid::GAP } else { room.x };
    let height = room.y.max(LEAST_HEIGHT);
    let draw_plot = |context: &mut Context<'_>, ui: &mut Ui| {
        grid::place(ui, width, height, &mut |ui| plot(context, ui));
    };
    if wide {
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = grid::GAP;
            draw_plot(context, ui);
            ui.vertical(|ui| {
                ui.spacing_mut().item_spacing.x = 8.0;
                ui.set_max_width(ASIDE);
                cards(context, ui);
            });
        });
    } else {
        draw_plot(context, ui);
        if !alone {
            ui.add_space(grid::GAP);
            cards(context, ui);
        }
    }
}
