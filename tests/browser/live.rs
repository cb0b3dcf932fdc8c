//! The Live tab in the built page.

use std::{thread::sleep, time::Duration};

use crate::{
    drag_slider, number,
    page::{Page, Theme},
};

fn click(page: &mut Page, label: &str) {
    let control = page.find(label, &["Button", "CheckBox", "Tab", "RadioButton"]);
    page.click(control.at(0.5, 0.5));
}

/// The number on the tile of periods.
fn periods(page: &mut Page) -> f64 {
    let tile = page.find("Periods: ", &["Label"]);
    tile.label.trim_start_matches("Periods: ").trim().parse().expect("a number of periods")
}

/// What the sound card was given: how many samples, and how loud they were.
const LISTEN: &str = "
    window.heard = { samples: 0, most: 0 };
    const play = globalThis.harvesterPlay;
    globalThis.harvesterPlay = (samples, rate) => {
        heard.samples += samples.length;
        for (const sample of samples) heard.most = Math.max(heard.most, Math.abs(sample));
        play(samples, rate);
    };
";

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn time_goes_on_while_a_slider_is_dragged() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    let json = r#"{"parameters":{"alpha":1e-4,"beta":0.01,"omega":8.0969}}"#;
    page.call("load", json).expect("a scenario");
    click(&mut page, "Live");
    page.wait_until("the tab", |state| state["view"]["tab"] == "live");
    let begun = periods(&mut page);
    sleep(Duration::from_secs(2));
    let later = periods(&mut page);
    assert!(later > begun + 1.0, "{begun} {later}");

    // A drag changes the numbers on the way, and the run neither stops nor starts again.
    let damping = number(&mut page, "Damping");
    drag_slider(&mut page, "Damping", 0.4, 0.6, 60);
    page.wait("another damping", |page| (number(page, "Damping") > damping).then_some(()));
    let dragged = periods(&mut page);
    assert!(dragged > later, "{later} {dragged}");
    page.screenshot("live-dragged");

    click(&mut page, "Pause");
    page.find("Run", &["Button"]);
    let paused = periods(&mut page);
    sleep(Duration::from_millis(500));
    assert_eq!(periods(&mut page), paused);
    click(&mut page, "Step a period");
    page.wait("a period", |page| ((periods(page) - paused - 1.0).abs() < 0.15).then_some(()));
    click(&mut page, "Kick up");
    click(&mut page, "Run");
    page.wait("the run to go on", |page| (periods(page) > paused + 1.5).then_some(()));

    // The link has the speed, the undo has the drag and no more.
    let undone = page.script("return harvester.undo()");
    println!("undo: {undone}");
    page.wait("the old damping", |page| (number(page, "Damping") == damping).then_some(()));
    click(&mut page, "From rest");
    page.wait("a new start", |page| (periods(page) < paused).then_some(()));
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn the_voltage_is_heard_when_asked_for_and_not_before() {
    let mut page = Page::open(1440, 900, Theme::Light);
    page.script(LISTEN);
    let json = r#"{"scenario":{"parameters":{"alpha":1e-4,"beta":0.01,"omega":8.0969}},"tab":"live"}"#;
    page.call("load", json).expect("a view");
    sleep(Duration::from_secs(1));
    assert_eq!(page.script("return heard.samples"), 0);
    click(&mut page, "Sound");
    click(&mut page, "110 periods/s");
    page.wait_until("the speed", |state| state["view"]["live"]["speed"] == 110.0);
    sleep(Duration::from_secs(1));
    let samples = |page: &Page| page.script("return heard.samples").as_f64().unwrap_or_default();
    let before = samples(&page);
    sleep(Duration::from_secs(2));
    let rate = 0.5 * (samples(&page) - before);
    let most = page.script("return heard.most").as_f64().unwrap_or_default();
    println!("sound: {rate:.0} samples a second, at most {most:.2}");
    assert!((15_000.0..30_000.0).contains(&rate) && (0.05..=1.0).contains(&most));
    page.screenshot("live-sound");
    click(&mut page, "Sound");
    sleep(Duration::from_millis(300));
    let before = samples(&page);
    sleep(Duration::from_millis(500));
    assert_eq!(samples(&page), before);
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn an_escape_is_said_in_words_and_can_be_started_again() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    let json = r#"{"scenario":{"parameters":{"alpha":1e-4,"beta":0.01,"omega":42.7125}},"tab":"live",
        "live":{"speed":20.0}}"#;
    page.call("load", json).expect("a view");
    page.find("The tip escaped at t = ", &[]);
    page.screenshot("live-escape");
    click(&mut page, "Start again from rest");
    page.find("The tip escaped at t = ", &[]);
    page.close();
}
