//! The entries a link can have: where each stands in the JSON of a view, and what it may be.

use serde_json::{Map, Value};

use super::number;
use crate::app::lessons::STEPS;
use crate::app::view::View;
use crate::app::view::design::{FREQUENCIES, POWERS};
use crate::app::view::live::{KICKS, SPEEDS, WINDOWS};
use crate::dynamics::attractors::sweep::Dwell;
use crate::export::number::shortest;
use crate::model::{Dimension, ForceLaw, MAX_MODES, Parameter};
use crate::questions::find::GENERATIONS;
use crate::questions::input::one_of;
use crate::questions::sweep::COUNTS;
use crate::scenario::END_TIME;
use crate::sentence::{Say as _, Sentence, said};

/// Where the device's dimensions stand.
const DEVICE: &str = "/scenario/device";
/// What a limit may be.
const LIMITS: (f64, f64) = (1e-12, 1e12);
/// Left out of names: what stands there is known well enough by its last name.
const SILENT: [&str; 4] = ["/scenario/parameters/", "/scenario/model/", "/scenario/device/", "/scenario/"];

/// What an entry may be.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    /// A number in this range, with its unit.
    Number((f64, f64), &'static str),
    /// The load's resistance: a positive number, or `open`.
    Resistance,
    /// Excitation periods a second.
    Speed,
    /// A whole number in this range.
    Whole(usize, usize),
    /// `true` or `false`.
    Flag,
    /// A word; the view says which there are.
    Word,
    /// Two words.
    Words,
    /// Numbers in this range, as many as given or any number.
    Numbers(Option<usize>, (f64, f64)),
    /// `quadratic`, `exact`, or `taylor5` with its degree.
    Force,
    /// A word, or `threshold:first` with its resonance.
    Quantity,
    /// `paper`: the paper's device, so that it is known that there is one.
    Device,
}

/// An entry.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Field {
    /// Its name in links.
    pub name: String,
    /// Its place in the JSON of a view.
    pub pointer: String,
    kind: Kind,
}

/// All entries, in the order in which they are written.
pub(super) fn fields() -> Vec<Field> {
    let mut fields = Vec::new();
    let mut add = |pointer: &str, kind| {
        let known = SILENT.iter().find_map(|prefix| pointer.strip_prefix(prefix));
        let name = known.unwrap_or(pointer).trim_start_matches('/').replace('/', ".");
        fields.push(Field { name, pointer: pointer.to_owned(), kind });
    };
    for parameter in Parameter::ALL {
        let pointer = format!("/scenario/parameters/{}", parameter.field());
        add(&pointer, Kind::Number(parameter.range(), ""));
    }
    add("/scenario/model/modes", Kind::Whole(1, MAX_MODES));
    add("/scenario/model/force", Kind::Force);
    add("/scenario/model/residual_moment", Kind::Flag);
    add("/scenario/t_end", Kind::Number(END_TIME, ""));
    add("/scenario/initial", Kind::Numbers(None, (-1e6, 1e6)));
    for dimension in Dimension::ALL {
        let number = Kind::Number(dimension.range(), dimension.fact().unit);
        let kind = if dimension == Dimension::Resistance { Kind::Resistance } else { number };
        add(&format!("{DEVICE}/{}", dimension.field()), kind);
    }
    add("/scenario/device/repelling", Kind::Flag);
    add("/scenario/device/ceramic", Kind::Word);
    add(DEVICE, Kind::Device);
    add("/scenario/scaling", Kind::Word);
    add("/tab", Kind::Word);
    add("/map", Kind::Word);
    add("/layer", Kind::Word);
    add("/sweep/parameter", Kind::Word);
    add("/sweep/range", Kind::Numbers(Some(2), (f64::MIN, f64::MAX)));
    add("/sweep/count", Kind::Whole(COUNTS.0, COUNTS.1));
    add("/sweep/dwell/discarded", Kind::Whole(Dwell::DISCARDED.0, Dwell::DISCARDED.1));
    add("/sweep/dwell/kept", Kind::Whole(Dwell::KEPT.0, Dwell::KEPT.1));
    add("/sweep/output", Kind::Word);
    add("/plane", Kind::Words);
    add("/figure", Kind::Whole(2, 12));
    add("/enlarged", Kind::Word);
    add("/design/page", Kind::Word);
    add("/design/dimensionless", Kind::Flag);
    add("/design/holds_acceleration", Kind::Flag);
    add("/design/watched", Kind::Word);
    add("/design/logarithmic", Kind::Flag);
    add("/design/window", Kind::Numbers(Some(2), FREQUENCIES));
    add("/design/least", Kind::Number(POWERS, "W"));
    add("/design/limits/voltage", Kind::Numbers(Some(2), LIMITS));
    add("/design/limits/gap", Kind::Number((LIMITS.0, 1.0), ""));
    add("/design/limits/deflection", Kind::Number(LIMITS, ""));
    add("/design/limits/slope", Kind::Number(LIMITS, ""));
    add("/design/mode", Kind::Whole(1, MAX_MODES));
    add("/design/resonance", Kind::Word);
    add("/design/quantity", Kind::Quantity);
    add("/design/search/aim", Kind::Word);
    for side in ["sides/0", "sides/1", "third"] {
        add(&format!("/design/search/{side}/dimension"), Kind::Word);
        add(&format!("/design/search/{side}/range"), Kind::Numbers(Some(2), (0.0, f64::MAX)));
    }
    add("/design/search/generations", Kind::Whole(GENERATIONS.0, GENERATIONS.1));
    add("/live/trace", Kind::Word);
    add("/live/speed", Kind::Speed);
    add("/live/periods", Kind::Whole(WINDOWS.0, WINDOWS.1));
    add("/live/kick", Kind::Number(KICKS, ""));
    add("/lesson", Kind::Word);
    add("/step", Kind::Whole(1, STEPS));
    add("/lang", Kind::Word);
    add("/dark", Kind::Flag);
    add("/contrast", Kind::Flag);
    add("/projector", Kind::Flag);
    add("/beam_moves", Kind::Flag);
    fields
}

