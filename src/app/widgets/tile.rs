//! A number large enough to be read from the back row, with its name and its unit.

use egui::{Align2, Color32, Response, Sense, Ui, WidgetInfo, pos2, vec2};

use crate::app::{fonts, theme};

/// Height of a tile, and size of its number, points.
const HEIGHT: f32 = 62.0;
const NUMBER: f32 = 23.0;

/// A tile.
pub struct Tile<'a> {
    /// Name of the quantity.
    pub name: &'a str,
    /// The number, or a word.
    pub value: &'a str,
    /// Its unit; may be empty.
    pub unit: &'a str,
    /// A quiet line below; may be empty.
    pub detail: &'a str,
    /// Colour of the number; that of titles when absent.
    pub colour: Option<Color32>,
}

impl Tile<'_> {
    /// Draws it over `width` points; a number that does not fit is made smaller, a detail is cut.
    pub fn show(&self, ui: &mut Ui, width: f32) -> Response {
        let tokens = theme::tokens(ui);
        let (rect, response) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::hover());
        let enabled = ui.is_enabled();
        let said = format!("{}: {} {}", self.name, self.value, self.unit);
        response.widget_info(|| WidgetInfo::labeled(egui::Role::Label, enabled, said.trim_end()));
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        let small = fonts::regular(theme::size::SMALL);
        painter.text(rect.left_top(), Align2::LEFT_TOP, self.name, small.clone(), tokens.text_weak);
        let unit =
            painter.layout_no_wrap(self.unit.to_owned(), fonts::regular(theme::size::BODY), tokens.text_weak);
        let room = (width - unit.size().x - 6.0).max(20.0);
        let colour = self.colour.unwrap_or(tokens.text_strong);
        let at_size = |size| painter.layout_no_wrap(self.value.to_owned(), fonts::semibold(size), colour);
        let mut number = at_size(NUMBER);
        if number.size().x > room {
            number = at_size((NUMBER * room / number.size().x).max(theme::size::BODY));
        }
        let baseline = rect.top() + 43.0;
        let end = rect.left() + number.size().x + 4.0;
        painter.galley(pos2(rect.left(), baseline - number.size().y), number, colour);
        painter.galley(pos2(end, baseline - 3.0 - unit.size().y), unit, tokens.text_weak);
        let mut job =
            egui::text::LayoutJob::simple_singleline(self.detail.to_owned(), small, tokens.text_weak);
        job.wrap = egui::text::TextWrapping::truncate_at_width(width);
        let detail = painter.layout_job(job);
        painter.galley(pos2(rect.left(), rect.bottom() - detail.size().y), detail, tokens.text_weak);
        if self.detail.is_empty() { response } else { response.on_hover_text(self.detail) }
    }
}

/// Tiles in as many columns of equal width as there is room for, `least` points each.
pub fn tiles(ui: &mut Ui, tiles: &[Tile<'_>], least: f32) {
    const GAP: f32 = 14.0;
    let room = ui.available_width();
    let most = (((room + GAP) / (least + GAP)) as usize).clamp(1, tiles.len().max(1));
    let columns = tiles.len().div_ceil(tiles.len().div_ceil(most).max(1)).max(1);
    let width = (room - GAP * (columns - 1) as f32) / columns as f32;
    for row in tiles.chunks(columns) {
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = GAP;
            for tile in row {
                tile.show(ui, width);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::widgets::harness::Harness;

    #[test]
    fn tiles_fill_narrow_and_wide_rows_without_overlap() {
        for width in [360.0, 1400.0] {
            let mut harness = Harness::new(width, 400.0);
            let names = ["Voltage", "Power", "Power per g²", "Tip", "Efficiency", "Limits"];
            harness.settle(|ui| {
                let all = names.map(|name| Tile {
                    name,
                    value: "123.45",
                    unit: "µW/g²",
                    detail: "a",
                    colour: None,
                });
                tiles(ui, &all, 104.0);
            });
            let found = names.map(|name| harness.find(egui::Role::Label, &format!("{name}:")).bounds);
            for (i, a) in found.iter().enumerate() {
                assert!(a.right() <= width, "{a:?}");
                assert!(found[i + 1..].iter().all(|b| !a.shrink(1.0).intersects(*b)));
            }
        }
    }
}
