//! Measured data over computed curves.

use egui::{RichText, Ui};
use egui_plot::PlotPoint;

use super::design::measure::Measure;
use super::design::{alignment, fitting};
use super::spec::{Place, Spec};
use super::{Context, grid};
use crate::app::bench::measured::{Domain, File, Reading};
use crate::app::command::Command;
use crate::app::text::{fill, marked, tr};
use crate::app::theme;
use crate::app::view::design::{Page, Watched};
use crate::app::widgets::number::{significant, with_unit};
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Card, Icon, Series, chips, legend};
use crate::dynamics::Measures;
use crate::export::Pen;
use crate::questions::design::measured::{Ask, Kind, Sampling};
use crate::questions::design::record::{Clock, Level};
use crate::questions::harvest::HarvestStudy;

/// Most columns that are offered.
const COLUMNS: usize = 8;

/// The plot.
pub(super) const PANEL: Spec = Spec::new(Place::Page(Page::Measured), |_| tr("Measured"), contents)
    .hint(hint)
    .asking(|asking| asking.studies.harvest(asking.view, asking.session));

fn hint(context: &Context<'_>) -> String {
    match context.bench.measured.progress() {
        Some(done) => fill("reading {percent} %", &[("percent", &format!("{:.0}", 100.0 * done))]),
        None => tr("drop a file anywhere on the page").to_owned(),
    }
}

fn contents(context: &mut Context<'_>, ui: &mut Ui) {
    match &context.bench.measured.file {
        None => before_a_file(context, ui),
        Some(file) if file.ask.is_some() => preview(ui, file),
        Some(file) => match file.reading.domain {
            Domain::Time => over_time(context, ui, file),
            Domain::Frequency => frequencies(context, ui, file),
        },
    }
}

/// What a record is going to be laid over, and how to bring one.
fn before_a_file(context: &Context<'_>, ui: &mut Ui) {
    let text =
        tr("Drop a text file here, or open one: columns of time and voltage, or of frequency and voltage. \
                   It stays in this browser.");
    let weak = theme::tokens(ui).text_weak;
    ui.add(egui::Label::new(RichText::new(text).color(weak)).wrap());
    legend::legend(ui, &[(Series::Numeric, tr("computed: the end of the run"))]);
    let curve = alignment::run_in_view(context);
    let (x, y) = time_and_voltage();
    plot_style::plot(ui, "before a file", &x, &y)
        .show(ui, |plot| plot_style::series(plot, Series::Numeric, tr("computed"), &curve));
}

