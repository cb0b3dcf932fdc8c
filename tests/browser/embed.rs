//! The page inside of another one: only what was asked for, and the wheel and fingers stay the outer page's.

use std::time::Duration;

use serde_json::{Value, json};

use super::{drag_slider, number};
use crate::page::{Control, Page, Theme};

/// An outer page, taller than the window, with a frame in its upper left corner. It lends the frame's functions to the
/// helpers of these tests, for which places in the frame are places in the window.
fn frame(page: &mut Page, width: u32, height: u32, query: &str) {
    page.goto_file("example.html");
    let script = "document.querySelector('main').hidden = true; \
        Object.assign(document.body.style, { margin: 0, maxWidth: 'none', padding: 0 }); \
        const frame = document.createElement('iframe'); \
        frame.id = 'frame'; \
        Object.assign(frame.style, { position: 'absolute', left: 0, top: 0, border: 0, \
            width: `${arguments[0]}px`, height: `${arguments[1]}px` }); \
        frame.src = arguments[2]; \
        const below = document.createElement('div'); \
        below.style.height = '5000px'; \
        document.body.append(frame, below);";
    page.script_with(script, vec![json!(width), json!(height), json!(format!("./{query}"))]);
    page.wait("the frame to start", |page| {
        let ready = "const inner = document.getElementById('frame').contentWindow; \
            if (inner.document?.documentElement?.dataset.phase !== 'ready') return false; \
            window.harvester = inner.harvester; return true;";
        (page.script(ready) == true).then_some(())
    });
}

fn scrolled(page: &Page) -> f64 {
    page.script("return window.scrollY").as_f64().expect("a number")
}

/// The titles of cards, by their buttons.
fn cards(page: &mut Page) -> Vec<String> {
    page.find("Enlarge: ", &["Button"]);
    let buttons = page.controls().into_iter().filter(|control| control.role == "Button");
    buttons.filter_map(|control| control.label.strip_prefix("Enlarge: ").map(str::to_owned)).collect()
}

fn sliders(page: &Page) -> Vec<String> {
    let controls = page.controls().into_iter();
    controls.filter(|control| control.role == "Slider").map(|control| control.label).collect()
}

