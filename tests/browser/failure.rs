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

/// Whether the text that needs no script is seen, in these languages.
fn late(page: &mut Page) -> Vec<String> {
    let seen = page.script(
        "const late = document.getElementById('late'); \
         if (getComputedStyle(late).visibility !== 'visible') return []; \
         return [...late.querySelectorAll('[lang]')].filter((text) => text.checkVisibility()).map((text) => text.lang)",
    );
    let seen = seen.as_array().cloned().unwrap_or_default();
    seen.iter().filter_map(|code| code.as_str().map(str::to_owned)).collect()
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_start_that_never_ends_says_what_to_do_after_ten_seconds() {
    let mut page = Page::open(1440, 900, Theme::Light);
    page.expects_errors();
    // The module never arrives.
    let undo = page.before_each_load(
        "WebAssembly.instantiateStreaming = WebAssembly.instantiate = () => new Promise(() => {})",
    );
    page.reload_unready();
    assert_eq!(late(&mut page), Vec::<String>::new());
    let begin = std::time::Instant::now();
    while late(&mut page).is_empty() {
        assert!(begin.elapsed() < Duration::from_secs(30), "nothing is said");
        sleep(Duration::from_millis(250));
    }
    assert!(begin.elapsed() > Duration::from_secs(6), "{:?}", begin.elapsed());
    assert_eq!(late(&mut page), ["en"]);
    page.screenshot("late");
    axe::check(&page, "late start");
    page.before_no_load(&undo);
    // The start script arrives cut: nothing of it runs, and no language is known.
    let undo = page.before_each_load("Object.defineProperty(HTMLElement.prototype, 'dataset', { get() { throw new SyntaxError('cut'); } })");
    page.reload_unready();
    let begin = std::time::Instant::now();
    while late(&mut page).is_empty() {
        assert!(begin.elapsed() < Duration::from_secs(30), "nothing is said");
        sleep(Duration::from_millis(250));
    }
    assert_eq!(late(&mut page), ["en", "de", "zh"]);
    page.screenshot("late-without-scripts");
    page.before_no_load(&undo);
    page.reload();
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_stored_state_with_bad_parts_starts_and_they_are_named() {
    let mut page = Page::open(1440, 900, Theme::Light);
    drag_slider(&mut page, "Frequency", 0.3, 0.7, 10);
    let frequency = number(&mut page, "Frequency");
    page.script(
        "const spoil = () => { \
           const state = JSON.parse(localStorage.getItem('harvester-lab.v1')); \
           state.lang = 5; state.scenario.t_end = 'long'; \
           localStorage.setItem('harvester-lab.v1', JSON.stringify(state)); \
         }; \
         addEventListener('pagehide', spoil)",
    );
    page.reload();
    assert_eq!(number(&mut page, "Frequency"), frequency);
    assert_eq!(page.state()["view"]["scenario"]["t_end"], 600.0);
    let notice = page.find("Parts of the stored state could not be used", &["Label"]).label;
    assert!(notice.contains(": lang, scenario.t_end. The rest is kept"), "{notice}");
    page.screenshot("bad-parts");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_lost_graphics_context_is_told() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    page.expects_errors();
    page.script("document.getElementById('canvas').getContext('webgl2').getExtension('WEBGL_lose_context').loseContext()");
    failed(&mut page, "The graphics card or its driver gave up on the page");
    page.close();
}
