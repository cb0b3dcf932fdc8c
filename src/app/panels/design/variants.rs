//! The pinned variants beside the present design: in what they differ, and what each gives.

use egui::{Color32, Grid, RichText, TextEdit, Ui, WidgetInfo};

use super::safety::{Judged, Safety};
use crate::app::bench::facts;
use crate::app::bench::variant::{Change, LETTERS, MOST, Variant};
use crate::app::command::Command;
use crate::app::crew::Studies;
use crate::app::panels::{Context, grid, plots};
use crate::app::session::Session;
use crate::app::text::{fill, tr};
use crate::app::theme::{self, Tokens};
use crate::app::view::View;
use crate::app::widgets::number::{significant, with_unit};
use crate::app::widgets::{Card, Icon, icon_button};
use crate::questions::design::Bounds;

/// Width of the names of rows, and of a design's column, points; and least height of the plot.
const NAMES: f32 = 130.0;
const COLUMN: f32 = 170.0;
const PLOT: f32 = 300.0;
/// Height of a row.
const ROW: f32 = 18.0;
/// Width of the field of a name.
const NAME: f32 = 84.0;

/// Draws the page.
pub(super) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    let room = ui.available_size();
    plots::column(context, ui, [room.x, 0.55 * room.y], PLOT);
    if context.on_top.is_none() {
        ui.add_space(grid::GAP);
    }
    let hint = fill("{count} of {most} pinned", &[("count", &context.bench.variants.len()), ("most", &MOST)]);
    Card::new(tr("Variants")).hint(&hint).hugging().show(ui, |ui| card(context, ui));
}

/// A cell: its text, its colour where that says something, and more about it.
struct Cell {
    text: String,
    colour: Option<Color32>,
    more: String,
}

impl Cell {
    fn new(text: String) -> Self {
        Self { text, colour: None, more: String::new() }
    }
}

/// The table of these designs: the name of each row, and a cell for each design.
fn table(view: &View, designs: &[&Variant], tokens: &Tokens) -> Vec<(String, Vec<Cell>)> {
    let scenarios: Vec<_> = designs.iter().map(|design| &design.scenario).collect();
    let holds = designs.iter().all(|design| design.holds_acceleration);
    let mut rows: Vec<(String, Vec<Cell>)> = Vec::new();
    for (name, values) in facts::differing(&scenarios, holds) {
        rows.push((name, values.into_iter().map(Cell::new).collect()));
    }
    let found: Vec<[Cell; 6]> = designs.iter().map(|design| numbers(view, design, tokens)).collect();
    let names = [tr("Power"), tr("Half-power band"), tr("Best load"), tr("Tip"), tr("Voltage"), tr("Limits")];
    let mut columns: Vec<_> = found.into_iter().map(IntoIterator::into_iter).collect();
    for name in names {
        rows.push((name.to_owned(), columns.iter_mut().filter_map(Iterator::next).collect()));
    }
    rows
}

/// What a design gives.
fn numbers(view: &View, design: &Variant, tokens: &Tokens) -> [Cell; 6] {
    let none = || Cell::new("–".to_owned());
    let load = design.load.map_or_else(none, |[resistance, power]| {
        let at = significant(design.scenario.units().hertz(design.scenario.parameters.omega), 4);
        let text = fill(
            "{load} gives {power}",
            &[("load", &with_unit(resistance, "Ω")), ("power", &with_unit(power, "W"))],
        );
        Cell { more: fill("at {hertz} Hz", &[("hertz", &at)]), ..Cell::new(text) }
    });
    let Some((best, half)) = design.best() else {
        return [Cell::new(tr("no motion that lasts").to_owned()), none(), load, none(), none(), none()];
    };
    let measures = best.measures;
    let at_end = |hertz: f64| super::bands::at_end(design.window, hertz);
    let sign = |ends: bool| if ends { "≥\u{a0}" } else { "" };
    let power = sign(at_end(best.frequency)).to_owned() + &with_unit(measures.power, "W");
    let power = fill("{what} at {hertz} Hz", &[("what", &power), ("hertz", &significant(best.frequency, 4))]);
    let half = half.map_or_else(none, |half| {
        let wide = format!(
            "{}{} Hz",
            sign(at_end(half.from) || at_end(half.to)),
            significant(half.to - half.from, 3)
        );
        Cell { more: super::bands::hertz_list(design.window, &[half]), ..Cell::new(wide) }
    });
    let (low, high) = measures.tip;
    let tip = fill("{from} to {to}", &[("from", &significant(low, 3)), ("to", &significant(high, 3))]);
    let peak = fill("peak {value}", &[("value", &with_unit(measures.v_peak, "V"))]);
    let voltage = format!("{}, {peak}", with_unit(measures.v_rms, tr("V rms")));
    let bounds: Bounds = design.bounds(view);
    let judged = Judged::of(&Safety(bounds), &design.scenario, &bounds.demand(&measures));
    let limits = judged.map_or_else(none, |judged| Cell {
        text: judged.word.to_owned(),
        colour: Some(judged.colour(tokens)),
        more: judged.detail,
    });
    [Cell::new(power), half, load, Cell::new(format!("{tip} mm")), Cell::new(voltage), limits]
}