fn inside(control: &Control, width: f64, height: f64) -> bool {
    let [left, top, right, bottom] = control.bounds;
    left >= 0.0 && top >= 0.0 && right <= width && bottom <= height
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_frame_shows_what_was_asked_for_and_leaves_the_wheel_to_the_page_around() {
    let mut page = Page::open(1000, 700, Theme::Light);
    page.call("load", r#"{"parameters":{"alpha":0.002}}"#).expect("a valid scenario");
    page.wait("the state to be stored", |page| {
        let stored = page.script("return localStorage.getItem('harvester-lab.v1')");
        stored.as_str().is_some_and(|text| text.contains("\"alpha\":0.002,")).then_some(())
    });
    let stored = page.script("return localStorage.getItem('harvester-lab.v1')");
    let query = "?embed=map,phase&controls=omega#v=1&alpha=1e-4&beta=0.01&omega=8.0969&map=first";
    frame(&mut page, 640, 360, query);
    assert_eq!(cards(&mut page), ["Stability near 2ω₁", "Phase portrait"]);
    assert_eq!(sliders(&page), ["Frequency"]);
    let (tabs, way) = (page.controls(), page.find("Open in Harvester Lab", &["Button"]));
    assert!(tabs.iter().all(|control| control.role != "Tab"), "no top bar");
    assert!(inside(&way, 640.0, 360.0), "everything is in the frame: {way:?}");
    page.wait_until("a verdict", |state| !state["verdict"].is_null());
    page.screenshot("embed-640x360-light");

    // The slider works, and what is stored of the whole page stays.
    let before = number(&mut page, "Frequency");
    drag_slider(&mut page, "Frequency", 0.3, 0.7, 8);
    assert!((number(&mut page, "Frequency") - before).abs() > 0.1);
    let history = page.script("return history.length");
    assert_eq!(page.script("return localStorage.getItem('harvester-lab.v1')"), stored);

    // The wheel over a plot scrolls the page around and does not zoom the plot.
    let state = page.state();
    page.wheel((480.0, 220.0), 300);
    page.wait("the outer page to scroll", |page| (scrolled(page) > 100.0).then_some(()));
    page.script("window.scrollTo(0, 0)");
    page.wheel((320.0, 20.0), 300);
    page.wait("the same over a slider", |page| (scrolled(page) > 100.0).then_some(()));
    page.script("window.scrollTo(0, 0)");
    assert_eq!(page.state()["view"], state["view"]);
    assert_eq!(page.script("return history.length"), history);
    let focus = page.script("return document.activeElement.tagName");
    assert!(focus == "IFRAME" || focus == "BODY", "{focus}");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_starting_frame_leaves_the_keyboard_where_it_is() {
    let mut page = Page::open(800, 600, Theme::Dark);
    frame(&mut page, 640, 360, "?embed=phase");
    assert_eq!(page.script("return document.activeElement.tagName"), "BODY");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_finger_scrolls_the_page_around_and_drags_sliders() {
    let mut page = Page::open(700, 600, Theme::Dark);
    page.wait_kept();
    page.touches();
    frame(&mut page, 640, 360, "?embed=map,phase&controls=omega#v=1&alpha=1e-4&beta=0.01&omega=8.0969");
    page.find("Frequency", &["Slider"]);
    let state = page.state();
    page.swipe((480.0, 260.0), (480.0, 120.0));
    page.wait("the outer page to scroll", |page| (scrolled(page) > 40.0).then_some(()));
    assert_eq!(page.state()["view"], state["view"], "a swipe is no click");
    // The browser lets a swipe run out for a while: what comes of it later would count for the slider.
    page.wait("the outer page to rest", |page| {
        page.script("window.scrollTo(0, 0)");
        std::thread::sleep(Duration::from_millis(300));
        (scrolled(page) == 0.0).then_some(())
    });
    let slider = page.slider("Frequency");
    page.swipe(slider.at(0.3, 0.5), slider.at(0.7, 0.5));
    page.wait_until("the slider to move", |now| now["view"] != state["view"]);
    assert_eq!(scrolled(&page), 0.0, "a slider is dragged, not scrolled");
    let moved = page.state();
    let [left, top, right, bottom] = page.find("Operating point", &["Button"]).bounds;
    let middle = (0.5 * (left + right), 0.5 * (top + bottom));
    page.swipe(middle, (middle.0, middle.1 + 50.0));
    page.wait_until("the point to move", |now| now["view"] != moved["view"]);
    assert_eq!(scrolled(&page), 0.0, "the point is dragged, not scrolled");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn on_a_phone_a_finger_on_a_plot_scrolls_the_page() {
    let mut page = Page::open(390, 760, Theme::Light);
    page.touches();
    page.reload();
    page.find("Export: Stability", &["Button"]);
    let state = page.state();
    let before = page.slider("Damping").bounds[1];
    // The browser of this test still claims to have a mouse: the first touch tells otherwise.
    page.wait("the page to scroll", |page| {
        page.swipe((330.0, 320.0), (330.0, 160.0));
        let controls = page.controls();
        let slider = controls.iter().find(|control| control.label == "Damping");
        slider.is_none_or(|slider| slider.bounds[1] < before - 100.0).then_some(())
    });
    assert_eq!(page.state()["view"], state["view"]);
    page.screenshot("phone-swiped");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn what_an_address_gets_wrong_is_told_and_the_rest_is_shown() {
    let mut page = Page::open(900, 700, Theme::Dark);
    frame(&mut page, 640, 360, "?embed=time,tims&controls=alpha,zeta");
    assert_eq!(cards(&mut page), ["Time history"]);
    assert_eq!(sliders(&page), ["Damping"]);
    let told = page.find("Not understood", &["Label"]).label;
    assert!(
        told.contains("in embed: tims. There are verdict, map") && told.contains("in controls: zeta."),
        "{told}"
    );
    page.screenshot("embed-unknown");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn every_part_fits_into_frames_of_slides() {
    let mut page = Page::open(1000, 700, Theme::Dark);
    let cases = [
        (800, 450, "verdict,map,phase", "alpha,beta,omega", 2),
        (960, 540, "map,phase,poincare,time,beam", "alpha,beta,omega,modes", 4),
        (360, 640, "chart,multipliers", "omega,force", 2),
        (960, 540, "curves,basins,spectrum,evidence", "", 4),
        (960, 540, "orbit,response,load,force", "resistance,omega", 4),
    ];
    for (index, (width, height, parts, controls, count)) in cases.into_iter().enumerate() {
        let hash = "#v=1&alpha=1e-4&beta=0.01&omega=8.0969";
        frame(&mut page, width, height, &format!("?embed={parts}&controls={controls}{hash}"));
        let found = cards(&mut page);
        assert_eq!(found.len(), count, "{parts}: {found:?}");
        let way = page.find("Open in Harvester Lab", &["Button"]);
        assert!(inside(&way, f64::from(width), f64::from(height)), "{parts}: {way:?}");
        std::thread::sleep(Duration::from_secs(3));
        page.screenshot(&format!("embed-case-{index}"));
    }
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn the_example_page_works() {
    let mut page = Page::open(1000, 900, Theme::Light);
    page.goto_file("example.html");
    let told = |page: &Page, id: &str| {
        let text =
            page.script_with("return document.getElementById(arguments[0]).textContent", vec![json!(id)]);
        text.as_str().unwrap_or_default().to_owned()
    };
    page.wait("the result", |page| told(page, "result").contains("ω = 8.0969: 14.").then_some(()));
    let press = |page: &Page, selector: &str| {
        page.script_with("document.querySelector(arguments[0]).click()", vec![Value::from(selector)])
    };
    press(&page, "#ask");
    page.wait("the answer", |page| told(page, "answer").contains("at ω = 8.0969: 0.00").then_some(()));
    press(&page, "[data-omega='25.4047']");
    page.wait("the change", |page| told(page, "result").contains("ω = 25.4047: ").then_some(()));
    page.screenshot("example");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn sharing_copies_a_frame_of_the_present_view() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    page.script(
        "window.copied = null; navigator.clipboard.writeText = async (text) => { window.copied = text; };",
    );
    for label in ["Share", "Embed", "Poincaré map", "Copy the frame"] {
        let control = page.find(label, &["Button", "CheckBox"]);
        page.click(control.at(0.1, 0.5));
    }
    let copied =
        page.wait("the text", |page| page.script("return window.copied").as_str().map(str::to_owned));
    assert!(copied.contains("?embed=map,phase,poincare&amp;controls=alpha,beta,omega#v=1&amp;"), "{copied}");
    page.screenshot("share-embed");
    page.close();
}
