//! What the page says, in the reader's language. The English text in the source is the key of the catalogue.

use std::fmt::Display;

/// A fixed text in the reader's language; English where the catalogue has nothing.
#[must_use]
pub fn tr(english: &'static str) -> &'static str {
    english
}

/// A text with values: each `{name}` of the translation is replaced by the value of that name, in any order.
///
/// Numbers are formatted by the caller, so that they look the same in every language.
#[must_use]
pub fn fill(english: &'static str, values: &[(&str, &dyn Display)]) -> String {
    let mut text = tr(english).to_owned();
    for (name, value) in values {
        text = text.replace(&format!("{{{name}}}"), &value.to_string());
    }
    text
}

/// Marks a text of a table as one of the catalogue; whoever shows it calls [`tr`].
#[must_use]
pub const fn marked(english: &'static str) -> &'static str {
    english
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_go_where_their_names_stand() {
        let text = fill("{power} at {frequency}, again {power}", &[("power", &"3 µW"), ("frequency", &8.16)]);
        assert_eq!(text, "3 µW at 8.16, again 3 µW");
        assert_eq!(marked("Damping"), tr("Damping"));
    }
}
