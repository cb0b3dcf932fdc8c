//! The track with its thumb: pointer, keyboard and accessibility.

use egui::accesskit::{Action, ActionData};
use egui::{
    CornerRadius, Event, EventFilter, Id, Key, Pos2, Rect, Response, Sense, Stroke, Ui, WidgetInfo, pos2,
    vec2,
};

use super::mapping::Mapping;
use super::marks::{self, Mark};
use crate::app::theme;
use crate::app::widgets::touch;

/// Height of the drawn track and radius of the thumb, points.
const TRACK: f32 = 5.0;
const THUMB: f32 = 8.0;
/// Parts of the pointer's way that a thumb goes when it is moved finely, and within `NEAR` of a mark, a part of the track.
const FINE: f64 = 0.1;
const FINEST: f64 = 0.04;
const NEAR: f64 = 0.02;
/// How far from the track a finger moves the thumb finely, points.
const FAR: f32 = 60.0;
/// How far a finger moves before it is clear whether it slides the thumb or scrolls the page, points.
const DECIDED: f32 = 8.0;

/// What the track reports.
pub(super) struct Outcome {
    pub(super) response: Response,
    /// A new value, if the user asked for one.
    pub(super) value: Option<f64>,
    /// Whether the user is done for now: the thumb was let go, or a key or a screen reader moved it.
    pub(super) released: bool,
    /// Where the thumb is to be drawn, from 0 to 1.
    fraction: f32,
}

/// The part of `area` between the thumb's extreme positions.
pub(super) fn rail(area: Rect) -> Rect {
    Rect::from_center_size(area.center(), vec2((area.width() - 2.0 * THUMB).max(1.0), TRACK))
}

/// Lets the track in `area` be used; the whole of it can be grabbed. [`paint`] draws it.
pub(super) fn interact(
    ui: &Ui,
    id: Id,
    area: Rect,
    name: &str,
    value: f64,
    mapping: &Mapping,
    snaps: &[Mark],
) -> Outcome {
    let rail = rail(area);
    touch::grip(ui, area);
    let response =
        ui.interact(area, id, Sense::drag()).on_hover_and_drag_cursor(egui::CursorIcon::PointingHand);
    let places: Vec<f64> = snaps.iter().map(|mark| mapping.fraction(mark.value)).collect();
    let dragged = dragged_to(ui, &response, rail, mapping.fraction(value), &places);
    let dragged = dragged.map(|(fraction, fine)| mapping.rounded_value(fraction, fine));
    let pressed =
        keyboard(ui, &response, value, mapping, snaps).or_else(|| screen_reader(ui, id, value, mapping));
    let new = dragged.or(pressed).filter(|new| *new != value);
    let released = response.drag_stopped() || (dragged.is_none() && pressed.is_some());

    let shown = new.unwrap_or(value);
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::slider(enabled, shown, name));
    ui.ctx().accesskit_node_builder(id, |node| {
        node.set_min_numeric_value(*mapping.range().start());
        node.set_max_numeric_value(*mapping.range().end());
        for action in [Action::SetValue, Action::Increment, Action::Decrement] {
            node.add_action(action);
        }
    });
    Outcome { response, value: new, released, fraction: mapping.fraction(shown) as f32 }
}

/// How a thumb is held.
#[derive(Clone, Copy, Default)]
struct Grab {
    /// How far from its middle, points.
    offset: f32,
    /// While it moves finely: where the pointer was when that began, or was last, and the thumb then.
    fine: Option<(f32, f64)>,
    /// A finger: where it came down, and what it is about.
    finger: Option<(Pos2, Way)>,
}

/// What a finger on a track is about. Its first movement decides.
#[derive(Clone, Copy, PartialEq)]
enum Way {
    Open,
    Slides,
    Scrolls,
}

/// What the finger is about after `moved` from where it came down.
fn way(before: Way, moved: egui::Vec2) -> Way {
    match before {
        Way::Open if moved.length() < DECIDED => Way::Open,
        Way::Open if moved.y.abs() > moved.x.abs() => Way::Scrolls,
        Way::Open => Way::Slides,
        decided => decided,
    }
}

/// The fraction the pointer asks for, and whether finely. The thumb keeps the offset at which it was grabbed; with Shift
/// held, or the finger far from the track, it moves a tenth as far as the pointer, and less about one of the `places`.
fn dragged_to(ui: &Ui, response: &Response, rail: Rect, now: f64, places: &[f64]) -> Option<(f64, bool)> {
    let pointer = response.interact_pointer_pos()?;
    let id = response.id.with("grab");
    let mut grab: Grab = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    let thumb_x = rail.left() + rail.width() * now as f32;
    let aside = (pointer.y - rail.center().y).abs() > FAR && touch::in_use(ui.ctx());
    let fine = aside || ui.input(|input| input.modifiers.shift);
    let here = (f64::from((pointer.x - rail.left()) / rail.width()), false);
    if ui.input(|input| input.pointer.any_pressed()) {
        let offset = pointer.x - thumb_x;
        let held = offset.abs() <= THUMB;
        // In a slow picture the finger has moved on already.
        let down = ui.input(|input| input.pointer.press_origin()).unwrap_or(pointer);
        let finger = touch::in_use(ui.ctx()).then_some((down, Way::Open));
        let offset = if held { offset } else { 0.0 };
        grab = Grab { offset, fine: fine.then_some((pointer.x, now)), finger };
        ui.data_mut(|data| data.insert_temp(id, grab));
        if finger.is_some() {
            return None;
        }
        response.request_focus();
        return (!held).then_some(here);
    }
    if let Some((down, before)) = grab.finger {
        let moved = pointer - down;
        let way = way(before, moved);
        grab.finger = Some((down, way));
        ui.data_mut(|data| data.insert_temp(id, grab));
        match way {
            Way::Scrolls => {
                let turn = ui.input(|input| input.pointer.delta().y);
                touch::scroll(ui.ctx(), if before == Way::Open { moved.y } else { turn });
                return None;
            }
            // A tap.
            Way::Open => return response.drag_stopped().then_some(here),
            Way::Slides if before == Way::Open => response.request_focus(),
            Way::Slides => {}
        }
    }
    if response.drag_stopped() {
        return None;
    }
    let asked = if fine {
        let (from, place) = grab.fine.unwrap_or((pointer.x, now));
        let near = places.iter().any(|mark| (place - mark).abs() < NEAR);
        let part = f64::from((pointer.x - from) / rail.width()) * if near { FINEST } else { FINE };
        let place = (place + part).clamp(0.0, 1.0);
        grab.fine = Some((pointer.x, place));
        (from != pointer.x).then_some((place, true))
    } else {
        if grab.fine.take().is_some() {
            // The thumb goes on from where it is.
            grab.offset = pointer.x - thumb_x;
        }
        let unmoved = (pointer.x - grab.offset - thumb_x).abs() < 0.5;
        let fraction = f64::from((pointer.x - grab.offset - rail.left()) / rail.width());
        (!unmoved).then_some((fraction, false))
    };
    ui.data_mut(|data| data.insert_temp(id, grab));
    asked
}

