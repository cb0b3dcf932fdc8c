//! The running lesson beside the plots: what is said, asked and to be done in the step in view. It stands at the right of
//! a wide page and below a narrower one, where it can be folded.

use egui::{
    Align, Button, Color32, Frame, Id, Layout, Margin, Panel, Rect, RichText, ScrollArea, Sense, Ui, pos2,
    vec2,
};

use super::super::Context;
use super::text;
use crate::app::command::Command;
use crate::app::lessons::course::{self, Action, Progress};
use crate::app::lessons::data::{Goal, Question, Step};
use crate::app::lessons::{Lesson, LessonId};
use crate::app::text::{fill, tr};
use crate::app::widgets::icon::BUTTON_SIDE;
use crate::app::widgets::{Icon, icon_button};
use crate::app::{fonts, theme};

/// Width of the guide beside the plots, and of the page from which it stands there.
const SIDE: f32 = 308.0;
const WIDE: f32 = 1200.0;
/// Width from which what is said and what is to be done stand side by side in the guide below.
const TWO_COLUMNS: f32 = 700.0;
/// Highest part of the page that the guide below takes, with two columns and with one.
const LOW: f32 = 0.28;
const HIGH: f32 = 0.38;
/// Space between the guide's row of buttons and its text.
const SPACE: f32 = 8.0;
/// Width below which the place in the lesson is given in figures.
const PHONE: f32 = 480.0;

/// A step that is shown.
#[derive(Clone, Copy)]
struct Shown {
    lesson: &'static Lesson,
    step: &'static Step,
    /// From 1.
    number: usize,
    progress: Progress,
}

impl Shown {
    fn of(context: &Context<'_>) -> Option<(LessonId, Self)> {
        let (id, lesson) = course::running(context.view)?;
        let step = course::step(context.view)?;
        let number = context.view.step.clamp(1, lesson.steps.len());
        Some((id, Self { lesson, step, number, progress: context.course.progress(context.view) }))
    }

    fn is_last(&self) -> bool {
        self.number == self.lesson.steps.len()
    }

    /// Whether what the step asks for has been done.
    fn is_done(&self) -> bool {
        (self.step.goal.is_none() || self.progress.reached)
            && (self.step.question.is_none() || self.progress.answer.is_some())
    }
}

/// Draws the guide when a lesson runs.
pub(in crate::app) fn guide(context: &mut Context<'_>, ui: &mut Ui) {
    let Some((id, shown)) = Shown::of(context) else { return };
    let tokens = theme::tokens(ui);
    let frame = Frame::new().fill(tokens.bar).inner_margin(Margin::symmetric(14, 10));
    let place = Id::unique("guide").with((id.number(), shown.number));
    if ui.available_width() >= WIDE {
        let panel = Panel::right("guide").exact_size(SIDE).resizable(false);
        panel.show_separator_line(false).frame(frame).show(ui, |ui| {
            heading(context, ui, shown);
            ui.add_space(8.0);
            let height = ui.available_height() - 40.0;
            ScrollArea::vertical().id_salt(place).auto_shrink([false, true]).max_height(height).show(
                ui,
                |ui| {
                    ui.set_max_width(ui.available_width() - 4.0);
                    said(ui, shown);
                    ui.add_space(10.0);
                    asked(context, ui, shown);
                },
            );
            ui.add_space(8.0);
            ui.horizontal(|ui| walk(context, ui, shown));
        });
        return;
    }
    below(context, ui, shown, frame, place);
}

/// What is remembered of the guide below: whether it is folded in this step, and how tall its text was in the last
/// frame.
#[derive(Clone, Copy, Default)]
struct Memory {
    folded: Option<Id>,
    height: Option<f32>,
}

fn below(context: &mut Context<'_>, ui: &mut Ui, shown: Shown, frame: Frame, place: Id) {
    let columns = ui.available_width() >= TWO_COLUMNS;
    let highest = ui.ctx().content_rect().height() * if columns { LOW } else { HIGH };
    let id = Id::unique("guide below");
    let Memory { folded, height } = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    let mut folded = folded == Some(place);
    let text = if folded { 0.0 } else { height.unwrap_or(highest).min(highest) + SPACE };
    let mut full = None;
    let panel = Panel::bottom("guide").exact_size(text + BUTTON_SIDE + frame.total_margin().sum().y);
    panel.resizable(false).show_separator_line(false).frame(frame).show(ui, |ui| {
        ui.horizontal(|ui| {
            let (icon, label) = if folded {
                (Icon::ChevronRight, tr("Unfold the lesson"))
            } else {
                (Icon::ChevronDown, tr("Fold the lesson"))
            };
            if icon_button(ui, icon, label).clicked() {
                folded = !folded;
            }
            heading_in_row(context, ui, shown);
        });
        if text == 0.0 {
            return;
        }
        let area = ScrollArea::vertical().id_salt(place).auto_shrink(false).show(ui, |ui| {
            ui.set_max_width(ui.available_width() - 8.0);
            if columns {
                side_by_side(context, ui, shown);
            } else {
                said(ui, shown);
                ui.add_space(8.0);
                asked(context, ui, shown);
            }
        });
        full = Some(area.content_size.y);
    });
    if full != height {
        ui.ctx().request_repaint();
    }
    ui.data_mut(|data| data.insert_temp(id, Memory { folded: folded.then_some(place), height: full }));
}

