//! Tables 1 and 2, with the dimensionless numbers that follow from the first.

use egui::{Grid, RichText, Ui};

use super::Context;
use crate::app::text::{fill, tr};
use crate::app::theme;
use crate::app::widgets::number::short;
use crate::app::widgets::{Card, number, symbol, touch};
use crate::model::materials::TABLE_2;
use crate::model::{Device, Dimension, ElectricalScaling, Parameter, Part};

/// Width below which columns stand closer together.
const NARROW: f32 = 400.0;

/// Width from which the two columns stand side by side.
const TWO_COLUMNS: f32 = 780.0;

/// Draws the three tables.
pub(super) fn show(_context: &mut Context<'_>, ui: &mut Ui) {
    if ui.available_width() < TWO_COLUMNS {
        first(ui);
        ui.add_space(10.0);
        second(ui);
    } else {
        ui.columns(2, |columns| {
            first(&mut columns[0]);
            second(&mut columns[1]);
        });
    }
}

fn first(ui: &mut Ui) {
    Card::new(tr("Table 1 and section 3.2: the device")).hugging().show(ui, device);
}

fn second(ui: &mut Ui) {
    Card::new(tr("Its dimensionless numbers, Eq. 8")).hugging().show(ui, numbers);
    ui.add_space(10.0);
    Card::new(tr("Table 2 and section 5.4: piezoelectric ceramics")).hugging().show(ui, ceramics);
}

/// Five significant digits without trailing zeros.
fn value(ui: &mut Ui, value: f64) {
    ui.label(number::typographic(&number::round_significant(value, 5).to_string()));
}

fn heading(ui: &mut Ui, texts: &[&str]) {
    let tokens = theme::tokens(ui);
    for text in texts {
        ui.label(RichText::new(*text).small().color(tokens.text_weak));
    }
    ui.end_row();
}

fn table(ui: &mut Ui, name: &str, contents: impl FnOnce(&mut Ui)) {
    let gap = if ui.available_width() < NARROW { 14.0 } else { 26.0 };
    touch::sideways(ui.ctx()).id_salt(name).show(ui, |ui| {
        Grid::new(name).num_columns(2).spacing([gap, 5.0]).show(ui, contents);
    });
}

fn device(ui: &mut Ui) {
    let device = Device::default();
    // The paper leaves out what is zero here.
    let printed = |dimension: &Dimension| {
        !matches!(dimension.fact().part, Part::Main | Part::Ceramic) && device.get(*dimension) != 0.0
    };
    table(ui, "device", |ui| {
        // The meaning last: on a phone it may reach beyond the edge.
        heading(ui, &[tr("symbol"), tr("value"), tr("unit"), tr("meaning")]);
        let mut row = |name: &str, number: f64, unit: &str, meaning: &str| {
            ui.label(symbol(name, theme::tokens(ui).text_strong));
            value(ui, number);
            ui.label(unit);
            ui.label(meaning);
            ui.end_row();
        };
        for dimension in Dimension::ALL.into_iter().filter(printed) {
            let fact = dimension.fact();
            let (unit, factor) = (ElectricalScaling::AsPrinted.unit(fact.shown.0), fact.shown.1);
            row(fact.symbol, factor * device.get(dimension), unit, tr(fact.title));
        }
        row("T", device.time_unit(), "s", tr("unit of time"));
    });
}

fn numbers(ui: &mut Ui) {
    let device = Device::default();
    let printed = device.dimensionless(ElectricalScaling::AsPrinted);
    let consistent = device.dimensionless(ElectricalScaling::Consistent);
    let (Ok(printed), Ok(consistent)) = (printed, consistent) else { return };
    table(ui, "numbers", |ui| {
        heading(ui, &[tr("number"), tr("as printed"), tr("consistent units")]);
        for parameter in Parameter::ALL.into_iter().filter(|parameter| printed.get(*parameter) != 0.0) {
            ui.label(symbol(parameter.fact().symbol, theme::tokens(ui).text_strong));
            value(ui, printed.get(parameter));
            value(ui, consistent.get(parameter));
            ui.end_row();
        }
    });
    let text = tr(
        "Eq. 8 scales the circuit with L². A moment ΘV needs Θ in N m/V, and then one factor L less; the paper's \
         c, κ and θ follow only from the printed form.",
    );
    ui.add(egui::Label::new(RichText::new(text).small().color(theme::tokens(ui).text_weak)).wrap());
}

fn ceramics(ui: &mut Ui) {
    table(ui, "ceramics", |ui| {
        heading(
            ui,
            &[tr("material"), tr("quality factor"), tr("dielectric loss"), tr("largest field [V/mil]")],
        );
        for material in TABLE_2 {
            ui.label(material.name);
            ui.label(material.quality_factor.to_string());
            let bound = if material.dissipation_is_bound { "< " } else { "" };
            ui.label(format!("{bound}{} %", short(100.0 * material.dissipation_factor)));
            ui.label(material.field_limit.map_or(tr("not given").to_owned(), |(low, high)| {
                fill("{low} to {high}", &[("low", &low), ("high", &high)])
            }));
            ui.end_row();
        }
    });
}
