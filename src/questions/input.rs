//! Input as people and their tools write it: bytes become text, text becomes JSON, JSON becomes fields. What is wrong
//! with it is said in words that need no knowledge of a programming language, and little of the input is repeated.

use std::cell::RefCell;
use std::fmt;

use serde::de::{self, DeserializeSeed, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::error::Category;
use serde_json::{Map, Number, Value};
use thiserror::Error;

use crate::sentence::{Say, Sentence, said};

mod fields;
mod words;

pub use fields::{FieldError, fields, known_fields};
pub use words::one_of;

/// Most characters of the input that a message repeats in one piece.
const REPEATED: usize = 80;
/// Longest text (characters) that may stand in a request or a stored view: names and words, all of them short.
const LONGEST: usize = 80;

/// Why bytes are no text; fits behind "the request is" and the like.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum NoText {
    /// Text in the encoding that some tools of Windows write.
    #[error("UTF-16 text: save it as UTF-8")]
    Utf16,
    /// Another encoding, or no text at all.
    #[error("not UTF-8 text")]
    Other,
}

/// Bytes as text, without a byte order mark before it.
///
/// # Errors
/// [`NoText`].
pub fn text(bytes: &[u8]) -> Result<&str, NoText> {
    if is_utf16(bytes) {
        return Err(NoText::Utf16);
    }
    let text = std::str::from_utf8(bytes).map_err(|_| NoText::Other)?;
    Ok(text.strip_prefix('\u{feff}').unwrap_or(text))
}

/// Whether bytes begin as UTF-16 text does: with its byte order mark, or with a letter of which every other byte is 0.
pub(crate) fn is_utf16(bytes: &[u8]) -> bool {
    match bytes {
        // What follows these marks in UTF-32 is no text in UTF-16 either.
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => true,
        [low, 0, next, 0, ..] => *low != 0 && *next != 0,
        [0, high, 0, next, ..] => *high != 0 && *next != 0,
        [letter, 0] | [0, letter] => *letter != 0,
        _ => false,
    }
}

/// Why a text is no JSON that can be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{}", self.say())]
pub enum JsonError {
    /// It is not JSON, and why.
    Syntax(Sentence),
    /// A name stands twice in one object; which of the two is meant, nobody knows.
    Twice {
        /// Where, such as `parameters.beta`.
        path: String,
    },
    /// A text far too long for a name or a word.
    Long {
        /// Its place in the input, as names and indices.
        path: String,
        /// How long it is.
        length: usize,
    },
}

impl Say for JsonError {
    fn say(&self) -> Sentence {
        match self {
            Self::Syntax(problem) => said("not valid JSON: {problem}", &[("problem", problem)]),
            Self::Twice { path } => said("{path} is given twice", &[("path", path)]),
            Self::Long { path, length } => said(
                "{path}: a text of {length} characters stands where names and words are, which have at most {most}",
                &[("path", path), ("length", length), ("most", &LONGEST)],
            ),
        }
    }
}

/// Reads JSON. A byte order mark before it is passed; a name given twice in an object, at any depth, is an error, where
/// `serde_json` would silently take the last.
///
/// # Errors
/// [`JsonError`].
pub fn json(text: &str) -> Result<Value, JsonError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let found = RefCell::new(None);
    let mut reader = serde_json::Deserializer::from_str(text);
    let value = Reader { path: &Path::Root, found: &found }.deserialize(&mut reader);
    match value.and_then(|value| reader.end().map(|()| value)) {
        Ok(value) => Ok(value),
        Err(error) => Err(found.into_inner().unwrap_or_else(|| JsonError::Syntax(syntax(&error)))),
    }
}

/// A piece of the input for a message: on one line, and of a long one the beginning.
pub fn cut(text: &str) -> String {
    let mut letters = text.chars().map(|letter| if letter.is_control() { ' ' } else { letter });
    let beginning: String = letters.by_ref().take(REPEATED).collect();
    if letters.next().is_none() {
        beginning
    } else {
        beginning.chars().take(REPEATED - 1).collect::<String>() + "…"
    }
}

/// What is wrong with the JSON, and where.
fn syntax(error: &serde_json::Error) -> Sentence {
    let place = format!("line {}, column {}", error.line(), error.column());
    if error.classify() == Category::Eof {
        return said("it ends too early ({place})", &[("place", &place)]);
    }
    let text = error.to_string();
    let what = text.split(" at line ").next().unwrap_or_default();
    let what = match what {
        "expected value" | "expected ident" => "no value that JSON has begins here",
        "trailing characters" => "something follows after its end",
        "trailing comma" => "nothing follows a comma",
        "key must be a string" => "a name must stand in quotation marks",
        "recursion limit exceeded" => "it is nested too deeply",
        "number out of range" => "a number is too large",
        other => other,
    };
    Sentence::Verbatim(format!("{what} ({place})"))
}

/// Where in the JSON.
enum Path<'a> {
    Root,
    Name(&'a Path<'a>, &'a str),
    Index(&'a Path<'a>, usize),
}

impl fmt::Display for Path<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Root => Ok(()),
            Self::Name(Self::Root, name) => f.write_str(name),
            Self::Name(parent, name) => write!(f, "{parent}.{name}"),
            Self::Index(parent, index) => write!(f, "{parent}[{index}]"),
        }
    }
}

