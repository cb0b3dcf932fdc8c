//! What fingers are for. A finger on a plot scrolls the page, as everywhere else on a phone, and two of them zoom the
//! plot; on a control made for dragging it drags. A mouse drags plots, too.

use egui::scroll_area::{DragScroll, ScrollSource};
use egui::style::ScrollAnimation;
use egui::{Context, Event, Id, Pos2, Rect, ScrollArea, TouchPhase, Ui};

/// Farther than a press may move and still be a click, points.
const NO_CLICK: f32 = 30.0;

#[derive(Clone, Default)]
struct Fingers {
    /// Whether the page was touched last, rather than pointed at.
    used: bool,
    /// What is dragged rather than scrolled.
    grips: Vec<Rect>,
    /// What comes in the next picture.
    late: Vec<Event>,
    /// How far what is touched is to be scrolled, points.
    turn: f32,
}

fn change<T>(context: &Context, with: impl FnOnce(&mut Fingers) -> T) -> T {
    context.data_mut(|data| with(data.get_temp_mut_or_default(Id::unique("fingers"))))
}

/// Says, before anything is touched, that fingers are what this screen is for.
pub fn expect_fingers(context: &Context) {
    change(context, |fingers| fingers.used = true);
}

/// Begins a frame.
pub fn begin_frame(context: &Context) {
    let (touched, pointed) = context.input(|input| {
        let touch = |event: &Event| matches!(event, Event::Touch { .. });
        let point = |event: &Event| matches!(event, Event::PointerMoved(_) | Event::MouseWheel { .. });
        (input.events.iter().any(touch), input.events.iter().any(point))
    });
    change(context, |fingers| {
        fingers.grips.clear();
        fingers.turn = 0.0;
        fingers.used = touched || (fingers.used && !pointed);
    });
}

/// Whether fingers are in use.
pub fn in_use(context: &Context) -> bool {
    change(context, |fingers| fingers.used)
}

/// Notes that what is here is dragged by a finger.
pub fn grip(ui: &Ui, rect: Rect) {
    let rect = rect.intersect(ui.clip_rect());
    change(ui.ctx(), |fingers| fingers.grips.push(rect));
}

/// What scrolls up and down. Under a finger its bar only tells where one is: who swipes along the edge means the page.
pub fn scroll_area(context: &Context) -> ScrollArea {
    ScrollArea::vertical().scroll_source(source(context))
}

/// The same of what scrolls from side to side.
pub fn sideways(context: &Context) -> ScrollArea {
    ScrollArea::horizontal().scroll_source(source(context))
}

/// What such an area is scrolled by. egui itself waits for a finger before its areas can be dragged, so that the first swipe of
/// all would be lost.
pub fn source(context: &Context) -> ScrollSource {
    let fingers = in_use(context);
    let drag = if fingers { DragScroll::Always } else { DragScroll::OnTouch };
    ScrollSource { scroll_bar: !fingers, drag, ..ScrollSource::default() }
}

/// Scrolls what is around by a finger that is on something else than the ground.
pub fn scroll(context: &Context, turn: f32) {
    change(context, |fingers| fingers.turn += turn);
}

/// Carries that out. Call it at the end of what scrolls: areas within would take it for theirs.
pub fn scrolled(ui: &Ui) {
    let turn = change(ui.ctx(), |fingers| std::mem::take(&mut fingers.turn));
    if turn != 0.0 {
        ui.scroll_with_delta_animation(egui::vec2(0.0, turn), ScrollAnimation::none());
    }
}

/// Whether a finger here drags something.
pub fn is_grip(context: &Context, place: Pos2) -> bool {
    change(context, |fingers| fingers.grips.iter().any(|rect| rect.contains(place)))
}

/// Lets a finger that came and went within one slow picture be seen in two: where it is gone again before anything was
/// drawn, egui finds nothing under it, and the tap would be lost.
pub fn part_taps(context: &Context, events: &mut Vec<Event>) {
    let mut all = change(context, |fingers| std::mem::take(&mut fingers.late));
    all.append(events);
    let comes = |event: &Event| matches!(event, Event::Touch { phase: TouchPhase::Start, .. });
    let goes = |event: &Event| matches!(event, Event::PointerButton { pressed: false, .. });
    let presses = |event: &Event| matches!(event, Event::PointerButton { pressed: true, .. });
    let end = all.iter().position(presses).and_then(|press| {
        let gone = all[press..].iter().position(goes)? + press;
        all[..gone].iter().any(comes).then_some(gone)
    });
    let late = end.map_or_else(Vec::new, |end| all.split_off(end));
    if !late.is_empty() {
        context.request_repaint();
    }
    change(context, |fingers| fingers.late = late);
    *events = all;
}

