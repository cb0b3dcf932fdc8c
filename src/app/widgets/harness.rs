//! Frames of an egui context without a window, fed with synthetic input.

use egui::{Event, Key, Modifiers, PointerButton, Pos2, RawInput, Rect, Ui, vec2};

use crate::app::{fonts, theme};

/// A context with the app's fonts and look, and a clock.
pub(in crate::app) struct Harness {
    pub(in crate::app) context: egui::Context,
    size: egui::Vec2,
    time: f64,
    /// Role, label, value and bounds of every widget of the last frame.
    pub(in crate::app) nodes: Vec<Node>,
    /// The texts that were painted, with how much of each is in sight.
    pub(in crate::app) texts: Vec<(String, f32)>,
}

/// One widget as the accessibility tree shows it.
#[derive(Debug, Clone)]
pub(in crate::app) struct Node {
    pub(in crate::app) id: egui::accesskit::NodeId,
    /// Whether Tab can bring the focus there, and whether it is there.
    pub(in crate::app) focusable: bool,
    pub(in crate::app) focused: bool,
    pub(in crate::app) role: egui::Role,
    pub(in crate::app) label: String,
    pub(in crate::app) number: Option<f64>,
    pub(in crate::app) bounds: Rect,
}

impl Harness {
    pub(in crate::app) fn new(width: f32, height: f32) -> Self {
        let context = egui::Context::default();
        fonts::install(&context, None);
        theme::apply(&context, &theme::DARK);
        context.enable_accesskit();
        Self { context, size: vec2(width, height), time: 0.0, nodes: Vec::new(), texts: Vec::new() }
    }

    /// One frame, 1/60 s after the previous, with these events.
    pub(in crate::app) fn frame(&mut self, events: Vec<Event>, mut draw: impl FnMut(&mut Ui)) {
        self.time += 1.0 / 60.0;
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, self.size)),
            time: Some(self.time),
            focused: true,
            events,
            ..RawInput::default()
        };
        let mut output = self.context.run_ui(input, |ui| {
            egui::CentralPanel::default().show(ui, |ui| draw(ui));
        });
        if let Some(update) = output.platform_output.accesskit_update.take() {
            self.nodes = update
                .nodes
                .iter()
                .map(|(id, node)| Node { focused: *id == update.focus, ..Node::read(*id, node) })
                .collect();
        }
        self.texts =
            output.shapes.iter().filter_map(|clipped| painted(clipped.clip_rect, &clipped.shape)).collect();
        output.drop_without_applying_deltas();
    }

    /// Makes the page another size from the next frame on.
    pub(in crate::app) fn resize(&mut self, width: f32, height: f32) {
        self.size = vec2(width, height);
    }

    /// Enough frames without input for layout and hit testing to settle.
    pub(in crate::app) fn settle(&mut self, mut draw: impl FnMut(&mut Ui)) {
        for _ in 0..3 {
            self.frame(Vec::new(), &mut draw);
        }
    }

    /// The first widget of that role whose label starts with `label`.
    pub(in crate::app) fn find(&self, role: egui::Role, label: &str) -> Node {
        let found = self.nodes.iter().find(|node| node.role == role && node.label.starts_with(label));
        found.unwrap_or_else(|| panic!("no {role:?} {label:?} in {:#?}", self.nodes)).clone()
    }

    /// What has the focus.
    pub(in crate::app) fn focused(&self) -> Option<&Node> {
        self.nodes.iter().find(|node| node.focused)
    }

    /// Presses and releases the primary button at `position`.
    pub(in crate::app) fn click(&mut self, position: Pos2, mut draw: impl FnMut(&mut Ui)) {
        self.frame(vec![Event::PointerMoved(position)], &mut draw);
        self.frame(vec![button(position, true)], &mut draw);
        self.frame(vec![button(position, false)], &mut draw);
    }

    /// Drags from one place to another in a few steps, and lets go.
    pub(in crate::app) fn drag(&mut self, from: Pos2, to: Pos2, mut draw: impl FnMut(&mut Ui)) {
        self.frame(vec![Event::PointerMoved(from)], &mut draw);
        self.frame(vec![button(from, true)], &mut draw);
        for step in 1..=4 {
            self.frame(vec![Event::PointerMoved(from.lerp(to, step as f32 / 4.0))], &mut draw);
        }
        self.frame(vec![button(to, false)], &mut draw);
    }

    /// Presses a key with modifiers held.
    pub(in crate::app) fn key(&mut self, key: Key, modifiers: Modifiers, mut draw: impl FnMut(&mut Ui)) {
        for pressed in [true, false] {
            let event = Event::Key { key, physical_key: None, pressed, repeat: false, modifiers };
            let held = if pressed { modifiers } else { Modifiers::NONE };
            self.frame(vec![Event::ModifiersChanged(held), event], &mut draw);
        }
    }

    /// Types text into whatever has the keyboard.
    pub(in crate::app) fn text(&mut self, text: &str, draw: impl FnMut(&mut Ui)) {
        self.frame(vec![Event::Text(text.to_owned())], draw);
    }
}

impl Node {
    fn read(id: egui::accesskit::NodeId, node: &egui::accesskit::Node) -> Self {
        let bounds = node.bounds().map_or(Rect::NOTHING, |b| {
            Rect::from_min_max(Pos2::new(b.x0 as f32, b.y0 as f32), Pos2::new(b.x1 as f32, b.y1 as f32))
        });
        let label = node.label().or(node.value()).unwrap_or_default().to_owned();
        let focusable = node.supports_action(egui::accesskit::Action::Focus) && !node.is_disabled();
        Self { id, focusable, focused: false, role: node.role(), label, number: node.numeric_value(), bounds }
    }
}

fn painted(clip: Rect, shape: &egui::Shape) -> Option<(String, f32)> {
    let egui::Shape::Text(text) = shape else { return None };
    let bounds = text.visual_bounding_rect();
    let seen = clip.intersect(bounds);
    let share = if seen.is_positive() { seen.area() / bounds.area() } else { 0.0 };
    Some((text.galley.text().to_owned(), share))
}

fn button(pos: Pos2, pressed: bool) -> Event {
    Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::default() }
}
