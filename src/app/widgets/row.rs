//! Rows of choices and legends above plots.

use egui::{Context, Id, Ui, scroll_area::ScrollBarVisibility};

use super::touch;

/// Height of a card's contents below which a plot needs all of it, points.
const ROOMY: f32 = 280.0;

fn low() -> Id {
    Id::unique("the card is low")
}

/// Says how high the contents of the card are that is drawn now; nothing where they decide that.
pub(super) fn begin_card(context: &Context, height: Option<f32>) {
    context.data_mut(|data| data.insert_temp(low(), height.is_some_and(|height| height < ROOMY)));
}

/// Whether the card that is drawn now is too low for more than one row above its plot.
pub(super) fn is_low(context: &Context) -> bool {
    context.data(|data| data.get_temp(low())).unwrap_or(false)
}

/// A row that breaks where it is too narrow. Where the card is too low for rows of that kind it stays one, which can be
/// pushed aside.
pub fn row<R>(ui: &mut Ui, contents: impl FnOnce(&mut Ui) -> R) -> R {
    if !is_low(ui.ctx()) {
        return ui.horizontal_wrapped(contents).inner;
    }
    let area = touch::sideways(ui.ctx()).id_salt(ui.next_auto_id());
    area.scroll_bar_visibility(ScrollBarVisibility::AlwaysHidden)
        .show(ui, |ui| ui.horizontal(contents).inner)
        .inner
}
