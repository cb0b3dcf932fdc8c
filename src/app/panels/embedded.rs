//! The page inside of another one: a row of sliders, and panels that fill the frame.

use egui::{Align, Layout, RichText, Ui, vec2};

use super::{Context, beam, device, grid, live, plots, structure, verdict};
use crate::app::embed::{Control, Embed, Part};
use crate::app::text::{fill, tr};
use crate::app::view::View;
use crate::app::widgets::touch;
use crate::app::{keyboard, link, theme};

/// Space around everything and between panels, points.
const MARGIN: i8 = 6;
const GAP: f32 = 6.0;
/// Width from which a slider stands beside another one.
const SLIDER: f32 = 250.0;
/// Least size of a panel; a frame without room for it is scrolled.
const LEAST: egui::Vec2 = vec2(230.0, 160.0);
/// Width over height that a panel is best seen with.
const BEST_SHAPE: f32 = 1.35;
/// What the beam's card needs beside its picture.
const BEAM_FRAME: f32 = 46.0;
/// Height of the row with the way to the whole page.
const WAY_OUT: f32 = 20.0;

/// Draws the page.
pub(in crate::app) fn show(context: &mut Context<'_>, embed: &Embed, notice: Option<&str>, ui: &mut Ui) {
    let page = egui::Frame::new().fill(theme::tokens(ui).page).inner_margin(MARGIN);
    egui::CentralPanel::default().frame(page).show(ui, |ui| {
        let area = touch::scroll_area(ui.ctx()).auto_shrink(false).show(ui, |ui| {
            keyboard::keep_focus_in_view(ui);
            ui.spacing_mut().item_spacing.y = GAP;
            contents(context, embed, notice, ui);
        });
        let offset = area.state.unclamped_offset().y;
        let beyond = (area.content_size.y - area.inner_rect.height()).max(0.0);
        embed.room.set([offset.min(beyond), (beyond - offset).max(0.0)]);
    });
}

fn contents(context: &mut Context<'_>, embed: &Embed, notice: Option<&str>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    for complaint in embed.complaint.as_deref().into_iter().chain(notice) {
        ui.add(egui::Label::new(RichText::new(complaint).small().color(tokens.warning)).wrap());
    }
    sliders(context, embed, ui);
    if let Some(reason) = &context.bench.refusal {
        let text = fill("Not changed: {reason}.", &[("reason", reason)]);
        ui.add(egui::Label::new(RichText::new(text).small().color(tokens.danger)).wrap());
    }
    if embed.parts.contains(&Part::Verdict) {
        verdict::show(context, ui);
    }
    if embed.parts.contains(&Part::Live) {
        live::controls(context, ui);
    }
    let card = |part: &Part| !matches!(part, Part::Verdict | Part::Live);
    let mut parts: Vec<Part> = embed.parts.iter().copied().filter(card).collect();
    if let Some(large) = context.view.enlarged.filter(|panel| embed.shows(*panel)) {
        parts = vec![Part::Plot(large)];
    }
    let room = vec2(ui.available_width(), ui.available_height() - WAY_OUT - GAP);
    let columns = columns(parts.len(), room);
    let rows = parts.len().div_ceil(columns).max(1);
    let share = |length: f32, count: usize| ((length - GAP * (count - 1) as f32) / count as f32).floor();
    let (width, height) = (share(room.x, columns), share(room.y, rows).max(LEAST.y));
    for row in parts.chunks(columns) {
        // The last row may have fewer, wider ones.
        let width = if row.len() < columns { share(room.x, row.len()) } else { width };
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing = vec2(GAP, 0.0);
            for part in row {
                grid::place(ui, width, height, &mut |ui| draw(context, ui, *part));
            }
        });
    }
    way_out(context, ui);
}

/// How many panels side by side fill a room best.
fn columns(count: usize, room: egui::Vec2) -> usize {
    let badness = |columns: &usize| {
        let rows = count.div_ceil(*columns);
        let size = vec2(room.x / *columns as f32, room.y / rows as f32);
        let too_small = (size.x < LEAST.x && *columns > 1) || size.y < LEAST.y;
        let shape = (size.x / size.y.max(1.0) / BEST_SHAPE).ln().abs();
        // A hole in the last row is worse than a shape that is not the best.
        let hole = if count.is_multiple_of(*columns) { 0.0 } else { 0.4 };
        shape + hole + if too_small { 10.0 } else { 0.0 }
    };
    (1..=count.max(1)).min_by(|a, b| badness(a).total_cmp(&badness(b))).unwrap_or(1)
}

fn draw(context: &mut Context<'_>, ui: &mut Ui, part: Part) {
    match part {
        Part::Plot(panel) => plots::draw(context, ui, panel),
        // The card's own title and margin take the rest.
        Part::Beam => beam::show_in(context, ui, ui.available_height() - BEAM_FRAME),
        Part::Verdict | Part::Live => {}
    }
}

fn sliders(context: &mut Context<'_>, embed: &Embed, ui: &mut Ui) {
    let width = ui.available_width();
    let count = ((width / SLIDER) as usize).clamp(1, embed.controls.len().max(1));
    // Rows of equal length.
    let rows = embed.controls.len().div_ceil(count).max(1);
    let count = embed.controls.len().div_ceil(rows).max(1);
    let mut scenario = context.view.scenario.clone();
    for row in embed.controls.chunks(count) {
        let usual = std::mem::replace(&mut ui.spacing_mut().item_spacing.x, 20.0);
        ui.columns(count, |columns| {
            for (ui, control) in columns.iter_mut().zip(row) {
                ui.spacing_mut().item_spacing.x = usual;
                match control {
                    Control::Number(parameter) => structure::number(ui, &mut scenario.parameters, *parameter),
                    Control::Dimension(dimension) => device::alone(context, ui, *dimension),
                    Control::Modes => structure::modes(ui, &mut scenario),
                    Control::Force => structure::force(ui, &mut scenario),
                }
            }
        });
    }
    if scenario != context.view.scenario {
        context.edit(|present| *present = scenario);
    }
}

/// A quiet way to the whole page, with what is in view.
fn way_out(context: &Context<'_>, ui: &mut Ui) {
    let right = Layout::right_to_left(Align::Center);
    let size = vec2(ui.available_width(), WAY_OUT);
    ui.allocate_ui_with_layout(size, right, |ui| {
        let colour = theme::tokens(ui).text_weak;
        let text = RichText::new(tr("Open in Harvester Lab")).small().color(colour);
        let link = ui.add(egui::Button::new(text).frame(false).small());
        if link.clicked() {
            let view = context.view.clone().with_looks_of(&View::default());
            let url = format!("{}#{}", context.address, link::write(&view));
            ui.ctx().open_url(egui::OpenUrl::new_tab(url));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_fill_frames_of_all_shapes() {
        let cases = [
            (1, (640.0, 330.0), 1),
            (2, (640.0, 330.0), 2),
            (2, (360.0, 640.0), 1),
            (3, (960.0, 300.0), 3),
            (4, (960.0, 540.0), 2),
            (4, (360.0, 700.0), 1),
            (4, (1600.0, 340.0), 4),
        ];
        for (count, (width, height), wanted) in cases {
            assert_eq!(columns(count, vec2(width, height)), wanted, "{count} in {width} x {height}");
        }
    }
}
