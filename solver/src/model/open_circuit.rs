//! An infinite resistance in JSON, which has no infinity: null.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

pub(super) fn serialize<S: Serializer>(resistance: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    resistance.is_finite().then_some(*resistance).serialize(serializer)
}

pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Option::<f64>::deserialize(deserializer).map(|resistance| resistance.unwrap_or(f64::INFINITY))
}
