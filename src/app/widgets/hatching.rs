//! Pictures some of whose cells are hatched: those beyond a limit.

use std::cell::OnceCell;

use egui::{Color32, Id, TextureHandle, Ui};
use egui_plot::PlotUi;

use super::raster::{draw_cells, raster};
use crate::app::theme::{self, Tokens};

/// Points of the screen from line to line of the hatching, and most that a cell is drawn with on a side.
const PERIOD: usize = 12;
const MOST: usize = 40;
/// Most pixels of a picture, roughly: it is painted anew whenever some of its cells become known.
const PIXELS: f32 = 250_000.0;

/// A picture whose cells are about as many pixels wide and high as they are points on the screen, so that lines in it
/// are seen as lines whatever the number of cells.
pub struct Hatched {
    texture: TextureHandle,
    size: (usize, usize),
}

impl Hatched {
    /// Draws it with the middles of its outer cells at the ends of the ranges `x` and `y`.
    pub fn draw(&self, plot: &mut PlotUi<'_>, x: (f64, f64), y: (f64, f64), opacity: f32) {
        draw_cells(plot, &self.texture, self.size, x, y, opacity);
    }
}

/// As [`raster`], where `paint` says of each cell its colour and whether it is hatched.
pub fn hatched(
    ui: &Ui,
    id: Id,
    revision: u64,
    size: (usize, usize),
    paint: &dyn Fn(usize, usize) -> Option<(Color32, bool)>,
) -> Option<Hatched> {
    let (columns, rows) = size;
    let room = ui.available_size();
    let room = room * (PIXELS / (room.x * room.y).max(1.0)).sqrt().min(1.0);
    let side = |points: f32, count: usize| ((points / count.max(1) as f32).round() as usize).clamp(1, MOST);
    let sides = [side(room.x, columns), side(room.y, rows)];
    let tokens = theme::tokens(ui);
    let cells = OnceCell::new();
    let cell = |x: usize, y: usize| -> Option<(Color32, bool)> {
        let painted =
            || (0..rows).flat_map(|row| (0..columns).map(move |column| paint(column, row))).collect();
        let known: &Vec<_> = cells.get_or_init(painted);
        let (column, row) = (x / sides[0], y / sides[1]);
        if column < columns && row < rows {
            known.get(row * columns + column).copied().flatten()
        } else {
            None
        }
    };
    let pixel = |x: usize, y: usize| -> Option<Color32> {
        let (colour, hatched) = cell(x, y)?;
        if !hatched {
            return Some(colour);
        }
        let beside = [(x.wrapping_sub(1), y), (x + 1, y), (x, y.wrapping_sub(1)), (x, y + 1)];
        let free = |(x, y): (usize, usize)| cell(x, y).is_some_and(|(_, hatched)| !hatched);
        let border = beside.into_iter().any(free).then_some(tokens.danger);
        Some(border.or_else(|| line(x + y, tokens)).unwrap_or(colour))
    };
    let [width, height] = [sides[0] * columns, sides[1] * rows];
    let sized = revision ^ ((sides[0] * MOST + sides[1]) as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let texture = raster(ui, id, sized, (width, height), &pixel)?;
    Some(Hatched { texture, size })
}

/// The colour of the hatching at a place across its lines, if there is one: lines with an edge, so that they are seen
/// on every ground.
pub fn line(across: usize, tokens: &Tokens) -> Option<Color32> {
    match across % PERIOD {
        1 | 2 => Some(tokens.danger),
        0 | 3 => Some(tokens.card),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::widgets::harness::Harness;

    #[test]
    fn hatching_has_the_same_lines_however_many_cells_there_are() {
        for count in [3, 60, 500] {
            let mut harness = Harness::new(1600.0, 900.0);
            harness.settle(|ui| {
                let half = |column: usize, _: usize| Some((Color32::BLUE, column >= count / 2));
                let picture = hatched(ui, Id::unique("half"), 1, (count, count), &half).expect("a picture");
                let [width, height] = picture.texture.size();
                assert!(width % count == 0 && height % count == 0 && width.max(height) <= 1700.max(count));
                assert!(width * height <= 2 * PIXELS as usize, "{width} x {height}");
            });
        }
        let tokens = theme::tokens_in(&egui::Context::default());
        let lines = (0..2 * PERIOD).filter(|across| line(*across, tokens) == Some(tokens.danger)).count();
        assert_eq!(lines, 4);
    }
}
