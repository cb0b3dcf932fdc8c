//! What keys do wherever the focus is, and keeping the focus in view.

use egui::style::ScrollAnimation;
use egui::{Context, Id, Key, Modifiers, Popup, Ui};

use super::command::{Command, Commands};
use super::figures;
use super::lessons::course::{self, Action};
use super::live::LiveAction;
use super::panels::spec::Place;
use super::panels::{greeting, list, shortcuts};
use super::view::{Panel, Tab, View};
use super::widgets::parameter_slider;

/// Keys that open the tabs, in their order.
const TABS: [Key; 9] =
    [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6, Key::Num7, Key::Num8, Key::Num9];
/// Keys of the live run; Space, which also presses what has the focus, comes beside them.
const LIVE: [(Key, LiveAction); 7] = [
    (Key::Period, LiveAction::StepPeriod),
    (Key::Comma, LiveAction::StepFrame),
    (Key::K, LiveAction::Kick(1.0)),
    (Key::J, LiveAction::Kick(-1.0)),
    (Key::R, LiveAction::FromRest),
    (Key::C, LiveAction::Clear),
    (Key::S, LiveAction::Sound),
];
/// Room kept around what has the focus, points.
const AROUND: f32 = 12.0;

/// Turns keys into commands, unless a text is being typed or something lies over the page, which have keys of their own.
pub(super) fn shortcuts(
    context: &Context,
    view: &View,
    pinned: bool,
    (dark, moves): (bool, bool),
    commands: &mut Commands,
) {
    let covered =
        shortcuts::SHEET.is_open(context) || greeting::SHEET.is_open(context) || Popup::is_any_open(context);
    if context.text_edit_focused() || covered {
        return;
    }
    let mut help = false;
    let free =
        context.memory(|memory| memory.focused()).is_none_or(|id| parameter_slider::is_track(context, id));
    context.input_mut(|input| {
        // The one with more modifiers first: the other would take it, too.
        let steps = [
            (Modifiers::COMMAND | Modifiers::SHIFT, Key::Z, Command::Redo),
            (Modifiers::COMMAND, Key::Y, Command::Redo),
            (Modifiers::COMMAND, Key::Z, Command::Undo),
            (Modifiers::COMMAND, Key::S, Command::SaveFile),
            (Modifiers::COMMAND, Key::O, Command::OpenFile),
            (Modifiers::SHIFT, Key::F, Command::FullScreen),
        ];
        for (modifiers, key, command) in steps {
            if input.consume_key(modifiers, key) {
                commands.push(command);
            }
        }
        if input.modifiers.alt {
            return;
        }
        let mut pressed = |key| input.consume_key(Modifiers::NONE, key);
        for ((tab, _), key) in Tab::NAMED.iter().zip(TABS) {
            if pressed(key) {
                commands.push(Command::OpenTab(*tab));
            }
        }
        let plain = [
            (Key::F, Command::Enlarge(next_plot(view))),
            (Key::P, Command::pin(view.tab, pinned)),
            (Key::D, Command::SetDark(!dark)),
            (Key::L, Command::SetProjector(!view.projector)),
            (Key::B, Command::MoveBeam(!moves)),
        ];
        for (key, command) in plain {
            if pressed(key) {
                commands.push(command);
            }
        }
        for (key, way) in [(Key::PageUp, -1), (Key::PageDown, 1)] {
            // Before the slider that has the focus: a presenter's clicker knows no others.
            if let Some(command) = presented(view, way).filter(|_| pressed(key)) {
                commands.push(command);
            }
        }
        if view.tab == Tab::Live {
            let live = LIVE.iter().filter(|(key, _)| pressed(*key));
            commands.extend(live.map(|(_, action)| Command::Live(*action)));
            if free && pressed(Key::Space) {
                commands.push(Command::Live(LiveAction::Toggle));
            }
        }
        if view.enlarged.is_some() && pressed(Key::Escape) {
            commands.push(Command::Enlarge(None));
        }
        help = pressed(Key::Questionmark);
    });
    if help {
        shortcuts::SHEET.open(context);
    }
}

/// What a presenter's clicker leads to, forwards or back: the next step of the running lesson, or figure of the paper.
fn presented(view: &View, way: i32) -> Option<Command> {
    if let Some((_, lesson)) = course::running(view) {
        let step = view.step.min(lesson.steps.len()).checked_add_signed(way as isize)?;
        return Some(Command::Lesson(Action::GoTo(step.max(1))));
    }
    let place = figures::FIGURES.iter().position(|figure| figure.number == view.figure);
    let next = match place {
        _ if view.tab != Tab::Paper => return None,
        Some(place) => place.checked_add_signed(way as isize)?,
        None => 0,
    };
    figures::FIGURES.get(next).map(|figure| Command::LoadFigure(figure.number))
}

/// The plot after the one that fills the page; none after the last.
fn next_plot(view: &View) -> Option<Panel> {
    let plots = list::at(Place::of(view));
    let present = view.enlarged.and_then(|enlarged| plots.iter().position(|plot| *plot == enlarged));
    plots.get(present.map_or(0, |place| place + 1)).copied()
}

/// What a scrolling part of the page knows of the focus.
#[derive(Clone, Copy, Default)]
struct Followed {
    /// What was brought into view last.
    seen: Option<Id>,
    /// Whether it has just been scrolled: where things are is known a frame later.
    moving: bool,
}

/// Inside of what scrolls: brings what has newly got the focus into view, as browsers do.
pub(super) fn keep_focus_in_view(ui: &Ui) {
    let focused = ui.memory(|memory| memory.focused());
    let id = ui.scope_id().with("focus");
    let mut followed: Followed = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    if focused == followed.seen {
        return;
    }
    // Where it was drawn last; a click finds what is in view already.
    let rect = focused.and_then(|focused| ui.ctx().read_response(focused)).and_then(|response| {
        let (rect, clip) = (response.rect, ui.clip_rect());
        let inside = response.layer_id == ui.layer_id() && clip.x_range().contains(rect.center().x);
        (inside && !clip.contains_rect(rect) && rect.height() < clip.height()).then_some(rect)
    });
    match rect {
        _ if followed.moving => followed.moving = false,
        Some(rect) => {
            ui.scroll_to_rect_animation(rect.expand(AROUND), None, ScrollAnimation::none());
            followed.moving = true;
        }
        None => followed.seen = focused,
    }
    ui.data_mut(|data| data.insert_temp(id, followed));
    ui.ctx().request_repaint();
}

#[cfg(test)]
mod tests;
