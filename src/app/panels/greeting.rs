//! What the page is, for whoever sees it for the first time: the device with its parts named, one sentence, three doors.

use egui::{Button, Context as Egui, Id, Modal, RichText, Ui, vec2};

use super::{Context, beam};
use crate::app::command::{Command, Commands};
use crate::app::lessons::LessonId;
use crate::app::lessons::course::Action;
use crate::app::text::tr;
use crate::app::view::Tab;
use crate::app::{fonts, theme};

/// Width of the greeting, and of a door where they stand side by side, points.
const WIDTH: f32 = 640.0;
const DOOR: f32 = 200.0;
/// Height of a door.
const DOOR_HEIGHT: f32 = 52.0;
/// Share of the page's height that the picture takes at most, and its usual height.
const SHARE: f32 = 0.36;
const PICTURE: f32 = 250.0;

fn id() -> Id {
    Id::unique("greeting")
}

/// Whether it is shown.
pub(in crate::app) fn is_open(context: &Egui) -> bool {
    context.data(|data| data.get_temp(id())).unwrap_or(false)
}

/// Shows it.
pub(in crate::app) fn open(context: &Egui) {
    set(context, true);
}

fn set(context: &Egui, open: bool) {
    context.data_mut(|data| data.insert_temp(id(), open));
    context.request_repaint();
}

/// Draws it over the page until a door is taken, Escape, or a click beside it.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &Ui) {
    if !is_open(ui.ctx()) {
        return;
    }
    let tokens = theme::tokens(ui);
    let page = ui.ctx().content_rect().size();
    let frame = egui::Frame::popup(ui.style()).inner_margin(20);
    let shown = Modal::new(id()).frame(frame).show(ui.ctx(), |ui| {
        ui.set_width(WIDTH.min(page.x - 64.0));
        let room = page.y - 90.0;
        // In a modal it would shrink to what its first picture had.
        let scroll = egui::ScrollArea::vertical().max_height(room).min_scrolled_height(room);
        scroll.show(ui, |ui| {
            let title = RichText::new("Harvester Lab").font(fonts::semibold(theme::size::HEADING));
            ui.label(title.color(tokens.text_strong));
            let sentence = tr(
                "A shaken beam with a magnet at its tip makes electricity. See when it follows the shaking, when its period \
                 doubles, when it becomes chaotic, and what power that gives.",
            );
            ui.add(egui::Label::new(RichText::new(sentence).color(tokens.text)).wrap());
            ui.add_space(8.0);
            beam::picture(context, ui, PICTURE.min(SHARE * page.y), true);
            ui.add_space(10.0);
            doors(context.commands, ui)
        })
    });
    if shown.inner.inner || shown.should_close() {
        set(ui.ctx(), false);
    }
}

/// Where to go from here, and whether one of the doors was taken.
fn doors(commands: &mut Commands, ui: &mut Ui) -> bool {
    let mut taken = false;
    let doors = [
        (tr("Tour"), tr("one minute, four touches"), Command::Lesson(Action::Begin(LessonId::tour()))),
        (tr("Lessons"), tr("one idea after the other"), Command::OpenTab(Tab::Lessons)),
        (tr("Design"), tr("your own device, in watts"), Command::OpenTab(Tab::Design)),
    ];
    let beside = ui.available_width() >= 3.0 * DOOR;
    let width = if beside {
        (ui.available_width() - 2.0 * ui.spacing().item_spacing.x) / 3.0
    } else {
        ui.available_width()
    };
    let show = |ui: &mut Ui| {
        for (name, promise, command) in doors {
            let text = format!("{name}\n{promise}");
            if ui.add_sized(vec2(width, DOOR_HEIGHT), Button::new(text).wrap()).clicked() {
                commands.push(command);
                taken = true;
            }
        }
    };
    if beside {
        ui.horizontal(show);
    } else {
        show(ui);
    }
    ui.add_space(4.0);
    taken | ui.vertical_centered(|ui| ui.button(tr("Look around")).clicked()).inner
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::rehearsal::Desk;
    use egui::{Key, Modifiers, Role};

    fn press(desk: &mut Desk, button: &str) {
        let place = desk.harness.find(Role::Button, button).bounds.center();
        let Desk { app, harness } = desk;
        harness.click(place, |ui| app.ui(ui));
    }

    #[test]
    fn each_door_leads_somewhere_and_none_comes_back_by_itself() {
        for (width, height) in [(1440.0, 900.0), (360.0, 760.0)] {
            for (door, lesson, tab) in [
                ("Tour\n", Some(LessonId::tour()), Tab::Explore),
                ("Lessons\n", None, Tab::Lessons),
                ("Design\n", None, Tab::Design),
                ("Look around", None, Tab::Explore),
            ] {
                let mut desk = Desk::new(width, height, r#"{"tab":"explore"}"#);
                desk.work(3);
                assert!(!is_open(&desk.harness.context));
                open(&desk.harness.context);
                desk.rest(3);
                press(&mut desk, door);
                desk.rest(2);
                assert!(!is_open(&desk.harness.context));
                assert_eq!((desk.app.view.lesson, desk.app.view.tab), (lesson, tab), "{door}");
            }
        }
    }

    #[test]
    fn escape_closes_it_and_the_list_of_keys_opens_it() {
        let mut desk = Desk::new(1000.0, 800.0, r#"{"tab":"explore"}"#);
        desk.work(3);
        desk.press(Key::Questionmark, Modifiers::NONE);
        desk.rest(2);
        press(&mut desk, "What is this?");
        desk.rest(2);
        assert!(is_open(&desk.harness.context));
        // No key is a shortcut meanwhile.
        desk.press(Key::Num2, Modifiers::NONE);
        assert_eq!(desk.app.view.tab, Tab::Explore);
        desk.press(Key::Escape, Modifiers::NONE);
        desk.rest(2);
        assert!(!is_open(&desk.harness.context));
    }
}
