//! Writing XML.

/// `text` as the contents of an element or an attribute.
pub(super) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            // Not allowed in XML, not even as references.
            control if control.is_control() && !matches!(control, '\n' | '\t') => out.push(' '),
            other => out.push(other),
        }
    }
    out
}

/// A coordinate of a drawing: hundredths are finer than any printer.
pub(super) fn short(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_safe_and_numbers_short() {
        assert_eq!(escape("a < b & \"c\" > d\u{7}"), "a &lt; b &amp; &quot;c&quot; &gt; d ");
        assert_eq!([short(1.0), short(-0.001), short(12.345), short(0.5)], ["1", "0", "12.35", "0.5"]);
    }
}