/// Reads a value at a place, and tells what is wrong apart from the syntax by `found`.
#[derive(Clone, Copy)]
struct Reader<'a> {
    path: &'a Path<'a>,
    found: &'a RefCell<Option<JsonError>>,
}

impl Reader<'_> {
    fn refuse<E: de::Error>(&self, error: JsonError) -> E {
        let message = E::custom(&error);
        self.found.replace(Some(error));
        message
    }

    fn short<E: de::Error>(&self, text: &str) -> Result<(), E> {
        let length = text.chars().count();
        if length <= LONGEST {
            return Ok(());
        }
        let path = match self.path {
            Path::Root => "the request".to_owned(),
            path => cut(&path.to_string()),
        };
        Err(self.refuse(JsonError::Long { path, length }))
    }
}

impl<'de> DeserializeSeed<'de> for Reader<'_> {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Value, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Reader<'_> {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(Value::Bool(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(Value::from(value))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(Value::from(value))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
        Ok(Number::from_f64(value).map_or(Value::Null, Value::Number))
    }

    fn visit_str<E: de::Error>(self, value: &str) -> Result<Value, E> {
        self.short(value)?;
        Ok(Value::from(value))
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let mut values = Vec::new();
        loop {
            let path = Path::Index(self.path, values.len());
            match entries.next_element_seed(Reader { path: &path, found: self.found })? {
                Some(value) => values.push(value),
                None => return Ok(Value::Array(values)),
            }
        }
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let mut values = Map::new();
        while let Some(name) = entries.next_key::<String>()? {
            let path = Path::Name(self.path, &name);
            let inner = Reader { path: &path, found: self.found };
            inner.short(&name)?;
            if values.contains_key(&name) {
                return Err(inner.refuse(JsonError::Twice { path: cut(&path.to_string()) }));
            }
            let value = entries.next_value_seed(inner)?;
            values.insert(name, value);
        }
        Ok(Value::Object(values))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn json_is_read_as_the_library_reads_it() {
        let text = r#"{"a":[1,-2,2.5e-3,true,null,"é\n"],"b":{"c":{}},"d":18446744073709551615,"e":[]}"#;
        assert_eq!(
            json(text),
            serde_json::from_str::<Value>(text)
                .map_err(|_| JsonError::Syntax(Sentence::Verbatim(String::new())))
        );
        assert_eq!(json("\u{feff} {\"a\": 1e-300}\r\n"), Ok(json!({ "a": 1e-300 })));
    }

    #[test]
    fn a_name_given_twice_is_named_with_its_path() {
        let twice = |text: &str| json(text).expect_err("twice").to_string();
        assert_eq!(twice(r#"{"task":"modes","task":"modes"}"#), "task is given twice");
        assert_eq!(
            twice(r#"{"parameters":{"beta":1,"alpha":0,"beta":1}}"#),
            "parameters.beta is given twice"
        );
        assert_eq!(twice(r#"{"a":[0,{"b":1,"b":2}]}"#), "a[1].b is given twice");
        // The same name in two objects is none.
        assert!(json(r#"[{"b":1},{"b":2}]"#).is_ok());
    }

    #[test]
    fn what_is_no_json_is_said_with_its_place_and_without_the_input() {
        let wrong = |text: &str| json(text).expect_err("no JSON").to_string();
        assert_eq!(wrong(""), "not valid JSON: it ends too early (line 1, column 0)");
        assert_eq!(wrong("{\"a\":\n1 2}"), "not valid JSON: expected `,` or `}` (line 2, column 3)");
        assert_eq!(wrong("{a:1}"), "not valid JSON: a name must stand in quotation marks (line 1, column 2)");
        assert_eq!(wrong("{} {}"), "not valid JSON: something follows after its end (line 1, column 4)");
        assert!(wrong(&"[".repeat(1000)).contains("nested too deeply"));
        assert!(wrong("1e999").contains("too large"));
        let long = "x".repeat(1 << 20);
        for text in [long.clone(), format!("\"{long}"), format!("{{\"{long}\":1}}"), format!("[\"{long}\"]")]
        {
            assert!(wrong(&text).chars().count() < 250, "{}", wrong(&text));
        }
    }

    #[test]
    fn marks_before_a_text_are_passed_and_other_encodings_named() {
        assert_eq!(text(b"\xef\xbb\xbf{}"), Ok("{}"));
        assert_eq!(text("ü".as_bytes()), Ok("ü"));
        for utf16 in
            [&b"\xff\xfe{\0}\0"[..], b"\xfe\xff\0{\0}", b"{\0\"\0", b"\0{\0\"", b"{\0", b"\xff\xfe\0"]
        {
            assert_eq!(text(utf16), Err(NoText::Utf16), "{utf16:?}");
        }
        assert_eq!(text(b"\xfc"), Err(NoText::Other));
        assert_eq!(text(b""), Ok(""));
    }

    #[test]
    fn a_piece_of_the_input_is_short_and_on_one_line() {
        assert_eq!(cut("a\nb"), "a b");
        assert_eq!(cut(&"ä".repeat(80)), "ä".repeat(80));
        assert_eq!(cut(&"ä".repeat(81)), "ä".repeat(79) + "…");
    }
}
