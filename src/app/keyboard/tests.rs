//! The whole app by keyboard, without a window.

use std::collections::BTreeSet;

use egui::{Key, Modifiers};

use crate::app::rehearsal::Desk;
use crate::app::view::{Panel, Tab};

fn desk(width: f32, stored: &str) -> Desk {
    let mut desk = Desk::new(width, 900.0, stored);
    desk.work(20);
    desk
}

#[test]
fn tab_reaches_every_control_of_every_page_and_brings_it_into_view() {
    let pages = ["harvest", "load", "materials", "trust", "search", "tolerances", "measured"];
    let tabs = ["explore", "live", "stability", "sweep", "paper"].map(|tab| (tab, "harvest"));
    for (tab, page) in tabs.into_iter().chain(pages.map(|page| ("design", page))) {
        for width in [360.0, 1440.0] {
            let stored = format!(
                r#"{{"scenario":{{"t_end":100}},"tab":"{tab}","beam_moves":false,"design":{{"page":"{page}"}}}}"#
            );
            let mut desk = desk(width, &stored);
            let (mut reached, mut first) = (BTreeSet::new(), None);
            for step in 0.. {
                assert!(step < 400, "{tab} {page} at {width}: the focus does not come round");
                desk.press(Key::Tab, Modifiers::NONE);
                let focused = desk.harness.focused().expect("something has the focus");
                assert!(!focused.label.is_empty(), "{tab} {page} at {width}: nameless {focused:?}");
                let page = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(width, 900.0));
                if !page.intersects(focused.bounds) {
                    desk.rest(40);
                }
                let focused = desk.harness.focused().expect("it keeps the focus");
                assert!(page.intersects(focused.bounds), "{tab} at {width}: out of sight: {focused:?}");
                let id = focused.id;
                if *first.get_or_insert(id) == id && !reached.is_empty() {
                    break;
                }
                reached.insert(id);
            }
            let missed: Vec<_> = desk
                .harness
                .nodes
                .iter()
                .filter(|node| node.focusable && !reached.contains(&node.id))
                .collect();
            assert!(missed.is_empty(), "{tab} {page} at {width}: {missed:#?}");
            assert!(reached.len() > 20, "{tab} {page} at {width}: {} controls", reached.len());
        }
    }
}

#[test]
fn keys_do_what_the_list_says() {
    let mut desk = desk(1440.0, r#"{"scenario":{"t_end":100}}"#);
    let plain = Modifiers::NONE;
    desk.press(Key::Num4, plain);
    assert_eq!(desk.app.view.tab, Tab::Sweep);
    desk.press(Key::Num1, plain);
    for plot in [Some(Panel::StabilityMap), Some(Panel::PhasePortrait)] {
        desk.press(Key::F, plain);
        assert_eq!(desk.app.view.enlarged, plot);
    }
    desk.press(Key::Escape, plain);
    assert_eq!(desk.app.view.enlarged, None);
    let dark = desk.app.view.dark;
    desk.press(Key::D, plain);
    desk.press(Key::L, plain);
    desk.press(Key::P, plain);
    assert!(desk.app.view.dark != dark && desk.app.view.projector && desk.app.session.pinned.is_some());
    desk.press(Key::L, plain);
    desk.press(Key::Questionmark, Modifiers::SHIFT);
    desk.rest(3);
    desk.harness.find(egui::Role::Button, "Close");
    // What lies over the page keeps the keys to itself.
    desk.press(Key::Num2, plain);
    assert_eq!(desk.app.view.tab, Tab::Explore);
    desk.press(Key::Escape, plain);
    desk.press(Key::Num3, plain);
    assert_eq!(desk.app.view.tab, Tab::Stability);
    desk.press(Key::Z, Modifiers::COMMAND);
    assert_eq!(desk.app.view.tab, Tab::Explore);
}

#[test]
fn the_live_run_has_keys_and_leaves_undo_alone() {
    let mut desk = desk(1440.0, r#"{"scenario":{"t_end":100},"tab":"live"}"#);
    let plain = Modifiers::NONE;
    let turns = |desk: &Desk| desk.app.live.now().map_or(f64::NAN, |(_, _, now)| now.turns);
    let running = turns(&desk);
    desk.rest(10);
    assert!(turns(&desk) > running && running >= 0.0);
    desk.press(Key::Space, plain);
    let paused = turns(&desk);
    desk.rest(10);
    assert_eq!(turns(&desk), paused);
    desk.press(Key::Period, plain);
    assert_eq!(turns(&desk), paused + 1.0);
    desk.press(Key::S, plain);
    assert!(desk.app.live.sounds());
    desk.press(Key::S, plain);
    desk.press(Key::R, plain);
    assert_eq!((turns(&desk), desk.app.live.sounds()), (0.0, false));
    // A slider that was dragged does not keep Space to itself.
    let slider = desk.harness.find(egui::Role::Slider, "Damping").bounds;
    let Desk { app, harness } = &mut desk;
    harness.drag(slider.center(), slider.center() + egui::vec2(20.0, 0.0), |ui| app.ui(ui));
    desk.press(Key::Space, plain);
    let before = turns(&desk);
    desk.rest(10);
    assert!(turns(&desk) > before);
    // The drag is the one step there is.
    desk.press(Key::K, plain);
    desk.press(Key::Z, Modifiers::COMMAND);
    assert!(!desk.app.history.can().0);
    for plot in [Some(Panel::Oscilloscope), Some(Panel::LivePortrait), Some(Panel::LiveBeam), None] {
        desk.press(Key::F, plain);
        assert_eq!(desk.app.view.enlarged, plot);
    }
}

#[test]
fn no_key_is_a_shortcut_while_a_number_is_typed() {
    let mut desk = desk(1440.0, r#"{"scenario":{"t_end":100}}"#);
    let field = desk.harness.find(egui::Role::TextInput, "Damping value").bounds.center();
    let Desk { app, harness } = &mut desk;
    harness.click(field, |ui| app.ui(ui));
    desk.rest(2);
    let before = desk.app.view.clone();
    for key in [Key::Num2, Key::D, Key::F, Key::P, Key::Questionmark] {
        desk.press(key, Modifiers::NONE);
    }
    assert_eq!(desk.app.view, before);
    assert!(!super::shortcuts::SHEET.is_open(&desk.harness.context));
}
