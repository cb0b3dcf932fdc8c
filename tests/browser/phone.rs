//! A phone: the chosen plot stays in sight above the sliders, and fingers do what they are for.

use std::collections::BTreeSet;
use std::thread::sleep;
use std::time::Duration;

use serde_json::Value;

use crate::page::{Control, Page, Theme, project};

const TABS: [&str; 6] = ["explore", "live", "stability", "sweep", "design", "paper"];

/// The lessons and how many steps each has.
fn lessons() -> Vec<(String, usize)> {
    let files = std::fs::read_dir(project().join("assets/lessons")).expect("lessons");
    let mut lessons: Vec<(String, usize)> = files
        .map(|file| {
            let path = file.expect("a file").path();
            let text = std::fs::read_to_string(&path).expect("a text");
            let lesson: Value = serde_json::from_str(&text).expect("a lesson");
            let name = path.file_stem().and_then(|name| name.to_str()).expect("a name").to_owned();
            (name, lesson["steps"].as_array().map_or(0, Vec::len))
        })
        .collect();
    lessons.sort();
    lessons
}

fn open_tab(page: &mut Page, tab: &str) {
    page.script_with("window.harvester.change('tab', arguments[0])", vec![Value::from(tab)]);
    page.wait_until("the tab", |state| state["view"]["tab"] == tab);
    sleep(Duration::from_millis(150));
}

/// What can be touched. The page makes the list when it is asked for, and has it a picture later.
fn controls(page: &Page) -> Vec<Control> {
    let mut asked = (0..100).map(|_| {
        sleep(Duration::from_millis(20));
        page.controls()
    });
    asked.find(|controls| !controls.is_empty()).unwrap_or_default()
}

/// Sliders that are in sight whole, below the plot that stays on top.
fn sliders(page: &Page, height: f64) -> Vec<Control> {
    let controls = controls(page);
    let plot = controls.iter().find(|control| control.label.starts_with("Export: "));
    let guide = controls.iter().find(|control| control.label == "Leave the lesson");
    // Height of the plot beneath its title, more or less.
    let high = if height < 500.0 {
        90.0
    } else if guide.is_some() {
        150.0
    } else {
        290.0
    };
    let top = plot.map_or(0.0, |plot| plot.bounds[3] + high);
    // The guide begins a margin above its first button.
    let bottom = guide.map_or(height, |guide| guide.bounds[1] - 16.0);
    let seen =
        |control: &Control| control.role == "Slider" && control.bounds[1] > top && control.bounds[3] < bottom;
    controls.into_iter().filter(seen).collect()
}

