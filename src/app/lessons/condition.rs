//! The conditions that goals set on facts (see [`super::facts`]).

use serde_json::Value;

/// A condition on one fact. What is not known fulfils none.
#[derive(Debug, Clone, PartialEq)]
pub struct Condition {
    /// Where the fact stands, as a JSON pointer such as `/view/scenario/parameters/beta`.
    pub at: String,
    /// The number may not be lower.
    pub from: Option<f64>,
    /// The number may not be higher.
    pub to: Option<f64>,
    /// The word, number or flag that it must be, or a list of those that it may be.
    pub is: Option<Value>,
}

impl Condition {
    /// Reads a condition; `None` when it names no fact, or has an entry that there is not.
    pub(super) fn read(value: &Value) -> Option<Self> {
        let entries = value.as_object()?;
        if entries.keys().any(|name| !["at", "from", "to", "is"].contains(&name.as_str())) {
            return None;
        }
        let number = |name| value.get(name).and_then(Value::as_f64);
        let at = value["at"].as_str()?.to_owned();
        Some(Self { at, from: number("from"), to: number("to"), is: value.get("is").cloned() })
    }

    /// Whether it holds.
    pub fn holds(&self, facts: &Value) -> bool {
        let Some(fact) = facts.pointer(&self.at).filter(|fact| !fact.is_null()) else { return false };
        let within = match (self.from, self.to) {
            (None, None) => true,
            (from, to) => fact.as_f64().is_some_and(|number| {
                from.is_none_or(|from| number >= from) && to.is_none_or(|to| number <= to)
            }),
        };
        let same = match &self.is {
            None => true,
            Some(Value::Array(allowed)) => allowed.contains(fact),
            // A whole number is also one with a point.
            Some(wanted) => {
                wanted == fact || wanted.as_f64().is_some_and(|number| fact.as_f64() == Some(number))
            }
        };
        within && same
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use serde_json::json;

    pub(in crate::app::lessons) fn holds(condition: &str, facts: &Value) -> bool {
        let condition: Value = serde_json::from_str(condition).expect("JSON");
        Condition::read(&condition).expect("a condition").holds(facts)
    }

    #[test]
    fn a_condition_is_on_a_number_a_word_or_a_flag_and_what_is_unknown_fulfils_none() {
        let facts =
            json!({ "a": { "number": 2.5, "whole": 10.0, "word": "torus", "flag": false, "nothing": null } });
        for (condition, expected) in [
            (r#"{"at":"/a/number","from":2.5}"#, true),
            (r#"{"at":"/a/number","from":2.6}"#, false),
            (r#"{"at":"/a/number","from":2,"to":3}"#, true),
            (r#"{"at":"/a/number","to":2.4}"#, false),
            (r#"{"at":"/a/whole","is":10}"#, true),
            (r#"{"at":"/a/whole","is":11}"#, false),
            (r#"{"at":"/a/word","from":0}"#, false),
            (r#"{"at":"/a/word","is":"torus"}"#, true),
            (r#"{"at":"/a/word","is":["other","torus"]}"#, true),
            (r#"{"at":"/a/word","is":["other"]}"#, false),
            (r#"{"at":"/a/flag","is":false}"#, true),
            (r#"{"at":"/a/flag","is":true}"#, false),
            (r#"{"at":"/a/nothing"}"#, false),
            (r#"{"at":"/b","from":0}"#, false),
        ] {
            assert_eq!(holds(condition, &facts), expected, "{condition}");
        }
    }
}
