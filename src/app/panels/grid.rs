//! Where cards stand: beside and below each other, with the same space between them on every tab.

use egui::{Ui, vec2};

/// Space between cards.
pub(super) const GAP: f32 = 10.0;
/// Least height of a plot's card, and where it stands alone in its row: its choices then take several rows.
pub(super) const LEAST_HEIGHT: f32 = 270.0;
pub(super) const LEAST_HEIGHT_ALONE: f32 = 420.0;
/// Height a card has, more or less, where there are more rows than fit the page.
const USUAL_HEIGHT: f32 = 330.0;
/// Where whole rows would be lower than this, the page scrolls anyway and its cards are as high as suits them: rows of choices and
/// legends leave the plots too little.
const LOW: f32 = 340.0;
const HIGH: f32 = 400.0;
/// What is seen of the row that begins below the page: its titles, so that one knows of it.
const PEEK: f32 = 36.0;
/// Width from which two cards stand side by side.
pub(super) const TWO_COLUMNS: f32 = 640.0;

/// Lays out cards of equal size in one or two columns: whole rows fill the page, the others are further down.
pub(super) fn grid<T>(ui: &mut Ui, cards: &[T], draw: &mut dyn FnMut(&mut Ui, &T)) {
    let columns = if ui.available_width() >= TWO_COLUMNS { 2 } else { 1 };
    let rows = cards.len().div_ceil(columns);
    let width = ((ui.available_width() - GAP * (columns - 1) as f32) / columns as f32).floor();
    let height = row_height(ui.available_height(), rows, columns);
    for (index, row) in cards.chunks(columns).enumerate() {
        if index > 0 {
            ui.add_space(GAP - ui.spacing().item_spacing.y);
        }
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing = vec2(GAP, 0.0);
            for card in row {
                place(ui, width, height, &mut |ui| draw(ui, card));
            }
        });
    }
}

/// Height of a row of cards, of which as many as are high enough to be read share the `room` of the page.
fn row_height(room: f32, rows: usize, columns: usize) -> f32 {
    let least = if columns == 1 { LEAST_HEIGHT_ALONE } else { LEAST_HEIGHT };
    let in_sight = (room / USUAL_HEIGHT).round().clamp(1.0, rows as f32);
    let scrolls = in_sight < rows as f32;
    let hidden = if scrolls { GAP + PEEK } else { 0.0 };
    let height = ((room - hidden - GAP * (in_sight - 1.0)) / in_sight).floor();
    if scrolls && columns > 1 && height < LOW { HIGH } else { height.max(least) }
}

/// A place of this size.
pub(super) fn place(ui: &mut Ui, width: f32, height: f32, draw: &mut dyn FnMut(&mut Ui)) {
    ui.allocate_ui(vec2(width, height), |ui| {
        ui.set_min_size(vec2(width, height));
        ui.set_max_size(vec2(width, height));
        draw(ui);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_fill_the_page_or_show_that_there_are_more() {
        // Two rows share the page, however low it is, down to a height that can be read.
        assert_eq!(row_height(750.0, 2, 2), 370.0);
        assert_eq!(row_height(560.0, 2, 2), 275.0);
        assert_eq!(row_height(300.0, 2, 2), HIGH);
        // On a low laptop whole rows would leave plots of 120 points under their legends.
        assert_eq!(row_height(640.0, 3, 2), HIGH);
        // Of three rows two are seen on a laptop, with the titles of the third; all on a projector.
        let height = row_height(750.0, 3, 2);
        assert_eq!(750.0 - 2.0 * (height + GAP), PEEK);
        assert_eq!(row_height(930.0, 3, 2), 303.0);
        assert_eq!(row_height(600.0, 6, 1), LEAST_HEIGHT_ALONE);
    }
}
