//! Pictures made of cells, drawn under the curves of a plot; remade only when their data change.

use egui::{Color32, ColorImage, Id, TextureHandle, TextureOptions, Ui, pos2};
use egui_plot::{PlotImage, PlotPoint, PlotUi};

use super::recorder;

/// A picture and what it was made from.
#[derive(Clone)]
struct Kept {
    revision: u64,
    texture: TextureHandle,
}

/// The picture of `columns` x `rows` cells kept under `id`, made anew by `paint(column, row)`, rows counted from the
/// bottom, when `revision` is another one than the last. Where `paint` gives `None` everywhere the last picture stays.
pub fn raster(
    ui: &Ui,
    id: Id,
    revision: u64,
    (columns, rows): (usize, usize),
    paint: &dyn Fn(usize, usize) -> Option<Color32>,
) -> Option<TextureHandle> {
    let recording = recorder::is_on(ui.ctx());
    // What is kept belongs to the page, and may be in the colours of another theme.
    let kept: Option<Kept> = if recording { None } else { ui.data(|data| data.get_temp(id)) };
    if let Some(kept) = kept.as_ref().filter(|kept| kept.revision == revision) {
        return Some(kept.texture.clone());
    }
    let cells = (0..rows).rev().flat_map(|row| (0..columns).map(move |column| (column, row)));
    let mut empty = true;
    let pixels: Vec<Color32> = cells
        .map(|(column, row)| {
            let colour = paint(column, row);
            empty &= colour.is_none();
            colour.unwrap_or(Color32::TRANSPARENT)
        })
        .collect();
    if empty && kept.is_some() {
        return kept.map(|kept| kept.texture);
    }
    let recorded = recording.then(|| pixels.clone());
    let image = ColorImage::new([columns, rows], pixels);
    let texture = match kept {
        Some(Kept { mut texture, .. }) => {
            texture.set(image, TextureOptions::NEAREST);
            texture
        }
        None => ui.ctx().load_texture(format!("{id:?}"), image, TextureOptions::NEAREST),
    };
    if let Some(pixels) = recorded {
        recorder::picture(ui.ctx(), texture.id(), [columns, rows], &pixels);
        return Some(texture);
    }
    ui.data_mut(|data| data.insert_temp(id, Kept { revision, texture: texture.clone() }));
    Some(texture)
}

/// How opaque a picture is that is the last one until the newest is `known`: it fades slowly, so that one which follows the
/// hand does not flicker.
pub fn fading(ui: &Ui, id: Id, known: bool) -> f32 {
    const FADED: f32 = 0.4;
    const SECONDS: f32 = 1.0;
    FADED + (1.0 - FADED) * ui.ctx().animate_bool_with_time(id.with("fading"), known, SECONDS)
}

/// Draws a picture whose outer cells have their middles at the ends of the ranges `x` and `y`; a cell is a pixel.
pub fn draw_raster(
    plot: &mut PlotUi<'_>,
    picture: &TextureHandle,
    x: (f64, f64),
    y: (f64, f64),
    opacity: f32,
) {
    let [columns, rows] = picture.size();
    draw_cells(plot, picture, (columns, rows), x, y, opacity);
}

/// The same with so many cells across and up, each of several pixels.
pub fn draw_cells(
    plot: &mut PlotUi<'_>,
    picture: &TextureHandle,
    (columns, rows): (usize, usize),
    x: (f64, f64),
    y: (f64, f64),
    opacity: f32,
) {
    let width = (x.1 - x.0) * columns as f64 / (columns as f64 - 1.0).max(1.0);
    let height = (y.1 - y.0) * rows as f64 / (rows as f64 - 1.0).max(1.0);
    let middle = PlotPoint::new(0.5 * (x.0 + x.1), 0.5 * (y.0 + y.1));
    let across = (middle.x - 0.5 * width, middle.x + 0.5 * width);
    let up = (middle.y - 0.5 * height, middle.y + 0.5 * height);
    recorder::draw_picture(plot, picture.id(), [across, up], opacity);
    let image = PlotImage::new("", picture.id(), middle, [width as f32, height as f32])
        .uv(egui::Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0)))
        .tint(Color32::WHITE.gamma_multiply(opacity));
    plot.image(image.allow_hover(false));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::widgets::harness::Harness;
    use std::cell::Cell;

    #[test]
    fn a_picture_is_remade_only_when_its_data_change() {
        let mut harness = Harness::new(100.0, 100.0);
        let made = Cell::new(0);
        let draw = |ui: &Ui, revision: u64, known: bool| {
            let paint = |_: usize, _: usize| {
                made.set(made.get() + 1);
                known.then_some(Color32::RED)
            };
            raster(ui, Id::unique("picture"), revision, (3, 2), &paint).map(|texture| texture.size())
        };
        harness.settle(|ui| {
            made.set(0);
            assert_eq!(draw(ui, 1, true), Some([3, 2]));
            assert_eq!(draw(ui, 1, true), Some([3, 2]));
            let first = made.get();
            assert!(first == 6 || first == 0, "{first}");
            draw(ui, 2, false);
            assert_eq!(made.get(), first + 6);
            draw(ui, 1, true);
        });
    }
}
