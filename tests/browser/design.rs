//! The Design tab in the built page.

use std::time::Duration;

use serde_json::Value;

use crate::page::{Page, Theme};

/// Longest frame (ms, logic and layout) while a file is read: nobody notices a quarter of a second once.
const LONGEST_FRAME: f64 = 250.0;

/// Drops a file of so many rows of time and voltage on the page.
const DROP: &str = "
    const rows = ['time [ms],voltage [V]'];
    for (let i = 0; i < arguments[0]; i += 1) rows.push(`${(i * 0.01).toFixed(2)},${(20 * Math.sin(i * 1e-4)).toFixed(4)}`);
    const data = new DataTransfer();
    data.items.add(new File([rows.join('\\n')], 'run.csv', { type: 'text/csv' }));
    const drop = new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true });
    document.getElementById('canvas').dispatchEvent(drop);
";

fn click(page: &mut Page, label: &str) {
    let control = page.find(label, &[]);
    page.click(control.at(0.5, 0.5));
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_million_measured_rows_open_while_the_page_goes_on() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    let count = |page: &Page| page.frames()["count"].as_u64().unwrap_or_default() as usize;
    let before = count(&page);
    page.script_with(DROP, vec![Value::from(1_000_000)]);
    page.find("1000000 rows read", &[]);
    let drawn = count(&page) - before;
    let frames = page.frames();
    let times = frames["cpu_ms"].as_array().into_iter().flatten().rev().take(drawn).filter_map(Value::as_f64);
    let longest = times.fold(0.0, f64::max);
    println!("a million rows: {drawn} frames, the longest {longest:.1} ms");
    page.screenshot("design-measured");
    assert!(longest < LONGEST_FRAME, "a frame took {longest} ms");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_device_out_of_its_limits_is_called_unsafe_and_the_search_finds_a_better_one() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    click(&mut page, "Design");
    page.find("Limits: model not valid", &[]);
    let json = r#"{"scenario":{"parameters":{"alpha":1e-4,"beta":0.01,"omega":8.0969}},"tab":"design",
        "design":{"limits":{"voltage":[20.0,20.0]},"watched":"peak"}}"#;
    page.call("load", json).expect("a view");
    page.find("Limits: unsafe", &[]);
    std::thread::sleep(Duration::from_secs(6));
    page.screenshot("design-unsafe");
    click(&mut page, "Search");
    click(&mut page, "Find the best within the limits");
    page.wait("a candidate within the limits", |page| {
        let found = page.controls().into_iter().find(|control| control.label.starts_with("best of "))?;
        found.label.ends_with("within the limits").then_some(())
    });
    page.screenshot("design-found");
    click(&mut page, "Stop");
    page.wait_until("the search to end", |state| {
        state["progress"].as_array().is_some_and(|lanes| lanes.iter().all(|lane| lane[0] != "find"))
    });
    click(&mut page, "Use it");
    let state = page.wait_until("another device", |state| state["view"]["scenario"]["device"].is_object());
    assert_ne!(state["view"]["scenario"]["parameters"]["kappa"], 1e-6);
    page.find("Limits: model not valid", &[]);
    page.close();
}

/// Waits until nothing is being computed.
fn rest(page: &mut Page) {
    std::thread::sleep(Duration::from_millis(600));
    page.wait_until("the curves", |state| state["progress"].as_array().is_some_and(Vec::is_empty));
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn one_sentence_answers_first_and_the_frequency_has_a_logarithmic_axis() {
    let mut page = Page::open(1440, 900, Theme::Light);
    page.call("load", r#"{"scenario":{"parameters":{"omega":4.0,"beta":1e-4}},"tab":"design"}"#)
        .expect("a view");
    click(&mut page, "all resonances");
    click(&mut page, "Scale of the frequency: log");
    page.wait_until("the axis", |state| state["view"]["design"]["logarithmic_frequency"] == true);
    rest(&mut page);
    let said = page.find("Shaken at ", &[]).label.replace('\u{a0}', " ");
    for part in [" it gives ", " Hz into 7.63 MΩ", " or more from ", "; without magnets "] {
        assert!(said.contains(part), "{said}: {part}");
    }
    page.screenshot("design-logarithmic");
    page.resize(360, 2400, Theme::Dark);
    std::thread::sleep(Duration::from_secs(1));
    page.find("Shaken at ", &[]);
    page.screenshot("design-logarithmic-phone");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn pinned_variants_stand_side_by_side_and_come_back_with_the_page() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    let view = |kappa: f64, c0: f64| {
        format!(
            r#"{{"scenario":{{"parameters":{{"omega":4.0,"beta":1e-4,"kappa":{kappa},"c0":{c0}}},"model":{{"force":"exact"}}}},
            "tab":"design","design":{{"page":"variants","window":[1.1,1.6]}}}}"#
        )
    };
    for (name, kappa, c0) in [("A", 1e-6, 0.5084), ("B", 4e-6, 0.5084), ("C", 1e-6, 0.4), ("D", 1e-6, 0.0)] {
        page.call("load", &view(kappa, c0)).expect("a view");
        rest(&mut page);
        click(&mut page, "Pin this design");
        page.find(&format!("Remove {name}"), &["Button"]);
    }
    page.call("load", &view(2e-6, 0.45)).expect("a view");
    rest(&mut page);
    page.find("load resistance", &[]);
    page.screenshot("design-variants");
    page.resize(360, 3000, Theme::Light);
    std::thread::sleep(Duration::from_secs(1));
    page.find("Remove D", &["Button"]);
    page.screenshot("design-variants-phone");
    page.resize(1440, 900, Theme::Light);
    page.reload();
    click(&mut page, "Make C the present design");
    let state = page.wait_until("the third", |state| state["view"]["scenario"]["parameters"]["c0"] == 0.4);
    assert_eq!(state["view"]["scenario"]["parameters"]["kappa"], 1e-6);
    rest(&mut page);
    page.screenshot("design-variants-restored");
    page.close();
}
