//! Curves of bifurcations of the forced motion in the plane of any two parameters, with the points where they meet.

use egui::Ui;
use egui_plot::{PlotBounds, PlotPoint};

use super::spec::{Asking, Place, Spec};
use super::{Context, facts};
use crate::app::command::Command;
use crate::app::text::{fill, marked, say, tr};
use crate::app::view::Tab;
use crate::app::widgets::number::round_significant;
use crate::app::widgets::plot_style;
use crate::app::widgets::{Series, chips_after, legend, row};
use crate::app::{colours, questions};
use crate::dynamics::Instability;
use crate::dynamics::bifurcations::curves::Criticality;
use crate::questions::curves::{CurvesStudy, PARAMETERS};
use crate::scheduler::{Asked as _, Study as _};

/// The curves.
pub(super) const PANEL: Spec = Spec::new(Place::Tab(Tab::Stability), |_| tr("Bifurcation curves"), contents)
    .hint(hint)
    .asking(ask)
    .embedded("curves", marked("Bifurcation curves"));

fn hint(context: &Context<'_>) -> String {
    match context.studies.lanes.study::<CurvesStudy>() {
        Some(study) if !study.finished() => {
            fill("tracing, {count} so far", &[("count", &study.curves().len())])
        }
        Some(study) if study.curves().is_empty() => tr("no bifurcations in this window").to_owned(),
        Some(study) if study.curves().len() == 1 => tr("1 curve").to_owned(),
        Some(study) => fill("{count} curves", &[("count", &study.curves().len())]),
        None => String::new(),
    }
}

fn ask(Asking { view, session, studies, .. }: &mut Asking<'_>) {
    if let Some(question) = questions::curves(view, session) {
        studies.lanes.ask(question, |(scenario, curves)| CurvesStudy::new(scenario, curves).ok());
    }
}

fn contents(context: &mut Context<'_>, ui: &mut Ui) {
    header(context, ui);
    plot(context, ui);
}

fn header(context: &mut Context<'_>, ui: &mut Ui) {
    let [mut x, mut y] = context.view.plane;
    let before = [x, y];
    let choices = PARAMETERS.map(|parameter| (parameter, parameter.fact().symbol));
    row(ui, |ui| {
        ui.spacing_mut().item_spacing.x = 6.0;
        chips_after(ui, tr("across"), tr("Horizontal parameter"), &mut x, &choices);
        chips_after(ui, tr("up"), tr("Vertical parameter"), &mut y, &choices);
    });
    if x == y {
        // The other axis takes what this one had.
        if x == before[0] { x = before[1] } else { y = before[0] }
    }
    if [x, y] != before {
        context.commands.push(Command::OpenPlane([x, y]));
    }
    legend::legend(
        ui,
        &[
            (Series::Exact, tr("period doubling")),
            (Series::Subcritical, &named(Instability::PeriodDoubling, Some(Criticality::Subcritical))),
            (Series::Torus, tr("Neimark–Sacker (torus)")),
            (Series::SubcriticalTorus, &named(Instability::NeimarkSacker, Some(Criticality::Subcritical))),
            (Series::Fold, tr("fold")),
        ],
    );
}

fn plot(context: &mut Context<'_>, ui: &mut Ui) {
    let Some(question) = questions::curves(context.view, context.session) else { return };
    let (x_side, y_side) = (question.1.x, question.1.y);
    let (x, y) = (facts::axis(x_side.parameter.fact()), facts::axis(y_side.parameter.fact()));
    let study = context.studies.lanes.study::<CurvesStudy>().filter(|study| study.asked().1 == question.1);
    let current = study.is_some_and(|study| *study.asked() == question);
    let curves = study.map_or(&[][..], |study| study.curves());
    let stretches = curves.iter().flat_map(|curve| {
        curve.stretches().into_iter().map(move |stretch| (curve.kind, stretch.criticality, stretch.places))
    });
    let lines: Vec<(Series, String, Vec<PlotPoint>)> = stretches
        .map(|(kind, criticality, places)| {
            let line = places.iter().map(|at| PlotPoint::new(at[0], at[1])).collect();
            (series(kind, criticality, current), named(kind, criticality), line)
        })
        .collect();
    let special: Vec<(String, PlotPoint)> = curves
        .iter()
        .flat_map(|curve| &curve.special)
        .map(|point| (say(&point.kind), PlotPoint::new(point.at[0], point.at[1])))
        .collect();
    let shown =
        plot_style::fixed(ui, ("curves", context.view.plane.map(|parameter| parameter as u8)), &x, &y).show(
            ui,
            |plot| {
                let (low, high) = ([x_side.from, y_side.from], [x_side.to, y_side.to]);
                plot.set_plot_bounds(PlotBounds::from_min_max(low, high));
                for (kind, name, line) in &lines {
                    plot_style::series(plot, *kind, name, line);
                }
                plot_style::special_points(plot, &special);
            },
        );
    let parameters = context.view.scenario.parameters;
    let here = [parameters.get(x_side.parameter), parameters.get(y_side.parameter)];
    let drag = plot_style::operating_point(ui, &shown, tr("Operating point in this plane"), here);
    if let Some(moved) = drag.moved {
        context.edit(|scenario| {
            for (side, value) in [x_side, y_side].iter().zip(moved) {
                let value = value.clamp(side.from, side.to);
                *scenario.parameters.get_mut(side.parameter) = round_significant(value, 5);
            }
        });
    }
}

/// The name of a bifurcation, with its criticality where it has one.
fn named(kind: Instability, criticality: Option<Criticality>) -> String {
    let kind = colours::name(kind);
    match criticality {
        None => kind.to_owned(),
        Some(Criticality::Supercritical) => fill("{kind}, supercritical", &[("kind", &kind)]),
        Some(Criticality::Subcritical) => fill("{kind}, subcritical", &[("kind", &kind)]),
    }
}

fn series(kind: Instability, criticality: Option<Criticality>, current: bool) -> Series {
    let subcritical = criticality == Some(Criticality::Subcritical);
    match kind {
        _ if !current => Series::Ghost,
        Instability::PeriodDoubling if subcritical => Series::Subcritical,
        Instability::PeriodDoubling => Series::Exact,
        Instability::NeimarkSacker if subcritical => Series::SubcriticalTorus,
        Instability::NeimarkSacker => Series::Torus,
        Instability::Fold => Series::Fold,
    }
}