impl Field {
    /// Whether this says that there is a device.
    pub(super) fn is_device(&self) -> bool {
        self.kind == Kind::Device
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

    /// Whether a view, given as JSON, takes this value; otherwise what is allowed.
    pub(super) fn try_out(&self, mut view: Value, value: &Value) -> Result<(), Sentence> {
        self.set(&mut view, value);
        View::from_value(view).map(|_| ()).map_err(|error| {
            if error.allowed.is_empty() {
                return error.say();
            }
            let words = one_of(error.allowed.iter().map(|word| (*word).to_owned()));
            said("allowed are {words}", &[("words", &words)])
        })
    }

    /// A value as text.
    pub(super) fn write(&self, value: &Value) -> String {
        match value {
            Value::Null => "open".to_owned(),
            Value::Bool(flag) => flag.to_string(),
            Value::String(word) => word.clone(),
            Value::Number(number) if matches!(self.kind, Kind::Whole(..)) => number.to_string(),
            Value::Number(number) => shortest(number.as_f64().unwrap_or_default()),
            Value::Array(values) => {
                let texts: Vec<String> = values.iter().map(|value| self.write(value)).collect();
                texts.join(" ")
            }
            Value::Object(_) if self.is_device() => "paper".to_owned(),
            Value::Object(quantity) if self.kind == Kind::Quantity => quantity
                .iter()
                .map(|(name, of)| format!("{name}:{}", of.as_str().unwrap_or_default()))
                .collect(),
            Value::Object(law) => law.iter().map(|(name, degree)| format!("{name}{degree}")).collect(),
        }
    }

    /// Text as a value; otherwise what is wrong with it.
    pub(super) fn read(&self, text: &str) -> Result<Value, Sentence> {
        match self.kind {
            Kind::Number(range, unit) => number::read(text, range, &number::range(unit)).map(Value::from),
            Kind::Resistance if text == "open" => Ok(Value::Null),
            Kind::Resistance => {
                let allowed = |from: &str, to: &str| {
                    said("allowed are {from} to {to} ohm, or open", &[("from", &from), ("to", &to)])
                };
                number::read(text, Dimension::Resistance.range(), &allowed).map(Value::from)
            }
            Kind::Speed => {
                let allowed = |from: &str, to: &str| {
                    said("allowed are {from} to {to} periods a second", &[("from", &from), ("to", &to)])
                };
                number::read(text, SPEEDS, &allowed).map(Value::from)
            }
            Kind::Whole(minimum, maximum) => match text.trim().parse::<usize>() {
                Ok(value) if (minimum..=maximum).contains(&value) => Ok(Value::from(value)),
                _ => Err(said(
                    "allowed are whole numbers from {from} to {to}",
                    &[("from", &minimum), ("to", &maximum)],
                )),
            },
            Kind::Flag => match text {
                "true" => Ok(Value::Bool(true)),
                "false" => Ok(Value::Bool(false)),
                _ => Err(said("allowed are true and false", &[])),
            },
            Kind::Word => Ok(Value::from(text)),
            Kind::Words => Ok(words(text).map(Value::from).collect()),
            Kind::Numbers(count, range) => {
                let allowed = number::range("");
                let numbers: Result<Vec<f64>, Sentence> =
                    words(text).map(|word| number::read(word, range, &allowed)).collect();
                match (numbers?, count) {
                    (numbers, Some(count)) if numbers.len() != count => {
                        Err(said("needs {count} numbers", &[("count", &count)]))
                    }
                    (numbers, _) => Ok(Value::from(numbers)),
                }
            }
            Kind::Force => force(text),
            Kind::Quantity => Ok(match text.split_once(':') {
                Some((name, of)) => Value::Object(Map::from_iter([(name.to_owned(), Value::from(of))])),
                None => Value::from(text),
            }),
            Kind::Device if text == "paper" => Ok(Value::Object(Map::new())),
            Kind::Device => Err(said("allowed is {word}", &[("word", &"paper")])),
        }
    }
}

fn insert(view: &mut Value, parent: &str, key: &str, value: Value) {
    if let Some(Value::Object(entries)) = view.pointer_mut(parent) {
        entries.insert(key.to_owned(), value);
    }
}

/// Blanks or commas may stand between the parts of a list.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split([' ', ',']).filter(|word| !word.is_empty())
}

fn force(text: &str) -> Result<Value, Sentence> {
    if matches!(text, "quadratic" | "exact") {
        return Ok(Value::from(text));
    }
    let degree = text.strip_prefix("taylor").and_then(|degree| degree.parse().ok()).map(ForceLaw::Taylor);
    match degree.map(ForceLaw::validate) {
        Some(Ok(ForceLaw::Taylor(degree))) => {
            Ok(Value::Object(Map::from_iter([("taylor".to_owned(), Value::from(degree))])))
        }
        _ => Err(said(
            "allowed are quadratic, taylor2 to taylor{degree} and exact",
            &[("degree", &ForceLaw::MAX_DEGREE)],
        )),
    }
}
