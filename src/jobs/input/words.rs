//! The deserialiser's messages in plain words: it names types of the programming language.

use super::cut;

/// A message of serde about a field, in words that a user understands; one of another kind stays.
pub(crate) fn plain(message: &str) -> String {
    if let Some((given, needed)) = split(message, &["invalid type: ", "invalid value: "], ", expected ") {
        return format!("{} stands where {} is needed", thing(given), kind(needed));
    }
    if let Some((given, needed)) = split(message, &["invalid length "], ", expected ") {
        return format!("{given} values stand where {} is needed", kind(needed));
    }
    let named = |prefix: &'static str| split(message, &[prefix], "`, ").map(|(name, rest)| (cut(name), rest));
    if let Some((name, rest)) = named("unknown field `") {
        return format!("unknown field `{name}`{}", allowed(rest, "known are"));
    }
    if let Some((name, rest)) = named("unknown variant `") {
        return format!("`{name}` is not available{}", allowed(rest, "allowed are"));
    }
    match message.strip_prefix("missing field ") {
        Some(name) => format!("{name} is missing"),
        None => message.to_owned(),
    }
}

/// What stands between one of the `prefixes` and the last `between`, and what follows it. The last: what was given comes
/// first, and may hold anything.
fn split<'a>(message: &'a str, prefixes: &[&str], between: &str) -> Option<(&'a str, &'a str)> {
    let rest = prefixes.iter().find_map(|prefix| message.strip_prefix(prefix))?;
    let place = if between == "`, " {
        rest.rfind("`, expected ").or_else(|| rest.rfind("`, there are no "))?
    } else {
        rest.rfind(between)?
    };
    Some((&rest[..place], &rest[place + between.len()..]))
}

/// The names that are known, from "expected one of `a`, `b`".
fn allowed(rest: &str, words: &str) -> String {
    let names = rest.strip_prefix("expected one of ").or_else(|| rest.strip_prefix("expected "));
    names.map_or_else(|| ": none is known here".to_owned(), |names| format!(": {words} {names}"))
}

/// What was given: "floating point `2.5`" is 2.5.
fn thing(given: &str) -> String {
    match given {
        "null" | "unit value" | "Option value" => return "null".to_owned(),
        "sequence" => return "a list".to_owned(),
        "map" => return "an object in braces".to_owned(),
        _ => {}
    }
    if let Some(text) = given.strip_prefix("string ") {
        return cut(text);
    }
    let value = given.split_once('`').and_then(|(_, value)| value.strip_suffix('`'));
    cut(value.unwrap_or(given))
}

/// What was needed: "usize" is a whole number.
fn kind(needed: &str) -> String {
    let count = |prefix: &str| needed.strip_prefix(prefix).and_then(|rest| rest.split(' ').next());
    if let Some(count) = count("an array of length ").or_else(|| count("a tuple of size ")) {
        return format!("a list of {count} values");
    }
    if needed.starts_with("struct ") || needed.starts_with("a map") {
        return "an object in braces".to_owned();
    }
    let words = match needed {
        "f64" | "f32" => "a number",
        "usize" | "u64" | "u32" | "u16" | "u8" => "a whole number of at least 0",
        "i64" | "i32" | "isize" => "a whole number",
        "bool" | "a boolean" => "true or false",
        "a string" | "str" | "string" | "variant identifier" => "a text in quotation marks",
        "a sequence" => "a list",
        "string or map" => "a text in quotation marks, or an object in braces",
        other if other.starts_with("enum ") || other.contains("variant") => "one of the names known here",
        other => other,
    };
    words.to_owned()
}

#[cfg(test)]
mod tests {
    use crate::jobs::input::fields;
    use serde::Deserialize;
    use serde_json::{Value, json};

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Inner {
        #[serde(default, rename = "number")]
        _number: f64,
        #[serde(default, rename = "count")]
        _count: usize,
        #[serde(default, rename = "word")]
        _word: Word,
        #[serde(default, rename = "flag")]
        _flag: bool,
        #[serde(default, rename = "text")]
        _text: String,
        #[serde(default, rename = "list")]
        _list: Vec<f64>,
        #[serde(default, rename = "pair")]
        _pair: (f64, f64),
        #[serde(default, rename = "inner")]
        _inner: Option<Box<Inner>>,
    }

    #[allow(dead_code, reason = "what is read here is of no interest")]
    #[derive(Debug, Default, Deserialize)]
    #[serde(rename_all = "lowercase")]
    enum Word {
        #[default]
        One,
        Two(u32),
    }

    #[test]
    fn whatever_serde_says_of_a_field_is_said_in_plain_words() {
        let many = "y".repeat(1 << 20);
        let said = |value: Value| {
            let error = fields::<Inner>(value).expect_err("a wrong field");
            format!("{}: {}", error.path, error.problem)
        };
        for (value, expected) in [
            (json!({"number": "fast"}), "number: \"fast\" stands where a number is needed"),
            (json!({"number": [1]}), "number: a list stands where a number is needed"),
            (json!({"number": null}), "number: null stands where a number is needed"),
            (json!({"number": {}}), "number: an object in braces stands where a number is needed"),
            (json!({"count": 2.5}), "count: 2.5 stands where a whole number of at least 0 is needed"),
            (json!({"count": -1}), "count: -1 stands where a whole number of at least 0 is needed"),
            (json!({"word": "three"}), "word: `three` is not available: allowed are `one` or `two`"),
            (
                json!({"word": {"two": "x"}}),
                "word.two: \"x\" stands where a whole number of at least 0 is needed",
            ),
            (
                json!({"word": 1}),
                "word: 1 stands where a text in quotation marks, or an object in braces is needed",
            ),
            (json!({"flag": 1}), "flag: 1 stands where true or false is needed"),
            (json!({"text": true}), "text: true stands where a text in quotation marks is needed"),
            (json!({"list": 3}), "list: 3 stands where a list is needed"),
            (json!({"pair": [1]}), "pair: 1 values stand where a list of 2 values is needed"),
            (json!({"inner": 3}), "inner: 3 stands where an object in braces is needed"),
            (json!(["x"]), ""),
            (json!({"number": many}), ""),
            (json!({many.clone(): 1}), ""),
            (json!({"word": many}), ""),
            (json!({"word": {many.clone(): 1}}), ""),
            (json!({"number": [1], "a`, expected one of b": 2}), ""),
            (json!({"count": 1e300}), ""),
        ] {
            let said = said(value);
            assert!(expected.is_empty() || said == expected, "{said}");
            for word in
                ["f64", "usize", "u32", "struct", "enum", "variant", "tuple", "invalid type", "at line"]
            {
                assert!(!said.contains(word), "{said}");
            }
            assert!(said.chars().count() < 300 && !said.contains(&many[..81]), "{said}");
        }
    }
}
