//! What is known of the language that the page speaks.

use std::sync::Arc;

use egui::epaint::text::FontData;

use super::link::Problem;
use super::text::Language;

/// What is known of languages beside the view.
#[derive(Default)]
pub(super) struct Speech {
    /// The browser's.
    pub preferred: Language,
    /// The one asked for last.
    pub asked: Option<Language>,
    /// The Chinese font, once it was needed.
    pub ideographs: Option<Arc<FontData>>,
    /// What could not be used of the last link, to be told anew in another language.
    pub misread: Vec<Problem>,
}
