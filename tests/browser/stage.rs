//! What a lecture needs: lessons that the address names, clips, and the whole screen.

use std::path::Path;
use std::{env, fs};

use crate::page::{Page, Theme, dist};

const LESSON: &str = r#"{"title":"Mine","summary":"My own.","minutes":1,"steps":[
    {"text":"We **begin**.","view":"v=1&omega=9&force=exact"},{"text":"And go on.","view":"v=1&omega=10&force=exact"}]}"#;

/// A copy of the built page beside which a lesson lies.
fn site_with(folder: &Path, name: &str) {
    fs::create_dir_all(folder).expect("a folder");
    for file in fs::read_dir(dist()).expect("the built page") {
        let file = file.expect("a file");
        if file.path().is_file() {
            fs::copy(file.path(), folder.join(file.file_name())).expect("copied");
        }
    }
    fs::write(folder.join(name), LESSON).expect("written");
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn the_address_names_a_lesson_of_the_same_site_and_a_missing_one_is_told() {
    let folder = env::temp_dir().join(format!("harvester-site-{}", std::process::id()));
    site_with(&folder, "mine.json");
    let mut page = Page::open_at(&folder, 1440, 900, Theme::Light);
    page.expects_errors();
    page.goto_file("index.html?lesson=mine.json");
    page.wait_ready();
    page.wait_until("its first step", |state| {
        state["view"]["lesson"] == "own" && state["view"]["scenario"]["parameters"]["omega"] == 9.0
    });
    page.screenshot("lesson-by-address");
    for (name, problem) in [
        ("other.json", "other.json could not be opened"),
        ("../mine.json", "../mine.json could not be opened"),
    ] {
        page.goto_file(&format!("index.html?lesson={name}"));
        page.wait_ready();
        page.find(problem, &["Label"]);
    }
    page.close();
    fs::remove_dir_all(&folder).expect("removed");
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_clip_of_the_page_and_of_a_plot_is_saved_as_a_film() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    let folder = env::temp_dir().join(format!("harvester-clips-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    page.downloads_to(&folder);
    page.let_move();
    let live = page.find("Live", &["Tab"]);
    page.click(live.at(0.5, 0.5));
    let record = page.find("Record a clip of the page", &["Button"]);
    page.click(record.at(0.5, 0.5));
    std::thread::sleep(std::time::Duration::from_secs(2));
    let stop = page.find("Stop recording", &["Button"]);
    page.screenshot("recording");
    page.click(stop.at(0.5, 0.5));
    let film = page.wait("the film", |_| {
        fs::read(folder.join("harvester-page.webm")).ok().filter(|film| !film.is_empty())
    });
    // The mark of Matroska, of which WebM is one kind, and pictures of some size.
    assert!(film.starts_with(&[0x1a, 0x45, 0xdf, 0xa3]) && film.len() > 10_000, "{} bytes", film.len());
    page.find("Record a clip of the page", &["Button"]);
    page.close();
    fs::remove_dir_all(&folder).expect("removed");
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn the_page_fills_the_screen_and_leaves_it() {
    let mut page = Page::open(1440, 900, Theme::Light);
    let is_full = |page: &Page| page.script("return Boolean(document.fullscreenElement)") == true;
    assert!(!is_full(&page));
    let button = page.find("Full screen", &["Button"]);
    page.click(button.at(0.5, 0.5));
    page.wait("the whole screen", |page| is_full(page).then_some(()));
    let button = page.find("Full screen", &["Button"]);
    page.click(button.at(0.5, 0.5));
    page.wait("the window again", |page| (!is_full(page)).then_some(()));
    page.close();
}
