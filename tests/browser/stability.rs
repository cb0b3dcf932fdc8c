//! What the workers do for the page: boundaries, charts, verdicts; at their own pace, and through the death of one.

use std::{thread::sleep, time::Duration};

use serde_json::{Value, json};

use crate::page::{Page, Theme};

/// Opens a tab.
fn open_tab(page: &mut Page, name: &str) {
    let tab = page.find(name, &["Tab"]);
    page.click(tab.at(0.5, 0.5));
}

/// Done part of what is under way in a lane; `None` when nothing is.
fn progress(state: &Value, lane: &str) -> Option<f64> {
    let lanes = state["progress"].as_array().into_iter().flatten();
    lanes.clone().find(|entry| entry[0] == lane).and_then(|entry| entry[1].as_f64())
}

/// Done part of a chart of motions or of basins that is its first picture: every fourth column and row.
const SKETCH: f64 = 0.0624;

/// Loads a scenario and lets the page itself look, every few milliseconds, what `lane` makes of it: milliseconds until
/// its first picture, which is so large a part of it, and until it has nothing left to do.
fn time_lane(page: &Page, scenario: &Value, lane: &str, picture: f64) -> (f64, f64) {
    const WATCH: &str = "return (async (scenario, lane, picture) => {
        const { load, state, frames } = window.harvester;
        const drawn = () => JSON.parse(frames()).count;
        const [begin, before] = [performance.now(), drawn()];
        load(scenario);
        for (let seen = false, first = null; ;) {
            const now = performance.now() - begin;
            const { progress, status } = JSON.parse(state());
            const entry = progress.find(([name]) => name === lane);
            seen ||= Boolean(entry);
            if (first === null && (entry ? entry[1] >= picture : seen)) first = now;
            const overlooked = status === 'done' && drawn() >= before + 3;
            if (!entry && (seen || overlooked)) return [first ?? now, now];
            if (now > 60000) return [null, null];
            await new Promise((resume) => setTimeout(resume, 4));
        }
    })(...arguments)";
    let answer = page.script_with(WATCH, vec![json!(scenario.to_string()), json!(lane), json!(picture)]);
    let time = |i: usize| answer[i].as_f64().expect("an end within a minute");
    (time(0), time(1))
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn boundaries_and_charts_are_there_soon() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    page.wait_until("the first verdict", |state| !state["verdict"].is_null());
    for alpha in [1.01e-4, 1e-3] {
        let scenario = json!({ "parameters": { "alpha": alpha, "beta": 0.01, "omega": 8.0969 } });
        let (_, took) = time_lane(&page, &scenario, "tongues", 0.02);
        println!("three exact tongues at alpha = {alpha}: {took:.0} ms");
    }
    open_tab(&mut page, "Stability");
    page.wait_until("the chart to begin", |state| progress(state, "multipliers").is_some());
    page.wait_until("the chart to end", |state| progress(state, "multipliers").is_none());
    let scenario = json!({ "parameters": { "alpha": 2e-4, "beta": 0.01, "omega": 8.0969 } });
    let (first, complete) = time_lane(&page, &scenario, "multipliers", 0.0199);
    println!(
        "chart of 256 x 256 multipliers: first picture after {first:.0} ms, complete after {complete:.0} ms"
    );
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn basins_are_there_soon_and_end_after_the_point_has_moved() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    open_tab(&mut page, "Stability");
    for lane in ["multipliers", "basin"] {
        page.wait_until("the tab to be computed", |state| progress(state, lane).is_none());
    }
    for beta in [0.004, 0.008] {
        let scenario = json!({ "parameters": { "alpha": 2e-4, "beta": beta, "omega": 8.0969 } });
        let (first, whole) = time_lane(&page, &scenario, "basin", SKETCH);
        println!(
            "basins of 64 x 64 starts at beta = {beta}: 16 x 16 after {first:.0} ms, all after {whole:.0} ms"
        );
    }
    let (x, y) = page.find("Operating point", &["Button"]).at(0.5, 0.5);
    let path: Vec<(f64, f64)> = (0..=150)
        .map(|i| f64::from(i) / 25.0)
        .map(|t| (x + 40.0 * t.sin(), y - 15.0 * (1.7 * t).sin().abs()))
        .collect();
    let times = frames_while(&mut page, |page| page.drag(&path, Duration::from_millis(20)));
    print_frames("while basins follow the hand", &times);
    page.wait_until("the basins to end", |state| progress(state, "basin").is_none());
    page.close();
}

