//! A QR code: dark on white in either theme, as cameras want it, with its quiet zone.

use std::sync::Arc;

use egui::{Color32, Mesh, Rect, Response, Sense, Shape, Ui, Vec2, WidgetInfo, pos2, vec2};
use qrcodegen::{QrCode, QrCodeEcc};

/// White modules around the code, as its standard demands.
const QUIET: i32 = 4;

/// A text and its code, kept between frames; `None` for a text that is too long.
#[derive(Clone, Default)]
struct Memory {
    text: String,
    code: Option<Arc<QrCode>>,
}

/// Shows `text` as a QR code in a square of about this `side`, in points; a click is for the caller. `None` when the
/// text is too long for one.
pub fn qr_code(ui: &mut Ui, text: &str, side: f32, label: &str) -> Option<Response> {
    let id = egui::Id::unique("QR code");
    let mut memory: Memory = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    if memory.text != text {
        // The lowest redundancy has the largest modules: screens are clean, but seen from far.
        let code = QrCode::encode_text(text, QrCodeEcc::Low).ok().map(Arc::new);
        memory = Memory { text: text.to_owned(), code };
        ui.data_mut(|data| data.insert_temp(id, memory.clone()));
    }
    let code = memory.code?;
    let modules = code.size() + 2 * QUIET;
    // Whole pixels, or modules would be of different sizes.
    let pixels = ui.pixels_per_point();
    let module = (side * pixels / modules as f32).floor().max(1.0) / pixels;
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(module * modules as f32), Sense::click());
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, enabled, label));
    let corner = pos2((rect.left() * pixels).round() / pixels, (rect.top() * pixels).round() / pixels);
    ui.painter().rect_filled(Rect::from_min_size(corner, rect.size()), 0, Color32::WHITE);
    ui.painter().add(Shape::mesh(dark_modules(&code, corner, module)));
    Some(response)
}

/// The side of the code of a link, in modules, and its dark modules as column and row; `None` when it is too long.
pub fn qr_modules(text: &str) -> Option<(usize, Vec<(usize, usize)>)> {
    let code = QrCode::encode_text(text, QrCodeEcc::Low).ok()?;
    let side = code.size();
    let places = (0..side).flat_map(|row| (0..side).map(move |column| (column, row)));
    let dark = places.filter(|(column, row)| code.get_module(*column, *row));
    Some((side as usize, dark.map(|(column, row)| (column as usize, row as usize)).collect()))
}

/// The dark modules, one rectangle a run. A mesh has no smoothed edges, so that neighbours join.
fn dark_modules(code: &QrCode, corner: egui::Pos2, module: f32) -> Mesh {
    let mut mesh = Mesh::default();
    for y in 0..code.size() {
        let mut x = 0;
        while x < code.size() {
            let start = x;
            while code.get_module(x, y) {
                x += 1;
            }
            if x > start {
                let at = corner + vec2((start + QUIET) as f32, (y + QUIET) as f32) * module;
                let size = vec2((x - start) as f32, 1.0) * module;
                mesh.add_colored_rect(Rect::from_min_size(at, size), Color32::BLACK);
            }
            x += 1;
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::widgets::harness::Harness;

    #[test]
    fn a_link_has_a_code_and_a_book_has_none() {
        let mut harness = Harness::new(400.0, 400.0);
        harness.settle(|ui| {
            let response = qr_code(ui, "https://example.org/#v=1&alpha=1e-4", 200.0, "QR code");
            let side = response.map_or(0.0, |response| response.rect.width());
            assert!((160.0..=200.0).contains(&side), "{side}");
            assert!(qr_code(ui, &"x".repeat(4000), 200.0, "none").is_none());
        });
    }

    #[test]
    fn the_mesh_covers_exactly_the_dark_modules() {
        let code = QrCode::encode_text("https://example.org/#v=1", QrCodeEcc::Low).expect("short");
        let dark = (0..code.size()).flat_map(|y| (0..code.size()).map(move |x| (x, y)));
        let dark = dark.filter(|&(x, y)| code.get_module(x, y)).count();
        let mesh = dark_modules(&code, pos2(0.0, 0.0), 1.0);
        let area: f32 = mesh
            .vertices
            .chunks(4)
            .map(|four| (four[3].pos.x - four[0].pos.x) * (four[3].pos.y - four[0].pos.y))
            .sum();
        assert_eq!(area.round() as usize, dark);
    }
}
