//! Running text of the lessons, with what is between `**` in bold.

use egui::text::{LayoutJob, TextFormat};
use egui::{Color32, Label, Response, Ui};

use crate::app::{fonts, theme};

/// Space between lines of running text, as a multiple of its size.
const LEADING: f32 = 1.42;

/// A paragraph in `colour`; bold words are as strong as the theme has them.
pub(super) fn paragraph(ui: &mut Ui, text: &str, colour: Color32) -> Response {
    ui.add(Label::new(job(ui, text, colour)).wrap())
}

/// The same, not yet placed.
pub(super) fn job(ui: &Ui, text: &str, colour: Color32) -> LayoutJob {
    let tokens = theme::tokens(ui);
    let size = theme::size::BODY;
    let mut job = LayoutJob::default();
    for (index, part) in text.split("**").enumerate() {
        let bold = index % 2 == 1;
        let (font_id, color) =
            if bold { (fonts::semibold(size), tokens.text_strong) } else { (fonts::regular(size), colour) };
        let format = TextFormat { font_id, color, line_height: Some(LEADING * size), ..Default::default() };
        job.append(part, 0.0, format);
    }
    job
}
