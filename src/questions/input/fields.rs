//! JSON becomes fields. One deserialiser for all that is read, which knows where in the JSON it is and speaks plainly: a
//! wrapper around the library's for every type would weigh more in the page than what it wraps.

use std::fmt;

use serde::de::{
    self, DeserializeOwned, DeserializeSeed, Deserializer, EnumAccess, IntoDeserializer, MapAccess,
    SeqAccess, Unexpected, VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any;
use serde_json::{Map, Value, map};

use super::{cut, words};
use crate::sentence::{Say, Sentence, said};

/// A field that cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.say())]
pub struct FieldError {
    /// Its path, such as `parameters.beta`; `.` is the whole.
    pub path: String,
    /// What is wrong with it.
    pub problem: Sentence,
    /// The words allowed, where it is none of these.
    pub allowed: &'static [&'static str],
}

/// JSON as what is meant by it.
///
/// # Errors
/// [`FieldError`] for the first field that cannot be read.
pub fn fields<T: DeserializeOwned>(value: &Value) -> Result<T, FieldError> {
    T::deserialize(At { value, beside: None }).map_err(FieldError::whole)
}

/// The same, where no field may be unknown; names of fields `beside` these are told with those that are known.
///
/// # Errors
/// As [`fields`].
pub fn known_fields<T: DeserializeOwned>(value: &Value, beside: &[&'static str]) -> Result<T, FieldError> {
    T::deserialize(At { value, beside: Some(beside) }).map_err(FieldError::whole)
}

impl FieldError {
    fn new(problem: Sentence) -> Self {
        Self { path: String::new(), problem, allowed: &[] }
    }

    /// Seen from what holds the field in a place.
    fn under(mut self, place: &str) -> Self {
        let dot = if self.path.is_empty() || self.path.starts_with('[') { "" } else { "." };
        self.path = format!("{place}{dot}{}", self.path);
        self
    }

    /// Seen from outside.
    fn whole(self) -> Self {
        let path = if self.path.is_empty() { ".".to_owned() } else { cut(&self.path) };
        Self { path, ..self }
    }

    fn unknown(name: &str, beside: &[&'static str], known: &'static [&'static str]) -> Self {
        Self::new(words::unknown(name, &[beside, known].concat()))
    }
}

impl Say for FieldError {
    fn say(&self) -> Sentence {
        said("{field}: {problem}", &[("field", &self.path), ("problem", &self.problem)])
    }
}

impl de::Error for FieldError {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::new(Sentence::Verbatim(message.to_string()))
    }

    fn invalid_type(given: Unexpected<'_>, needed: &dyn de::Expected) -> Self {
        Self::new(words::instead(&given, needed))
    }

    fn invalid_value(given: Unexpected<'_>, needed: &dyn de::Expected) -> Self {
        Self::new(words::instead(&given, needed))
    }

    fn invalid_length(given: usize, needed: &dyn de::Expected) -> Self {
        Self::new(words::as_many(given, needed))
    }

    fn unknown_variant(name: &str, allowed: &'static [&'static str]) -> Self {
        Self { allowed, ..Self::new(words::not_available(name, allowed)) }
    }

    fn unknown_field(name: &str, known: &'static [&'static str]) -> Self {
        Self::unknown(name, &[], known)
    }

    fn missing_field(name: &'static str) -> Self {
        Self::new(words::missing(name))
    }
}

/// A value, and, where no field may be unknown, the names beside those of its type.
#[derive(Clone, Copy)]
struct At<'a> {
    value: &'a Value,
    beside: Option<&'a [&'static str]>,
}

impl<'a> At<'a> {
    fn inside(value: &'a Value) -> Self {
        Self { value, beside: None }
    }
}

