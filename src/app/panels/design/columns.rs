//! Which columns of a file are read, in which units, and what is the matter with its rows.

use egui::{RichText, Ui};

use crate::app::bench::measured::{Domain, File, Reading};
use crate::app::command::Command;
use crate::app::panels::Context;
use crate::app::text::{fill, marked, tr};
use crate::app::theme;
use crate::app::widgets::number::with_unit;
use crate::app::widgets::{chips, touch};
use crate::model::STANDARD_GRAVITY;
use crate::questions::design::measured::{Ask, Kind, Sampling};
use crate::questions::design::record::Clock;

/// Most columns that are offered.
const COLUMNS: usize = 8;

/// The first rows of a file of which something has to be said before it is read.
pub(in crate::app::panels) fn preview(ui: &mut Ui, file: &File, wanted: Kind) {
    let tokens = theme::tokens(ui);
    let text = match file.ask {
        Some(Ask::Commas) => tr(
            "Its commas may be decimal commas or stand between columns. Say beside the plot which they are.",
        ),
        _ if wanted == Kind::Acceleration => tr(
            "Nothing says which column is the acceleration. Choose it; nothing is taken for one by itself.",
        ),
        _ => tr(
            "Nothing says which column is the voltage. Choose it beside the plot; nothing is taken for one by itself.",
        ),
    };
    ui.add(egui::Label::new(RichText::new(text).color(tokens.warning)).wrap());
    ui.add_space(8.0);
    let columns = file.layout.columns.min(COLUMNS);
    touch::sideways(ui.ctx()).show(ui, |ui| {
        egui::Grid::new("preview").striped(true).spacing([18.0, 6.0]).show(ui, |ui| {
            for name in names(file, columns) {
                ui.label(RichText::new(name).small().color(tokens.text_weak));
            }
            ui.end_row();
            for row in &file.layout.rows {
                for field in row.iter().take(columns) {
                    let field: String = field.chars().take(18).collect();
                    ui.label(RichText::new(field).monospace());
                }
                ui.end_row();
            }
        });
    });
}

/// What columns are called: by their names, or by their numbers.
fn names(file: &File, count: usize) -> Vec<String> {
    let named = |column: usize| {
        let names = file.layout.header.as_ref();
        names.and_then(|names| names.get(column)).filter(|name| !name.is_empty())
    };
    let name = |column: usize| {
        named(column).map_or_else(|| format!("{}", column + 1), |name| name.chars().take(18).collect())
    };
    (0..count).map(name).collect()
}

