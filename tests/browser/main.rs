//! The built page in a real Chromium and a real Firefox. `make test` builds the page and runs these; plain `cargo test` skips them.

#![allow(clippy::expect_used, clippy::unwrap_used, reason = "helpers of tests panic as tests do")]

mod agreement;
mod axe;
mod design;
mod driver;
mod embed;
mod export;
mod failure;
mod firefox;
mod keyboard;
mod languages;
mod lessons;
mod live;
mod mirror;
mod offline;
mod page;
mod phone;
mod server;
mod shaken;
mod share;
mod stability;
mod stage;
mod wheel;

use std::path::PathBuf;
use std::{collections::BTreeSet, env, fs, io::Write as _, thread::sleep, time::Duration};

use flate2::{Compression, write::GzEncoder};
use page::{Page, Theme};
use serde_json::Value;

/// What the page may weigh, compressed, with everything it keeps for use without a network: 2.06 MB, of which a sixth is what
/// egui shapes and draws text with, and 130 kB are the German and Chinese texts and the Chinese font.
const LIMIT: usize = 2_080_000;

/// The number a slider shows.
fn number(page: &mut Page, label: &str) -> f64 {
    page.slider(label).number.expect("a slider has a number")
}

/// Drags a slider from its middle to a fraction of its length.
fn drag_slider(page: &mut Page, label: &str, from: f64, to: f64, moves: usize) {
    let slider = page.slider(label);
    let path: Vec<_> =
        (0..=moves).map(|index| slider.at(from + (to - from) * index as f64 / moves as f64, 0.5)).collect();
    page.drag(&path, Duration::from_millis(8));
}