/// That a slider can be dragged while the plot above it is in sight.
fn drags_under_its_plot(page: &mut Page, place: &str, height: f64) {
    let found = page.wait(&format!("a slider under a plot: {place}"), |page| {
        let plot = controls(page).into_iter().find(|control| control.label.starts_with("Export: "))?;
        Some((plot, sliders(page, height).into_iter().next()?))
    });
    let (plot, slider) = found;
    let room = slider.bounds[1] - plot.bounds[3];
    assert!(plot.bounds[1] > 0.0 && room > 60.0, "{place}: {plot:?} over {slider:?}");
    // To one of two places: it may stand at the other.
    let moved = [(0.35, 0.65), (0.65, 0.3)].into_iter().any(|(from, to)| {
        page.swipe(slider.at(from, 0.5), slider.at(to, 0.5));
        let controls = controls(page);
        let is_plot = |control: &Control| control.label.starts_with("Export: ") && control.bounds[1] > 0.0;
        assert!(controls.iter().any(is_plot), "{place}: the plot has gone");
        let same = |control: &&Control| control.role == "Slider" && control.label == slider.label;
        controls.iter().find(same).is_some_and(|now| now.number != slider.number)
    });
    assert!(moved, "{place}: {slider:?} did not move");
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn slider_and_plot_are_both_in_sight_while_one_drags_on_every_tab() {
    let mut page = Page::open(360, 760, Theme::Light);
    page.touches();
    for tab in TABS {
        open_tab(&mut page, tab);
        drags_under_its_plot(&mut page, tab, 760.0);
        page.screenshot(&format!("phone-{tab}"));
    }
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn slider_and_plot_are_both_in_sight_in_every_step_of_every_lesson() {
    let mut page = Page::open(360, 760, Theme::Light);
    page.touches();
    for (lesson, steps) in lessons() {
        for step in 1..=steps {
            page.script_with(
                "location.hash = `#v=1&lesson=${arguments[0]}&step=${arguments[1]}`",
                vec![Value::from(lesson.clone()), Value::from(step)],
            );
            page.wait_until("the step", |state| {
                state["view"]["lesson"] == *lesson && state["view"]["step"] == step
            });
            sleep(Duration::from_millis(150));
            drags_under_its_plot(&mut page, &format!("{lesson}, step {step}"), 760.0);
        }
    }
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn slider_and_plot_are_both_in_sight_at_200_per_cent() {
    let mut page = Page::open(720, 450, Theme::Dark);
    page.touches();
    for tab in TABS {
        open_tab(&mut page, tab);
        drags_under_its_plot(&mut page, tab, 450.0);
    }
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_vertical_swipe_over_any_slider_scrolls_and_changes_no_value() {
    let mut page = Page::open(360, 760, Theme::Dark);
    page.touches();
    for tab in TABS {
        open_tab(&mut page, tab);
        let state = page.state()["view"].clone();
        let mut swiped = BTreeSet::new();
        // Down the page, slider by slider, the highest first, which is the next to leave.
        loop {
            let seen = sliders(&page, 750.0).into_iter().filter(|slider| !swiped.contains(&slider.label));
            let Some(next) = seen.min_by(|a, b| a.bounds[1].total_cmp(&b.bounds[1])) else { break };
            swiped.insert(next.label.clone());
            // Less than from slider to slider, so that none leaves unswiped.
            let from = next.at(0.7, 0.5);
            page.swipe(from, (from.0 + 4.0, from.1 - 60.0));
            sleep(Duration::from_millis(60));
            assert_eq!(page.state()["view"], state, "{tab}: {next:?}");
        }
        assert!(swiped.len() >= 2, "{tab}: {swiped:?}");
    }
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_swipe_along_the_edge_scrolls_the_page_the_way_it_goes() {
    let mut page = Page::open(360, 760, Theme::Dark);
    page.touches();
    // A phone has fingers before it has the page.
    page.reload();
    for tab in ["explore", "design", "paper"] {
        open_tab(&mut page, tab);
        let before = controls(&page);
        // Over the scroll bar, which is none for fingers.
        page.swipe((354.0, 740.0), (355.0, 540.0));
        page.wait(&format!("the page to scroll: {tab}"), |page| {
            let now = controls(page);
            let by = before.iter().filter_map(|old| {
                let same = |new: &&Control| new.label == old.label && new.role == old.role;
                Some(now.iter().find(same)?.bounds[1] - old.bounds[1])
            });
            by.fold(0.0, f64::min).lt(&-150.0).then_some(())
        });
    }
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn a_tap_on_a_track_sets_the_value_and_the_question_mark_leads_back_to_the_greeting() {
    let mut page = Page::open(360, 760, Theme::Dark);
    page.touches();
    let slider = page.slider("Frequency");
    let before = slider.number;
    let at = slider.at(0.8, 0.5);
    page.swipe(at, at);
    page.wait("the value", |page| {
        let controls = page.controls();
        let now = controls.iter().find(|control| control.label == "Frequency" && control.role == "Slider")?;
        (now.number != before).then_some(())
    });
    for (label, shows) in [("Keys", "What is this?"), ("What is this?", "Look around")] {
        let button = page.find(label, &["Button"]);
        let [left, top, right, bottom] = button.bounds;
        assert!(left >= 0.0 && top >= 0.0 && right <= 360.0 && bottom <= 760.0, "{button:?}");
        page.click(button.at(0.5, 0.5));
        page.find(shows, &["Button"]);
    }
    page.close();
}

#[test]
#[ignore = "needs the built page and Chromium: make test"]
fn the_emulated_phone_of_a_browsers_tools_has_a_canvas_of_its_own_pixels() {
    let mut page = Page::open(360, 760, Theme::Dark);
    for ratio in [3.0, 2.625] {
        page.emulate_phone(360, 760, ratio);
        page.reload();
        page.find("Frequency", &["Slider"]);
        let told =
            page.script("return [devicePixelRatio, canvas.width / innerWidth, canvas.height / innerHeight]");
        for part in 0..3 {
            let found = told[part].as_f64().unwrap_or_default();
            assert!((found - ratio).abs() < 0.01, "{told}");
        }
        let slider = page.slider("Frequency");
        assert!(slider.bounds[2] > 300.0 && slider.bounds[2] <= 360.0, "{slider:?}");
        page.screenshot("phone-emulated");
    }
    page.close();
}
