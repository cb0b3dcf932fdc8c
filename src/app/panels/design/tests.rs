//! The Design tab, drawn without a window.

use std::cell::RefCell;
use std::rc::Rc;

use egui::Role;

use crate::app::App;
use crate::app::crew::{Crew, Inline};
use crate::app::widgets::harness::{Harness, Node};

fn app(harness: &Harness, page: &str) -> App {
    let crew = Rc::new(RefCell::new(Crew::new(Box::new(Inline::default()))));
    let stored = format!(
        r#"{{"scenario":{{"parameters":{{"alpha":0.001}},"t_end":100}},"tab":"design","design":{{"page":"{page}"}}}}"#
    );
    App::new(&harness.context, Some(&stored), crew)
}

fn frames(app: &mut App, harness: &mut Harness, count: usize) {
    for _ in 0..count {
        let context = harness.context.clone();
        app.logic(&context);
        harness.frame(Vec::new(), |ui| app.ui(ui));
    }
}

#[test]
fn every_page_draws_on_a_phone_and_on_a_desk_without_labels_over_each_other() {
    for page in ["harvest", "load", "materials", "trust", "search", "measured"] {
        for width in [360.0, 1440.0] {
            let mut harness = Harness::new(width, 900.0);
            let mut app = app(&harness, page);
            frames(&mut app, &mut harness, 20);
            // A text that breaks has a rectangle in which its neighbours begin.
            let whole =
                |node: &&Node| node.role == Role::Label && node.bounds.height() < 28.0 && node.label != "·";
            let labels: Vec<_> = harness.nodes.iter().filter(whole).collect();
            assert!(labels.len() > 10, "{page} at {width}: {} labels", labels.len());
            for (i, a) in labels.iter().enumerate() {
                for b in &labels[i + 1..] {
                    let common = a.bounds.shrink(1.5).intersect(b.bounds.shrink(1.5));
                    assert!(!common.is_positive(), "{page} at {width}: {a:?} over {b:?}");
                }
            }
        }
    }
}

#[test]
fn the_summary_says_what_the_device_delivers() {
    let mut harness = Harness::new(1440.0, 900.0);
    let mut app = app(&harness, "harvest");
    for _ in 0..400 {
        frames(&mut app, &mut harness, 1);
        if harness.nodes.iter().any(|node| node.label.starts_with("Limits: ")) {
            break;
        }
    }
    for name in
        ["Voltage, rms: ", "Power in the load: ", "Power per g²: ", "Tip: ", "Efficiency: ", "Limits: safe"]
    {
        harness.find(Role::Label, name);
    }
}
