//! List and guide, drawn without a window.

use egui::{Rect, Role, pos2};

use crate::app::lessons::LessonId;
use crate::app::rehearsal::Desk;
use crate::app::widgets::harness::Node;

fn desk(width: f32, height: f32, view: &str) -> Desk {
    Desk::new(width, height, &format!(r#"{{"scenario":{{"t_end":50}},{view}}}"#))
}

#[test]
fn every_card_holds_its_texts_at_every_width() {
    for width in [360.0, 768.0, 1024.0, 1280.0, 1440.0, 1920.0] {
        let mut desk = desk(width, 2400.0, r#""tab":"lessons""#);
        desk.work(3);
        for id in LessonId::all() {
            let lesson = id.lesson().expect("a lesson");
            let card = desk.harness.find(Role::Button, &format!("Begin: {}", lesson.title.get())).bounds;
            let texts: Vec<&Node> = desk
                .harness
                .nodes
                .iter()
                .filter(|node| node.role == Role::Label && card.contains(node.bounds.left_top()))
                .collect();
            assert_eq!(texts.len(), 3, "{id} at {width}: title, summary, length");
            for (i, a) in texts.iter().enumerate() {
                assert!(card.contains_rect(a.bounds), "{id} at {width}: {a:?} leaves {card:?}");
                for b in &texts[i + 1..] {
                    let common = a.bounds.shrink(1.0).intersect(b.bounds.shrink(1.0));
                    assert!(!common.is_positive(), "{id} at {width}: {a:?} over {b:?}");
                }
            }
        }
    }
}

#[test]
fn every_step_has_its_buttons_on_the_page_and_leaves_room_for_the_plots() {
    for (width, height) in [(360.0, 760.0), (1024.0, 768.0), (1440.0, 900.0)] {
        let page = Rect::from_min_size(pos2(0.0, 0.0), egui::vec2(width, height));
        for id in LessonId::all() {
            let lesson = id.lesson().expect("a lesson");
            for step in 1..=lesson.steps.len() {
                let mut desk = desk(width, height, &format!(r#""lesson":"{id}","step":{step}"#));
                desk.work(4);
                let next = if step == lesson.steps.len() { "Finish" } else { "Next" };
                for label in ["Leave the lesson", "Back", next] {
                    let bounds = desk.harness.find(Role::Button, label).bounds;
                    assert!(
                        page.contains_rect(bounds),
                        "{id}, step {step}, at {width}: {label} at {bounds:?}"
                    );
                }
                // Beside the plots or below them, they keep more than half of the page.
                let leave = desk.harness.find(Role::Button, "Leave the lesson").bounds;
                let beside = width >= 1200.0;
                let room = if beside { leave.right() - 320.0 } else { leave.top() };
                assert!(
                    room > 0.5 * if beside { width } else { height },
                    "{id}, step {step}, at {width}: {room}"
                );
            }
        }
    }
}

#[test]
fn who_has_done_the_last_step_is_offered_the_next_lesson() {
    let lessons: Vec<LessonId> = LessonId::all().collect();
    for pair in lessons.windows(2) {
        let steps = pair[0].lesson().expect("a lesson").steps.len();
        for (width, height) in [(360.0, 760.0), (1440.0, 900.0)] {
            let view = format!(r#""lesson":"{}","step":{steps}"#, pair[0]);
            let mut desk = desk(width, height, &view);
            desk.work(1);
            let progress = desk.app.course.note(&desk.app.view);
            (progress.reached, progress.answer) = (true, Some(0));
            desk.work(3);
            let [next, finish] =
                ["Next lesson", "Finish"].map(|name| desk.harness.find(Role::Button, name).bounds);
            let page = Rect::from_min_size(pos2(0.0, 0.0), egui::vec2(width, height));
            assert!(page.contains_rect(next) && !next.intersects(finish), "{} {next:?}", pair[0]);
            let Desk { app, harness } = &mut desk;
            harness.click(next.center(), |ui| app.ui(ui));
            assert_eq!((desk.app.view.lesson, desk.app.view.step), (Some(pair[1]), 1));
            assert!(desk.app.course.is_finished(pair[0]));
        }
    }
}

#[test]
fn on_a_phone_a_step_has_the_tabs_when_it_asks_for_one() {
    for (step, asks) in [(1, false), (2, false), (3, true), (4, true)] {
        let mut desk = desk(360.0, 760.0, &format!(r#""lesson":"tour","step":{step}"#));
        desk.rest(3);
        let live = |node: &Node| node.role == Role::Tab && node.label == "Live";
        assert_eq!(desk.harness.nodes.iter().any(live), asks, "step {step}");
    }
}
