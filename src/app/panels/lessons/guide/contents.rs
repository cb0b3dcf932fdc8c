//! What a step says, what it asks to be done, and its question.

use egui::{Button, Color32, Frame, Margin, RichText, Ui, vec2};

use super::shown::Shown;
use crate::app::command::Command;
use crate::app::lessons::course::Action;
use crate::app::lessons::data::{Goal, Question};
use crate::app::panels::Context;
use crate::app::panels::lessons::text;
use crate::app::text::tr;
use crate::app::{fonts, theme};

pub(super) fn said(ui: &mut Ui, shown: Shown) {
    let colour = theme::tokens(ui).text;
    for part in shown.step.text.get().split('\n') {
        text::paragraph(ui, part, colour);
    }
}

pub(super) fn asked(context: &mut Context<'_>, ui: &mut Ui, shown: Shown) {
    if let Some(goal) = &shown.step.goal {
        to_do(context, ui, goal, shown.progress.reached);
        ui.add_space(8.0);
    }
    if let Some(question) = &shown.step.question {
        to_answer(context, ui, question, shown);
    }
}

/// A box for what is to be done or was said to it.
fn boxed(ui: &mut Ui, edge: Color32, contents: &mut dyn FnMut(&mut Ui)) {
    let tokens = theme::tokens(ui);
    let frame = Frame::new().fill(tokens.tint(edge)).corner_radius(theme::radius::CONTROL);
    let shown = frame.inner_margin(Margin { left: 12, right: 10, top: 8, bottom: 8 }).show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        contents(ui);
    });
    let rect = shown.response.rect;
    ui.painter().rect_filled(rect.with_max_x(rect.left() + 3.0), 1, edge);
}

fn to_do(context: &mut Context<'_>, ui: &mut Ui, goal: &Goal, reached: bool) {
    let tokens = theme::tokens(ui);
    let (edge, lead) = if reached { (tokens.ok, tr("✓ Done")) } else { (tokens.accent, tr("Your turn")) };
    boxed(ui, edge, &mut |ui| {
        ui.label(RichText::new(lead).font(fonts::semibold(theme::size::BODY)).color(edge));
        text::paragraph(ui, goal.task.get(), if reached { tokens.text_weak } else { tokens.text });
        if reached {
            ui.add_space(4.0);
            text::paragraph(ui, goal.reaction.get(), tokens.text);
            return;
        }
        ui.add_space(2.0);
        if ui.add(Button::new(tr("Show me")).stroke(egui::Stroke::new(1.0, edge))).clicked() {
            context.commands.push(Command::Lesson(Action::Show));
        }
    });
}

fn to_answer(context: &mut Context<'_>, ui: &mut Ui, question: &Question, shown: Shown) {
    let tokens = theme::tokens(ui);
    let chosen = shown.progress.answer;
    // Nothing is said about a prediction before it is shown what comes.
    let open = question.reveal.is_some() && !shown.progress.revealed;
    if question.reveal.is_some() {
        let lead = if open { tr("Predict first") } else { tr("What came") };
        ui.label(RichText::new(lead).font(fonts::semibold(theme::size::BODY)).color(tokens.accent));
    }
    text::paragraph(ui, &format!("**{}**", question.text.get()), tokens.text);
    for (index, answer) in question.answers.iter().enumerate() {
        let mine = chosen == Some(index);
        let (sign, edge) = match (mine, answer.right) {
            (false, _) => ("", tokens.text),
            (true, _) if open => ("• ", tokens.accent),
            (true, true) => ("✓ ", tokens.ok),
            (true, false) => ("✕ ", tokens.warning),
        };
        let words = format!("{sign}{}", answer.text.get());
        let words = text::job(ui, &words, edge);
        let button = Button::new(words).wrap().min_size(vec2(ui.available_width(), 0.0)).fill(tokens.field);
        if ui.add_enabled(question.reveal.is_none() || open, button).clicked() {
            context.commands.push(Command::Lesson(Action::Answer(index)));
        }
        if mine && !open {
            boxed(ui, edge, &mut |ui| {
                text::paragraph(ui, answer.reply.get(), tokens.text);
            });
        }
    }
    if open {
        let words = RichText::new(tr("Show what comes")).font(fonts::semibold(theme::size::BODY));
        if ui.add_enabled(chosen.is_some(), Button::new(words)).clicked() {
            context.commands.push(Command::Lesson(Action::Reveal));
        }
    }
}
