//! The chosen plot of a page with one column, and what comes of the sliders in a row below it. Both stay on top, whatever
//! scrolls beneath them.

use egui::{Frame, Id, Margin, Panel, Ui};

use super::spec::Place;
use super::{Context, figure_boundaries, figure_panels, list, plots, verdict};
use crate::app::command::Command;
use crate::app::figures;
use crate::app::theme;
use crate::app::view::Tab;
use crate::app::view::design::Page;
use crate::app::widgets::touch;

/// Share of the room that the plot takes, and beside a lesson, at least and at most so high, and what is left for a slider all
/// the same.
const SHARE: f32 = 0.5;
const SHARE_IN_LESSON: f32 = 0.58;
const LEAST: f32 = 150.0;
const MOST: f32 = 340.0;
const SLIDER: f32 = 110.0;
/// Height of the row below the plot.
const ANSWER: f32 = 26.0;

/// Draws it, where the tab has plots.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    let panels = list::at(Place::of(context.view));
    let figure = figures::figure(context.view.figure).filter(|_| context.view.tab == Tab::Paper);
    if panels.is_empty() && figure.is_none() {
        return;
    }
    context.on_top = Some(ui.available_rect_before_wrap());
    let room = ui.available_height();
    let share = if context.view.lesson.is_some() { SHARE_IN_LESSON } else { SHARE };
    // What shakes the base there is another thing than the sine, of which the row tells.
    let answers = context.view.shaken().is_none() && Place::of(context.view) != Place::Page(Page::Shake);
    let beneath = SLIDER + if answers { ANSWER } else { 0.0 };
    let height = (share * room).clamp(LEAST, MOST).min(room - beneath).max(0.0);
    let margin = Margin { left: 12, right: 12, top: 8, bottom: 0 };
    let panel = Panel::top("on top").exact_size(height).resizable(false).show_separator_line(false);
    let frame = Frame::new().fill(theme::tokens(ui).page).inner_margin(margin);
    let shown = panel.frame(frame).show(ui, |ui| {
        if let Some(figure) = figure {
            let id = Id::unique("letter on top");
            let letters = figure_panels::panels(figure);
            let titles: Vec<&str> = letters.iter().map(|letter| letter.title(figure)).collect();
            let chosen: usize = ui.data(|data| data.get_temp(id)).unwrap_or(0).min(letters.len() - 1);
            let other = match figure.boundaries() {
                Some(boundaries) => {
                    figure_boundaries::show(context, ui, &boundaries);
                    None
                }
                None => figure_panels::show(context, ui, figure, letters[chosen], &titles),
            };
            if let Some(other) = other {
                ui.data_mut(|data| data.insert_temp(id, other));
            }
            return;
        }
        let panel = plots::alone(context, &panels).unwrap_or(panels[0]);
        let titles: Vec<&str> = panels.iter().map(|panel| (list::spec(*panel).title)(context.view)).collect();
        if let Some(other) = plots::draw_among(context, ui, panel, &titles) {
            context.commands.push(Command::Enlarge(panels.get(other).copied()));
        }
    });
    let mut rect = shown.response.rect;
    // Whatever is moved beneath: what comes of it.
    if answers {
        let margin = Margin { left: 14, right: 14, top: 6, bottom: 0 };
        let panel =
            Panel::top("answer on top").exact_size(ANSWER).resizable(false).show_separator_line(false);
        let frame = Frame::new().fill(theme::tokens(ui).page).inner_margin(margin);
        rect = rect.union(panel.frame(frame).show(ui, |ui| verdict::row(context, ui)).response.rect);
    }
    context.on_top = Some(rect);
}

/// Scrolls what is beneath by the wheel over the plot, or by a finger that came down on it and drags nothing of it.
pub(in crate::app) fn scroll_beneath(context: &Context<'_>, ui: &Ui) {
    let Some(plot) = context.on_top else { return };
    let touched = touch::in_use(ui.ctx());
    if touched && ui.ctx().dragged_id().is_some() {
        return;
    }
    let turn = ui.input(|input| {
        let pointer = &input.pointer;
        let on_it = |at: Option<egui::Pos2>| at.is_some_and(|at| plot.contains(at));
        match touched {
            true if pointer.any_down() && on_it(pointer.press_origin()) => pointer.delta().y,
            false if on_it(pointer.hover_pos()) => input.smooth_scroll_delta().y,
            _ => 0.0,
        }
    });
    touch::scroll(ui.ctx(), turn);
}
