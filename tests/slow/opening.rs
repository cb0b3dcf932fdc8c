//! What the page opens with: a motion that lasts, and goes on to do so while the frequency is dragged.

use harvester_lab::app::view::opening;
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::answer;

fn verdict(omega: f64) -> Value {
    let scenario = opening();
    let mut parameters = scenario.parameters;
    parameters.omega = omega;
    answer(&json!({"task": "verdict", "parameters": parameters, "model": scenario.model}))
}

#[test]
fn the_page_opens_with_a_doubled_motion_about_which_there_is_nothing_to_excuse() {
    let verdict = verdict(opening().parameters.omega);
    assert_eq!(verdict["motion"], json!({"kind": "periodic", "periods": 2}));
    assert_eq!(verdict["warnings"], json!([]));
}

#[test]
fn no_frequency_from_1_to_47_ends_the_motion_there() {
    let ended: Vec<_> = (0..=92)
        .into_par_iter()
        .map(|half| 1.0 + 0.5 * f64::from(half))
        .filter(|omega| ["escape", "contact"].iter().any(|end| verdict(*omega)["motion"]["kind"] == *end))
        .collect();
    assert!(ended.is_empty(), "{ended:?}");
}