/// Where the track that has the focus is noted.
fn focused() -> egui::Id {
    egui::Id::unique("track with the focus")
}

/// Whether this is the track that had the focus last: Space and Enter, which press other controls, do nothing there.
pub fn is_track(context: &egui::Context, id: egui::Id) -> bool {
    context.data(|data| data.get_temp(focused())) == Some(id)
}

/// The value after this frame's key presses, if there were any.
fn keyboard(ui: &Ui, response: &Response, value: f64, mapping: &Mapping, snaps: &[Mark]) -> Option<f64> {
    if !response.has_focus() {
        return None;
    }
    ui.data_mut(|data| data.insert_temp(focused(), response.id));
    let filter = EventFilter { horizontal_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    let presses: Vec<(Key, egui::Modifiers)> = ui.input(|input| {
        let pressed = |event: &Event| match event {
            Event::Key { key, pressed: true, modifiers, .. } => Some((*key, *modifiers)),
            _ => None,
        };
        input.events.iter().filter_map(pressed).collect()
    });
    let mut new = None;
    for (key, modifiers) in presses {
        let current = new.unwrap_or(value);
        let step = if modifiers.shift { 1.0 / 2000.0 } else { 1.0 / 200.0 };
        new = match key {
            Key::ArrowLeft | Key::ArrowRight if modifiers.command => {
                marks::neighbour(snaps, mapping, current, key == Key::ArrowRight).or(new)
            }
            Key::ArrowRight => Some(moved(mapping, current, step)),
            Key::ArrowLeft => Some(moved(mapping, current, -step)),
            Key::PageUp => Some(moved(mapping, current, 0.05)),
            Key::PageDown => Some(moved(mapping, current, -0.05)),
            Key::Home => Some(*mapping.range().start()),
            Key::End => Some(*mapping.range().end()),
            _ => new,
        };
    }
    new
}

/// What a screen reader asked for.
fn screen_reader(ui: &Ui, id: Id, value: f64, mapping: &Mapping) -> Option<f64> {
    ui.input(|input| {
        let count = |action| input.num_accesskit_action_requests(id, action) as f64;
        let steps = count(Action::Increment) - count(Action::Decrement);
        let set =
            input.accesskit_action_requests(id, Action::SetValue).filter_map(|request| match request.data {
                Some(ActionData::NumericValue(number)) if number.is_finite() => Some(number),
                _ => None,
            });
        let stepped = (steps != 0.0).then(|| moved(mapping, value, steps / 200.0));
        set.last().map(|number| number.clamp(*mapping.range().start(), *mapping.range().end())).or(stepped)
    })
}

/// `value` moved by a part of the track, rounded when that does not swallow the step.
fn moved(mapping: &Mapping, value: f64, step: f64) -> f64 {
    let fraction = mapping.fraction(value) + step;
    let rounded = mapping.rounded_value(fraction, false);
    let resolved = (mapping.fraction(rounded) - fraction).abs() < 0.2 * step.abs();
    if resolved { rounded } else { super::super::number::round_significant(mapping.value(fraction), 6) }
        .clamp(*mapping.range().start(), *mapping.range().end())
}

/// Draws the track and its thumb, over the marks.
pub(super) fn paint(ui: &Ui, outcome: &Outcome, area: Rect) {
    let Outcome { response, fraction, .. } = outcome;
    let rail = rail(area);
    let tokens = theme::tokens(ui);
    let x = rail.left() + rail.width() * fraction;
    let corners = CornerRadius::same(3);
    let painter = ui.painter();
    painter.rect_filled(rail.expand2(vec2(THUMB - 2.0, 0.0)), corners, tokens.track);
    let filled = Rect::from_min_max(rail.left_top() - vec2(THUMB - 2.0, 0.0), pos2(x, rail.bottom()));
    painter.rect_filled(filled, corners, tokens.accent);
    let centre = pos2(x, rail.center().y);
    let active = response.dragged() || response.has_focus();
    if active || response.hovered() {
        let halo = tokens.accent.gamma_multiply(if active { 0.35 } else { 0.2 });
        painter.circle_filled(centre, THUMB + 4.0, halo);
    }
    let rim = if tokens.dark { Stroke::new(2.0, tokens.card) } else { Stroke::new(2.0, tokens.accent) };
    painter.circle(centre, THUMB, tokens.thumb, rim);
}
