//! What the deserialiser says, in plain words: it names types of the programming language.

use serde::de::{Expected, Unexpected};
use serde_json::Value;

use super::cut;
use crate::sentence::{Say, Sentence, said};

/// Something else was given than what is needed.
pub(super) fn instead(given: &Unexpected<'_>, needed: &dyn Expected) -> Sentence {
    stands(&thing(given), &kind(&needed.to_string()))
}

/// The same where one of several things is chosen by its name.
pub(super) fn no_choice(given: &Value) -> Sentence {
    let given = if given.is_array() { said("a list", &[]) } else { Sentence::Verbatim(given.to_string()) };
    stands(&given, &said("a text in quotation marks, or an object in braces", &[]))
}

fn stands(given: &Sentence, needed: &Sentence) -> Sentence {
    said("{given} stands where {needed} is needed", &[("given", given), ("needed", needed)])
}

/// Too many values, or too few.
pub(super) fn as_many(given: usize, needed: &dyn Expected) -> Sentence {
    let needed = kind(&needed.to_string());
    said("{count} values stand where {needed} is needed", &[("count", &given), ("needed", &needed)])
}

/// No field has this name.
pub(super) fn unknown(name: &str, known: &[&str]) -> Sentence {
    let name = quoted(&cut(name));
    if known.is_empty() {
        return said("unknown field {name}: none is known here", &[("name", &name)]);
    }
    let names = one_of(known.iter().map(|name| quoted(name)));
    said("unknown field {name}: known are {names}", &[("name", &name), ("names", &names)])
}

/// A word that is none of those allowed.
pub(super) fn not_available(word: &str, allowed: &[&str]) -> Sentence {
    let (name, names) = (quoted(&cut(word)), one_of(allowed.iter().map(|word| quoted(word))));
    said("{name} is not available: allowed are {names}", &[("name", &name), ("names", &names)])
}

/// A field that must be there is not.
pub(super) fn missing(name: &str) -> Sentence {
    said("{name} is missing", &[("name", &quoted(name))])
}

fn quoted(name: &str) -> String {
    format!("`{name}`")
}

/// Names to choose from.
pub fn one_of(names: impl Iterator<Item = String>) -> Sentence {
    let names: Vec<String> = names.collect();
    match names.as_slice() {
        [one, other] => said("{one} or {other}", &[("one", one), ("other", other)]),
        _ => Sentence::Verbatim(names.join(", ")),
    }
}

/// What was given.
fn thing(given: &Unexpected<'_>) -> Sentence {
    Sentence::Verbatim(match given {
        Unexpected::Seq => return said("a list", &[]),
        Unexpected::Map => return said("an object in braces", &[]),
        Unexpected::Unit | Unexpected::Option => "null".to_owned(),
        Unexpected::Str(text) => cut(&format!("{text:?}")),
        Unexpected::Float(value) => Value::from(*value).to_string(),
        Unexpected::Bool(value) => value.to_string(),
        Unexpected::Signed(value) => value.to_string(),
        Unexpected::Unsigned(value) => value.to_string(),
        other => cut(&other.to_string()),
    })
}

/// What was needed: "usize" is a whole number.
fn kind(needed: &str) -> Sentence {
    let count = |prefix: &str| needed.strip_prefix(prefix).and_then(|rest| rest.split(' ').next());
    if let Some(count) = count("an array of length ").or_else(|| count("a tuple of size ")) {
        return said("a list of {count} values", &[("count", &count)]);
    }
    match needed {
        "f64" | "f32" => said("a number", &[]),
        "usize" | "u64" | "u32" | "u16" | "u8" => said("a whole number of at least 0", &[]),
        "i64" | "i32" | "isize" => said("a whole number", &[]),
        "bool" | "a boolean" => said("true or false", &[]),
        "a string" | "str" | "string" | "variant identifier" => said("a text in quotation marks", &[]),
        "a sequence" => said("a list", &[]),
        other if ["struct ", "a map", "internally tagged "].iter().any(|what| other.starts_with(what)) => {
            said("an object in braces", &[])
        }
        other if other.starts_with("enum ") || other.contains("variant") => {
            said("one of the names known here", &[])
        }
        other => other.say(),
    }
}

#[cfg(test)]
mod tests {
    use crate::questions::input::fields;
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
        #[serde(default, rename = "tagged")]
        _tagged: Option<Tagged>,
    }

    #[derive(Debug, Deserialize)]
    #[serde(tag = "kind")]
    enum Tagged {
        #[serde(rename = "empty")]
        Empty {},
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
        let said = |value: Value| fields::<Inner>(&value).expect_err("a wrong field").to_string();
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
            (json!({"tagged": 3}), "tagged: 3 stands where an object in braces is needed"),
            (
                json!({"tagged": {"kind": "full"}}),
                "tagged.kind: `full` is not available: allowed are `empty`",
            ),
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
