//! The entries a link can have: the leaves of a view's JSON, named by the last parts of their places. What each may be is
//! known to the view alone, which is asked by trying.

use serde_json::{Map, Value};

use crate::app::view::{Fault, View};
use crate::export::number::shortest;
use crate::model::{ForceLaw, ModelError};
use crate::questions::input::{FieldError, one_of};
use crate::sentence::{Say, Sentence, allowed, said};

/// Where the device's dimensions stand.
const DEVICE: &str = "/scenario/device";
/// Where its layers stand, all of them one entry: an arrangement without the numbers that go with it would mean nothing.
const LAYERS: &str = "/scenario/device/layers";
/// The numbers of that entry behind the arrangement, in their order; the last three where the glue counts.
const LAYER_NUMBERS: [&str; 12] = [
    "width",
    "substrate/thickness",
    "substrate/youngs_modulus",
    "substrate/density",
    "ceramic/thickness",
    "ceramic/youngs_modulus",
    "ceramic/density",
    "ceramic/d31",
    "ceramic/permittivity",
    "epoxy/thickness",
    "epoxy/youngs_modulus",
    "epoxy/density",
];
const WITHOUT_GLUE: usize = 9;
/// Left out of names: what stands there is known well enough by its last name.
const SILENT: [&str; 4] = ["/scenario/parameters/", "/scenario/model/", "/scenario/device/", "/scenario/"];
/// The version of a scenario is that of the link.
const VERSION: &str = "/scenario/version";

/// An entry.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Field {
    /// Its name in links.
    pub name: String,
    /// Its place in the JSON of a view.
    pub pointer: String,
}

/// All entries, in the order in which they are written: that of the fields of a view, and behind those of its device the
/// device itself.
pub(super) fn fields() -> Vec<Field> {
    let text = serde_json::to_string(&View::complete()).unwrap_or_default();
    let mut pointers = Vec::new();
    leaves(&serde_json::from_str(&text).unwrap_or_default(), "", &mut pointers);
    pointers.retain(|pointer| pointer != VERSION);
    // A map of JSON knows no order, its text does.
    pointers.sort_by_cached_key(|pointer| {
        let names = pointer.split('/').filter(|name| name.parse::<usize>().is_err());
        names.fold(0, |at, name| at + text[at..].find(&format!("\"{name}\":")).unwrap_or(0))
    });
    let behind = pointers.iter().rposition(|pointer| pointer.starts_with(DEVICE)).map_or(0, |last| last + 1);
    pointers.insert(behind, DEVICE.to_owned());
    let named = |pointer: String| {
        let known = SILENT.iter().find_map(|prefix| pointer.strip_prefix(prefix));
        let name = known.unwrap_or(&pointer).trim_start_matches('/').replace('/', ".");
        Field { name, pointer }
    };
    pointers.into_iter().map(named).collect()
}

/// Gathers the places of what holds nothing else; a list of numbers or words is one.
fn leaves(value: &Value, place: &str, found: &mut Vec<String>) {
    match value {
        Value::Object(entries) if place != LAYERS => {
            entries.iter().for_each(|(name, entry)| leaves(entry, &format!("{place}/{name}"), found));
        }
        Value::Array(parts) if parts.iter().any(Value::is_object) => {
            parts.iter().enumerate().for_each(|(i, part)| leaves(part, &format!("{place}/{i}"), found));
        }
        _ => found.push(place.to_owned()),
    }
}

impl Field {
    /// Whether this says that there is a device.
    pub(super) fn is_device(&self) -> bool {
        self.pointer == DEVICE
    }

    /// Whether this is one of a device's dimensions.
    pub(super) fn is_dimension(&self) -> bool {
        self.pointer.starts_with(DEVICE)
    }

    /// Whether this stands in that part of a view, such as `scenario`.
    pub(super) fn is_part_of(&self, part: &str) -> bool {
        self.pointer[1..].starts_with(part)
    }

