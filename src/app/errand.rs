//! What the app asks of the browser, which does it after the frame.
//!
//! `bridge/files.rs` carries errands out. Dropped files other than measured data (`sharing::is_measured_data`) are scenarios, or refused with a reason.

use super::text::Language;

/// What only the browser can do.
#[derive(Debug, Clone, PartialEq)]
pub enum Errand {
    /// Save a text as a file of this name and type.
    Save(String, &'static str, String),
    /// Make a picture of this drawing with so many times its pixels, and save it under this name.
    Picture(String, String, u8),
    /// Let these samples between -1 and 1 be heard after those before them; none ends the sound.
    Sound(Vec<f32>),
    /// Ask for a file, and pass it to [`super::App::open_file`].
    Open,
    /// Fill the screen with the page, or end that.
    FullScreen,
    /// Record a part of the picture, by its place in parts of the whole, for a file of this name without ending.
    Record(String, egui::Rect),
    /// End that, and save it.
    StopRecording,
    /// Fetch what this language needs, and pass it to [`super::App::learn`].
    Fetch(Language),
    /// Have the page's own markup in this language, with these texts by their English ones, as JSON.
    Speak(Language, String),
}
