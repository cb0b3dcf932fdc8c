//! Recorded vibration in the built page: ten minutes at 1 kHz, dropped, computed, stopped, and live.

use std::{thread::sleep, time::Duration};

use serde_json::Value;

use crate::page::{Page, Theme};

/// Frames that are drawn at least while a file is read, taken over and computed with: how long they take is printed.
const LEAST_FRAMES: usize = 15;
/// Part of the frames of which the longest is told.
const MOST: f64 = 0.95;

/// Drops a file of so many rows of time and acceleration, so many ms apart, on the page.
const DROP: &str = "
    const rows = ['time [s],acceleration [g]'];
    for (let i = 0; i < arguments[0]; i += 1) {
      const t = i * 1e-3 * arguments[1];
      const a = Math.sin(9.1 * t) + Math.sin(13.7 * t + Math.sin(0.11 * t)) + 0.5 * Math.sin(45.3 * t);
      rows.push(`${t.toFixed(3)},${(2e-3 * a).toFixed(6)}`);
    }
    const data = new DataTransfer();
    data.items.add(new File([rows.join('\\n')], 'pump.csv', { type: 'text/csv' }));
    const drop = new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true });
    document.getElementById('canvas').dispatchEvent(drop);
";

fn press(page: &mut Page, label: &str) {
    let control = page.find(label, &[]);
    page.click(control.at(0.5, 0.5));
}

/// How many per cent the page says are computed, while it is neither at the beginning nor at the end.
fn percent(page: &Page) -> Option<u32> {
    let controls = page.controls();
    let said = controls.iter().find_map(|control| control.label.strip_prefix("computing "))?;
    said.strip_suffix(" %")?.parse().ok().filter(|percent| (1..100).contains(percent))
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn ten_minutes_of_recorded_vibration_shake_the_page_which_goes_on() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    press(&mut page, "Shaken by: recording");
    let count = |page: &Page| page.frames()["count"].as_u64().unwrap_or_default() as usize;
    let before = count(&page);
    page.script_with(DROP, vec![Value::from(600_000), Value::from(1)]);
    page.find("Over the whole recording it gives", &[]);
    let drawn = count(&page) - before;
    let frames = page.frames();
    let mut times: Vec<f64> = frames["cpu_ms"]
        .as_array()
        .into_iter()
        .flatten()
        .rev()
        .take(drawn)
        .filter_map(Value::as_f64)
        .collect();
    times.sort_by(f64::total_cmp);
    let longest = times.last().copied().unwrap_or_default();
    let most = times[(MOST * times.len() as f64) as usize];
    println!("600,000 samples: {drawn} frames, 95 % within {most:.1} ms, the longest {longest:.1} ms");
    page.find("pump.csv: 600000 samples in 600 s", &[]);
    page.screenshot("shaken-recorded");
    assert!(drawn > LEAST_FRAMES, "{drawn} frames");
    press(&mut page, "Live");
    page.find("The base is shaken as recorded in pump.csv.", &[]);
    page.screenshot("shaken-live");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_long_recording_says_how_far_it_is_stops_and_is_taken_up_again() {
    let mut page = Page::open(1440, 900, Theme::Light);
    page.call("load", r#"{"parameters":{},"model":{"modes":8,"force":"exact"}}"#).expect("a slow model");
    press(&mut page, "Shaken by: recording");
    // Between samples so far apart the integrator takes a dozen steps.
    page.script_with(DROP, vec![Value::from(600_000), Value::from(1000)]);
    let first = page.wait("a part of the runs", percent);
    let second = page.wait("more of them", |page| percent(page).filter(|percent| *percent > first));
    println!("600,000 samples, 8 modes: {first} %, then {second} %");
    // While all cores compute a press may come to nothing. Where the button was there is none afterwards.
    page.wait("the end of the runs", |page| {
        let controls = page.controls();
        let stop = controls.iter().find(|control| control.role == "Button" && control.label == "Stop");
        stop.iter().for_each(|stop| page.click(stop.at(0.5, 0.5)));
        controls.iter().any(|control| control.label == "Stopped before its end.").then_some(())
    });
    let spoken = |page: &Page| page.script("return document.getElementById('verdict').textContent");
    page.wait("the mirror to say so", |page| {
        spoken(page).as_str().is_some_and(|text| text.contains("Stopped before its end.")).then_some(())
    });
    // A worker that was in the middle of it has been replaced meanwhile, and nothing has begun again.
    sleep(Duration::from_secs(3));
    page.find("Stopped before its end.", &[]);
    let progress = page.state()["progress"].clone();
    assert!(
        progress.as_array().is_some_and(|lanes| lanes.iter().all(|lane| lane[0] != "shake")),
        "{progress}"
    );
    page.screenshot("shaken-stopped");
    press(&mut page, "Compute");
    page.find("Over the whole recording it gives", &[]);
    page.close();
}
