//! What is shown when the page cannot start or cannot go on.

use std::{thread::sleep, time::Duration};

use super::{axe, drag_slider, number};
use crate::page::{Page, Theme};

fn failed(page: &mut Page, with: &str) -> String {
    page.wait(&format!("the failure screen with {with:?}"), |page| {
        let text = page.script(
            "return document.documentElement.dataset.phase === 'failed' ? document.body.innerText : null",
        );
        text.as_str().filter(|text| text.contains(with)).map(str::to_owned)
    })
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_panic_is_told_and_the_state_survives_it() {
    let mut page = Page::open(1440, 900, Theme::Light);
    page.expects_errors();
    drag_slider(&mut page, "Frequency", 0.3, 0.7, 10);
    let frequency = number(&mut page, "Frequency");
    sleep(Duration::from_millis(1500));
    // A driver that has no textures left makes the renderer panic with the next picture.
    page.script("WebGL2RenderingContext.prototype.createTexture = () => null");
    page.script("harvester.change('tab', 'stability')");
    let text = failed(&mut page, "Harvester Lab stopped");
    assert!(text.contains("panicked at") && text.contains("Reload continues it"), "{text}");
    assert_eq!(page.script("return document.activeElement.id"), "reload");
    page.screenshot("failure");
    axe::check(&page, "failure");
    // Without a clipboard the state is shown to be copied by hand.
    page.script("Object.defineProperty(navigator, 'clipboard', { value: undefined })");
    page.script("document.getElementById('copy-state').click()");
    let state = page.wait("the state as text", |page| {
        let text = page.script(
            "const text = document.getElementById('state-text'); return text.hidden ? null : text.value",
        );
        text.as_str().map(str::to_owned)
    });
    let state: serde_json::Value = serde_json::from_str(&state).expect("JSON");
    assert_eq!(state["scenario"]["parameters"]["omega"], frequency);
    page.screenshot("failure-state");
    axe::check(&page, "failure with its state");
    page.script("document.getElementById('reload').click()");
    page.wait_ready();
    assert_eq!(number(&mut page, "Frequency"), frequency);
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn what_a_browser_lacks_is_named() {
    let mut page = Page::open(360, 760, Theme::Dark);
    page.expects_errors();
    let lack = |page: &mut Page, script: &str, words: &str| {
        let undo = page.before_each_load(script);
        page.reload_unready();
        let text = failed(page, words);
        page.before_no_load(&undo);
        text
    };
    let screen = "HTMLCanvasElement.prototype.getContext = () => null";
    let text = lack(&mut page, screen, "WebGL 2 is missing or switched off");
    assert!(text.contains("This browser cannot show Harvester Lab") && text.contains("Reload"), "{text}");
    page.screenshot("no-webgl");
    axe::check(&page, "no WebGL");
    lack(&mut page, "delete window.WebAssembly", "WebAssembly is missing or switched off");
    let old = "WebAssembly.instantiateStreaming = WebAssembly.instantiate = () => Promise.reject(new WebAssembly.CompileError('no vectors'))";
    lack(&mut page, old, "no vectors");
    page.reload();
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_lost_graphics_context_is_told() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    page.expects_errors();
    page.script("document.getElementById('canvas').getContext('webgl2').getExtension('WEBGL_lose_context').loseContext()");
    failed(&mut page, "The graphics card or its driver gave the page up");
    page.close();
}
