//! What a word means, told where the pointer rests on it or a finger taps it.

use egui::{Frame, Popup, Response, RichText, Ui};

use crate::app::text::terms::{self, Term};
use crate::app::text::tr;
use crate::app::{fonts, theme};

/// Width of what is told, points, and most words of a longer text that are explained.
const WIDTH: f32 = 330.0;
const MOST: usize = 4;

/// Explains `text`, where it is a word that has a meaning.
pub fn explained(response: Response, text: &str) -> Response {
    told(response, || terms::meaning(text).map(|term| (String::new(), term)).into_iter().collect())
}

/// Explains the words in `text`.
pub fn words_explained(response: Response, text: &str) -> Response {
    told(response, || {
        terms::within(text, MOST).into_iter().map(|(word, term)| (word.to_owned(), term)).collect()
    })
}

fn told(response: Response, find: impl FnOnce() -> Vec<(String, &'static Term)>) -> Response {
    let open = Popup::is_id_open(&response.ctx, Popup::default_response_id(&response));
    if !open && !response.hovered() && !response.clicked() {
        return response;
    }
    let found = find();
    if found.is_empty() {
        return response;
    }
    Popup::from_toggle_button_response(&response).show(|ui| show(ui, &found));
    response.on_hover_ui(|ui| show(ui, &found))
}

fn show(ui: &mut Ui, found: &[(String, &'static Term)]) {
    ui.set_max_width(WIDTH.min(ui.ctx().content_rect().width() - 40.0));
    for (word, term) in found {
        meaning(ui, word, term);
    }
}

/// One meaning, under its word if there is more than one.
pub fn meaning(ui: &mut Ui, word: &str, term: &Term) {
    let tokens = theme::tokens(ui);
    if !word.is_empty() {
        ui.label(RichText::new(word).font(fonts::semibold(theme::size::BODY)).color(tokens.text_strong));
    }
    ui.add(egui::Label::new(tr(term.sentence)).wrap());
    if !term.equation.is_empty() {
        Frame::new().fill(tokens.inset).corner_radius(theme::radius::CONTROL).inner_margin(8).show(
            ui,
            |ui| {
                for line in term.equation.split('\n') {
                    let text =
                        RichText::new(line).font(fonts::regular(theme::size::BODY)).color(tokens.text_strong);
                    ui.add(egui::Label::new(text).wrap());
                }
            },
        );
    }
}