    /// Its value in the JSON of a view; null when it is not there.
    pub(super) fn of<'a>(&self, view: &'a Value) -> &'a Value {
        view.pointer(&self.pointer).unwrap_or(&Value::Null)
    }

    /// Puts a value in its place in the JSON of a view.
    pub(super) fn set(&self, view: &mut Value, value: &Value) {
        let Some((parent, key)) = self.pointer.rsplit_once('/') else { return };
        // The parts of what there need not be: a device, a third side.
        if view.pointer(parent).is_none_or(Value::is_null)
            && let Some((whole, part)) = parent.rsplit_once('/')
        {
            insert(view, whole, part, Value::Object(Map::new()));
        }
        // What says that there is a device does not undo what says more.
        if !self.is_device() || self.of(view).is_null() {
            insert(view, parent, key, value.clone());
        }
    }

    /// The view given as JSON with this value in its place.
    fn with(&self, view: &Value, value: &Value) -> Result<View, FieldError> {
        let mut view = view.clone();
        self.set(&mut view, value);
        View::from_value(view)
    }

    /// Text as a value that has its place in a view, given as JSON; otherwise what is allowed. Whether the view can be shown
    /// with it is another question.
    pub(super) fn read(&self, text: &str, view: &Value) -> Result<Value, Sentence> {
        let mut problem = said("allowed is {word}", &[("word", &"paper")]);
        if self.is_layers() {
            let counts: [(&str, &dyn Say); 2] = [("count", &WITHOUT_GLUE), ("more", &LAYER_NUMBERS.len())];
            problem = said("allowed are an arrangement and {count} numbers, or {more} with glue", &counts);
        }
        for value in self.meanings(text.trim()) {
            match self.with(view, &value) {
                Ok(_) => return Ok(value),
                Err(error) if error.allowed.is_empty() => problem = error.problem,
                Err(error) => {
                    let words = one_of(error.allowed.iter().map(|word| (*word).to_owned()));
                    problem = said("allowed are {words}", &[("words", &words)]);
                }
            }
        }
        Err(match self.range(view) {
            Some((range, whole)) if whole || number(text.trim()).is_some() => range,
            Some((range, _)) => said("not a number; {allowed}", &[("allowed", &range)]),
            None if self.name == "force" => laws(),
            None => problem,
        })
    }

    /// What a text can mean.
    fn meanings(&self, text: &str) -> Vec<Value> {
        if self.is_device() {
            return (text == "paper").then(|| Value::Object(Map::new())).into_iter().collect();
        }
        if self.is_layers() {
            return layers(text).into_iter().collect();
        }
        let meant = |word: &str| number(word).unwrap_or_else(|| Value::from(word));
        let mut meanings: Vec<Value> = text.parse().map(Value::Bool).into_iter().collect();
        meanings.extend((self.is_open_circuit(text)).then_some(Value::Null));
        meanings.extend(number(text));
        // Blanks or commas may stand between the parts of a list.
        let words: Vec<&str> = text.split([' ', ',']).filter(|word| !word.is_empty()).collect();
        if words.len() > 1 {
            meanings.push(words.into_iter().map(meant).collect());
        }
        // One of several things with what it holds: `taylor5`, `threshold:first`.
        let digits = text.trim_end_matches(|letter: char| letter.is_ascii_digit()).len();
        let (name, held) = text.split_once(':').unwrap_or_else(|| text.split_at(digits));
        meanings.push(Value::Object(Map::from_iter([(name.to_owned(), meant(held))])));
        meanings.push(Value::from(text));
        meanings
    }

    fn is_layers(&self) -> bool {
        self.pointer == LAYERS
    }

    fn is_open_circuit(&self, text: &str) -> bool {
        self.name == "resistance" && text == "open"
    }

    /// A value as text.
    pub(super) fn write(&self, value: &Value) -> String {
        match value {
            Value::Object(_) if self.is_layers() => self.write_layers(value),
            Value::Null => "open".to_owned(),
            Value::Bool(flag) => flag.to_string(),
            Value::String(word) => word.clone(),
            Value::Number(number) if number.is_u64() => number.to_string(),
            Value::Number(number) => shortest(number.as_f64().unwrap_or_default()),
            Value::Array(values) => {
                let texts: Vec<String> = values.iter().map(|value| self.write(value)).collect();
                texts.join(" ")
            }
            Value::Object(_) if self.is_device() => "paper".to_owned(),
            Value::Object(choice) => choice
                .iter()
                .map(|(name, held)| match held {
                    Value::String(of) => format!("{name}:{of}"),
                    held => format!("{name}{held}"),
                })
                .collect(),
        }
    }

    fn write_layers(&self, value: &Value) -> String {
        let arrangement = value.get("arrangement").and_then(Value::as_str).unwrap_or_default().to_owned();
        let numbers = LAYER_NUMBERS.iter().filter_map(|place| value.pointer(&format!("/{place}")));
        numbers.fold(arrangement, |text, number| text + " " + &self.write(number))
    }

    /// What a number may be, and whether it is a whole one: what the check of a view says of one that is far too large.
    fn range(&self, view: &Value) -> Option<(Sentence, bool)> {
        let far = [Value::from(f64::MAX), Value::from(u32::MAX), Value::from(u8::MAX)];
        far.iter().find_map(|value| {
            let fault = self.with(view, value).ok()?.check().err()?;
            Some((self.allowed(&fault)?, matches!(fault.error, Some(ModelError::Count { .. }))))
        })
    }

    /// What this entry may be, where a view's fault is that it is out of its range.
    pub(super) fn allowed(&self, fault: &Fault) -> Option<Sentence> {
        let (field, range) = match fault.error.as_ref()? {
            ModelError::OutOfRange { field, minimum, maximum, unit, .. }
            | ModelError::NotFinite { field, minimum, maximum, unit } => {
                let (from, to) = (shortest(*minimum), shortest(*maximum));
                let range = match self.name.as_str() {
                    "resistance" => {
                        said("allowed are {from} to {to} ohm, or open", &[("from", &from), ("to", &to)])
                    }
                    "live.speed" => {
                        said("allowed are {from} to {to} periods a second", &[("from", &from), ("to", &to)])
                    }
                    _ => allowed(&from, &(to + unit)),
                };
                (field.as_str(), range)
            }
            ModelError::Count { field: "taylor degree", .. } => ("force", laws()),
            ModelError::Count { field, minimum, maximum, .. } => {
                let ends: [(&str, &dyn Say); 2] = [("from", minimum), ("to", maximum)];
                (*field, said("allowed are whole numbers from {from} to {to}", &ends))
            }
            _ => return None,
        };
        let own =
            self.is_part_of(fault.part) && (self.name == field || self.name.ends_with(&format!(".{field}")));
        own.then_some(range)
    }
}