/// The first rows of a file of which something has to be said before it is read.
fn preview(ui: &mut Ui, file: &File) {
    let tokens = theme::tokens(ui);
    let text = match file.ask {
        Some(Ask::Commas) => tr(
            "Its commas may be decimal commas or stand between columns. Say beside the plot which they are.",
        ),
        _ => tr(
            "Nothing says which column is the voltage. Choose it beside the plot; nothing is taken for one by itself.",
        ),
    };
    ui.add(egui::Label::new(RichText::new(text).color(tokens.warning)).wrap());
    ui.add_space(8.0);
    let columns = file.layout.columns.min(COLUMNS);
    egui::ScrollArea::horizontal().show(ui, |ui| {
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

fn time_and_voltage() -> (Axis, Axis) {
    (Axis::new(tr("time"), "t").unit("s"), Axis::new(tr("voltage"), "v").unit("V"))
}

/// Voltage over time, beside the end of the run in view.
fn over_time(context: &Context<'_>, ui: &mut Ui, file: &File) {
    legend::legend(
        ui,
        &[(Series::Measured, tr("measured")), (Series::Numeric, tr("computed: the end of the run"))],
    );
    let curve = alignment::computed(context, file);
    let (x, y) = time_and_voltage();
    plot_style::plot(ui, ("measured", file.name.as_str(), 0), &x, &y).show(ui, |plot| {
        plot_style::series(plot, Series::Numeric, tr("computed"), &curve);
        let colour = theme::tokens_in(plot.ctx()).theory;
        plot_style::curve(plot, tr("measured"), colour, Pen::Dashes(1.4, 5.0), &file.drawn);
    });
}

/// Voltage over frequency, beside the curves of the page Harvest.
fn frequencies(context: &Context<'_>, ui: &mut Ui, file: &File) {
    legend::legend(
        ui,
        &[
            (Series::Measured, tr("measured")),
            (Series::Linear, tr("without magnets")),
            (Series::Stable, tr("stable")),
            (Series::FromRest, tr("from rest")),
            (Series::Best, tr("fitted")),
        ],
    );
    let (x, y) =
        (Axis::new(tr("excitation frequency"), "f").unit("Hz"), Axis::new(tr("voltage, rms"), "v").unit("V"));
    let mut stable: Vec<Vec<PlotPoint>> = Vec::new();
    let (mut linear, mut reached) = (Vec::new(), Vec::new());
    if let Some(study) = context.studies.lanes.study::<HarvestStudy>() {
        linear.extend(study.linear().points.iter().map(|[f, v, ..]| PlotPoint::new(*f, *v)));
        for branch in study.branches().and_then(Result::ok).unwrap_or_default() {
            let points = study.branch_points(branch);
            for run in points.chunk_by(|a, b| a.1 == b.1).filter(|run| run[0].1) {
                stable.push(
                    run.iter()
                        .map(|(point, _)| PlotPoint::new(point.frequency, point.measures.v_rms))
                        .collect(),
                );
            }
        }
        let starts = study.from_rest().iter().filter_map(|start| start.flatten());
        reached.extend(starts.map(|(_, point)| PlotPoint::new(point.frequency, point.measures.v_rms)));
    }
    let fitted = fitting::curves(context, file);
    plot_style::plot(ui, ("measured", file.name.as_str(), 1), &x, &y).include_y(0.0).show(ui, |plot| {
        plot_style::series(plot, Series::Linear, tr("without magnets"), &linear);
        for run in &stable {
            plot_style::series(plot, Series::Stable, tr("stable"), run);
        }
        plot_style::points(plot, Series::FromRest, tr("from rest"), &reached);
        plot_style::points(plot, Series::Measured, tr("measured"), &file.drawn);
        plot_style::series(plot, Series::Ghost, tr("start of the fit"), &fitted[0]);
        plot_style::series(plot, Series::Best, tr("fitted"), &fitted[1]);
    });
}

/// The measured voltages over frequency, for a plot of voltages.
pub(super) fn over_frequency(context: &Context<'_>, watched: Watched, measure: &Measure) -> Vec<PlotPoint> {
    let file = context.bench.measured.file.as_ref().filter(|file| file.reading.domain == Domain::Frequency);
    match (watched, file) {
        (Watched::Voltage | Watched::Peak, Some(file)) => {
            file.drawn.iter().map(|point| measure.place(point.x, point.y)).collect()
        }
        _ => Vec::new(),
    }
}

/// The cards beside the plot.
pub(super) fn cards(context: &mut Context<'_>, ui: &mut Ui) {
    let title = context.bench.measured.file.as_ref().map_or(tr("File"), |file| file.name.as_str());
    let open = context.bench.measured.file.is_some();
    let card = Card::new(title).hugging();
    let card = if open { card.button(Icon::Close, tr("Close")) } else { card };
    let shown = card.show(ui, |ui| {
        let tokens = theme::tokens(ui);
        if ui.button(tr("Open a file")).clicked() {
            context.commands.push(Command::OpenFile);
        }
        if let Some(error) = &context.bench.measured.error {
            ui.add(egui::Label::new(RichText::new(format!("{error}.")).color(tokens.danger)).wrap());
        }
        match &context.bench.measured.file {
            Some(file) => reading(context, ui, file),
            None => {
                let text = tr("Comma, semicolon, tab or blanks between the columns, decimal point or comma, any header: \
                               these are found out. A million rows are welcome.");
                ui.add(egui::Label::new(RichText::new(text).small().color(tokens.text_weak)).wrap());
                if ui.add_enabled(context.shown().is_some(), egui::Button::new(tr("Try it with the run in view"))).clicked() {
                    context.commands.push(Command::MeasureRun);
                }
            }
        }
    });
    if shown.pressed.is_some() {
        context.commands.push(Command::Measure(None));
    }
    if let Some(file) = context.bench.measured.file.as_ref().filter(|file| file.measures.is_some()) {
        ui.add_space(grid::GAP);
        Card::new(tr("Compared")).hugging().show(ui, |ui| compared(context, ui, file));
        if file.reading.domain == Domain::Frequency {
            ui.add_space(grid::GAP);
            Card::new(tr("Fit")).hugging().show(ui, |ui| fitting::controls(context, ui, file));
        }
    }
}

/// Which columns, in which units.
fn reading(context: &mut Context<'_>, ui: &mut Ui, file: &File) {
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
                context.commands.push(Command::Measure(Some(reading)));
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
        chips(
            ui,
            tr("First column is"),
            &mut reading.domain,
            &[(Domain::Time, tr("time")), (Domain::Frequency, tr("frequency"))],
        );
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
    label(ui, if reading.domain == Domain::Time { tr("voltage") } else { tr("voltage, rms unless scaled") });
    let mut column = (file.ask != Some(Ask::Column)).then_some(reading.columns.y);
    let choices: Vec<(Option<usize>, &str)> = columns.iter().map(|(i, name)| (Some(*i), *name)).collect();
    let chosen = chips(ui, tr("Column of the voltage"), &mut column, &choices);
    if let (true, Some(column)) = (chosen, column) {
        let (kind, unit) = file.layout.kinds()[column];
        reading.chosen = true;
        reading.columns.y = column;
        reading.columns.y_unit = if kind == Kind::Voltage { unit } else { 1.0 };
    }
    let volts = [(1.0, "V"), (1e-3, "mV"), (std::f64::consts::FRAC_1_SQRT_2, tr("V amplitude")), (1e3, "kV")];
    chips(ui, tr("Unit of the voltage"), &mut reading.columns.y_unit, &volts);
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
        context.commands.push(Command::Measure(Some(reading)));
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

/// Measured and computed in numbers.
fn compared(context: &mut Context<'_>, ui: &mut Ui, file: &File) {
    let Some(Level { rms, peak, cycles, .. }) = file.measures else { return };
    let tokens = theme::tokens(ui);
    let line = |ui: &mut Ui, text: String| {
        ui.add(egui::Label::new(RichText::new(text).small().color(tokens.text)).wrap());
    };
    let (first, last) = (file.points.first(), file.points.last());
    if let (Some(first), Some(last)) = (first, last) {
        let unit = if file.reading.domain == Domain::Time { "s" } else { "Hz" };
        line(
            ui,
            fill(
                "from {from} to {to} {unit}",
                &[("from", &significant(first[0], 5)), ("to", &significant(last[0], 5)), ("unit", &unit)],
            ),
        );
    }
    if file.reading.domain == Domain::Frequency {
        if let Some([frequency, volts]) = &file.highest {
            line(
                ui,
                fill(
                    "highest {volts} at {hertz} Hz",
                    &[("volts", &with_unit(*volts, "V")), ("hertz", &significant(*frequency, 5))],
                ),
            );
        }
        return;
    }
    line(
        ui,
        fill(
            "measured {rms}, peak {peak} (about its mean)",
            &[("rms", &with_unit(rms, tr("V rms"))), ("peak", &with_unit(peak, "V"))],
        ),
    );
    line(
        ui,
        match cycles {
            0 => tr("over the whole record: it has no whole cycle").to_owned(),
            1 => tr("over one cycle").to_owned(),
            cycles => fill("over {cycles} whole cycles", &[("cycles", &cycles)]),
        },
    );
    let found = context.studies.operating(&context.view.scenario);
    if let Some((Ok(operating), true)) = found
        && let Some(harvest) = &operating.reached.harvest
    {
        let Measures { v_rms, v_peak, .. } = harvest.measures;
        line(
            ui,
            fill(
                "computed {rms}, peak {peak}",
                &[("rms", &with_unit(v_rms, tr("V rms"))), ("peak", &with_unit(v_peak, "V"))],
            ),
        );
        if v_rms > 0.0 {
            line(ui, fill("measured over computed: {ratio}", &[("ratio", &significant(rms / v_rms, 3))]));
        }
    }
    if context.view.scenario.base().loss_tangent > 0.0 {
        line(ui, tr("The curve is drawn without the dielectric loss.").to_owned());
    }
    alignment::controls(context, ui, file);
}
