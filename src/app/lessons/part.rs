//! A part of a lesson's file, and where it stands: so that what is wrong with it can be told.

use serde_json::Value;

use crate::sentence::{Say, Sentence, said};

/// What was read, or what is wrong.
pub(super) type Read<T> = Result<T, Sentence>;

/// What stands where, as sentences name it.
type At<'a> = &'a [(&'a str, &'a dyn Say)];

/// A part of a file.
pub(super) struct Part<'a> {
    pub(super) value: &'a Value,
    /// Its path, such as `steps 2, goal, show`.
    pub(super) at: String,
}

impl<'a> Part<'a> {
    /// Says what it must be; where it is not there at all, that.
    pub(super) fn wants<T>(&self, wrong: impl FnOnce(At<'_>) -> Sentence) -> Read<T> {
        let at: At<'_> = &[("at", &self.at)];
        Err(if self.value.is_null() { said("{at} is missing", at) } else { wrong(at) })
    }

    fn within(&self, place: &str) -> String {
        if self.at.is_empty() { place.to_owned() } else { format!("{}, {place}", self.at) }
    }

    /// One of its entries.
    pub(super) fn entry(&self, name: &str) -> Self {
        static NONE: Value = Value::Null;
        Part { value: self.value.get(name).unwrap_or(&NONE), at: self.within(name) }
    }

    /// Reads an entry that need not be there.
    pub(super) fn optional<T>(&self, name: &str, read: fn(&Part<'_>) -> Read<T>) -> Read<Option<T>> {
        self.value.get(name).map(|_| read(&self.entry(name))).transpose()
    }

    /// Reads the entries of a list that is not empty.
    pub(super) fn each<T>(&self, read: impl Fn(&Part<'_>) -> Read<T>) -> Read<Vec<T>> {
        let Some(entries) = self.value.as_array().filter(|entries| !entries.is_empty()) else {
            return self.wants(|at| said("{at} must be a list with something in it", at));
        };
        let entry = |(index, value)| read(&Part { value, at: format!("{} {}", self.at, index + 1) });
        entries.iter().enumerate().map(entry).collect()
    }

    /// A text of one language.
    pub(super) fn word(&self) -> Read<String> {
        let text = self.value.as_str().map(str::to_owned);
        text.map_or_else(|| self.wants(|at| said("{at} must be a text in quotation marks", at)), Ok)
    }

    /// That it has no entries but these.
    pub(super) fn knows(&self, names: &[&str]) -> Read<()> {
        let strange =
            self.value.as_object().into_iter().flatten().find(|(name, _)| !names.contains(&name.as_str()));
        let Some((name, _)) = strange else { return Ok(()) };
        let known = names.join(", ");
        Err(said("{at} is not known; there are {known}", &[("at", &self.within(name)), ("known", &known)]))
    }
}
