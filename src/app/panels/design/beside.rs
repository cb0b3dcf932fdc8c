//! The plots of a page and the cards about them.

use egui::Ui;

use crate::app::panels::spec::Place;
use crate::app::panels::{Context, grid, list, plots};

/// Width from which a page has a column beside its plot, that column's width, and least height of a plot's card.
const BESIDE: f32 = 860.0;
const ASIDE: f32 = 340.0;
pub(super) const LEAST_HEIGHT: f32 = 400.0;

/// The page's plots, with cards beside them where there is room, else below them. A plot alone when it is made large.
pub(super) fn beside(context: &mut Context<'_>, ui: &mut Ui, cards: fn(&mut Context<'_>, &mut Ui)) {
    let room = ui.available_size();
    let alone = plots::alone(context, &list::at(Place::of(context.view))).is_some();
    let wide = room.x >= BESIDE && !alone;
    let width = if wide { room.x - ASIDE - grid::GAP } else { room.x };
    if wide {
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = grid::GAP;
            ui.vertical(|ui| plots::column(context, ui, [width, room.y], LEAST_HEIGHT));
            ui.vertical(|ui| {
                ui.spacing_mut().item_spacing.x = 8.0;
                ui.set_max_width(ASIDE);
                cards(context, ui);
            });
        });
    } else {
        plots::column(context, ui, [width, room.y], LEAST_HEIGHT);
        if !alone {
            ui.add_space(grid::GAP);
            cards(context, ui);
        }
    }
}