impl<'de> Deserializer<'de> for At<'_> {
    type Error = FieldError;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, FieldError> {
        match self.value {
            Value::Null => visitor.visit_unit(),
            Value::Bool(value) => visitor.visit_bool(*value),
            Value::String(text) => visitor.visit_str(text),
            Value::Number(number) => match (number.as_u64(), number.as_i64()) {
                (Some(value), _) => visitor.visit_u64(value),
                (None, Some(value)) => visitor.visit_i64(value),
                (None, None) => visitor.visit_f64(number.as_f64().unwrap_or_default()),
            },
            Value::Array(values) => {
                let mut entries = Entries { values: values.iter(), count: 0 };
                let read = visitor.visit_seq(&mut entries)?;
                if entries.values.len() == 0 {
                    return Ok(read);
                }
                Err(de::Error::invalid_length(values.len(), &"fewer elements in array"))
            }
            Value::Object(values) => visitor.visit_map(Names { entries: values.iter(), next: None }),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, FieldError> {
        if self.value.is_null() { visitor.visit_none() } else { visitor.visit_some(self) }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, FieldError> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        known: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, FieldError> {
        if let (Some(beside), Value::Object(values)) = (self.beside, self.value) {
            only(values, beside, known)?;
        }
        self.deserialize_any(visitor)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, FieldError> {
        let (name, value) = match self.value {
            Value::String(name) => (name, None),
            Value::Object(values) => match values.iter().next() {
                Some((name, value)) if values.len() == 1 => (name, Some(value)),
                _ => return Err(de::Error::invalid_value(Unexpected::Map, &"map with a single key")),
            },
            other => return Err(FieldError::new(words::no_choice(other))),
        };
        visitor.visit_enum(Choice { name, value })
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct seq tuple
        tuple_struct map identifier ignored_any
    }
}

/// Refuses fields that are neither `beside` nor `known`.
fn only(
    values: &Map<String, Value>,
    beside: &[&'static str],
    known: &'static [&'static str],
) -> Result<(), FieldError> {
    let other = |name: &&String| !known.contains(&name.as_str());
    values.keys().find(other).map_or(Ok(()), |name| Err(FieldError::unknown(name, beside, known).under(name)))
}

struct Entries<'a> {
    values: std::slice::Iter<'a, Value>,
    count: usize,
}

impl<'de> SeqAccess<'de> for &mut Entries<'_> {
    type Error = FieldError;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, FieldError> {
        let Some(value) = self.values.next() else { return Ok(None) };
        let index = self.count;
        self.count += 1;
        seed.deserialize(At::inside(value)).map(Some).map_err(|error| error.under(&format!("[{index}]")))
    }
}

struct Names<'a> {
    entries: map::Iter<'a>,
    /// The entry whose name has been read.
    next: Option<(&'a String, &'a Value)>,
}

impl<'de> MapAccess<'de> for Names<'_> {
    type Error = FieldError;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, FieldError> {
        self.next = self.entries.next();
        let Some((name, _)) = self.next else { return Ok(None) };
        let read = seed.deserialize(name.as_str().into_deserializer());
        read.map(Some).map_err(|error: FieldError| error.under(name))
    }

    fn next_value_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<T::Value, FieldError> {
        let Some((name, value)) = self.next.take() else { return Err(de::Error::custom("no value")) };
        seed.deserialize(At::inside(value)).map_err(|error| error.under(name))
    }
}

/// One of several, by its name, and what it holds.
struct Choice<'a> {
    name: &'a str,
    value: Option<&'a Value>,
}

impl<'a, 'de> EnumAccess<'de> for Choice<'a> {
    type Error = FieldError;
    type Variant = Self;

    fn variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<(T::Value, Self), FieldError> {
        Ok((seed.deserialize(self.name.into_deserializer())?, self))
    }
}

impl<'a> Choice<'a> {
    fn held(&self) -> At<'a> {
        At::inside(self.value.unwrap_or(&Value::Null))
    }
}

impl<'de> VariantAccess<'de> for Choice<'_> {
    type Error = FieldError;

    fn unit_variant(self) -> Result<(), FieldError> {
        self.value.map_or(Ok(()), |_| {
            de::Deserialize::deserialize(self.held()).map_err(|error: FieldError| error.under(self.name))
        })
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, FieldError> {
        seed.deserialize(self.held()).map_err(|error| error.under(self.name))
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, FieldError> {
        self.held().deserialize_any(visitor).map_err(|error| error.under(self.name))
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, FieldError> {
        self.held().deserialize_any(visitor).map_err(|error| error.under(self.name))
    }
}
