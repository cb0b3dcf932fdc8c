//! The page in Firefox: what another engine could do otherwise.

use serde_json::json;

use super::{axe, colours, drag_slider, number};
use crate::page::{ESCAPE, Page, TAB, Theme, dist};

#[test]
#[ignore = "needs the built page and Firefox: make test"]
fn the_page_works_in_firefox_also_without_a_network() {
    let mut page = Page::open_in_firefox(&dist(), 1440, 1000, Theme::Dark);
    page.wait_until("the verdict", |state| !state["verdict"].is_null());
    assert!(colours(&page.png()) > 50, "the canvas is nearly blank");
    page.screenshot("firefox");
    let modes = page.call("solve", r#"{"task":"modes"}"#).expect("an answer");
    assert!(modes.as_str().is_some_and(|text| text.contains("A_e")), "{modes}");

    // By mouse, by keyboard, by the native controls.
    let before = number(&mut page, "Frequency");
    drag_slider(&mut page, "Frequency", 0.3, 0.6, 8);
    assert!((number(&mut page, "Frequency") - before).abs() > 1.0);
    page.keys(&[], '4');
    page.wait_until("the sweep tab", |state| state["view"]["tab"] == "sweep");
    page.keys(&[], '1');
    page.keys(&[], ESCAPE);
    page.keys(&[], TAB);
    assert_eq!(page.script("return document.activeElement.id"), "alpha");
    let enter = "const field = document.getElementById('omega'); field.value = '8.2'; \
                 field.dispatchEvent(new Event('change', { bubbles: true }));";
    page.script(enter);
    page.wait_until("the number of the native control", |state| {
        state["view"]["scenario"]["parameters"]["omega"] == 8.2 && state["status"] == "done"
    });
    assert_eq!(number(&mut page, "Frequency"), 8.2);
    axe::check(&page, "text controls in Firefox");
    page.screenshot("firefox-mirror");

    page.script_with("location.hash = arguments[0]", vec![json!("v=1&omega=17&beta=0.005&force=taylor5")]);
    page.wait_until("the link", |state| {
        state["view"]["scenario"]["model"]["force"] == json!({ "taylor": 5 })
    });
    page.wait_kept();
    page.files.stop();
    page.reload();
    assert_eq!(number(&mut page, "Frequency"), 17.0);
    page.wait_until("the verdict without a network", |state| !state["verdict"].is_null());
    page.close();
}
