//! The languages that the page speaks.

use serde::{Deserialize, Serialize};

/// A language.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Language {
    /// English.
    #[default]
    #[serde(rename = "en")]
    English,
    /// German.
    #[serde(rename = "de")]
    German,
    /// Chinese in simplified characters.
    #[serde(rename = "zh")]
    Chinese,
}

impl Language {
    /// All of them, as they are offered.
    pub const ALL: [Self; 3] = [Self::English, Self::German, Self::Chinese];

    /// As in links, in lessons and in the page's markup (ISO 639).
    pub const fn code(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::German => "de",
            Self::Chinese => "zh",
        }
    }

    /// Its name in itself. The Chinese one can be drawn before any Chinese font is there: `assets/fonts` sees to it.
    pub const fn own_name(self) -> &'static str {
        match self {
            Self::English => "English",
            Self::German => "Deutsch",
            Self::Chinese => "中文",
        }
    }

    /// The language of a tag such as `de-AT` or `zh_CN`; none where the page does not speak it.
    pub fn of_tag(tag: &str) -> Option<Self> {
        let first = tag.split(['-', '_']).next().unwrap_or_default();
        Self::ALL.into_iter().find(|language| language.code().eq_ignore_ascii_case(first))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_of_browsers_are_understood() {
        for (tag, language) in [("de-AT", "de"), ("zh-Hans-CN", "zh"), ("EN", "en"), ("zh_TW", "zh")] {
            assert_eq!(Language::of_tag(tag).map(Language::code), Some(language), "{tag}");
        }
        assert!(["", "fr", "deutsch", "-de"].iter().all(|tag| Language::of_tag(tag).is_none()));
    }
}
