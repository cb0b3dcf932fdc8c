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

/// The number on the tile of periods, once it is drawn.
fn seen(page: &Page) -> Option<f64> {
    let controls = page.controls();
    let tile = controls.iter().find_map(|control| control.label.strip_prefix("Periods: "))?;
    tile.trim().parse().ok()
}

fn periods(page: &mut Page) -> f64 {
    page.wait("the number of periods", seen)
}

/// Waits until the number of periods is as wanted.
fn wait_for(page: &mut Page, what: &str, wanted: impl Fn(f64) -> bool) {
    page.wait(what, |page| seen(page).filter(|periods| wanted(*periods)));
}

/// What the slider of the damping shows, once it is as wanted.
fn wait_damping(page: &mut Page, wanted: impl Fn(f64) -> bool) {
    page.wait("the damping", |page| {
        let slider = page.controls().into_iter().find(|it| it.role == "Slider" && it.label == "Damping")?;
        slider.number.filter(|damping| wanted(*damping))
    });
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
    page.let_move();
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
    wait_damping(&mut page, |now| now > damping);
    let dragged = periods(&mut page);
    assert!(dragged > later, "{later} {dragged}");
    page.screenshot("live-dragged");

    click(&mut page, "Pause");
    page.find("Run", &["Button"]);
    let paused = periods(&mut page);
    sleep(Duration::from_millis(500));
    assert_eq!(periods(&mut page), paused);
    click(&mut page, "Step a period");
    wait_for(&mut page, "a period", |now| (now - paused - 1.0).abs() < 0.15);
    click(&mut page, "Kick up");
    click(&mut page, "Run");
    wait_for(&mut page, "the run to go on", |now| now > paused + 1.5);

    // The whole drag is one step, and the run made none.
    page.script("harvester.undo()");
    wait_damping(&mut page, |now| now == damping);
    click(&mut page, "From rest");
    wait_for(&mut page, "a new start", |now| now < paused);
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn the_voltage_is_heard_when_asked_for_and_not_before() {
    let mut page = Page::open(1440, 900, Theme::Light);
    page.let_move();
    page.script(LISTEN);
    let json = r#"{"scenario":{"parameters":{"alpha":1e-4,"beta":0.01,"omega":8.0969}},"tab":"live"}"#;
    page.call("load", json).expect("a view");
    sleep(Duration::from_secs(1));
    assert_eq!(page.script("return heard.samples"), 0);
    click(&mut page, "Sound");
    click(&mut page, "110 periods/s");
    page.wait_until("the speed", |state| state["view"]["live"]["speed"] == 110.0);
    sleep(Duration::from_secs(1));
    // Samples and the page's own clock (ms) at one moment: a loaded machine answers late.
    let heard = |page: &Page| {
        let heard = page.script("return [heard.samples, performance.now()]");
        [0, 1].map(|part| heard[part].as_f64().unwrap_or_default())
    };
    let before = heard(&page);
    sleep(Duration::from_secs(2));
    let after = heard(&page);
    let rate = 1e3 * (after[0] - before[0]) / (after[1] - before[1]);
    let most = page.script("return heard.most").as_f64().unwrap_or_default();
    println!("sound: {rate:.0} samples a second, at most {most:.2}");
    // 24 000 and a piece at the edges; fewer where frames take longer than the run may count.
    assert!((1_000.0..26_000.0).contains(&rate) && (0.05..0.61).contains(&most), "{rate} {most}");
    page.screenshot("live-sound");
    click(&mut page, "Sound");
    sleep(Duration::from_millis(300));
    let before = heard(&page)[0];
    sleep(Duration::from_millis(500));
    assert_eq!(heard(&page)[0], before);
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn an_escape_is_said_in_words_and_can_be_started_again() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    page.let_move();
    let json = r#"{"scenario":{"parameters":{"alpha":1e-4,"beta":0.01,"omega":42.7125}},"tab":"live",
        "live":{"speed":20.0}}"#;
    page.call("load", json).expect("a view");
    page.find("The tip escaped at t = ", &[]);
    page.screenshot("live-escape");
    click(&mut page, "Start again from rest");
    page.find("The tip escaped at t = ", &[]);
    page.close();
}
