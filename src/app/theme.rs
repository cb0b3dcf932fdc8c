//! Colours, text sizes and spacing: the only place of the app where a colour is written down.
//!
//! Plot colours descend from the Okabe-Ito palette, which stays distinct under the common colour-vision
//! deficiencies; each theme tunes their lightness to its background. Curves differ in line style as well.

mod palette;
pub mod radius;
pub mod size;
mod style;

pub use palette::{BLACK, DARK, LIGHT, Tokens, WHITE};

/// Puts the look on `context`: fonts' sizes, spacing and colours.
pub fn apply(context: &egui::Context, tokens: &Tokens) {
    let theme = if tokens.dark { egui::Theme::Dark } else { egui::Theme::Light };
    context.set_theme(theme);
    context.set_style_of(theme, style::style(tokens));
}

/// The design tokens in force in `ui`.
pub fn tokens(ui: &egui::Ui) -> &'static Tokens {
    Tokens::in_force(ui.visuals())
}

/// The design tokens in force in `context`.
pub fn tokens_in(context: &egui::Context) -> &'static Tokens {
    Tokens::in_force(&context.global_style().visuals)
}

/// Zoom factor that makes the page legible from the back row of a lecture hall.
pub const PROJECTOR_ZOOM: f32 = 1.4;
