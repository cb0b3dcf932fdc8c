//! The page against the native core: same numbers, nearly the same speed, and how soon an answer is on the screen.

use std::thread::sleep;
use std::time::{Duration, Instant};

use harvester_lab::questions::{Run, solve};
use harvester_lab::scenario::Scenario;
use serde_json::Value;

use super::page::{Page, Theme};

/// Figure 4's run to the time of its reference state.
const FIGURE_4: &str = r#"{"task":"simulate","samples":2,"t_end":604.999982934,
    "parameters":{"alpha":1e-4,"beta":1e-2,"omega":25.4046948222}}"#;

/// Waits until what is shown answers the newest question.
fn settled(page: &mut Page) -> Value {
    page.wait_until("the answer to the newest question", |state| {
        state["status"] == "done" && state["generation"] == state["shown_generation"]
    })
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().into_iter().flatten().filter_map(Value::as_f64).collect()
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_moved_slider_shows_what_the_native_core_computes() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    page.call("load", r#"{"parameters":{"alpha":0.001,"beta":0.002}}"#).expect("a valid scenario");
    let before = settled(&mut page);
    let slider = page.slider("Frequency");
    let path: Vec<_> = (0..=12).map(|i| slider.at(0.5 + 0.02 * f64::from(i), 0.5)).collect();
    page.drag(&path, Duration::from_millis(8));
    page.wait_until("another question", |state| state["generation"] != before["generation"]);
    let state = settled(&mut page);
    let result = &state["result"];
    let scenario: Scenario = serde_json::from_value(result["scenario"].clone()).expect("a scenario");
    assert_ne!(serde_json::to_value(&scenario).expect("plain data"), before["result"]["scenario"]);
    let run = Run::compute(&scenario).expect("the scenario of the page is valid");
    let page_state = numbers(&result["final_state"]);
    assert_eq!(page_state.len(), run.trajectory.final_state().len());
    for (shown, native) in page_state.iter().zip(run.trajectory.final_state()) {
        assert!((shown - native).abs() <= 1e-9 * native.abs().max(1.0), "{shown} instead of {native}");
    }
    let (shown, native) =
        (result["summary"]["v_rms"].as_f64(), run.summary.map(|summary| summary.measures.v_rms));
    let (shown, native) = (shown.expect("the page has a voltage"), native.expect("so has the core"));
    assert!((shown / native - 1.0).abs() < 1e-9, "{shown} V rms instead of {native}");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn says_how_soon_a_moved_slider_is_answered_and_how_fast_the_page_computes() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    settled(&mut page);
    let slider = page.slider("Frequency");
    // The list of widgets costs time itself; the page stops making it soon after the last question.
    sleep(Duration::from_secs(2));
    let answered = |page: &Page| page.state()["frames_to_answer"].as_array().map_or(0, Vec::len);
    let before = answered(&page);
    // From omega = 5 to 45 on a track that reaches from 0.5 to 50.
    let fraction = |omega: f64| (omega - 0.5) / 49.5;
    let path: Vec<_> = (0..=200).map(|i| slider.at(fraction(5.0 + 0.2 * f64::from(i)), 0.5)).collect();
    page.drag(&path, Duration::from_millis(16));
    let state = settled(&mut page);
    let mut frames = numbers(&state["frames_to_answer"]).split_off(before);
    frames.sort_by(f64::total_cmp);
    assert!(!frames.is_empty(), "nothing was computed while the slider moved");
    let within = frames.iter().filter(|frames| **frames <= 2.0).count();
    println!(
        "answers: {} questions, {within} on the screen in the next frame or the one after",
        frames.len()
    );

    page.wait_until("the workers to be free", |state| {
        state["progress"].as_array().is_some_and(Vec::is_empty)
    });
    let request = Value::from(FIGURE_4).to_string();
    let script = format!(
        "return (async function() {{ const times = []; for (let i = 0; i < 9; i++) {{ const start = performance.now(); \
         await window.harvester.solve({request}); times.push(performance.now() - start); }} return times; }})()"
    );
    let in_page = numbers(&page.script(&script)).into_iter().fold(f64::INFINITY, f64::min);
    let native = (0..9).map(|_| {
        let start = Instant::now();
        solve(FIGURE_4).expect("Figure 4 is valid");
        start.elapsed().as_secs_f64() * 1e3
    });
    let native = native.fold(f64::INFINITY, f64::min);
    println!("Figure 4 to t = 605: {in_page:.2} ms in the page, {native:.2} ms natively (test profile)");
    page.close();
}
