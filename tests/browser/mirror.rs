//! The native controls beside the canvas: in step with it both ways, reached by the keyboard, fit for screen readers.

use serde_json::{Value, json};

use super::{axe, drag_slider, number};
use crate::page::{ENTER, ESCAPE, Page, SHIFT, TAB, Theme};

const CONTROLS: [&str; 6] = ["alpha", "beta", "omega", "modes", "force", "tab"];

/// What a native control shows.
fn shown(page: &Page, id: &str) -> String {
    let text = page.script_with("return document.getElementById(arguments[0]).value", vec![json!(id)]);
    text.as_str().expect("a text").to_owned()
}

/// The element that has the keyboard.
fn focused(page: &Page) -> String {
    let id = page.script("return document.activeElement.id || document.activeElement.tagName");
    id.as_str().expect("an element").to_owned()
}

/// Types into a native control as a user does who has come to it by Tab, and leaves it by Enter.
fn enter(page: &Page, id: &str, text: &str) {
    page.script_with(
        "const field = document.getElementById(arguments[0]); field.focus(); field.select();",
        vec![json!(id)],
    );
    text.chars().for_each(|key| page.keys(&[], key));
    page.keys(&[], ENTER);
}

fn chosen(page: &Page, id: &str, value: &str) {
    let script = "const choice = document.getElementById(arguments[0]); choice.value = arguments[1]; \
                  choice.dispatchEvent(new Event('change', { bubbles: true }));";
    page.script_with(script, vec![json!(id), json!(value)]);
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn native_controls_drive_the_plots_and_follow_them() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    page.call("load", r#"{"parameters":{"alpha":1e-4,"beta":0.01,"omega":8.0969}}"#).expect("Figure 9");
    page.wait("the mirror to be filled", |page| (shown(page, "alpha") == "0.0001").then_some(()));
    let spoken = |page: &Page| page.script("return document.getElementById('verdict').textContent");
    let verdict = page.wait("a verdict in words", |page| {
        Some(spoken(page)).filter(|text| text.as_str().is_some_and(|text| text.starts_with("Period 2")))
    });
    assert!(verdict.as_str().is_some_and(|text| text.contains(" V rms")), "{verdict}");

    let before = page.state()["generation"].clone();
    enter(&page, "omega", "8.2");
    let state = page.wait_until("another motion", |state| {
        state["generation"] != before && state["shown_generation"] == state["generation"]
    });
    assert_eq!(state["result"]["scenario"]["parameters"]["omega"], 8.2);
    assert_eq!(number(&mut page, "Frequency"), 8.2);
    page.wait("another verdict in words", |page| (spoken(page) != verdict).then_some(()));
    page.screenshot("mirror");
    axe::check(&page, "text controls");

    // What is refused changes nothing, says why, and stays to be corrected.
    enter(&page, "beta", "7");
    let error = "const field = document.getElementById('beta'); \
                 return [field.value, field.getAttribute('aria-invalid'), \
                         document.getElementById(field.getAttribute('aria-describedby')).textContent]";
    assert_eq!(page.script(error), json!(["7", "true", "beta = 7 (allowed are 0 to 0.2)"]));
    assert_eq!(page.state()["view"]["scenario"]["parameters"]["beta"], 0.01);
    page.screenshot("mirror-error");
    axe::check(&page, "a refused number");
    enter(&page, "beta", "0.004");
    page.wait_until("the corrected number", |state| state["view"]["scenario"]["parameters"]["beta"] == 0.004);
    assert_eq!(page.script(error), json!(["0.004", "false", ""]));

    chosen(&page, "force", "taylor5");
    chosen(&page, "tab", "sweep");
    enter(&page, "modes", "3");
    let state =
        page.wait_until("modes, law and tab", |state| state["view"]["scenario"]["model"]["modes"] == 3);
    assert_eq!(state["view"]["scenario"]["model"]["force"], json!({ "taylor": 5 }));
    assert_eq!(state["view"]["tab"], "sweep");

    // And the other way: a slider of the canvas, and steps back.
    drag_slider(&mut page, "Frequency", 0.4, 0.6, 8);
    let moved = number(&mut page, "Frequency");
    page.wait("the mirror to follow", |page| (shown(page, "omega").parse() == Ok(moved)).then_some(()));
    let press = |page: &Page, id: &str| {
        page.script_with("document.getElementById(arguments[0]).click()", vec![json!(id)])
    };
    press(&page, "undo");
    page.wait("a step back", |page| (shown(page, "omega") == "8.2").then_some(()));
    press(&page, "redo");
    page.wait("the step again", |page| (shown(page, "omega").parse() == Ok(moved)).then_some(()));
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn listeners_are_told_of_changes() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    page.script("addEventListener('harvester:change', ({ detail }) => { window.heard = detail.state; })");
    page.script("harvester.change('omega', '8.3')");
    let heard = page.wait("the event", |page| {
        let text = page.script("return window.heard ?? null");
        text.as_str().and_then(|text| serde_json::from_str::<Value>(text).ok())
    });
    assert_eq!(heard["view"]["scenario"]["parameters"]["omega"], 8.3);
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn the_keyboard_goes_from_the_picture_to_the_native_controls_and_back() {
    let mut page = Page::open(1440, 900, Theme::Light);
    let mut tabs: Vec<String> = page.labels("Tab").iter().map(|tab| tab.to_lowercase()).collect();
    tabs.sort();
    let options =
        page.script("return [...document.getElementById('tab').options].map(({ value }) => value).sort()");
    assert_eq!(json!(tabs), options, "every tab is in the list");
    // Within the picture Tab stays within it.
    page.keys(&[], TAB);
    page.keys(&[], TAB);
    assert_eq!(focused(&page), "canvas");
    page.keys(&[], ESCAPE);
    page.keys(&[], TAB);
    let walked: Vec<String> = (0..9)
        .map(|_| {
            let id = focused(&page);
            page.keys(&[], TAB);
            id
        })
        .collect();
    assert_eq!(walked[..6], CONTROLS.map(str::to_owned));
    assert_eq!(walked[6..], ["undo", "redo", "to-canvas"].map(str::to_owned));
    page.script("document.getElementById('alpha').focus()");
    page.keys(&[SHIFT], TAB);
    assert_eq!(focused(&page), "canvas");
    page.keys(&[], ESCAPE);
    page.keys(&[SHIFT], TAB);
    assert_eq!(focused(&page), "to-controls");
    page.screenshot("to-controls");
    page.keys(&[], ENTER);
    assert_eq!(focused(&page), "alpha");
    page.resize(360, 760, Theme::Light);
    page.screenshot("mirror-phone");
    axe::check(&page, "text controls on a phone");
    page.close();
}
