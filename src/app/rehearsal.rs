//! The whole app without a window, for tests: what it computes, it computes at once.

use std::cell::RefCell;
use std::rc::Rc;

use egui::{Event, Key, Modifiers};

use super::App;
use super::crew::{Crew, Inline};
use super::widgets::harness::Harness;

/// An app that remembers what is `stored`.
pub(super) fn app(context: &egui::Context, stored: Option<&str>) -> App {
    let crew = Rc::new(RefCell::new(Crew::new(Box::new(Inline::default()))));
    App::new(context, stored, crew)
}

/// An app and the pictures it draws.
pub(super) struct Desk {
    pub(super) app: App,
    pub(super) harness: Harness,
}

impl Desk {
    /// A page of this size, in points, that remembers what is `stored`. Nothing is drawn yet.
    pub(super) fn new(width: f32, height: f32, stored: &str) -> Self {
        let harness = Harness::new(width, height);
        Self { app: app(&harness.context, Some(stored)), harness }
    }

    /// Pictures of a page that goes on with its work between them.
    pub(super) fn work(&mut self, frames: usize) {
        for _ in 0..frames {
            self.app.logic(&self.harness.context.clone());
            self.rest(1);
        }
    }

    /// Pictures for which nothing is computed.
    pub(super) fn rest(&mut self, frames: usize) {
        (0..frames).for_each(|_| self.frame(Vec::new()));
    }

    fn frame(&mut self, events: Vec<Event>) {
        self.harness.frame(events, |ui| self.app.ui(ui));
    }

    /// Presses and releases a key.
    pub(super) fn press(&mut self, key: Key, modifiers: Modifiers) {
        for pressed in [true, false] {
            self.frame(vec![Event::Key { key, physical_key: None, pressed, repeat: false, modifiers }]);
        }
        self.rest(1);
    }
}
