//! Measured data over computed curves.

use egui::{RichText, Ui};
use egui_plot::PlotPoint;

use super::design::measure::Measure;
use super::design::{alignment, columns, fitting};
use super::spec::{Asking, Place, Spec};
use super::{Context, grid};
use crate::app::bench::measured::{Domain, File};
use crate::app::command::Command;
use crate::app::text::{fill, tr};
use crate::app::theme;
use crate::app::view::design::{Page, Watched};
use crate::app::widgets::number::{significant, with_unit};
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Card, Icon, Series, legend};
use crate::dynamics::Measures;
use crate::export::Pen;
use crate::questions::design::measured::Kind;
use crate::questions::design::record::Level;
use crate::questions::harvest::HarvestStudy;

/// The plot.
pub(super) const PANEL: Spec =
    Spec::new(Place::Page(Page::Measured), |_| tr("Measured"), contents).hint(hint).asking(ask);

/// Of a file over frequency the curves are those of its own frequencies.
fn ask(asking: &mut Asking<'_>) {
    let Some(window) = asking.bench.measured.file.as_ref().and_then(File::frequencies) else {
        return asking.studies.harvest(asking.view, asking.session);
    };
    let mut view = asking.view.clone();
    view.design.window = Some(window);
    asking.studies.harvest(&view, asking.session);
}

fn hint(context: &Context<'_>) -> String {
    match context.bench.measured.progress() {
        Some(done) => super::reading(done),
        None => tr("drop a file anywhere on the page").to_owned(),
    }
}

fn contents(context: &mut Context<'_>, ui: &mut Ui) {
    match &context.bench.measured.file {
        None => before_a_file(context, ui),
        Some(file) if file.ask.is_some() => columns::preview(ui, file, Kind::Voltage),
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
            Some(file) => columns::reading(context, ui, file, Kind::Voltage),
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
        context.commands.push(Command::Measure(Kind::Voltage, None));
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
