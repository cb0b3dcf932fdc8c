//! Power against the load: over six decades at the frequency in view, and at the best frequency of each load.

use egui::{RichText, Ui};
use egui_plot::PlotPoint;

use super::safety::{Safety, beyond};
use crate::app::panels::computing;
use crate::app::panels::{Context, grid};
use crate::app::text::{fill, marked, reworded, tr};
use crate::app::theme;
use crate::app::view::Panel;
use crate::app::widgets::number::{prefix, round_significant, significant, with_unit};
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Card, Series, chips, legend};
use crate::export::Pen;
use crate::jobs::design::load::{BestFrequency, LoadPoint};
use crate::jobs::design::{DesignFinding, Plant};
use crate::jobs::study::Study as _;
use crate::jobs::study::load::LoadStudy;
use crate::jobs::work::Finding;

/// Draws the card with the curves.
pub(super) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    let progress = context.studies.bench.load.study().map(|study| (study.progress(), study.finished()));
    let hint = match progress {
        Some((done, false)) => computing(done),
        _ => tr("click to take a load").to_owned(),
    };
    context.plot_card(ui, Panel::Load, tr("Over the load"), &hint, |context, ui| {
        header(context, ui);
        match context.studies.bench.load.study() {
            Some(study) if study.failure().is_none() => plot(context, ui, study),
            study => {
                let why = study
                    .and_then(LoadStudy::failure)
                    .unwrap_or(marked("There is no curve for this device."));
                plot_style::no_data(ui, ui.available_rect_before_wrap(), &reworded(why));
            }
        }
    });
}

fn header(context: &mut Context<'_>, ui: &mut Ui) {
    let mut logarithmic = context.view.design.logarithmic;
    ui.horizontal_wrapped(|ui| {
        if chips(ui, tr("Scale"), &mut logarithmic, &[(false, tr("linear")), (true, tr("log"))]) {
            context.redesign(|design| design.logarithmic = logarithmic);
        }
        let hertz = context.view.scenario.units().hertz(context.view.scenario.parameters.omega);
        let text = fill(
            "at {hertz} Hz, and at the best frequency of each load",
            &[("hertz", &significant(hertz, 4))],
        );
        ui.label(RichText::new(text).small().color(theme::tokens(ui).text_weak));
    });
    legend::legend(
        ui,
        &[
            (Series::Linear, tr("without magnets")),
            (Series::Stable, tr("forced")),
            (Series::Unstable, tr("unstable")),
            (Series::Up, tr("reached")),
            (Series::Theory, tr("best frequency, without magnets")),
            (Series::Best, tr("best frequency, stable motions")),
            (Series::Beyond, tr("beyond a limit")),
        ],
    );
}

/// What is known of the best frequencies.
fn best_frequencies<'a>(context: &Context<'a>) -> Vec<&'a BestFrequency> {
    let found = context.studies.bench.best.study().map_or(&[][..], |table| table.found());
    let pick = |found: &'a Option<Result<Finding, String>>| match found {
        Some(Ok(Finding::Design(DesignFinding::BestFrequency(best)))) => Some(best),
        _ => None,
    };
    found.iter().filter_map(pick).collect()
}

fn plot(context: &mut Context<'_>, ui: &mut Ui, study: &LoadStudy) {
    let view = context.view;
    let best = best_frequencies(context);
    let forced: Vec<LoadPoint> = study.forced().unwrap_or_default().iter().flatten().copied().collect();
    let reached: Vec<LoadPoint> = study.reached().iter().flatten().filter(|p| p.stable).copied().collect();
    let highest =
        forced.iter().chain(&reached).map(|point| point.power).fold(study.linear_best()[1], f64::max);
    let highest =
        best.iter().filter_map(|best| best.nonlinear).map(|[_, power]| power).fold(highest, f64::max);
    let (factor, sign) = prefix(highest);
    let y = Axis::new(tr("power in the load"), "P").unit(format!("{sign}W"));
    let y = if view.design.logarithmic { y.logarithmic() } else { y };
    let x = Axis::new(tr("load"), "R").unit("Ω").logarithmic();
    let at =
        |resistance: f64, power: f64| PlotPoint::new(x.coordinate(resistance), y.coordinate(factor * power));
    let place = |point: &LoadPoint| at(point.resistance, point.power);
    let mut drawn: Vec<(Series, &str, Vec<PlotPoint>)> = Vec::new();
    drawn.push((
        Series::Linear,
        tr("without magnets"),
        study.linear().iter().map(|[r, p]| at(*r, *p)).collect(),
    ));
    for run in forced.chunk_by(|a, b| a.stable == b.stable) {
        let kind = if run[0].stable { Series::Stable } else { Series::Unstable };
        drawn.push((kind, tr("forced motion"), run.iter().map(place).collect()));
    }
    let linear = best.iter().map(|best| at(best.resistance, best.linear[1])).collect();
    drawn.push((Series::Theory, tr("without magnets, best frequency"), linear));
    let stable = best.iter().filter_map(|best| best.nonlinear.map(|[_, power]| at(best.resistance, power)));
    drawn.push((Series::Best, tr("stable motions, best frequency"), stable.collect()));
    drawn.push((Series::Up, tr("reached"), reached.iter().map(place).collect()));
    let safety = Safety::of(view, context.session);
    let demand = |point: &LoadPoint| (point.v_peak, point.tip);
    drawn.push((Series::Beyond, tr("beyond a limit"), beyond(safety.as_ref(), &reached, &demand, &place)));
    let own = Plant::new(&view.scenario).map_or(f64::NAN, |plant| plant.resistance());
    let colour = theme::tokens(ui).ruler;
    let optimum = best_reached(study).filter(|_| study.finished());
    let mut plot = plot_style::plot(ui, ("load", y.title()), &x, &y);
    if !view.design.logarithmic {
        plot = plot.include_y(0.0).include_y(1.1 * factor * highest);
    }
    let shown = plot.show(ui, |plot| {
        plot_style::rule(plot, true, "", x.coordinate(own), colour, Pen::Line(1.0));
        for (kind, name, line) in &drawn {
            plot_style::series(plot, *kind, name, line);
        }
        if let Some([resistance, power]) = optimum {
            let name = format!("{}: {}", with_unit(resistance, "Ω"), with_unit(power, "W"));
            plot_style::special_point(plot, &name, at(resistance, power));
        }
    });
    let clicked = shown.response.clicked().then(|| shown.response.interact_pointer_pos()).flatten();
    if let Some(position) = clicked {
        let (low, high) = study.question().range;
        use_load(context, x.value(shown.transform.value_from_position(position).x).clamp(low, high));
    }
}

