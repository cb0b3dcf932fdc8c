//! Power against the load: over six decades at the frequency in view, and at the best frequency of each load.

use egui::{RichText, Ui};
use egui_plot::PlotPoint;

use super::Context;
use super::design::going::use_load;
use super::design::optimum::Optimum;
use super::design::safety::{Safety, beyond};
use super::spec::{Asking, Place, Spec};
use crate::app::bench::questions;
use crate::app::text::{fill, marked, say, tr};
use crate::app::theme;
use crate::app::view::design::Page;
use crate::app::widgets::number::{prefix, significant, with_unit};
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Series, chips, legend, row};
use crate::export::Pen;
use crate::questions::design::Plant;
use crate::questions::design::load::{BestFrequency, LoadPoint};
use crate::questions::design::peak::Peak;
use crate::questions::load::{BestAt, LoadStudy};
use crate::scheduler::{Study as _, Table};

/// The curves.
pub(super) const PANEL: Spec = Spec::new(Place::Page(Page::Load), |_| tr("Over the load"), contents)
    .hint(|context| context.computing::<LoadStudy>(tr("click to take a load")))
    .asking(ask)
    .embedded("load", marked("Over the load"));

fn ask(Asking { view, session, studies, .. }: &mut Asking<'_>) {
    studies.load(view);
    if let Some(loads) = studies.lanes.study() {
        studies.tabulate(questions::best_frequencies(view, session, loads));
    }
}

fn contents(context: &mut Context<'_>, ui: &mut Ui) {
    header(context, ui);
    match context.studies.lanes.study::<LoadStudy>() {
        Some(study) if study.failure().is_none() => plot(context, ui, study),
        study => {
            let none = || tr("There is no curve for this device.").to_owned();
            let why = study.and_then(LoadStudy::failure).map_or_else(none, |failure| say(failure));
            plot_style::no_data(ui, ui.available_rect_before_wrap(), &why);
        }
    }
}

fn header(context: &mut Context<'_>, ui: &mut Ui) {
    let mut logarithmic = context.view.design.logarithmic;
    row(ui, |ui| {
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
pub(super) fn best_frequencies<'a>(context: &Context<'a>) -> Vec<&'a BestFrequency> {
    let table = context.studies.lanes.study::<Table<BestAt>>();
    table.into_iter().flat_map(Table::found).filter_map(|found| found?.ok()).collect()
}

fn plot(context: &mut Context<'_>, ui: &mut Ui, study: &LoadStudy) {
    let view = context.view;
    let best = best_frequencies(context);
    let forced: Vec<LoadPoint> = study.forced().unwrap_or_default().iter().flatten().copied().collect();
    let reached: Vec<LoadPoint> = study.reached().iter().flatten().filter(|p| p.stable).copied().collect();
    let highest = forced
        .iter()
        .chain(&reached)
        .map(|point| point.measures.power)
        .fold(study.linear_best()[1], f64::max);
    let highest =
        best.iter().filter_map(|best| best.stable).map(|peak| peak.measures.power).fold(highest, f64::max);
    let (factor, sign) = prefix(highest);
    let y = Axis::new(tr("power in the load"), "P").unit(format!("{sign}W"));
    let y = if view.design.logarithmic { y.logarithmic() } else { y };
    let x = Axis::new(tr("load"), "R").unit("Ω").logarithmic();
    let at =
        |resistance: f64, power: f64| PlotPoint::new(x.coordinate(resistance), y.coordinate(factor * power));
    let place = |point: &LoadPoint| at(point.resistance, point.measures.power);
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
    let stable: Vec<(f64, Peak)> =
        best.iter().filter_map(|best| best.stable.map(|peak| (best.resistance, peak))).collect();
    let crest = |(resistance, peak): &(f64, Peak)| at(*resistance, peak.measures.power);
    drawn.push((Series::Best, tr("stable motions, best frequency"), stable.iter().map(crest).collect()));
    drawn.push((Series::Up, tr("reached"), reached.iter().map(place).collect()));
    let bounds = Safety::of(view, context.session).map(|safety| safety.0);
    let over = beyond(bounds, &reached, &|point: &LoadPoint| point.measures, &place);
    drawn.push((Series::Beyond, tr("beyond a limit"), over));
    let over = beyond(bounds, &stable, &|(_, peak)| peak.measures, &crest);
    drawn.push((Series::Beyond, tr("beyond a limit"), over));
    let own = Plant::new(&view.scenario).map_or(f64::NAN, |plant| plant.resistance());
    let colour = theme::tokens(ui).ruler;
    let optimum = Optimum::of(study, bounds).filter(|_| study.finished()).map(|best| best.to_use());
    let mut plot = plot_style::plot(ui, ("load", y.title()), &x, &y);
    if !view.design.logarithmic {
        plot = plot.include_y(0.0).include_y(1.1 * factor * highest);
    }
    let shown = plot.show(ui, |plot| {
        plot_style::rule(plot, true, "", x.coordinate(own), colour, Pen::Line(1.0));
        for (kind, name, line) in &drawn {
            plot_style::series(plot, *kind, name, line);
        }
        if let Some(optimum) = optimum {
            let name =
                format!("{}: {}", with_unit(optimum.resistance, "Ω"), with_unit(optimum.measures.power, "W"));
            plot_style::special_point(plot, &name, place(&optimum));
        }
    });
    if let Some(position) = context.clicked(&shown) {
        let (low, high) = (study.resistances()[0], study.resistances()[study.resistances().len() - 1]);
        use_load(context, x.value(shown.transform.value_from_position(position).x).clamp(low, high));
    }
}
