//! The powers that devices give whose dimensions scatter, as the share of them that give less.

use egui::Ui;
use egui_plot::PlotPoint;

use super::Context;
use super::spec::{Asking, Place, Spec};
use crate::app::bench::questions;
use crate::app::text::{say, tr};
use crate::app::theme;
use crate::app::view::design::Page;
use crate::app::widgets::number::prefix;
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Series, legend};
use crate::questions::tolerances::ToleranceStudy;

/// The curve.
pub(super) const PANEL: Spec =
    Spec::new(Place::Page(Page::Tolerances), |_| tr("Power of many devices"), contents)
        .hint(|context| context.computing::<ToleranceStudy>(tr("dimensions scatter as chosen")))
        .asking(ask);

fn ask(Asking { view, studies, .. }: &mut Asking<'_>) {
    studies
        .lanes
        .ask(questions::tolerances(view), |(scenario, asked)| ToleranceStudy::new(scenario, asked).ok());
}

fn contents(context: &mut Context<'_>, ui: &mut Ui) {
    legend::legend(ui, &[(Series::Numeric, tr("share that gives less")), (Series::Linear, tr("as meant"))]);
    let study = context.studies.lanes.study::<ToleranceStudy>();
    let powers = study.map(ToleranceStudy::powers).unwrap_or_default();
    let (Some(study), Some(highest)) = (study, powers.last()) else {
        let failure = study.and_then(ToleranceStudy::failure);
        let why = failure.map_or_else(|| tr("No motion lasts yet.").to_owned(), |failure| say(failure));
        return plot_style::no_data(ui, ui.available_rect_before_wrap(), &why);
    };
    let (factor, sign) = prefix(*highest);
    let x = Axis::new(tr("mean power"), "P").unit(format!("{sign}W"));
    let y = Axis::new(tr("share that gives less"), "").unit("%");
    // A staircase: each device is a step.
    let step = 100.0 / powers.len() as f64;
    let stairs = powers
        .iter()
        .enumerate()
        .flat_map(|(i, power)| [i, i + 1].map(|count| PlotPoint::new(factor * power, step * count as f64)));
    let stairs: Vec<PlotPoint> = stairs.collect();
    let meant = study.nominal().and_then(|nominal| nominal.power);
    let colour = Series::Linear.colour(theme::tokens(ui));
    plot_style::plot(ui, ("tolerances", y.title()), &x, &y).include_y(0.0).include_y(100.0).show(
        ui,
        |plot| {
            if let Some(power) = meant {
                plot_style::rule(plot, true, tr("as meant"), factor * power, colour, Series::Linear.pen());
            }
            plot_style::series(plot, Series::Numeric, tr("share that gives less"), &stairs);
        },
    );
}
