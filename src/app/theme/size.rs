//! Text sizes in points, at zoom 1. A projector view multiplies them through the zoom factor of the context.

/// Plain text, numbers and buttons.
pub const BODY: f32 = 13.5;
/// Hints, legends, tick labels.
pub const SMALL: f32 = 11.5;
/// Titles of cards and tabs.
pub const TITLE: f32 = 14.0;
/// The verdict's first word, dialogue titles.
pub const HEADING: f32 = 18.0;
