//! What has to follow motions for long: the paper's figures, verdicts, curves and basins, requests to every task, the
//! design bench, lessons.

#![allow(clippy::expect_used, clippy::unwrap_used, reason = "helpers of tests panic as tests do")]

mod basins;
mod bench;
mod bifurcation_curves;
mod branches;
mod continuation;
mod design;
mod edge;
mod figures;
mod floquet_boundaries;
mod forced_motion;
mod harvest;
#[cfg(feature = "app")]
mod lessons;
mod motions;
#[cfg(feature = "app")]
mod opening;
mod orbits;
mod requests;
mod shake;
mod tasks;
mod tips;
mod verdict;

use harvester_lab::questions::solve;
use serde_json::Value;

/// What a test gives back that fails by `?`, too.
type Fallible<T> = Result<T, Box<dyn std::error::Error>>;
type TestResult = Fallible<()>;

/// The paper's omega_1, omega_2 in 40-digit arithmetic, rounded to a double's digits.
const OMEGA_1: f64 = 4.04845139686289;
const OMEGA_2: f64 = 21.3562434253049;

/// The answer to a request.
fn answer(request: &Value) -> Value {
    let text = solve(&request.to_string()).unwrap_or_else(|message| panic!("{request}: {message}"));
    serde_json::from_str(&text).expect("an answer is JSON")
}

/// A number of an answer, NaN where there is none.
fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

/// A list of an answer, empty where there is none.
fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}