/// Ends the press of a finger that the browser has taken for scrolling: nobody else tells that it is over. It must not
/// count as a click, so it moves first.
pub fn end_cancelled(events: &mut Vec<Event>, last: Option<Pos2>) {
    let cancelled = |event: &Event| matches!(event, Event::Touch { phase: TouchPhase::Cancel, .. });
    if !events.iter().any(cancelled) {
        return;
    }
    if let Some(last) = last {
        let pos = last + egui::vec2(NO_CLICK, 0.0);
        events.push(Event::PointerMoved(pos));
        let button = egui::PointerButton::Primary;
        events.push(Event::PointerButton { pos, button, pressed: false, modifiers: egui::Modifiers::NONE });
    }
    events.push(Event::PointerGone);
}

#[cfg(test)]
mod tests {
    use egui::{Align2, Modifiers, PointerButton, Sense, TouchDeviceId, TouchId, pos2, vec2};

    use super::*;

    fn frame(context: &Context, mut events: Vec<Event>, seen: &mut dyn FnMut(&egui::Response)) {
        end_cancelled(&mut events, context.input(|input| input.pointer.latest_pos()));
        let screen_rect = Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(200.0, 200.0)));
        let output = context.run_ui(egui::RawInput { events, screen_rect, ..Default::default() }, |ui| {
            begin_frame(ui.ctx());
            let area = Align2::LEFT_TOP.align_size_within_rect(vec2(200.0, 200.0), ui.ctx().content_rect());
            seen(&ui.interact(area, Id::unique("plot"), Sense::click()));
        });
        output.drop_without_applying_deltas();
    }

    #[test]
    fn a_tap_within_one_slow_picture_is_a_click() {
        let context = Context::default();
        context.options_mut(|options| options.input_options.max_click_duration = f64::INFINITY);
        let mut clicks = 0;
        let mut seen = |response: &egui::Response| clicks += usize::from(response.clicked());
        frame(&context, vec![], &mut seen);
        let gone = [press(false), Event::PointerGone, touch(TouchPhase::End)];
        let mut events = vec![press(true), touch(TouchPhase::Start)];
        events.extend(gone);
        part_taps(&context, &mut events);
        assert_eq!(events, [press(true), touch(TouchPhase::Start)]);
        frame(&context, events, &mut seen);
        // Another one has come meanwhile, and waits for its turn.
        let mut events = vec![press(true), touch(TouchPhase::Start)];
        part_taps(&context, &mut events);
        assert_eq!(events.len(), 5);
        frame(&context, events, &mut seen);
        assert_eq!(clicks, 1);
    }

    fn press(pressed: bool) -> Event {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        Event::PointerButton { pos: pos2(50.0, 50.0), button, pressed, modifiers }
    }

    fn touch(phase: TouchPhase) -> Event {
        let (device_id, id, pos) = (TouchDeviceId(1), TouchId::from(1_u64), pos2(50.0, 50.0));
        Event::Touch { device_id, id, phase, pos, force: None }
    }

    #[test]
    fn a_swipe_that_scrolls_the_page_is_no_click_and_a_tap_is_one() {
        let context = Context::default();
        let mut clicks = 0;
        let mut seen = |response: &egui::Response| clicks += usize::from(response.clicked());
        frame(&context, vec![], &mut seen);
        frame(&context, vec![press(true), touch(TouchPhase::Start)], &mut seen);
        frame(&context, vec![touch(TouchPhase::Cancel)], &mut seen);
        assert!(!context.input(|input| input.pointer.any_down()) && in_use(&context));
        frame(&context, vec![], &mut seen);
        assert_eq!(clicks, 0);
        let mut seen = |response: &egui::Response| clicks += usize::from(response.clicked());
        frame(&context, vec![press(true), touch(TouchPhase::Start)], &mut seen);
        frame(&context, vec![press(false), Event::PointerGone, touch(TouchPhase::End)], &mut seen);
        assert_eq!(clicks, 1);
        frame(&context, vec![Event::PointerMoved(pos2(9.0, 9.0))], &mut |_| {});
        assert!(!in_use(&context));
    }
}