/// Processor times (ms) of the frames drawn while something is done, ascending.
fn frames_while(page: &mut Page, act: impl FnOnce(&mut Page)) -> Vec<f64> {
    let count = |page: &Page| page.frames()["count"].as_u64().unwrap_or_default() as usize;
    let before = count(page);
    act(page);
    let drawn = count(page) - before;
    let frames = page.frames();
    let times = frames["cpu_ms"].as_array().into_iter().flatten().rev().take(drawn);
    let mut times: Vec<f64> = times.filter_map(Value::as_f64).collect();
    times.sort_by(f64::total_cmp);
    times
}

fn print_frames(what: &str, times: &[f64]) {
    let at = |share: f64| times[((times.len() - 1) as f64 * share).round() as usize];
    println!(
        "frames {what}, {} frames: p50 {:.2} ms, p95 {:.2} ms, max {:.2} ms",
        times.len(),
        at(0.5),
        at(0.95),
        at(1.0)
    );
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn the_point_can_be_dragged_while_a_chart_is_computed() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    open_tab(&mut page, "Stability");
    page.wait_until("the chart to begin", |state| progress(state, "multipliers").is_some());
    let point = page.find("Operating point", &["Button"]);
    sleep(Duration::from_secs(2));
    // A new device: the chart begins again while the hand moves.
    let scenario = json!({ "parameters": { "alpha": 3e-4, "beta": 0.01, "omega": 8.0969 } });
    page.call("load", &scenario.to_string()).expect("a scenario");
    let (x, y) = point.at(0.5, 0.5);
    let path: Vec<(f64, f64)> = (0..=150)
        .map(|i| f64::from(i) / 25.0)
        .map(|t| (x + 60.0 * t.sin(), y - 20.0 * (1.7 * t).sin()))
        .collect();
    let times = frames_while(&mut page, |page| page.drag(&path, Duration::from_millis(10)));
    print_frames("while a chart is computed", &times);
    page.wait_until("the chart to end", |state| progress(state, "multipliers").is_none());
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_worker_that_dies_is_replaced_and_its_work_done() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    // Keeps hold of the page's workers from the next load on.
    let spy = "window.hired = []; \
               window.Worker = class extends Worker { constructor(...a) { super(...a); window.hired.push(this); } };";
    page.before_each_load(spy);
    page.reload();
    page.wait_until("the first verdict", |state| !state["verdict"].is_null());
    open_tab(&mut page, "Stability");
    page.wait_until("the chart to begin", |state| progress(state, "multipliers").is_some());
    let hired = page.script("return window.hired.length").as_u64().expect("a number");
    assert!(hired >= 2, "{hired} workers");
    page.script("for (const worker of [...window.hired]) { worker.terminate(); worker.dispatchEvent(new ErrorEvent('error')); }");
    page.wait_until("the chart to end", |state| progress(state, "multipliers").is_none());
    let later = page.script("return window.hired.length").as_u64().expect("a number");
    assert_eq!(later, 2 * hired);
    let answer = page.call("solve", r#"{"task":"modes"}"#).expect("an answer");
    assert!(answer.as_str().is_some_and(|text| text.contains("A_e")), "{answer}");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn the_verdict_of_figure_4_knows_of_the_other_motion() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    let scenario = json!({ "parameters": { "alpha": 1e-4, "beta": 0.01, "omega": 25.4047 }, "t_end": 605 });
    page.call("load", &scenario.to_string()).expect("a scenario");
    let state = page.wait_until("the verdict", |state| {
        state["verdict"]["motion"]["kind"].is_string()
            && state["status"] == "done"
            && state["view"]["scenario"]["parameters"]["omega"] == 25.4047
    });
    let verdict = &state["verdict"];
    assert_eq!(verdict["motion"]["kind"], "quasiperiodic", "{verdict}");
    // An independent program's multiplier of the small forced motion.
    let modulus = verdict["forced"]["multiplier"]["modulus"].as_f64().expect("a modulus");
    assert!((modulus - 0.999378).abs() < 1e-6, "{modulus}");
    assert_eq!(verdict["coexists"][0]["motion"]["periods"], 1, "{verdict}");
    page.close();
}