/// How many different colours a picture has.
fn colours(png: &[u8]) -> usize {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut pixels).expect("a picture");
    let stride = info.color_type.samples();
    pixels[..info.buffer_size()]
        .chunks_exact(stride)
        .map(|pixel| pixel[..3].to_vec())
        .collect::<BTreeSet<_>>()
        .len()
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn starts_below_a_sub_path_and_then_asks_for_nothing() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    page.screenshot("start");
    let variety = colours(&page.png());
    assert!(variety > 50, "the canvas is nearly blank: {variety} colours");

    let refused: Vec<_> = page.files.log().iter().filter(|served| served.status >= 400).cloned().collect();
    assert!(refused.is_empty(), "asked for what is not there: {refused:?}");
    // The workers have loaded their scripts when they have answered.
    page.wait_until("the verdict", |state| !state["verdict"].is_null());
    // And the browser has kept the page for use without a network.
    page.wait_kept();
    let loaded = page.files.log().len();
    drag_slider(&mut page, "Frequency", 0.4, 0.6, 10);
    sleep(Duration::from_millis(500));
    let later = page.files.log()[loaded..].to_vec();
    assert!(later.is_empty(), "the running page went to the network: {later:?}");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn weighs_little() {
    let page = Page::open(1440, 900, Theme::Dark);
    let paths: BTreeSet<String> = page.files.log().iter().map(|served| served.path.clone()).collect();
    let mut total = 0;
    for path in &paths {
        let file = page.files.file(path).expect("a file of the page");
        let bytes = fs::read(&file).expect("a served file");
        let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(&bytes).expect("gzip");
        let size = encoder.finish().expect("gzip").len();
        total += size;
        println!("{:>9} B  {:>9} B gzip  {path}", bytes.len(), size);
    }
    println!("page weight: {:.3} MB gzip of {:.1} MB allowed", total as f64 / 1e6, LIMIT as f64 / 1e6);
    assert!(total < LIMIT || env::var_os("HARVESTER_DIST").is_some(), "the page weighs {total} bytes gzip");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_dragged_slider_changes_the_state_and_a_reload_keeps_it() {
    let mut page = Page::open(1440, 900, Theme::Light);
    let (before, state) = (number(&mut page, "Frequency"), page.state());
    drag_slider(&mut page, "Frequency", 0.3, 0.8, 20);
    page.wait_until("another state", |now| *now != state);
    let after = number(&mut page, "Frequency");
    assert!((after - before).abs() > 1e-3, "the slider stayed at {before}");
    page.screenshot("dragged");
    page.reload();
    let kept = number(&mut page, "Frequency");
    assert!((kept - after).abs() < 1e-9, "{after} became {kept} by reloading");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn garbage_in_storage_does_not_keep_the_page_from_starting() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    for garbage in
        ["", "{", "null", "[1e999]", r#"{"frequency":"x"}"#, r#"{"version":99999}"#, "\u{0}\u{ffff}"]
    {
        let quoted = Value::from(garbage).to_string();
        page.script(&format!("localStorage.setItem('harvester-lab.v1', {quoted})"));
        page.reload();
        assert!(number(&mut page, "Frequency").is_finite());
    }
    page.close();
}

/// The one line with which a function refuses its argument.
fn refusal(page: &Page, function: &str, argument: &str) -> String {
    let Err(message) = page.call(function, argument) else { panic!("{function}({argument:?}) was accepted") };
    assert!(!message.is_empty() && !message.contains('\n'), "{function}({argument:?}): {message:?}");
    message
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn refuses_nonsense_with_a_message() {
    let page = Page::open(1440, 900, Theme::Dark);
    let scenario = |page: &Page| page.state()["view"]["scenario"].clone();
    let before = scenario(&page);
    assert!(before.is_object(), "state() holds the scenario");
    for nonsense in ["", "{", "[]", "7", r#"{"task":"dance"}"#] {
        refusal(&page, "load", nonsense);
        refusal(&page, "solve", nonsense);
    }
    assert_eq!(scenario(&page), before);
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn nothing_moves_by_itself_where_the_system_asks_for_stillness() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    let count = |page: &Page| page.frames()["count"].as_u64().unwrap_or_default();
    page.wait("the page to rest", |page| {
        let before = count(page);
        sleep(Duration::from_secs(1));
        (count(page) == before).then_some(())
    });
    let before = count(&page);
    page.let_move();
    page.wait("the beam to move", |page| (count(page) > before + 10).then_some(()));
    page.find("Hold: The beam", &["Button"]);
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn says_what_a_frame_costs() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    page.let_move();
    let slider = page.slider("Frequency");
    // The list of widgets costs time itself; the page stops making it soon after the last question.
    sleep(Duration::from_secs(2));
    let path: Vec<_> =
        (0..=200).map(|index| slider.at(0.02 + 0.96 * f64::from(index) / 200.0, 0.5)).collect();
    let count = |page: &Page| page.frames()["count"].as_u64().unwrap_or_default() as usize;
    let before = count(&page);
    page.drag(&path, Duration::from_millis(8));
    let drawn = count(&page) - before;
    let frames = page.frames();
    for (key, what) in [("cpu_ms", "logic and layout"), ("total_ms", "with tessellation and paint")] {
        let times = frames[key].as_array().into_iter().flatten().rev().take(drawn);
        let mut times: Vec<f64> = times.filter_map(Value::as_f64).collect();
        times.sort_by(f64::total_cmp);
        let Some(last) = times.len().checked_sub(1) else { panic!("no frame was timed") };
        let at = |share: f64| times[(last as f64 * share).round() as usize];
        println!(
            "frame time ({what}), {} frames: p50 {:.2} ms, p95 {:.2} ms, max {:.2} ms",
            times.len(),
            at(0.5),
            at(0.95),
            at(1.0)
        );
    }
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn says_how_soon_the_first_plot_stands() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    // Looks at every frame, since the page has nothing to say before it is there.
    page.before_each_load(
        "const look = () => {
            const state = window.harvester && document.documentElement.dataset.phase === 'ready'
                && JSON.parse(window.harvester.state());
            if (state && state.status === 'done') window.firstPlot = performance.now();
            else requestAnimationFrame(look);
        };
        requestAnimationFrame(look);",
    );
    let mut times: Vec<f64> = (0..5)
        .map(|_| {
            page.reload();
            page.wait("the first plot", |page| page.script("return window.firstPlot ?? null;").as_f64())
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!("first plot after navigation: median {:.0} ms, slowest {:.0} ms of 5", times[2], times[4]);
    page.close();
}

/// Not a check but a tool: see `scripts/screenshots.sh`.
#[test]
#[ignore = "needs the built page and Chromium: scripts/screenshots.sh"]
fn screenshots() {
    let name = env::var("HARVESTER_NAME").unwrap_or_else(|_| "page".to_owned());
    let settle = env::var("HARVESTER_SETTLE_MS").ok().and_then(|text| text.parse().ok()).unwrap_or(700);
    let sizes = env::var("HARVESTER_SIZES")
        .unwrap_or_else(|_| "1440x900-dark 1440x900-light 1920x1080-dark 360x760-light".to_owned());
    let mut page = Page::open(1440, 900, Theme::Dark);
    if let Some(file) = env::var_os("HARVESTER_LOAD") {
        let json = fs::read_to_string(&file).expect("the scenario");
        page.call("load", &json).expect("load() takes the scenario");
    }
    if let Some(file) = env::var_os("HARVESTER_DROP").map(PathBuf::from) {
        let name = file.file_name().and_then(|name| name.to_str()).expect("a name");
        share::drop_file(&page, name, &fs::read_to_string(&file).expect("the file to drop"));
    }
    for label in env::var("HARVESTER_CLICK").iter().flat_map(|labels| labels.split(',')) {
        let control = page.find(label, &[]);
        page.click(control.at(0.5, 0.5));
    }
    for size in sizes.split_whitespace() {
        let (pixels, theme) = size.split_once('-').expect("like 1440x900-dark");
        let (width, height) = pixels.split_once('x').expect("like 1440x900-dark");
        let theme = match theme {
            "light" => Theme::Light,
            "dark-contrast" => Theme::DarkContrast,
            "light-contrast" => Theme::LightContrast,
            _ => Theme::Dark,
        };
        page.resize(width.parse().expect("a width"), height.parse().expect("a height"), theme);
        sleep(Duration::from_millis(settle));
        println!("{}", page.screenshot(&format!("{name}-{size}")).display());
    }
    page.close();
}
