//! What is known of the page and of the motion in view, and the conditions that goals set on it.
//!
//! Facts are one JSON value: `view` as stored, `verdict` as the solver answers, and `theory`: at the frequency in view,
//! `over_published` and `over_coupled` are the excitation over the boundary of either theory, near a resonance.

use serde_json::{Value, json};

use crate::app::map::{Boundaries, Structure};
use crate::app::view::View;
use crate::dynamics::Verdict;
use crate::questions::inspection;

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
            Some(wanted) => wanted == fact,
        };
        within && same
    }
}

/// The facts of a page that shows `view`, with the boundaries of its structure and the verdict on its scenario once they
/// are there.
pub(in crate::app) fn facts(
    view: &View,
    boundaries: Option<&Boundaries>,
    verdict: Option<&Verdict>,
) -> Value {
    let over = |boundary: Option<f64>| boundary.map(|beta| view.scenario.parameters.beta / beta);
    let omega = view.scenario.parameters.omega;
    let near = boundaries.and_then(|found| Some((found, found.resonance_near(omega)?)));
    let published = near.and_then(|(found, near)| found.published.as_ref()?.boundary(near, omega));
    let coupled = near.and_then(|(found, near)| found.coupled.as_ref()?.boundary(near, omega));
    // By way of text: another serialiser would weigh more.
    let verdict = verdict.and_then(|verdict| serde_json::to_string(verdict).ok());
    let verdict: Value = verdict.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default();
    json!({
        "view": view.to_value(),
        "verdict": verdict,
        "theory": { "over_published": over(published), "over_coupled": over(coupled) },
    })
}

/// The facts with the verdict computed at once, as a page would know them after a while.
///
/// # Errors
/// One line when the scenario cannot be computed.
pub fn facts_at_once(view: &View) -> Result<Value, String> {
    let (system, _) = view.scenario.validate().map_err(|error| error.to_string())?;
    let boundaries = Boundaries::new(Structure::of(&view.scenario), &system);
    let found = inspection::inspect(&view.scenario).map_err(|error| error.to_string())?;
    Ok(facts(view, Some(&boundaries), Some(&found.verdict)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn holds(condition: &str, facts: &Value) -> bool {
        let condition: Value = serde_json::from_str(condition).expect("JSON");
        Condition::read(&condition).expect("a condition").holds(facts)
    }

    #[test]
    fn a_condition_is_on_a_number_a_word_or_a_flag_and_what_is_unknown_fulfils_none() {
        let facts = json!({ "a": { "number": 2.5, "word": "torus", "flag": false, "nothing": null } });
        for (condition, expected) in [
            (r#"{"at":"/a/number","from":2.5}"#, true),
            (r#"{"at":"/a/number","from":2.6}"#, false),
            (r#"{"at":"/a/number","from":2,"to":3}"#, true),
            (r#"{"at":"/a/number","to":2.4}"#, false),
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

    #[test]
    fn the_facts_hold_view_verdict_and_theory() {
        // Figure 9, with the numbers of an independent program.
        let facts = facts_at_once(&View::default()).expect("facts");
        for condition in [
            r#"{"at":"/view/scenario/parameters/beta","is":0.01}"#,
            r#"{"at":"/view/tab","is":"explore"}"#,
            r#"{"at":"/verdict/motion/kind","is":"periodic"}"#,
            r#"{"at":"/verdict/motion/periods","is":2}"#,
            r#"{"at":"/verdict/forced/multiplier/modulus","from":1.1482,"to":1.1486}"#,
            r#"{"at":"/theory/over_coupled","from":6.02,"to":6.05}"#,
            r#"{"at":"/theory/over_published","from":100}"#,
        ] {
            assert!(holds(condition, &facts), "{condition}");
        }
        // Far from any resonance the theories say nothing.
        let mut view = View::default();
        view.scenario.parameters.omega = 15.0;
        let facts = facts_at_once(&view).expect("facts");
        assert!(!holds(r#"{"at":"/theory/over_coupled","from":0}"#, &facts));
    }
}
