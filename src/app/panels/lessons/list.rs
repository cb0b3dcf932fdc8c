//! The list of lessons: a card each, with what it is about, how long it takes, and whether it is done.

use egui::{Align, Layout, Rect, Response, RichText, Sense, Ui, UiBuilder, WidgetInfo, pos2, vec2};

use super::super::Context;
use super::text;
use crate::app::command::Command;
use crate::app::lessons::course::Action;
use crate::app::lessons::{Lesson, LessonId};
use crate::app::panels::grid::GAP;
use crate::app::text::{fill, tr};
use crate::app::widgets::{BadgeKind, badge};
use crate::app::{fonts, theme};

/// Least width and height of a card.
const WIDTH: f32 = 330.0;
const HEIGHT: f32 = 144.0;
const MARGIN: f32 = 14.0;
/// Side of a lesson's picture.
const PICTURE: f32 = 50.0;
/// Widest that the introduction runs.
const MEASURE: f32 = 760.0;

/// Draws the tab.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    introduction(context, ui);
    ui.add_space(GAP);
    let columns = (((ui.available_width() + GAP) / (WIDTH + GAP)) as usize).clamp(1, 4);
    let width = ((ui.available_width() - GAP * (columns - 1) as f32) / columns as f32).floor();
    let ids = [LessonId::own()].into_iter().chain(LessonId::all());
    let lessons: Vec<_> = ids.filter_map(|id| Some((id, id.lesson()?))).collect();
    for row in lessons.chunks(columns) {
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = GAP;
            for (id, lesson) in row {
                if card(context, ui, *id, lesson, width).clicked() {
                    context.commands.push(Command::Lesson(Action::Begin(*id)));
                }
            }
        });
        ui.add_space(GAP - ui.spacing().item_spacing.y);
    }
}

fn introduction(context: &Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let done = LessonId::all().filter(|id| context.course.is_finished(*id)).count();
    ui.horizontal_wrapped(|ui| {
        let title = RichText::new(tr("Guided lessons")).font(fonts::semibold(theme::size::HEADING));
        ui.label(title.color(tokens.text_strong));
        if done > 0 {
            badge(
                ui,
                BadgeKind::Converged,
                &fill("{done} of {count} done", &[("done", &done), ("count", &LessonId::all().count())]),
            );
        }
    });
    ui.scope(|ui| {
        ui.set_max_width(MEASURE.min(ui.available_width()));
        let words = tr("From linear resonance to energy from a doubled period. Each lesson sets the page, gives you \
                        something to do, and says why it came out so. A lesson can be left at any step; Undo brings \
                        back what you had before.");
        text::paragraph(ui, words, tokens.text_weak);
    });
}

/// The lines of a lesson's picture.
fn draw(ui: &Ui, place: Rect, lines: &[Vec<[u8; 2]>]) {
    let tokens = theme::tokens(ui);
    let at = |[x, y]: &[u8; 2]| {
        place.left_bottom() + vec2(f32::from(*x) * place.width(), -f32::from(*y) * place.height()) / 99.0
    };
    for (line, colour) in lines.iter().zip([tokens.accent, tokens.warning, tokens.accent, tokens.text_weak]) {
        ui.painter().add(egui::Shape::line(line.iter().map(at).collect(), egui::Stroke::new(1.8, colour)));
    }
}

/// A card to click.
fn card(context: &Context<'_>, ui: &mut Ui, id: LessonId, lesson: &Lesson, width: f32) -> Response {
    let tokens = theme::tokens(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::click());
    let (done, runs) = (context.course.is_finished(id), context.view.lesson == Some(id));
    let title = lesson.title.get();
    response.widget_info(|| {
        WidgetInfo::labeled(egui::Role::Button, true, fill("Begin: {title}", &[("title", &title)]))
    });
    let lit = response.hovered() || response.has_focus();
    let edge = if runs || lit { tokens.accent } else { tokens.outline };
    let ground = if lit { tokens.field } else { tokens.card };
    let stroke = egui::Stroke::new(1.0, edge);
    ui.painter().rect(rect, theme::radius::CARD, ground, stroke, egui::StrokeKind::Inside);
    let picture =
        Rect::from_min_size(rect.right_top() + vec2(-MARGIN - PICTURE, MARGIN), vec2(PICTURE, PICTURE));
    let room = if lesson.picture.is_empty() { 0.0 } else { PICTURE + 10.0 };
    draw(ui, picture.shrink(4.0), &lesson.picture);
    let inner = rect.shrink(MARGIN);
    let foot = Rect::from_min_max(pos2(inner.left(), inner.bottom() - 21.0), inner.max);
    let down = Layout::top_down(Align::Min);
    let mut head = ui.new_child(
        UiBuilder::new().max_rect(inner.with_max_y(foot.top()).with_max_x(inner.right() - room)).layout(down),
    );
    head.spacing_mut().item_spacing.y = 4.0;
    let heading = if id == LessonId::own() { title.to_owned() } else { format!("{}  {title}", id.number()) };
    let heading = RichText::new(heading);
    let heading = heading.font(fonts::semibold(theme::size::TITLE)).color(tokens.text_strong);
    head.add(egui::Label::new(heading).wrap().selectable(false));
    let summary = text::job(&head, lesson.summary.get(), tokens.text);
    head.add(egui::Label::new(summary).wrap().selectable(false));
    let mut foot = ui.new_child(UiBuilder::new().max_rect(foot).layout(Layout::left_to_right(Align::Center)));
    let length = fill(
        "{steps} steps  ·  {minutes} min",
        &[("steps", &lesson.steps.len()), ("minutes", &lesson.minutes)],
    );
    foot.label(RichText::new(length).small().color(tokens.text_weak));
    foot.with_layout(Layout::right_to_left(Align::Center), |ui| {
        if runs {
            badge(ui, BadgeKind::Neutral, tr("running"));
        } else if done {
            badge(ui, BadgeKind::Converged, tr("done"));
        }
    });
    response.on_hover_cursor(egui::CursorIcon::PointingHand)
}
