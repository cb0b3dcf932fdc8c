//! What the page is, for whoever sees it for the first time: the device with its parts named, one sentence, three doors.

use egui::{Button, RichText, Ui, vec2};

use super::{Context, beam};
use crate::app::command::{Command, Commands};
use crate::app::lessons::LessonId;
use crate::app::lessons::course::Action;
use crate::app::text::tr;
use crate::app::view::Tab;
use crate::app::widgets::Overlay;
use crate::app::{fonts, theme};

/// The greeting.
pub(in crate::app) const SHEET: Overlay = Overlay::new("greeting", 640.0);

/// Width of a door where they stand side by side, points.
const DOOR: f32 = 200.0;
/// Height of a door, and of one that stands beside others, where its promise may take two rows.
const DOOR_HEIGHT: f32 = 52.0;
const HIGH_DOOR: f32 = 68.0;
/// Share of the page's height that the picture takes at most, and its usual height.
const SHARE: f32 = 0.36;
const PICTURE: f32 = 250.0;

/// Draws it over the page until a door is taken, Escape, or a click beside it.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &Ui) {
    let tokens = theme::tokens(ui);
    SHEET.show(ui, |ui| {
        Overlay::scrolled(ui, 90.0, |ui| {
            let title = RichText::new("Harvester Lab").font(fonts::semibold(theme::size::HEADING));
            ui.label(title.color(tokens.text_strong));
            let sentence = tr(
                "A shaken beam with a magnet at its tip makes electricity. See when it follows the shaking, when its period \
                 doubles, when it becomes chaotic, and what power that gives.",
            );
            ui.add(egui::Label::new(RichText::new(sentence).color(tokens.text)).wrap());
            ui.add_space(8.0);
            let height = ui.ctx().content_rect().height();
            beam::picture(context, ui, PICTURE.min(SHARE * height), true);
            ui.add_space(10.0);
            doors(context.commands, ui)
        })
    });
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
    let height = if beside { HIGH_DOOR } else { DOOR_HEIGHT };
    let show = |ui: &mut Ui| {
        for (name, promise, command) in doors {
            let text = format!("{name}\n{promise}");
            if ui.add_sized(vec2(width, height), Button::new(text).wrap()).clicked() {
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
                assert!(!SHEET.is_open(&desk.harness.context));
                SHEET.open(&desk.harness.context);
                desk.rest(3);
                press(&mut desk, door);
                desk.rest(2);
                assert!(!SHEET.is_open(&desk.harness.context));
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
        assert!(SHEET.is_open(&desk.harness.context));
        // No key is a shortcut meanwhile.
        desk.press(Key::Num2, Modifiers::NONE);
        assert_eq!(desk.app.view.tab, Tab::Explore);
        desk.press(Key::Escape, Modifiers::NONE);
        desk.rest(2);
        assert!(!SHEET.is_open(&desk.harness.context));
    }
}
