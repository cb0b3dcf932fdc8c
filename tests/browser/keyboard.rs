//! The canvas by keyboard alone.

use std::collections::BTreeSet;

use crate::page::{Control, ENTER, ESCAPE, Page, SHIFT, TAB, Theme};

const RIGHT: char = '\u{e014}';

/// Presses Tab; what has the focus then.
fn tab_on(page: &mut Page, before: Option<u64>) -> Control {
    page.keys(&[], TAB);
    page.wait("the focus to go on", |page| {
        page.controls()
            .into_iter()
            .find(|control| control.focused && control.focusable && Some(control.id) != before)
    })
}

/// Presses Tab until a control has the focus.
fn tab_to(page: &mut Page, role: &str, label: &str) {
    let mut before = None;
    loop {
        let focused = tab_on(page, before);
        if focused.role == role && focused.label == label {
            return;
        }
        before = Some(focused.id);
    }
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn tab_goes_round_all_controls_of_every_tab() {
    let mut page = Page::open(1000, 700, Theme::Dark);
    page.script("harvester.load('{\"t_end\":100}')");
    for (key, tab) in
        ['1', '2', '3', '4', '5'].into_iter().zip(["explore", "stability", "sweep", "design", "paper"])
    {
        page.keys(&[], key);
        page.wait_until("the tab", |state| state["view"]["tab"] == tab);
        let (mut reached, mut last) = (BTreeSet::new(), None);
        loop {
            let focused = tab_on(&mut page, last);
            last = Some(focused.id);
            if !reached.insert(focused.id) {
                break;
            }
        }
        let missed: Vec<Control> = page
            .controls()
            .into_iter()
            .filter(|control| control.focusable && !reached.contains(&control.id))
            .collect();
        println!("{tab}: {} controls by keyboard", reached.len());
        assert!(missed.is_empty(), "{tab}: {missed:#?}");
        page.keys(&[], ESCAPE);
    }
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_slider_and_the_list_of_keys_work_without_a_mouse() {
    let mut page = Page::open(1440, 900, Theme::Light);
    let before = page.slider("Damping").number;
    tab_to(&mut page, "Slider", "Damping");
    page.screenshot("keyboard-slider");
    page.keys(&[], RIGHT);
    page.keys(&[SHIFT], RIGHT);
    page.wait("the slider to move", |page| {
        let controls = page.controls();
        controls
            .into_iter()
            .find(|control| control.role == "Slider" && control.label == "Damping")
            .filter(|now| now.number > before)
    });
    page.keys(&[], '?');
    page.find("Close", &["Button"]);
    page.screenshot("keys");
    page.keys(&[], ESCAPE);
    page.wait("the list to go", |page| {
        page.controls().iter().all(|control| control.label != "Close").then_some(())
    });
    page.keys(&[], 'f');
    page.wait_until("a large plot", |state| state["view"]["enlarged"] == "stability_map");
    page.keys(&[], ESCAPE);
    page.wait_until("all plots", |state| state["view"]["enlarged"].is_null());
    // A typed number is no shortcut. (Tab right after Escape would leave the canvas.)
    page.keys(&[], SHIFT);
    page.keys(&[], RIGHT);
    tab_to(&mut page, "TextInput", "Damping value");
    "0.002".chars().for_each(|key| page.keys(&[], key));
    page.keys(&[], ENTER);
    let state = page
        .wait_until("the typed number", |state| state["view"]["scenario"]["parameters"]["alpha"] == 0.002);
    assert_eq!(state["view"]["tab"], "explore");
    page.close();
}
