//! Power into a store behind a rectifier, over the voltage of the store, beside what the best load takes.

use egui::Ui;
use egui_plot::PlotPoint;

use super::Context;
use super::design::optimum::Optimum;
use super::spec::{Asking, Place, Spec};
use crate::app::bench::questions;
use crate::app::text::{marked, say, tr};
use crate::app::theme;
use crate::app::view::design::Page;
use crate::app::widgets::number::{prefix, with_unit};
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Series, legend};
use crate::questions::load::LoadStudy;
use crate::questions::rectifier::RectifierStudy;
use crate::scheduler::Study as _;

/// The curve.
pub(super) const PANEL: Spec = Spec::new(Place::Page(Page::Load), |_| tr("Into a store"), contents)
    .hint(|context| context.computing::<RectifierStudy>(tr("full-wave rectifier, store held at a voltage")))
    .asking(ask)
    .embedded("store", marked("Into a store"));

fn ask(Asking { view, studies, .. }: &mut Asking<'_>) {
    studies.load(view);
    studies.lanes.ask(questions::rectifier(view), |(scenario, rectifier)| {
        RectifierStudy::new(scenario, rectifier).ok()
    });
}

fn contents(context: &mut Context<'_>, ui: &mut Ui) {
    legend::legend(
        ui,
        &[
            (Series::Stable, tr("into the store")),
            (Series::Linear, tr("best load, without magnets")),
            (Series::Best, tr("best load, motion reached")),
        ],
    );
    match context.studies.lanes.study::<RectifierStudy>() {
        Some(study) if study.failure().is_none() && !nothing(study) => plot(context, ui, study),
        study => {
            let none = || tr("Nothing reaches the store.").to_owned();
            let why = study.and_then(RectifierStudy::failure).map_or_else(none, |failure| say(failure));
            plot_style::no_data(ui, ui.available_rect_before_wrap(), &why);
        }
    }
}

fn nothing(study: &RectifierStudy) -> bool {
    study.finished() && study.best().is_none()
}

fn plot(context: &mut Context<'_>, ui: &mut Ui, study: &RectifierStudy) {
    let loads = context.studies.lanes.study::<LoadStudy>();
    let linear = loads.map(|loads| loads.linear_best()[1]);
    let reached = loads.and_then(|loads| Optimum::of(loads, None)).map(|best| best.of_all.measures.power);
    let known = study.curve().filter(|point| point.delivered.is_some());
    let highest = known.clone().map(|point| point.power()).chain(linear).chain(reached).fold(0.0, f64::max);
    let (factor, sign) = prefix(highest);
    let x = Axis::new(tr("voltage of the store"), "V").unit("V");
    let y = Axis::new(tr("power into the store"), "P").unit(format!("{sign}W"));
    let curve: Vec<PlotPoint> =
        known.map(|point| PlotPoint::new(point.voltage, factor * point.power())).collect();
    let tokens = theme::tokens(ui);
    let plot = plot_style::plot(ui, ("store", y.title()), &x, &y);
    plot.include_x(0.0).include_y(0.0).include_y(1.1 * factor * highest).show(ui, |plot| {
        for (kind, name, power) in [
            (Series::Linear, tr("best load, without magnets"), linear),
            (Series::Best, tr("best load, motion reached"), reached),
        ] {
            if let Some(power) = power {
                plot_style::rule(plot, false, name, factor * power, kind.colour(tokens), kind.pen());
            }
        }
        plot_style::series(plot, Series::Stable, tr("into the store"), &curve);
        if let Some(best) = study.best() {
            let name = format!("{}: {}", with_unit(best.voltage, "V"), with_unit(best.power(), "W"));
            plot_style::special_point(plot, &name, PlotPoint::new(best.voltage, factor * best.power()));
        }
    });
}
