//! German and Chinese: chosen, kept, offline, and back to English.

use crate::page::{Page, Theme};

fn choose(page: &mut Page, menu: &str, language: &str) {
    let button = page.find(menu, &["Button"]);
    page.click(button.at(0.5, 0.5));
    let choice = page.find(language, &["RadioButton"]);
    page.click(choice.at(0.5, 0.5));
}

fn language_of(page: &Page) -> String {
    page.script("return document.documentElement.lang").as_str().unwrap_or_default().to_owned()
}

/// The native control of damping, as screen readers name it.
fn native_label(page: &Page) -> String {
    page.script("return document.querySelector('label[for=alpha]').textContent")
        .as_str()
        .unwrap_or_default()
        .to_owned()
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn languages_are_chosen_kept_and_work_without_a_network() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    page.wait_kept();
    assert_eq!((language_of(&page), native_label(&page)), ("en".to_owned(), "Damping α".to_owned()));

    choose(&mut page, "Language", "Deutsch");
    page.find("Dämpfung", &["Slider"]);
    page.find("Stabilität", &["Tab"]);
    page.wait("the page's own texts", |page| (language_of(page) == "de").then_some(()));
    assert_eq!(native_label(&page), "Dämpfung α");
    page.wait_until("a verdict", |state| !state["verdict"].is_null());
    page.wait("the verdict in words", |page| {
        let said = page.script("return document.getElementById('verdict').textContent");
        said.as_str()?.starts_with("Periode 2: ").then_some(())
    });
    page.screenshot("german");

    // Without a network, after a reload: from what the browser has kept.
    page.files.stop();
    page.reload();
    page.find("Dämpfung", &["Slider"]);
    assert_eq!(page.state()["view"]["lang"], "de");
    choose(&mut page, "Sprache", "中文");
    page.find("阻尼", &["Slider"]);
    page.wait("the page's own texts", |page| (language_of(page) == "zh").then_some(()));
    assert_eq!(native_label(&page), "阻尼 α");
    page.screenshot("chinese");

    // It belongs to the room: undo leaves it.
    page.script("harvester.change('omega', '8.2'); harvester.undo()");
    page.find("阻尼", &["Slider"]);
    choose(&mut page, "语言", "English");
    page.find("Damping", &["Slider"]);
    page.wait("the page's own texts", |page| (language_of(page) == "en").then_some(()));
    assert_eq!(native_label(&page), "Damping α");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn an_address_asks_for_a_language_once() {
    let mut page = Page::open(1440, 900, Theme::Light);
    page.script("history.replaceState(null, '', '?lang=de')");
    page.reload();
    page.find("Dämpfung", &["Slider"]);
    assert_eq!(page.script("return location.search"), "");
    page.script("history.replaceState(null, '', '#v=1&lang=zh&omega=8.2')");
    page.reload();
    page.find("阻尼", &["Slider"]);
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_language_that_cannot_be_fetched_is_told() {
    let mut page = Page::open(1440, 900, Theme::Light);
    page.expects_errors();
    page.script("document.querySelector('meta[name=text-de]').content = 'missing.json'");
    choose(&mut page, "Language", "Deutsch");
    page.find("German could not be loaded", &["Label"]);
    page.find("Damping", &["Slider"]);
    page.close();
}
