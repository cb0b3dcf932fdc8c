//! The canvas by keyboard alone.

use serde_json::json;

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

/// Presses Tab in the page itself, which is quicker by far than from here, until the focus has come round: the controls
/// that had it, and those that never had.
const WALK: &str = "return (async () => {
    const frame = () => new Promise(requestAnimationFrame);
    const key = (type) => document.activeElement.dispatchEvent(
        new KeyboardEvent(type, { key: 'Tab', code: 'Tab', keyCode: 9, bubbles: true, cancelable: true }));
    // Numbers too long for JavaScript stay text.
    const look = () => JSON.parse(harvester.controls().replace(/\"id\":(\\d+)/g, '\"id\":\"$1\"'));
    const reached = new Set();
    // Told to look, the page has a list from the next frame on.
    look();
    await frame();
    await frame();
    let now = look().find(({ focused }) => focused)?.id;
    for (let presses = 0; presses < 300; presses += 1) {
        const before = now;
        key('keydown');
        key('keyup');
        for (let frames = 0; frames < 200 && now === before; frames += 1) {
            await frame();
            now = look().find(({ focused, focusable }) => focused && focusable)?.id ?? before;
        }
        if (reached.has(now)) break;
        reached.add(now);
    }
    const missed = look().filter(({ id, focusable }) => focusable && !reached.has(id));
    return [reached.size, missed.map(({ role, label }) => `${role} ${label}`)];
})()";

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn tab_goes_round_all_controls_of_every_tab() {
    let mut page = Page::open(1000, 700, Theme::Dark);
    page.script("harvester.load('{\"t_end\":100}')");
    page.let_move();
    // A beam that moves asks for pictures all the time.
    page.keys(&[], 'b');
    page.wait_until("the beam to be held", |state| state["view"]["beam_moves"] == false);
    for (key, tab) in
        ['1', '3', '4', '5', '6'].into_iter().zip(["explore", "stability", "sweep", "design", "paper"])
    {
        page.keys(&[], key);
        page.wait_until("the tab", |state| state["view"]["tab"] == tab);
        // What is found meanwhile may bring controls with it, behind the focus: another round reaches them.
        let mut rounds = (0..3).map(|_| page.script(WALK));
        let walk = rounds.find(|walk| walk[1] == json!([]));
        let walk = walk.unwrap_or_else(|| panic!("{tab}: {}", page.script(WALK)));
        println!("{tab}: {} controls by keyboard", walk[0]);
        assert!(walk[0].as_u64() > Some(25), "{tab}: {walk}");
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
