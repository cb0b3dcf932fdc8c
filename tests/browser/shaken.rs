//! Recorded vibration in the built page: ten minutes at 1 kHz, dropped, computed, and live.

use serde_json::Value;

use crate::page::{Page, Theme};

/// Frames that are drawn at least while a file is read, taken over and computed with: how long they take is printed.
const LEAST_FRAMES: usize = 15;
/// Part of the frames of which the longest is told.
const MOST: f64 = 0.95;

/// Drops a file of so many rows of time and acceleration, 1 ms apart, on the page.
const DROP: &str = "
    const rows = ['time [s],acceleration [g]'];
    for (let i = 0; i < arguments[0]; i += 1) {
      const t = i * 1e-3;
      const a = Math.sin(9.1 * t) + Math.sin(13.7 * t + Math.sin(0.11 * t)) + 0.5 * Math.sin(45.3 * t);
      rows.push(`${t.toFixed(3)},${(2e-3 * a).toFixed(6)}`);
    }
    const data = new DataTransfer();
    data.items.add(new File([rows.join('\\n')], 'pump.csv', { type: 'text/csv' }));
    const drop = new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true });
    document.getElementById('canvas').dispatchEvent(drop);
";

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn ten_minutes_of_recorded_vibration_shake_the_page_which_goes_on() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    let recording = page.find("Shaken by: recording", &[]);
    page.click(recording.at(0.5, 0.5));
    let count = |page: &Page| page.frames()["count"].as_u64().unwrap_or_default() as usize;
    let before = count(&page);
    page.script_with(DROP, vec![Value::from(600_000)]);
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
    let live = page.find("Live", &[]);
    page.click(live.at(0.5, 0.5));
    page.find("The base is shaken as recorded in pump.csv.", &[]);
    page.screenshot("shaken-live");
    page.close();
}
