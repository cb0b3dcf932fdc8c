//! What the page says, in the reader's language. The English text in the source is the key of the catalogue.
//!
//! English is compiled in. The other catalogues (`assets/text`) are fetched when their language is chosen; until one is
//! there, and for what it lacks, English stands in.
//!
//! `text::tr` is for fixed texts, `text::fill` for those with values, `text::marked` in tables. With Chinese comes a font
//! of just the characters used (`assets/fonts/subset.sh chinese`). `app::speaking` has them fetched, the service worker
//! keeps them like the rest; `scripts/precache.py` puts hashes into their names.
//!
//! What the solver, the questions and links have to say is data: motions, warnings, evidence and errors are enums with
//! values, and [`Say`] makes a [`Sentence`](crate::sentence::Sentence) of each, whose English words are a key of the
//! catalogue again. [`say`] and the values of [`fill`] are in the reader's language, `Display` is English. A worker whose
//! piece fails sends the sentence. What others say (a library, the browser) stays as it is.
//!
//! Texts of `index.html` and `assets/shell` are listed in `text::page`, and the page's script puts them in. What may have
//! to be said before the app is there has a small table in `start.js`. `tests/fast/texts.rs` holds sources, catalogues and
//! fonts together: a new text or sentence, also one in the row of a parameter or dimension, needs its line in both
//! catalogues, and a new Chinese character another run of `subset.sh`.

mod language;
pub mod page;
pub mod terms;

use std::cell::Cell;
use std::collections::HashMap;

pub use language::Language;

use crate::sentence::{Say, said};

/// Translations by their English texts.
type Catalogue = HashMap<String, String>;

thread_local! {
    /// The language spoken, with its catalogue. Every catalogue is kept for good, as texts of it may be in use.
    static SPOKEN: Cell<(Language, Option<&'static Catalogue>)> = const { Cell::new((Language::English, None)) };
    /// The catalogues read so far, so that none is read twice.
    static READ: Cell<[Option<&'static Catalogue>; Language::ALL.len()]> = const { Cell::new([None; Language::ALL.len()]) };
}

/// The language that texts are in now.
#[must_use]
pub fn language() -> Language {
    SPOKEN.get().0
}

fn is_english() -> bool {
    SPOKEN.get().1.is_none()
}

/// Whether `language` can be spoken without a catalogue to be fetched.
#[must_use]
pub fn is_known(language: Language) -> bool {
    language == Language::English || READ.get()[language as usize].is_some()
}

/// Speaks a language that is known; says whether it is.
pub fn speak(language: Language) -> bool {
    if is_known(language) {
        SPOKEN.set((language, READ.get()[language as usize]));
    }
    is_known(language)
}

/// Reads the catalogue of a language, which can be spoken from now on.
///
/// # Errors
/// What is wrong with the catalogue.
pub fn learn(language: Language, json: &[u8]) -> Result<(), String> {
    let catalogue: Catalogue = serde_json::from_slice(json).map_err(|error| error.to_string())?;
    let mut read = READ.get();
    read[language as usize] = Some(Box::leak(Box::new(catalogue)));
    READ.set(read);
    Ok(())
}

/// Reads a catalogue and speaks it.
#[cfg(test)]
pub(crate) fn install(language: Language, json: &str) -> Result<(), String> {
    learn(language, json.as_bytes())?;
    speak(language);
    Ok(())
}

/// Speaks English again and forgets all catalogues; tests share their thread with others.
#[cfg(test)]
pub(crate) fn reset() {
    SPOKEN.set((Language::English, None));
    READ.set([None; Language::ALL.len()]);
}

fn look_up(english: &str) -> Option<&'static str> {
    SPOKEN.get().1?.get(english).map(String::as_str)
}

/// A fixed text in the reader's language; English where the catalogue has nothing.
#[must_use]
pub fn tr(english: &'static str) -> &'static str {
    look_up(english).unwrap_or(english)
}

/// What can be told, in the reader's language.
#[must_use]
pub fn say(what: &dyn Say) -> String {
    what.say().in_words(|english| look_up(english).unwrap_or(english))
}

/// A text with values: each `{name}` of the translation is replaced by the value of that name, in any order.
///
/// Numbers are formatted by the caller, so that they look the same in every language.
#[must_use]
pub fn fill(english: &'static str, values: &[(&str, &dyn Say)]) -> String {
    say(&said(english, values))
}

/// Marks a text of a table as one of the catalogue; whoever shows it calls [`tr`].
#[must_use]
pub const fn marked(english: &'static str) -> &'static str {
    english
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::attractors::motion::{Motion, Undecided};

    #[test]
    fn values_go_where_their_names_stand() {
        let text = fill("{power} at {frequency}, again {power}", &[("power", &"3 µW"), ("frequency", &8.16)]);
        assert_eq!(text, "3 µW at 8.16, again 3 µW");
        assert_eq!(marked("Damping"), tr("Damping"));
        let text = fill("{name}: {reason} {", &[("name", &"a{reason}.json"), ("reason", &"no {")]);
        assert_eq!(text, "a{reason}.json: no { {");
    }

    #[test]
    fn sentences_within_sentences_are_in_the_readers_language() {
        let undecided = Motion::Undecided { why: Undecided::EvidenceDisagrees };
        let catalogue = r#"{"undecided: {why}":"offen: {why}","the evidence disagrees":"die Befunde widersprechen sich"}"#;
        let english = say(&undecided);
        install(Language::German, catalogue).expect("a catalogue");
        let german = (say(&undecided), fill("{a}: {b}", &[("a", &undecided), ("b", &"undecided: {why}")]));
        reset();
        assert_eq!(english, "undecided: the evidence disagrees");
        assert_eq!(german.0, "offen: die Befunde widersprechen sich");
        // What others said is left alone.
        assert_eq!(german.1, "offen: die Befunde widersprechen sich: undecided: {why}");
        assert_eq!(undecided.to_string(), english);
    }

    #[test]
    fn a_catalogue_speaks_where_it_can_and_english_stands_in() {
        let catalogue = r#"{"Damping":"Dämpfung","{power} at {frequency}":"bei {frequency} {power}"}"#;
        assert!(install(Language::German, "[]").is_err() && language() == Language::English);
        install(Language::German, catalogue).expect("a catalogue");
        let values: [(&str, &dyn Say); 2] = [("power", &"3 W"), ("frequency", &"8 Hz")];
        let said = (tr("Damping"), tr("Excitation"), fill("{power} at {frequency}", &values));
        assert!(speak(Language::English) && speak(Language::German) && !speak(Language::Chinese));
        reset();
        assert_eq!(said, ("Dämpfung", "Excitation", "bei 8 Hz 3 W".to_owned()));
        assert_eq!(tr("Damping"), "Damping");
    }
}