/// The table in words for a report: a row with the names of the designs, and the others; empty where nothing is pinned.
pub(in crate::app) fn in_words(
    view: &View,
    session: &Session,
    studies: &Studies,
    pinned: &[Variant],
) -> Vec<Vec<String>> {
    if pinned.is_empty() {
        return Vec::new();
    }
    let present = Variant::present(view, session, studies).map(|(present, _)| present);
    let designs: Vec<&Variant> = present.iter().chain(pinned).collect();
    let name = |design: &&Variant| {
        if design.name.is_empty() { tr("present").to_owned() } else { design.name.clone() }
    };
    let head = [String::new()].into_iter().chain(designs.iter().map(name)).collect();
    let text = |cell: Cell| match cell.more.as_str() {
        "" => cell.text,
        more => format!("{} ({more})", cell.text),
    };
    let rows = table(view, &designs, &theme::LIGHT).into_iter();
    let rows = rows.map(|(name, cells)| [name].into_iter().chain(cells.into_iter().map(text)).collect());
    [head].into_iter().chain(rows).collect()
}

fn card(context: &mut Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let present = Variant::present(context.view, context.session, context.studies);
    let pinned = context.bench.variants.clone();
    let known = present.as_ref().is_some_and(|(_, all)| *all);
    let again = present.as_ref().is_some_and(|(present, _)| pinned.iter().any(|one| one.is_same(present)));
    if ui
        .add_enabled(known && !again && pinned.len() < MOST, egui::Button::new(tr("Pin this design")))
        .clicked()
    {
        context.commands.push(Command::Variant(Change::Pin));
    }
    if pinned.is_empty() {
        let text = tr(
            "Pin up to four designs, change the sliders, and see here in what they differ and what each gives.",
        );
        ui.add(egui::Label::new(RichText::new(text).small().color(tokens.text_weak)).wrap());
    }
    ui.add_space(4.0);
    ui.spacing_mut().interact_size.y = ROW;
    let present = present.map(|(present, _)| present);
    let designs: Vec<(Option<usize>, &Variant)> = present
        .iter()
        .map(|present| (None, present))
        .chain(pinned.iter().enumerate().map(|(index, variant)| (Some(index), variant)))
        .collect();
    let all: Vec<&Variant> = designs.iter().map(|(_, design)| *design).collect();
    let rows = table(context.view, &all, tokens);
    let room = ui.available_width();
    if room >= NAMES + COLUMN * designs.len() as f32 {
        Grid::new("variants").num_columns(designs.len() + 1).spacing([16.0, 5.0]).show(ui, |ui| {
            ui.label("");
            designs.iter().for_each(|(index, design)| head(context, ui, *index, design));
            ui.end_row();
            for (name, cells) in &rows {
                ui.label(RichText::new(name).small().color(tokens.text_weak));
                cells.iter().for_each(|cell| draw(ui, cell, tokens));
                ui.end_row();
            }
        });
        return;
    }
    for (column, (index, design)) in designs.iter().enumerate() {
        if column > 0 {
            ui.separator();
        }
        head(context, ui, *index, design);
        Grid::new(("variant", column)).num_columns(2).spacing([12.0, 4.0]).show(ui, |ui| {
            for (name, cells) in &rows {
                ui.label(RichText::new(name).small().color(tokens.text_weak));
                if let Some(cell) = cells.get(column) {
                    draw(ui, cell, tokens);
                }
                ui.end_row();
            }
        });
    }
}

fn draw(ui: &mut Ui, cell: &Cell, tokens: &Tokens) {
    let label = ui.label(RichText::new(&cell.text).small().color(cell.colour.unwrap_or(tokens.text_strong)));
    if !cell.more.is_empty() {
        label.on_hover_text(&cell.more);
    }
}

/// The name of a design, and what can be done with one that is pinned.
fn head(context: &mut Context<'_>, ui: &mut Ui, index: Option<usize>, design: &Variant) {
    let tokens = theme::tokens(ui);
    let Some(index) = index else {
        ui.label(RichText::new(tr("present")).color(tokens.text_strong).strong());
        return;
    };
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        let id = ui.make_persistent_id(("name of a variant", index));
        let mut name: String = ui.data(|data| data.get_temp(id)).unwrap_or_else(|| design.name.clone());
        let field = ui.add(TextEdit::singleline(&mut name).id(id).desired_width(NAME).char_limit(LETTERS));
        let said = fill("Name of {name}", &[("name", &design.name)]);
        field.widget_info(|| WidgetInfo::labeled(egui::Role::TextInput, true, said.clone()));
        if field.has_focus() {
            ui.data_mut(|data| data.insert_temp(id, name));
        } else {
            ui.data_mut(|data| data.remove_temp::<String>(id));
            let name = name.trim().to_owned();
            if field.lost_focus() && !name.is_empty() && name != design.name {
                context.commands.push(Command::Variant(Change::Rename(index, name)));
            }
        }
        let restore = fill("Make {name} the present design", &[("name", &design.name)]);
        if icon_button(ui, Icon::Reset, &restore).clicked() {
            context.commands.push(Command::Variant(Change::Restore(index)));
        }
        let remove = fill("Remove {name}", &[("name", &design.name)]);
        if icon_button(ui, Icon::Close, &remove).clicked() {
            context.commands.push(Command::Variant(Change::Remove(index)));
        }
    });
}
