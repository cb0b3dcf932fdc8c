//! The page inside of another one: `?embed=map,phase&controls=omega` shows just these, for a frame in slides.
//!
//! `app::embed` reads `?embed=..&controls=..`; `panels::embedded` draws instead of the page, from the panels that the
//! tabs draw, and `app::asking` asks for what these show. The keeper of such a page has no storage and leaves the
//! address alone. `bridge` asks `App::keeps` of each event whether the browser is to do nothing more with it: the
//! wheel and a finger belong to the page around, unless Ctrl is down, the contents are too tall for the frame, or the
//! finger is on a `widgets::touch::grip`. `touch-action: pan-y` lets the browser scroll then; it tells of that by a
//! cancelled touch, which eframe does not pass on as the end of a press, so `touch::end_cancelled` does. Where fingers
//! are used, plots do not sense drags, in the whole page neither: one finger scrolls, two zoom.

use std::cell::Cell;

use super::text::{fill, tr};
use super::view::Panel;
use crate::model::{Dimension, Parameter};
use crate::sentence::Say;

/// Characters of an unknown name that are repeated, and names that are.
const SHOWN_CHARACTERS: usize = 24;
const SHOWN_NAMES: usize = 4;

/// What can stand in an embedded page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// The bar with the verdict.
    Verdict,
    /// The moving beam.
    Beam,
    /// What drives the live run.
    Live,
    /// A plot, or what the verdict rests on.
    Plot(Panel),
}

/// Parts with their names in addresses, and what they are called.
pub type Parts = Vec<(Part, &'static str, &'static str)>;

/// What can be changed in an embedded page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Control {
    /// One of the ten dimensionless numbers.
    Number(Parameter),
    /// A dimension of the device.
    Dimension(Dimension),
    /// How many modes are kept.
    Modes,
    /// The force law.
    Force,
}

/// What an address asks to be shown.
#[derive(Debug)]
pub struct Embed {
    /// Without doubles, in the order given.
    pub parts: Vec<Part>,
    /// Without doubles, in the order given.
    pub controls: Vec<Control>,
    /// What of the address was not understood.
    pub complaint: Option<String>,
    /// How far the contents can be scrolled, up and down: a frame can be too low for them.
    pub room: Cell<[f32; 2]>,
    /// Whether the finger holds a control of the page rather than what is around it.
    pub held: Cell<bool>,
    /// Whether it has moved without holding one: the browser may be scrolling by it then.
    pub swiped: Cell<bool>,
}

impl Embed {
    /// Reads the part of an address from `?` on, which names some of `all` parts; the first two plots when it names none.
    /// `None` when it is that of the whole page.
    #[must_use]
    pub fn read(search: &str, all: &Parts) -> Option<Self> {
        let (mut parts, mut controls) = (None, Vec::new());
        let (mut unknown_parts, mut unknown_controls) = (Vec::new(), Vec::new());
        for (name, value) in form_urlencoded::parse(search.trim_start_matches('?').as_bytes()) {
            let words = value.split([',', ' ']).filter(|word| !word.is_empty());
            match &*name {
                "embed" => {
                    let known = |word: &str| all.iter().find(|part| part.1 == word).map(|part| part.0);
                    collect(words, &known, parts.get_or_insert_default(), &mut unknown_parts);
                }
                "controls" => collect(words, &control, &mut controls, &mut unknown_controls),
                _ => {}
            }
        }
        let mut parts = parts?;
        if parts.is_empty() {
            parts.extend(all.iter().map(|part| part.0).filter(|part| matches!(part, Part::Plot(_))).take(2));
        }
        let part_names: Vec<&str> = all.iter().map(|part| part.1).collect();
        let complaints = [
            complaint("embed", &unknown_parts, &part_names),
            complaint("controls", &unknown_controls, &control_names()),
        ];
        let complaints: Vec<String> = complaints.into_iter().flatten().collect();
        let complaint = (!complaints.is_empty()).then(|| complaints.join(" "));
        Some(Self {
            parts,
            controls,
            complaint,
            room: Cell::default(),
            held: Cell::default(),
            swiped: Cell::default(),
        })
    }

    /// Whether this plot is shown.
    #[must_use]
    pub fn shows(&self, panel: Panel) -> bool {
        self.parts.contains(&Part::Plot(panel))
    }

    /// Whether the page keeps an event for itself. Otherwise the browser scrolls what is around the frame.
    pub fn keeps(&self, event: &egui::Event, on_grip: &dyn Fn(egui::Pos2) -> bool) -> bool {
        let [up, down] = self.room.get();
        match event {
            egui::Event::MouseWheel { delta, modifiers, .. } => {
                let scrolls = if delta.y > 0.0 { up } else { down } > 0.5 && delta.y != 0.0;
                modifiers.ctrl || modifiers.command || scrolls
            }
            egui::Event::PointerButton { pos, pressed: true, .. } => {
                self.held.set(up + down > 0.5 || on_grip(*pos));
                self.swiped.set(false);
                self.held.get()
            }
            egui::Event::PointerMoved(_) => {
                self.swiped.set(!self.held.get());
                self.held.get()
            }
            // Otherwise a tap would be told once more as that of a mouse.
            egui::Event::PointerButton { .. } => !self.swiped.get(),
            _ => true,
        }
    }
}

fn collect<'a, T: PartialEq>(
    words: impl Iterator<Item = &'a str>,
    known: &dyn Fn(&str) -> Option<T>,
    found: &mut Vec<T>,
    unknown: &mut Vec<String>,
) {
    for word in words {
        match known(word) {
            Some(thing) if !found.contains(&thing) => found.push(thing),
            Some(_) => {}
            None => unknown.push(word.chars().take(SHOWN_CHARACTERS).collect()),
        }
    }
}

/// The control of this name, which is that of links.
fn control(word: &str) -> Option<Control> {
    match word {
        "modes" => Some(Control::Modes),
        "force" => Some(Control::Force),
        _ => Parameter::named(word)
            .map(Control::Number)
            .or_else(|| Dimension::named(word).map(Control::Dimension)),
    }
}

/// The names of all controls, as in links.
#[must_use]
pub fn control_names() -> Vec<&'static str> {
    let numbers = Parameter::ALL.iter().map(|parameter| parameter.field());
    let dimensions = Dimension::ALL.iter().map(|dimension| dimension.field());
    numbers.chain(["modes", "force"]).chain(dimensions).collect()
}

fn complaint(name: &str, unknown: &[String], allowed: &[&str]) -> Option<String> {
    if unknown.is_empty() {
        return None;
    }
    let named = unknown[..unknown.len().min(SHOWN_NAMES)].join(", ");
    let values: [(&str, &dyn Say); 3] =
        [("name", &name), ("unknown", &named), ("allowed", &allowed.join(", "))];
    Some(fill("Not understood in {name}: {unknown}. There are {allowed}.", &values))
}

/// The element that shows the parts of these names of the page at `address`, as HTML.
#[must_use]
pub fn snippet(address: &str, fragment: &str, parts: &[&str], controls: &[&str]) -> String {
    let query = format!("embed={}&controls={}", parts.join(","), controls.join(","));
    let source = format!("{address}?{query}#{fragment}").replace('&', "&amp;").replace('"', "&quot;");
    let title = tr("Harvester Lab");
    format!(
        "<iframe src=\"{source}\" title=\"{title}\" width=\"960\" height=\"540\" style=\"border:0\"></iframe>"
    )
}

#[cfg(test)]
mod tests;
