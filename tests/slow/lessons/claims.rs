//! Numbers in the texts with the request whose answer they are, put to the solver.

use std::collections::BTreeMap;
use std::sync::Mutex;

use harvester_lab::app::lessons::LessonId;
use harvester_lab::questions;
use rayon::prelude::*;
use serde::Deserialize;
use serde_json::Value;

use super::{steps, texts};

/// A number in a text, and the request whose answer it is.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Claim {
    /// The number as it stands in the text, or a word for it.
    pub(super) says: String,
    pub(super) request: Value,
    /// Where the value stands in the answer.
    at: String,
    /// Multiplies it.
    times: Option<f64>,
    /// Is added: a number, or another term.
    plus: Option<Value>,
    /// Divides it.
    over: Option<Term>,
    /// What it is, when that is not what is said.
    value: Option<f64>,
    /// How far it may be off; half a unit of the last digit of what is said when absent.
    tolerance: Option<f64>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct Term {
    request: Value,
    at: String,
    times: Option<f64>,
}

/// Answers, each computed once.
#[derive(Default)]
struct Solver(Mutex<BTreeMap<String, Value>>);

impl Solver {
    fn number(&self, request: &Value, at: &str) -> Result<f64, String> {
        let text = request.to_string();
        let known = self.0.lock().map_err(|_| "a panic elsewhere")?.get(&text).cloned();
        let answer = match known {
            Some(answer) => answer,
            None => {
                let answer: Value =
                    serde_json::from_str(&questions::solve(&text)?).map_err(|error| error.to_string())?;
                self.0.lock().map_err(|_| "a panic elsewhere")?.insert(text, answer.clone());
                answer
            }
        };
        answer.pointer(at).and_then(Value::as_f64).ok_or_else(|| format!("no number at {at} of {request}"))
    }

    fn value(&self, claim: &Claim) -> Result<f64, String> {
        let mut value = self.number(&claim.request, &claim.at)? * claim.times.unwrap_or(1.0);
        if let Some(over) = &claim.over {
            value /= self.number(&over.request, &over.at)? * over.times.unwrap_or(1.0);
        }
        if let Some(plus) = &claim.plus {
            value += match plus.as_f64() {
                Some(number) => number,
                None => {
                    let term = Term::deserialize(plus).map_err(|error| error.to_string())?;
                    self.number(&term.request, &term.at)? * term.times.unwrap_or(1.0)
                }
            };
        }
        Ok(value)
    }
}

/// A number as printed, and half a unit of its last digit.
pub(super) fn printed(text: &str) -> Option<(f64, f64)> {
    let digits = text.split_once('.').map_or(0, |(_, digits)| digits.len());
    let value = text.replace('−', "-").parse().ok()?;
    Some((value, 0.5 * 10.0_f64.powi(-i32::try_from(digits).ok()?)))
}

/// What a step claims.
pub(super) fn claims(id: LessonId, step: usize) -> Vec<Claim> {
    let lesson: Value = serde_json::from_str(id.source()).expect("JSON");
    let claims = lesson["steps"][step - 1].get("claims").cloned().unwrap_or_else(|| Value::Array(Vec::new()));
    questions::input::fields(&claims).unwrap_or_else(|error| panic!("{id}, step {step}: {error}"))
}

#[test]
fn every_claim_is_what_the_solver_answers() {
    let solver = Solver::default();
    let mut all = Vec::new();
    for (place, id, step, _, number) in steps() {
        let whole: Vec<&str> = texts(step).iter().map(|(_, text)| text["en"].as_str()).collect();
        for claim in claims(id, number) {
            assert!(whole.join("\n").contains(&claim.says), "{place} does not say {}", claim.says);
            all.push((place.clone(), claim));
        }
    }
    assert!(all.len() > 100, "{} claims", all.len());
    let failures: Vec<String> = all
        .into_par_iter()
        .filter_map(|(place, claim)| {
            let printed = printed(&claim.says);
            let wanted = claim.value.or(printed.map(|(value, _)| value));
            let tolerance = claim.tolerance.or(printed.map(|(_, half)| half));
            let (Some(wanted), Some(tolerance)) = (wanted, tolerance) else {
                return Some(format!("{place}: {} needs a value and a tolerance", claim.says));
            };
            match solver.value(&claim) {
                // Half a unit, less or more by rounding.
                Ok(value) if (value - wanted).abs() <= tolerance * (1.0 + 1e-9) => None,
                Ok(value) => Some(format!("{place} says {}, but it is {value}", claim.says)),
                Err(why) => Some(format!("{place}: {}: {why}", claim.says)),
            }
        })
        .collect();
    assert!(failures.is_empty(), "{failures:#?}");
}
