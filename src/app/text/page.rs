//! Texts that stand in the page's own markup and scripts (`index.html`, `assets/shell`), which the app has no part in but
//! for their language.

use std::collections::BTreeMap;

use super::{fill, marked, tr};
use crate::model::ForceLaw;
use crate::sentence::Say;

/// The texts as they stand there, without blanks at their ends.
pub const TEXTS: [&str; 37] = [
    marked("Go to text controls"),
    marked("Harvester Lab: sliders and plots"),
    marked(
        "Tab moves within the picture. Escape and then Tab leads on to text controls of the same, with the result in words.",
    ),
    marked("Harvester Lab: text controls"),
    marked("Damping α"),
    marked("Excitation β"),
    marked("Frequency ω"),
    marked("Modes"),
    marked("Force law"),
    marked("quadratic"),
    marked("exact"),
    marked("Page"),
    marked("Explore"),
    marked("Live"),
    marked("Stability"),
    marked("Sweep"),
    marked("Design"),
    marked("Paper"),
    marked("Lessons"),
    marked("Undo"),
    marked("Redo"),
    marked("Back to the picture"),
    marked("A newer version is ready."),
    marked("Reload"),
    marked("Later"),
    marked("Copy state"),
    marked("Copied"),
    marked("Start over"),
    marked("State"),
    marked("Text typed into the picture"),
    marked("Harvester Lab stopped"),
    marked("Harvester Lab cannot start"),
    marked("This browser cannot show Harvester Lab"),
    marked("The graphics card or its driver gave up on the page."),
    marked("Loading"),
    marked("A shaken beam with a magnet at its tip makes electricity."),
    marked(
        "Your last scenario is kept in this browser. Reload continues it. If that stops again, copy it and start over.",
    ),
];

/// The texts in the reader's language by their English ones, as JSON; empty in English.
pub fn words() -> String {
    if super::is_english() {
        return "{}".to_owned();
    }
    let mut words: BTreeMap<String, String> =
        TEXTS.iter().map(|text| ((*text).to_owned(), tr(text).to_owned())).collect();
    for degree in 2..=ForceLaw::MAX_DEGREE {
        let values: [(&str, &dyn Say); 1] = [("degree", &degree)];
        words.insert(format!("Taylor, degree {degree}"), fill("Taylor, degree {degree}", &values));
    }
    serde_json::to_string(&words).unwrap_or_default()
}