fn side_by_side(context: &mut Context<'_>, ui: &mut Ui, shown: Shown) {
    let usual = std::mem::replace(&mut ui.spacing_mut().item_spacing.x, 28.0);
    ui.columns(2, |columns| {
        for (index, column) in columns.iter_mut().enumerate() {
            column.spacing_mut().item_spacing.x = usual;
            column.with_layout(Layout::top_down(Align::Min), |ui| match index {
                0 => said(ui, shown),
                _ => asked(context, ui, shown),
            });
        }
    });
}

/// Title, place in the lesson, and the way out.
fn heading(context: &mut Context<'_>, ui: &mut Ui, shown: Shown) {
    let tokens = theme::tokens(ui);
    ui.horizontal_top(|ui| {
        let title = RichText::new(shown.lesson.title.get()).font(fonts::semibold(theme::size::TITLE));
        let width = ui.available_width() - 34.0;
        ui.allocate_ui(vec2(width, 0.0), |ui| {
            ui.set_min_width(width);
            ui.add(egui::Label::new(title.color(tokens.text_strong)).wrap());
        });
        leave(context, ui);
    });
    track(ui, shown);
    ui.label(RichText::new(place_in_words(shown)).small().color(tokens.text_weak));
}

/// The same with the buttons in one row, for the guide below.
fn heading_in_row(context: &mut Context<'_>, ui: &mut Ui, shown: Shown) {
    let tokens = theme::tokens(ui);
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        leave(context, ui);
        next(context, ui, shown);
        back(context, ui, shown);
        restart(context, ui, shown);
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            let phone = ui.ctx().content_rect().width() < PHONE;
            let place = if phone {
                format!("{}/{}", shown.number, shown.lesson.steps.len())
            } else {
                place_in_words(shown)
            };
            ui.label(RichText::new(place).small().color(tokens.text_weak));
            let title = RichText::new(shown.lesson.title.get()).font(fonts::semibold(theme::size::TITLE));
            ui.add(egui::Label::new(title.color(tokens.text_strong)).truncate());
        });
    });
}

fn place_in_words(shown: Shown) -> String {
    fill("Step {number} of {count}", &[("number", &shown.number), ("count", &shown.lesson.steps.len())])
}

/// A bar a step, filled up to the one in view.
fn track(ui: &mut Ui, shown: Shown) {
    let tokens = theme::tokens(ui);
    let count = shown.lesson.steps.len();
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 6.0), Sense::hover());
    let gap = 4.0;
    let width = (rect.width() - gap * (count - 1) as f32) / count as f32;
    for index in 0..count {
        let left = rect.left() + index as f32 * (width + gap);
        let bar = Rect::from_min_size(pos2(left, rect.center().y - 1.5), vec2(width, 3.0));
        let colour = if index < shown.number { tokens.accent } else { tokens.track };
        ui.painter().rect_filled(bar, 1, colour);
    }
}

fn said(ui: &mut Ui, shown: Shown) {
    let colour = theme::tokens(ui).text;
    for part in shown.step.text.get().split('\n') {
        text::paragraph(ui, part, colour);
    }
}

fn asked(context: &mut Context<'_>, ui: &mut Ui, shown: Shown) {
    if let Some(goal) = &shown.step.goal {
        to_do(context, ui, goal, shown.progress.reached);
        ui.add_space(8.0);
    }
    if let Some(question) = &shown.step.question {
        to_answer(context, ui, question, shown.progress.answer);
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

fn to_answer(context: &mut Context<'_>, ui: &mut Ui, question: &Question, chosen: Option<usize>) {
    let tokens = theme::tokens(ui);
    text::paragraph(ui, &format!("**{}**", question.text.get()), tokens.text);
    for (index, answer) in question.answers.iter().enumerate() {
        let mine = chosen == Some(index);
        let (sign, edge) = match (mine, answer.right) {
            (false, _) => ("", tokens.text),
            (true, true) => ("✓ ", tokens.ok),
            (true, false) => ("✕ ", tokens.warning),
        };
        let words = format!("{sign}{}", answer.text.get());
        let words = text::job(ui, &words, edge);
        let button = Button::new(words).wrap().min_size(vec2(ui.available_width(), 0.0)).fill(tokens.field);
        if ui.add(button).clicked() {
            context.commands.push(Command::Lesson(Action::Answer(index)));
        }
        if mine {
            boxed(ui, edge, &mut |ui| {
                text::paragraph(ui, answer.reply.get(), tokens.text);
            });
        }
    }
}

/// The buttons from step to step, from left to right.
fn walk(context: &mut Context<'_>, ui: &mut Ui, shown: Shown) {
    back(context, ui, shown);
    restart(context, ui, shown);
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| next(context, ui, shown));
}

fn leave(context: &mut Context<'_>, ui: &mut Ui) {
    if icon_button(ui, Icon::Close, tr("Leave the lesson")).clicked() {
        context.commands.push(Command::Lesson(Action::Leave));
    }
}

fn restart(context: &mut Context<'_>, ui: &mut Ui, shown: Shown) {
    if shown.step.view.is_some()
        && icon_button(ui, Icon::Reset, tr("Set the page as this step began")).clicked()
    {
        context.commands.push(Command::Lesson(Action::Restart));
    }
}

fn back(context: &mut Context<'_>, ui: &mut Ui, shown: Shown) {
    if ui.add_enabled(shown.number > 1, Button::new(tr("Back"))).clicked() {
        context.commands.push(Command::Lesson(Action::GoTo(shown.number - 1)));
    }
}

/// Lit once the step is done; before that it goes on as well.
fn next(context: &mut Context<'_>, ui: &mut Ui, shown: Shown) {
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
}
