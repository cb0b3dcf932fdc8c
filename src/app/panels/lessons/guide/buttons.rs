//! The buttons that go from step to step, and out of the lesson.

use egui::{Align, Button, Layout, RichText, Ui};

use super::shown::Shown;
use crate::app::command::Command;
use crate::app::lessons::LessonId;
use crate::app::lessons::course::Action;
use crate::app::panels::Context;
use crate::app::text::tr;
use crate::app::widgets::{Icon, icon_button};
use crate::app::{fonts, theme};

/// The buttons from step to step, from left to right.
pub(super) fn walk(context: &mut Context<'_>, ui: &mut Ui, shown: Shown) {
    back(context, ui, shown);
    restart(context, ui, shown);
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| next(context, ui, shown));
}

pub(super) fn leave(context: &mut Context<'_>, ui: &mut Ui) {
    if icon_button(ui, Icon::Close, tr("Leave the lesson")).clicked() {
        context.commands.push(Command::Lesson(Action::Leave));
    }
}

pub(super) fn restart(context: &mut Context<'_>, ui: &mut Ui, shown: Shown) {
    if shown.step.view.is_some()
        && icon_button(ui, Icon::Reset, tr("Set the page as this step began")).clicked()
    {
        context.commands.push(Command::Lesson(Action::Restart));
    }
}

pub(super) fn back(context: &mut Context<'_>, ui: &mut Ui, shown: Shown) {
    if ui.add_enabled(shown.number > 1, Button::new(tr("Back"))).clicked() {
        context.commands.push(Command::Lesson(Action::GoTo(shown.number - 1)));
    }
}

/// Lit once the step is done; before that it goes on as well.
pub(super) fn next(context: &mut Context<'_>, ui: &mut Ui, shown: Shown) {
    let tokens = theme::tokens(ui);
    let (words, action) = if shown.is_last() {
        (tr("Finish"), Action::Finish)
    } else {
        (tr("Next"), Action::GoTo(shown.number + 1))
    };
    let button = if shown.is_done() {
        let words = RichText::new(words).font(fonts::semibold(theme::size::BODY)).color(tokens.on_accent);
        Button::new(words).fill(tokens.accent)
    } else {
        Button::new(words)
    };
    if ui.add(button).clicked() {
        context.commands.push(Command::Lesson(action));
    }
    let number = context.view.lesson.map_or(0, LessonId::number);
    let following = LessonId::all().find(|id| id.number() == number + 1);
    if let Some(id) = following.filter(|_| shown.is_last() && shown.is_done())
        && ui
            .button(tr("Next lesson"))
            .on_hover_text(id.lesson().map_or("", |lesson| lesson.title.get()))
            .clicked()
    {
        context.commands.extend([Action::Finish, Action::Begin(id)].map(Command::Lesson));
    }
}
