//! Links, undo and redo, and scenario files, as a user has them.

use std::{env, fs};

use serde_json::{Value, json};

use super::page::{CONTROL, Page, SHIFT, Theme};
use super::{drag_slider, number};

fn parameter(state: &Value, name: &str) -> f64 {
    state["view"]["scenario"]["parameters"][name].as_f64().expect("a number")
}

/// Changes the address's fragment, as a link on another page of the same site would.
fn go_to(page: &Page, fragment: &str) {
    page.script_with("location.hash = arguments[0]", vec![json!(fragment)]);
}

fn press(page: &mut Page, label: &str) {
    let control = page.find(label, &["Button"]);
    page.click(control.at(0.5, 0.5));
}

/// Drops a file on the page.
pub(crate) fn drop_file(page: &Page, name: &str, text: &str) {
    let script = "const files = new DataTransfer(); files.items.add(new File([arguments[1]], arguments[0])); \
        const drop = new DragEvent('drop', { dataTransfer: files, bubbles: true, cancelable: true }); \
        document.getElementById('canvas').dispatchEvent(drop);";
    page.script_with(script, vec![json!(name), json!(text)]);
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_link_wins_over_what_was_stored_until_something_is_changed() {
    let mut page = Page::open(1440, 900, Theme::Light);
    page.call("load", r#"{"parameters":{"alpha":0.002,"beta":0.003}}"#).expect("a valid scenario");
    page.script("history.replaceState(null, '', '#v=1&alpha=1e-4&beta=0.004&omega=25.4&tab=sweep&modes=3')");
    page.reload();
    let state = page.state();
    assert_eq!([parameter(&state, "beta"), parameter(&state, "omega")], [0.004, 25.4]);
    assert_eq!((&state["view"]["tab"], &state["view"]["map"]), (&json!("sweep"), &json!("sum")));
    assert_eq!(state["view"]["scenario"]["model"]["modes"], 3);
    // What was there before the link is a step back.
    page.keys(&[CONTROL], 'z');
    page.wait_until("the stored state", |state| parameter(state, "beta") == 0.003);
    page.keys(&[CONTROL], 'y');
    page.wait_until("the link's state", |state| parameter(state, "beta") == 0.004);
    // A reload goes on with what was changed, and the address does not claim otherwise.
    drag_slider(&mut page, "Frequency", 0.5, 0.7, 10);
    page.wait("the link to leave the address", |page| {
        (page.script("return location.hash") == "").then_some(())
    });
    let moved = number(&mut page, "Frequency");
    page.reload();
    assert!((number(&mut page, "Frequency") - moved).abs() < 1e-9);
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_bad_link_loads_what_is_valid_and_says_what_was_not() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    go_to(&page, "v=1&beta=7&omega=9&tab=dance&colour=red");
    let state = page.wait_until("the link's frequency", |state| parameter(state, "omega") == 9.0);
    assert_eq!(parameter(&state, "beta"), 0.001);
    let notice = page.find("Not everything in this link", &["Label"]).label;
    for part in ["beta = 7 (allowed are 0 to 0.2)", "tab = dance (allowed are explore, ", "colour = red"] {
        assert!(notice.contains(part), "{notice}");
    }
    page.screenshot("bad-link");
    // What is no link at all changes nothing.
    go_to(&page, "%%%&&;;=\u{1f600}");
    page.find("Not everything in this link could be used: %%%", &["Label"]);
    assert_eq!(parameter(&page.state(), "omega"), 9.0);
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn the_address_is_followed_and_the_link_that_is_offered_leads_back() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    go_to(&page, "v=1&omega=17&beta=0.005&force=taylor5&map=all");
    page.wait_until("the first link", |state| parameter(state, "omega") == 17.0);
    let shared = page.state()["view"].clone();
    press(&mut page, "Share: link");
    let field = page.find("Link to this view", &["TextInput"]);
    let link = field.value.expect("a text");
    assert_eq!(link, format!("{}#v=1&beta=0.005&omega=17&force=taylor5&map=all", page.files.url()));
    page.find("QR code of the link", &["Button"]);
    page.screenshot("share");
    press(&mut page, "Large code");
    page.find("QR code of the link: close", &["Button"]);
    page.screenshot("share-large");
    page.click((720.0, 450.0));
    go_to(&page, "v=1&omega=8");
    page.wait_until("the second link", |state| parameter(state, "omega") == 8.0);
    go_to(&page, link.split_once('#').expect("a fragment").1);
    let state = page.wait_until("the first link again", |state| parameter(state, "omega") == 17.0);
    assert_eq!(state["view"], shared);
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn what_is_shared_fits_a_phone() {
    let mut page = Page::open(360, 760, Theme::Light);
    press(&mut page, "Share: link");
    for (label, role) in [
        ("Undo", "Button"),
        ("Theme", "Button"),
        ("Link to this view", "TextInput"),
        ("QR code of the link", "Button"),
        ("Open file", "Button"),
    ] {
        let [left, top, right, bottom] = page.find(label, &[role]).bounds;
        assert!(left >= 0.0 && top >= 0.0 && right <= 360.0 && bottom <= 760.0, "{label} sticks out");
    }
    page.screenshot("share-phone");
    press(&mut page, "QR code of the link");
    let [left, _, right, _] = page.find("QR code of the link: close", &["Button"]).bounds;
    assert!(left >= 0.0 && right <= 360.0 && right - left > 250.0, "{left} to {right}");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_whole_drag_is_undone_and_done_again_by_keyboard_and_by_button() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    let before = number(&mut page, "Frequency");
    drag_slider(&mut page, "Frequency", 0.3, 0.6, 20);
    let first = number(&mut page, "Frequency");
    drag_slider(&mut page, "Frequency", 0.6, 0.8, 20);
    let second = number(&mut page, "Frequency");
    assert!(before != first && first != second, "{before} {first} {second}");
    let mut becomes = |what: &str, act: &dyn Fn(&mut Page), wanted: f64| {
        act(&mut page);
        page.wait_until(what, |state| (parameter(state, "omega") - wanted).abs() < 1e-9);
    };
    becomes("undo by keyboard", &|page| page.keys(&[CONTROL], 'z'), first);
    becomes("undo by button", &|page| press(page, "Undo"), before);
    becomes("redo by keyboard", &|page| page.keys(&[CONTROL, SHIFT], 'z'), first);
    becomes("redo by button", &|page| press(page, "Redo"), second);
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_file_is_saved_opened_and_dropped_and_a_bad_one_changes_nothing() {
    let mut page = Page::open(1440, 900, Theme::Light);
    let folder = env::temp_dir().join(format!("harvester-files-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    page.downloads_to(&folder);
    page.call("load", r#"{"parameters":{"beta":0.0042,"omega":25.4}}"#).expect("a valid scenario");
    press(&mut page, "Share: link");
    press(&mut page, "Save file");
    let file = folder.join("harvester-scenario.json");
    let text =
        page.wait("the saved file", |_| fs::read_to_string(&file).ok().filter(|text| text.ends_with('\n')));
    assert!(text.contains("\"beta\": 0.0042"), "{text}");
    fs::remove_dir_all(&folder).expect("the folder goes");

    go_to(&page, "v=1");
    page.wait_until("another state", |state| parameter(state, "beta") == 0.001);
    drop_file(&page, "mine.json", &text);
    page.wait_until("the dropped file", |state| parameter(state, "beta") == 0.0042);
    drop_file(&page, "bad.json", r#"{"parameters":{"beta":7}}"#);
    let notice = page.find("bad.json could not be opened", &["Label"]).label;
    assert!(notice.contains("beta = 7 is out of range: allowed are 0 to 0.2"), "{notice}");
    assert_eq!(parameter(&page.state(), "beta"), 0.0042);
    // Measured data has a page of its own.
    drop_file(&page, "measured.csv", "frequency,volts\n1,2\n");
    page.find("1 row read", &["Label"]);
    assert_eq!(page.state()["view"]["design"]["page"], "measured");

    go_to(&page, "v=1&beta=0.002");
    page.wait_until("another state", |state| parameter(state, "beta") == 0.002);
    // Nobody is there to choose a file in a dialog.
    page.reload();
    page.script("HTMLInputElement.prototype.click = function () { window.asked = true; }");
    press(&mut page, "Share: link");
    press(&mut page, "Open file");
    page.wait("the dialog", |page| (page.script("return window.asked === true") == true).then_some(()));
    let script = "const files = new DataTransfer(); files.items.add(new File([arguments[0]], 'mine.json')); \
        const input = document.getElementById('open-file'); input.files = files.files; \
        input.dispatchEvent(new Event('change'));";
    page.script_with(script, vec![json!(text)]);
    page.wait_until("the opened file", |state| parameter(state, "beta") == 0.0042);
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_file_that_cannot_be_opened_is_refused_by_its_beginning() {
    let mut page = Page::open(1440, 900, Theme::Light);
    page.script(
        "window.read = []; const all = Blob.prototype.arrayBuffer; \
         Blob.prototype.arrayBuffer = function () { window.read.push(this.size); return all.call(this); }",
    );
    for (name, fill, part) in [
        ("sound.wav", 0, "it is not text: byte 1 belongs to no character"),
        ("one.csv", i32::from(b'1'), "line 1 is longer than 65536 characters"),
    ] {
        page.script_with(
            "const files = new DataTransfer(); \
             files.items.add(new File([new Uint8Array(5e7).fill(arguments[1])], arguments[0])); \
             const drop = new DragEvent('drop', { dataTransfer: files, bubbles: true, cancelable: true }); \
             document.getElementById('canvas').dispatchEvent(drop);",
            vec![json!(name), json!(fill)],
        );
        let notice = page.find(&format!("{name} could not be opened"), &["Label"]).label;
        assert!(notice.contains(part), "{notice}");
    }
    assert_eq!(page.script("return window.read"), json!([65536, 65536]));
    assert_ne!(page.state()["view"]["tab"], "design");
    page.close();
}