/// The best load (ohm) with its power (W) among the motions reached.
pub(super) fn best_reached(study: &LoadStudy) -> Option<[f64; 2]> {
    let points = study.reached().iter().flatten().filter(|point| point.stable);
    points.map(|point| [point.resistance, point.power]).max_by(|a, b| a[1].total_cmp(&b[1]))
}

/// The cards beside the plot.
pub(super) fn cards(context: &mut Context<'_>, ui: &mut Ui) {
    Card::new(tr("Best load")).hugging().show(ui, |ui| brief(context, ui));
    ui.add_space(grid::GAP);
    Card::new(tr("Best load and frequency")).hugging().show(ui, |ui| both(context, ui));
    ui.add_space(grid::GAP);
    Card::new(tr("Limits")).hugging().show(ui, |ui| super::limits::controls(context, ui));
}

/// The best load in a few words, with a button to take it.
pub(super) fn brief(context: &mut Context<'_>, ui: &mut Ui) {
    let Some(study) = context.studies.bench.load.study() else { return };
    line(ui, &fill("without magnets: {what}", &[("what", &gives(study.linear_best()))]));
    match best_reached(study) {
        Some(best) if study.finished() => {
            line(ui, &fill("the motion reached: {what}", &[("what", &gives(best))]));
            if ui.button(fill("Use {load}", &[("load", &with_unit(best[0], "Ω"))])).clicked() {
                use_load(context, best[0]);
            }
        }
        _ => line(
            ui,
            &fill(
                "the motion reached: computing {percent} %",
                &[("percent", &format!("{:.0}", 100.0 * study.progress()))],
            ),
        ),
    }
}

fn gives([resistance, power]: [f64; 2]) -> String {
    fill("{load} gives {power}", &[("load", &with_unit(resistance, "Ω")), ("power", &with_unit(power, "W"))])
}

fn line(ui: &mut Ui, text: &str) {
    let colour = theme::tokens(ui).text;
    ui.add(egui::Label::new(RichText::new(text).small().color(colour)).wrap());
}

/// The best of all loads at the best of all frequencies.
fn both(context: &mut Context<'_>, ui: &mut Ui) {
    let best = best_frequencies(context);
    let unfinished = context.studies.bench.best.study().filter(|table| !table.finished());
    if let Some(table) = unfinished {
        line(ui, &computing(table.progress()));
    }
    let finished = unfinished.is_none();
    let place = |frequency: f64, resistance: f64, power: f64| {
        fill(
            "{what} at {hertz} Hz",
            &[("what", &gives([resistance, power])), ("hertz", &significant(frequency, 4))],
        )
    };
    let linear = best.iter().max_by(|a, b| a.linear[1].total_cmp(&b.linear[1]));
    if let Some(best) = linear {
        line(
            ui,
            &fill(
                "without magnets: {what}",
                &[("what", &place(best.linear[0], best.resistance, best.linear[1]))],
            ),
        );
    }
    let stable =
        best.iter().filter_map(|best| best.nonlinear.map(|[f, p]| (best.resistance, f, p, best.periods)));
    if let Some((resistance, frequency, power, periods)) = stable.max_by(|a, b| a.2.total_cmp(&b.2)) {
        let text = place(frequency, resistance, power);
        line(
            ui,
            &fill("stable motions: {text}, period {periods}", &[("text", &text), ("periods", &periods)]),
        );
        // Half of a search may be far from the best.
        if ui.add_enabled(finished, egui::Button::new(tr("Use both"))).clicked() {
            super::harvest::go_to(context, frequency);
            use_load(context, resistance);
        }
        line(ui, tr("A start at rest may lead to another motion."));
    }
    line(ui, tr("Within the window of frequencies of the page Harvest, at the base's present amplitude."));
}

/// Makes `resistance` (ohm) the load.
pub(super) fn use_load(context: &mut Context<'_>, resistance: f64) {
    let resistance = round_significant(resistance, 4);
    // After another wish of this frame, if there is one.
    let waiting = context.commands.iter().rev().find_map(|command| match command {
        crate::app::command::Command::Show(scenario) => Some((**scenario).clone()),
        _ => None,
    });
    let before = waiting.unwrap_or_else(|| context.view.scenario.clone());
    context.edit(|scenario| {
        *scenario = before;
        scenario.parameters.kappa = 1.0 / (scenario.units().power * resistance);
    });
}
