//! A lesson played through by hand.

use serde_json::Value;

use crate::drag_slider;
use crate::page::{Control, Page, Theme};
use crate::share::drop_file;

const CONTROL: char = '\u{e009}';

fn press(page: &mut Page, label: &str) {
    let button = page.find(label, &["Button", "Tab"]);
    page.click(button.at(0.5, 0.5));
}

/// The running lesson and its step.
fn place(state: &Value) -> (Option<&str>, u64) {
    (state["view"]["lesson"].as_str(), state["view"]["step"].as_u64().unwrap_or_default())
}

fn wait_for_step(page: &mut Page, lesson: &str, step: u64) {
    page.wait_until("the step", |state| place(state) == (Some(lesson), step));
}

fn beta(state: &Value) -> f64 {
    state["view"]["scenario"]["parameters"]["beta"].as_f64().unwrap_or(f64::NAN)
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_lesson_is_played_to_its_end_and_remembered() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    press(&mut page, "Lessons");
    press(&mut page, "Begin: The first tongue");
    wait_for_step(&mut page, "first-tongue", 1);
    let loaded = page.files.log().len();

    // By hand.
    page.find("Your turn", &["Label"]);
    assert_eq!(beta(&page.state()), 5e-4);
    drag_slider(&mut page, "Excitation", 0.5, 0.62, 10);
    page.find("✓ Done", &["Label"]);
    page.find("It happens at", &["Label"]);
    page.screenshot("lesson-done");
    press(&mut page, "Next");
    wait_for_step(&mut page, "first-tongue", 2);
    page.wait_until("its view", |state| beta(state) == 1e-3);

    // By what is shown.
    press(&mut page, "Show me");
    page.find("The tip is at", &["Label"]);
    press(&mut page, "Next");
    wait_for_step(&mut page, "first-tongue", 3);

    // By answering, wrong at first; and one can go on without doing what is asked.
    // Nothing is said about a prediction before it is shown what comes.
    page.find("Predict first", &["Label"]);
    press(&mut page, "At 0.00070");
    press(&mut page, "At 0.0042");
    press(&mut page, "Show what comes");
    page.wait_until("what comes", |state| state["view"]["scenario"]["parameters"]["alpha"] == 1e-3);
    page.find("It would be if", &["Label"]);
    page.screenshot("lesson-predicted");
    press(&mut page, "Next");
    wait_for_step(&mut page, "first-tongue", 4);
    page.wait_until("another tab", |state| state["view"]["tab"] == "stability");
    press(&mut page, "Back");
    wait_for_step(&mut page, "first-tongue", 3);
    page.find("It would be if", &["Label"]);
    page.keys(&[CONTROL], 'z');
    wait_for_step(&mut page, "first-tongue", 4);
    press(&mut page, "Finish");
    page.wait_until("the list", |state| place(state) == (None, 1) && state["view"]["tab"] == "lessons");
    page.find("1 of 13 done", &["Status"]);
    page.reload();
    page.find("1 of 13 done", &["Status"]);
    let names: Vec<_> = page.files.log()[loaded..].iter().map(|served| served.path.clone()).collect();
    assert!(!names.iter().any(|path| path.contains("lesson")), "lessons were loaded: {names:?}");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_link_to_a_lesson_opens_its_step_also_on_a_phone() {
    let mut page = Page::open(360, 760, Theme::Light);
    page.script("location.hash = 'v=1&lesson=torus&step=2'");
    wait_for_step(&mut page, "torus", 2);
    // The step's own view, as nothing else is in the link.
    page.wait_until("its view", |state| {
        state["view"]["tab"] == "stability" && state["view"]["enlarged"] == "spectrum"
    });
    let inside = |control: Control| {
        let [left, top, right, bottom] = control.bounds;
        assert!(left >= 0.0 && top >= 0.0 && right <= 360.0 && bottom <= 760.0, "{control:?} sticks out");
    };
    for label in ["Fold the lesson", "Back", "Next", "Leave the lesson"] {
        inside(page.find(label, &["Button"]));
    }
    page.screenshot("lesson-phone");
    press(&mut page, "Fold the lesson");
    inside(page.find("Unfold the lesson", &["Button"]));
    press(&mut page, "Leave the lesson");
    page.wait_until("no lesson", |state| place(state) == (None, 1));
    assert_eq!(page.state()["view"]["tab"], "stability");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn back_and_forward_walk_through_tabs_figures_and_lessons() {
    let mut page = Page::open(1440, 900, Theme::Light);
    let tab = |state: &Value| state["view"]["tab"].as_str().unwrap_or_default().to_owned();
    press(&mut page, "Sweep");
    page.wait_until("Sweep", |state| tab(state) == "sweep");
    press(&mut page, "Paper");
    page.wait_until("Paper", |state| tab(state) == "paper");
    let figure = page.find("Figure: 4", &[]);
    page.click(figure.at(0.5, 0.5));
    page.wait_until("Figure 4", |state| state["view"]["figure"] == 4);
    press(&mut page, "Lessons");
    press(&mut page, "Begin: The first tongue");
    wait_for_step(&mut page, "first-tongue", 1);
    // A presenter's clicker.
    page.keys(&[], '\u{e00f}');
    wait_for_step(&mut page, "first-tongue", 2);
    page.keys(&[], '\u{e00e}');
    wait_for_step(&mut page, "first-tongue", 1);
    for expected in ["first-tongue 2", "first-tongue 1", "lessons", "paper 4", "paper 9", "sweep", "explore"]
    {
        page.script("history.back()");
        page.wait_until(expected, |state| {
            let (lesson, step) = place(state);
            let figure = state["view"]["figure"].as_u64().unwrap_or_default();
            match lesson {
                Some(name) => expected == format!("{name} {step}"),
                None if tab(state) == "paper" => expected == format!("paper {figure}"),
                None => expected == tab(state),
            }
        });
    }
    page.script("history.forward()");
    page.wait_until("forward", |state| tab(state) == "sweep");
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_lesson_of_ones_own_is_dropped_on_the_page_and_a_broken_one_is_explained() {
    let mut page = Page::open(1440, 900, Theme::Dark);
    let lesson = r#"{"title":"Mine","summary":"My own.","minutes":1,"steps":[
        {"text":"We **begin**.","view":"v=1&omega=9&force=exact","goal":{"task":"Go to 10.",
         "conditions":[{"at":"/view/scenario/parameters/omega","is":10}],"show":"v=1&omega=10&force=exact",
         "reaction":"There."}}]}"#;
    drop_file(&page, "mine.json", &lesson.replace("omega=9", "omeag=9"));
    page.find("mine.json could not be opened: steps 1, view: omeag = 9", &["Label"]);
    drop_file(&page, "mine.json", lesson);
    wait_for_step(&mut page, "own", 1);
    page.find("Mine", &["Label"]);
    press(&mut page, "Show me");
    page.find("✓ Done", &["Label"]);
    page.screenshot("lesson-own");
    page.close();
}
