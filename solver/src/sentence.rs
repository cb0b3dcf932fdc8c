//! What a person will read, as data: English words with places for values. Whoever shows it puts it into a language; the
//! solver knows none but English.

use std::fmt;

use nanoserde::{DeBin, SerBin};

/// A sentence, or a part of one, with what stands in it.
#[derive(Debug, Clone, PartialEq, Eq, SerBin, DeBin)]
pub enum Sentence {
    /// The same in every language: a number, a name, what others said.
    Verbatim(String),
    /// Words of ours.
    Words {
        /// In English, with `{name}` where a value stands.
        english: String,
        /// The values by their names.
        values: Vec<(String, Sentence)>,
    },
}

/// What can be told to a person.
pub trait Say {
    /// As a sentence.
    fn say(&self) -> Sentence;
}

/// `Display` in English.
macro_rules! in_english {
    ($($kind:ty),*) => {$(
        impl std::fmt::Display for $kind {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                std::fmt::Display::fmt(&$crate::sentence::Say::say(self), f)
            }
        }
    )*};
}
pub(crate) use in_english;

/// A sentence with its values, by name. The words stand in the source where it is called, and nowhere else.
#[must_use]
pub fn said(english: &'static str, values: &[(&str, &dyn Say)]) -> Sentence {
    let values = values.iter().map(|(name, value)| ((*name).to_owned(), value.say()));
    Sentence::Words { english: english.to_owned(), values: values.collect() }
}

/// A field whose value is none of those in a range.
#[must_use]
pub fn not_available(field: &dyn Say, value: &dyn Say, range: (&dyn Say, &dyn Say)) -> Sentence {
    said(
        "{field} = {value} is not available: {allowed}",
        &[("field", field), ("value", value), ("allowed", &allowed(range.0, range.1))],
    )
}

/// What a range allows.
#[must_use]
pub fn allowed(from: &dyn Say, to: &dyn Say) -> Sentence {
    said("allowed are {from} to {to}", &[("from", from), ("to", to)])
}

impl Sentence {
    /// Several, with something `between` them that is the same in every language.
    #[must_use]
    pub fn list(parts: impl IntoIterator<Item = Self>, between: &str) -> Self {
        let values: Vec<_> = parts.into_iter().enumerate().map(|(i, part)| (i.to_string(), part)).collect();
        let places: Vec<String> = values.iter().map(|(name, _)| format!("{{{name}}}")).collect();
        Self::Words { english: places.join(between), values }
    }

    /// In the language into which `translate` puts words.
    #[must_use]
    pub fn in_words(&self, translate: fn(&str) -> &str) -> String {
        let mut text = String::new();
        self.append(&mut text, translate);
        text
    }

    /// What a value says is left alone, braces and all.
    fn append(&self, text: &mut String, translate: fn(&str) -> &str) {
        let (english, values) = match self {
            Self::Verbatim(told) => return text.push_str(told),
            Self::Words { english, values } => (english, values),
        };
        let mut rest = translate(english);
        while let Some((before, after)) = rest.split_once('{') {
            text.push_str(before);
            let value = |(name, after)| Some((values.iter().find(|(known, _)| known == name)?, after));
            rest = if let Some(((_, value), after)) = after.split_once('}').and_then(value) {
                value.append(text, translate);
                after
            } else {
                text.push('{');
                after
            };
        }
        text.push_str(rest);
    }
}

impl fmt::Display for Sentence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.in_words(|english| english))
    }
}

impl<E: Say + std::error::Error> From<E> for Sentence {
    fn from(error: E) -> Self {
        error.say()
    }
}

impl Say for Sentence {
    fn say(&self) -> Sentence {
        self.clone()
    }
}

impl<T: Say + ?Sized> Say for &T {
    fn say(&self) -> Sentence {
        (**self).say()
    }
}

macro_rules! verbatim {
    ($($kind:ty),*) => {$(
        impl Say for $kind {
            fn say(&self) -> Sentence {
                Sentence::Verbatim(self.to_string())
            }
        }
    )*};
}

verbatim!(str, String, f64, i32, u8, u32, u64, usize);

#[cfg(test)]
mod tests {
    use super::*;

    fn german(english: &str) -> &str {
        match english {
            "{count} steps: {why}" => "{why} nach {count} Schritten",
            "too few" => "zu wenige",
            other => other,
        }
    }

    #[test]
    fn a_sentence_and_those_within_it_are_put_into_words_and_arrive_as_they_were_sent() {
        let sentence = said("{count} steps: {why}", &[("count", &7_usize), ("why", &said("too few", &[]))]);
        assert_eq!(sentence.to_string(), "7 steps: too few");
        assert_eq!(sentence.in_words(german), "zu wenige nach 7 Schritten");
        assert_eq!(Sentence::deserialize_bin(&sentence.serialize_bin()).expect("a message"), sentence);
    }

    #[test]
    fn what_others_said_is_left_alone() {
        let told = said("{file}: {why}", &[("file", &"{why}.json"), ("why", &"too few {")]);
        assert_eq!(told.in_words(german), "{why}.json: too few {");
    }

    #[test]
    fn a_list_is_joined_in_every_language() {
        let parts = || [said("too few", &[]), Sentence::Verbatim("too few".to_owned())];
        assert_eq!(Sentence::list(parts(), "; ").to_string(), "too few; too few");
        assert_eq!(Sentence::list(parts(), "; ").in_words(german), "zu wenige; too few");
        assert_eq!(Sentence::list([], ", ").to_string(), "");
    }
}
