//! The language of the page: chosen by the reader, else by the browser; fetched when it is chosen.

use std::sync::Arc;

use egui::epaint::text::FontData;

use super::errand::Errand;
use super::text::{self, Language, fill, marked, page};
use super::{App, fonts, link};

/// What a language needs beside the page.
pub struct Words {
    /// The catalogue.
    pub catalogue: Vec<u8>,
    /// A font, if its letters are not among those that are always there.
    pub font: Option<Vec<u8>>,
}

/// The name of a language in English.
fn name(language: Language) -> &'static str {
    match language {
        Language::English => marked("English"),
        Language::German => marked("German"),
        Language::Chinese => marked("Chinese"),
    }
}

impl App {
    /// Tells in which language the browser's user reads.
    pub fn prefer_language(&mut self, language: Language) {
        self.speech.preferred = language;
    }

    /// Chooses a language as by hand.
    pub fn choose_language(&mut self, language: Language) {
        self.view.language = Some(language);
    }

    /// Whether texts are still in another language than the one chosen.
    pub fn awaits_words(&self) -> bool {
        self.speech.asked.is_some_and(|asked| !text::is_known(asked)) && self.notice.is_none()
    }

    /// Speaks the language chosen, or has its words fetched.
    pub(super) fn find_words(&mut self) {
        let language = self.view.language.unwrap_or(self.speech.preferred);
        if self.speech.asked == Some(language) {
            return;
        }
        let first = self.speech.asked.replace(language).is_none();
        if self.speak(language) {
            // The page begins in English.
            if first && language == Language::English {
                return;
            }
            self.errands.push(Errand::Speak(language, page::words()));
        } else {
            self.errands.push(Errand::Fetch(language));
        }
    }

    /// Speaks a language if it is known, which is returned. A page opened by a link complains of it before it knows the
    /// words of its language.
    fn speak(&mut self, language: Language) -> bool {
        let told = link::complaint(&self.speech.misread).filter(|told| self.notice.as_ref() == Some(told));
        let known = text::speak(language);
        if known && told.is_some() {
            self.notice = link::complaint(&self.speech.misread);
        }
        known
    }

    /// Takes in what was fetched; says so when that failed, and leaves the texts as they are.
    pub fn learn(&mut self, context: &egui::Context, language: Language, words: Option<Words>) {
        let learnt = words.and_then(|words| {
            text::learn(language, &words.catalogue).ok()?;
            if let Some(font) = words.font {
                self.speech.ideographs = Some(Arc::new(FontData::from_owned(font)));
                fonts::install(context, self.speech.ideographs.as_ref());
            }
            Some(())
        });
        if learnt.is_none() {
            let sentence = marked("{language} could not be loaded. The texts stay as they are.");
            self.errands.push(Errand::Speak(text::language(), page::words()));
            self.notice = Some(fill(sentence, &[("language", &text::tr(name(language)))]));
        } else if self.speech.asked == Some(language) {
            self.speak(language);
            self.errands.push(Errand::Speak(language, page::words()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::rehearsal;

    #[test]
    fn a_link_is_complained_of_in_the_language_that_comes_after_it() {
        text::reset();
        let mut app = rehearsal::app(&egui::Context::default(), None);
        app.choose_language(Language::German);
        app.find_words();
        app.open_link("v=1&omega=abc");
        let english = app.notice.clone().expect("a complaint");
        assert!(english.starts_with("Not everything in this link could be used: omega = abc"), "{english}");
        let catalogue = include_bytes!("../../assets/text/de.json").to_vec();
        app.learn(&egui::Context::default(), Language::German, Some(Words { catalogue, font: None }));
        let german = app.notice.clone().expect("a complaint");
        assert!(german.starts_with("Nicht alles in diesem Link"), "{german}");
        assert!(german.contains("omega = abc"), "{german}");
        app.notice = Some("something else".to_owned());
        app.choose_language(Language::English);
        app.find_words();
        assert_eq!(app.notice.as_deref(), Some("something else"));
        text::reset();
    }
}