/// Which columns, in which units.
pub(in crate::app::panels) fn reading(context: &mut Context<'_>, ui: &mut Ui, file: &File, wanted: Kind) {
    let weak = theme::tokens(ui).text_weak;
    let mut reading = file.reading;
    let count = file.layout.columns.min(COLUMNS);
    let names = names(file, count);
    let columns: Vec<(usize, &str)> = (0..count).zip(names.iter().map(String::as_str)).collect();
    let label = |ui: &mut Ui, text: &str| {
        ui.label(RichText::new(text).small().color(weak));
    };
    if file.ask == Some(Ask::Commas) || reading.decimal_commas.is_some() {
        label(ui, tr("commas are"));
        let mut commas = reading.decimal_commas;
        let choices = [(Some(true), tr("decimal: 0,5 is a half")), (Some(false), tr("between columns"))];
        if chips(ui, tr("Commas are"), &mut commas, &choices) {
            reading.decimal_commas = commas;
        }
        if file.ask == Some(Ask::Commas) {
            if reading != file.reading {
                context.commands.push(Command::Measure(wanted, Some(reading)));
            }
            return;
        }
    }
    if let Some(Sampling { start, increment, .. }) = file.layout.sampling {
        let (start, increment) = (with_unit(start, "s"), with_unit(increment, "s"));
        let text = fill(
            "times from the head: from {start} every {increment}",
            &[("start", &start), ("increment", &increment)],
        );
        label(ui, &text);
    } else {
        label(ui, tr("first column is"));
        if wanted == Kind::Voltage {
            let domains = [(Domain::Time, tr("time")), (Domain::Frequency, tr("frequency"))];
            chips(ui, tr("First column is"), &mut reading.domain, &domains);
        }
        chips(ui, tr("Column of the first"), &mut reading.columns.x, &columns);
        let units: &[(f64, &str)] = match reading.domain {
            Domain::Time => &[(1.0, "s"), (1e-3, "ms"), (1e-6, "µs")],
            Domain::Frequency => &[(1.0, "Hz"), (1e3, "kHz"), (std::f64::consts::FRAC_1_PI / 2.0, "rad/s")],
        };
        if reading.domain != file.reading.domain {
            reading.columns.x_unit = 1.0;
        }
        chips(ui, tr("Unit of the first"), &mut reading.columns.x_unit, units);
    }
    let (name, chosen_among) = match (wanted, reading.domain) {
        (Kind::Acceleration, _) => (tr("acceleration"), tr("Column of the acceleration")),
        (_, Domain::Time) => (tr("voltage"), tr("Column of the voltage")),
        (_, Domain::Frequency) => (tr("voltage, rms unless scaled"), tr("Column of the voltage")),
    };
    label(ui, name);
    let mut column = (file.ask != Some(Ask::Column)).then_some(reading.columns.y);
    let choices: Vec<(Option<usize>, &str)> = columns.iter().map(|(i, name)| (Some(*i), *name)).collect();
    let chosen = chips(ui, chosen_among, &mut column, &choices);
    if let (true, Some(column)) = (chosen, column) {
        let (kind, unit) = file.layout.kinds()[column];
        reading.chosen = true;
        reading.columns.y = column;
        reading.columns.y_unit = if kind == wanted { unit } else { 1.0 };
    }
    if wanted == Kind::Acceleration {
        let units = [(STANDARD_GRAVITY, "g"), (1.0, "m/s²"), (1e-3 * STANDARD_GRAVITY, "mg")];
        chips(ui, tr("Unit of the acceleration"), &mut reading.columns.y_unit, &units);
    } else {
        let volts =
            [(1.0, "V"), (1e-3, "mV"), (std::f64::consts::FRAC_1_SQRT_2, tr("V amplitude")), (1e3, "kV")];
        chips(ui, tr("Unit of the voltage"), &mut reading.columns.y_unit, &volts);
    }
    let rows = match file.points.len() {
        0 => String::new(),
        1 => tr("1 row read").to_owned(),
        rows => fill("{rows} rows read", &[("rows", &rows)]),
    };
    label(ui, &rows);
    if file.over_range > 0 {
        label(
            ui,
            &fill("{count} rows left out: out of the instrument's range", &[("count", &file.over_range)]),
        );
    }
    warnings(ui, file, &mut reading);
    if reading != file.reading {
        context.commands.push(Command::Measure(wanted, Some(reading)));
    }
}

/// What is the matter with the times, and what can be done about it.
fn warnings(ui: &mut Ui, file: &File, reading: &mut Reading) {
    let warning = theme::tokens(ui).warning;
    let Clock { decreases, repeats, unit_changes } = file.clock;
    let say = |ui: &mut Ui, text: &'static str, row: usize| {
        let text = fill(text, &[("row", &(row + 1))]);
        ui.add(egui::Label::new(RichText::new(text).small().color(warning)).wrap());
    };
    if let Some(row) = decreases {
        say(ui, marked("the first column goes back at row {row}"), row);
        ui.checkbox(&mut reading.sorted, tr("sort by it"));
    }
    if let Some(row) = repeats {
        say(ui, marked("the first column stays at row {row}"), row);
    }
    if let Some(row) = unit_changes {
        say(ui, marked("from row {row} on its steps are a thousand times others: another unit?"), row);
    }
}
