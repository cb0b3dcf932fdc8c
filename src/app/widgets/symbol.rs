//! Symbols with an index.

use egui::text::{LayoutJob, TextFormat};
use egui::{Align, Color32};

use crate::app::{fonts, theme};

/// Size of an index over that of its symbol.
const INDEX: f32 = 0.72;

/// A symbol on one line, what follows an underscore lowered.
pub fn symbol(text: &str, color: Color32) -> LayoutJob {
    let (base, index) = text.split_once('_').unwrap_or((text, ""));
    let mut job = LayoutJob::default();
    for (part, size) in [(base, 1.0), (index, INDEX)] {
        let font_id = fonts::regular(size * theme::size::BODY);
        job.append(part, 0.0, TextFormat { font_id, color, valign: Align::BOTTOM, ..Default::default() });
    }
    job
}