fn insert(view: &mut Value, parent: &str, key: &str, value: Value) {
    if let Some(Value::Object(entries)) = view.pointer_mut(parent) {
        entries.insert(key.to_owned(), value);
    }
}

/// Layers as their entry gives them: the arrangement and its numbers.
fn layers(text: &str) -> Option<Value> {
    let mut words = text.split([' ', ',']).filter(|word| !word.is_empty());
    let arrangement = Value::from(words.next()?);
    let numbers: Vec<Value> = words.map(number).collect::<Option<_>>()?;
    if numbers.len() != LAYER_NUMBERS.len() && numbers.len() != WITHOUT_GLUE {
        return None;
    }
    let mut layers = Map::from_iter([("arrangement".to_owned(), arrangement)]);
    for (place, number) in LAYER_NUMBERS.iter().zip(numbers) {
        match place.split_once('/') {
            None => _ = layers.insert((*place).to_owned(), number),
            Some((layer, name)) => {
                let layer = layers.entry(layer).or_insert_with(|| Value::Object(Map::new()));
                _ = layer.as_object_mut()?.insert(name.to_owned(), number);
            }
        }
    }
    Some(Value::Object(layers))
}

/// A finite number.
fn number(text: &str) -> Option<Value> {
    let whole = || text.parse::<u64>().ok().map(Value::from);
    whole().or_else(|| text.parse().ok().filter(|number: &f64| number.is_finite()).map(Value::from))
}

fn laws() -> Sentence {
    said("allowed are quadratic, taylor2 to taylor{degree} and exact", &[("degree", &ForceLaw::MAX_DEGREE)])
}
