//! What the device delivers over frequency: linear, forced, from rest, and by sweeps up and down.

use egui::Ui;
use egui_plot::PlotPoint;

use super::Context;
use super::design::going::go_to;
use super::design::measure::{self, Measure, values};
use super::design::safety::{Safety, beyond};
use super::spec::{Place, Spec};
use crate::app::panels::say_cut;
use crate::app::text::{fill, marked, say, tr};
use crate::app::theme;
use crate::app::view::design::{Page, Watched};
use crate::app::widgets::plot_style;
use crate::app::widgets::{Series, legend};
use crate::export::Pen;
use crate::questions::design::HarvestPoint;
use crate::questions::harvest::HarvestStudy;
use crate::questions::sweep::Direction;

/// The curves.
pub(super) const PANEL: Spec = Spec::new(Place::Page(Page::Harvest), |_| tr("Over frequency"), contents)
    .hint(|context| context.computing::<HarvestStudy>(tr("click to go to a frequency")))
    .asking(|asking| asking.studies.harvest(asking.view, asking.session))
    .embedded("harvest", marked("Over frequency"));

fn contents(context: &mut Context<'_>, ui: &mut Ui) {
    header(context, ui);
    let failure = match context.studies.lanes.study::<HarvestStudy>() {
        Some(study) => match study.failure() {
            None => return plot(context, ui, study),
            Some(failure) => say(failure),
        },
        None => tr("There are no curves for this device: see the message above.").to_owned(),
    };
    plot_style::no_data(ui, ui.available_rect_before_wrap(), &failure);
}

fn header(context: &mut Context<'_>, ui: &mut Ui) {
    measure::choose(context, ui);
    legend::legend(
        ui,
        &[
            (Series::Linear, tr("without magnets")),
            (Series::Stable, tr("stable")),
            (Series::Unstable, tr("unstable")),
            (Series::FromRest, tr("from rest")),
            (Series::Up, tr("swept up")),
            (Series::Down, tr("swept down")),
            (Series::Beyond, tr("beyond a limit")),
        ],
    );
}

/// Everything that is drawn: its kind, its name, its points.
fn curves(study: &HarvestStudy) -> Vec<(Series, String, Vec<HarvestPoint>)> {
    let mut curves = vec![(Series::Linear, tr("without magnets").to_owned(), study.linear_points())];
    for branch in study.branches().and_then(Result::ok).unwrap_or_default() {
        let name = match branch.periods {
            1 => tr("forced motion").to_owned(),
            periods => fill("period {periods}", &[("periods", &periods)]),
        };
        let points = study.branch_points(branch);
        let mut rest = points.as_slice();
        while let Some((_, stable)) = rest.first() {
            let count = rest.iter().take_while(|(_, other)| other == stable).count();
            // Neighbours share their border.
            let run = rest[..(count + 1).min(rest.len())].iter().map(|(point, _)| *point).collect();
            curves.push((if *stable { Series::Stable } else { Series::Unstable }, name.clone(), run));
            rest = &rest[count..];
        }
    }
    let from_rest = study.from_rest().iter().filter_map(|start| start.flatten()).map(|(_, point)| point);
    curves.push((Series::FromRest, tr("from rest").to_owned(), from_rest.collect()));
    curves.push((Series::Down, tr("swept down").to_owned(), study.swept_pieces(Direction::Down).concat()));
    curves.push((Series::Up, tr("swept up").to_owned(), study.swept_pieces(Direction::Up).concat()));
    curves
}

fn plot(context: &mut Context<'_>, ui: &mut Ui, study: &HarvestStudy) {
    let branches = study.branches().and_then(Result::ok).unwrap_or_default();
    say_cut(ui, branches.iter().any(|branch| branch.cut));
    let view = context.view;
    let watched = view.design.watched;
    let curves = curves(study);
    let all = || curves.iter().flat_map(|(_, _, points)| points);
    let highest = all().map(|point| values(watched, point)[1].abs()).fold(0.0, f64::max);
    let measure = Measure::new(&view.design, highest);
    let safety = Safety::of(view, context.session);
    let place = |side: usize| {
        let measure = &measure;
        move |point: &HarvestPoint| measure.place(point.frequency, measure.values(point)[side])
    };
    let sides = if watched == Watched::Tip { 2 } else { 1 };
    let mut drawn: Vec<(Series, &str, Vec<PlotPoint>)> = Vec::new();
    for side in 0..sides {
        for (kind, name, points) in &curves {
            drawn.push((*kind, name, measure.line(points, side)));
            if *kind != Series::Unstable {
                // The linear device has no magnets to touch.
                let bounds = match (&safety, kind) {
                    (Some(Safety(bounds)), Series::Linear) => Some(bounds.without_magnets()),
                    (safety, _) => safety.as_ref().map(|safety| safety.0),
                };
                let over = beyond(bounds, points, &|point: &HarvestPoint| point.measures, &place(side));
                drawn.push((Series::Beyond, tr("beyond a limit"), over));
            }
        }
    }
    let measured = super::measured::over_frequency(context, watched, &measure);
    let x = measure.frequency();
    let units = view.scenario.units();
    let (low, high) = study.window();
    let (left, right) = (x.coordinate(low), x.coordinate(high));
    let here = x.coordinate(units.hertz(view.scenario.parameters.omega));
    let colour = theme::tokens(ui).ruler;
    let id = ("harvest", watched as u8, measure.axis().title(), x.is_logarithmic());
    let mut plot = plot_style::plot(ui, id, x, measure.axis()).include_x(left).include_x(right);
    if watched != Watched::Tip && !view.design.logarithmic {
        plot = plot.include_y(0.0);
    }
    let shown = plot.show(ui, |plot| {
        plot_style::rule(plot, true, "", here, colour, Pen::Line(1.0));
        for (kind, name, line) in &drawn {
            plot_style::series(plot, *kind, name, line);
        }
        plot_style::points(plot, Series::Measured, tr("measured"), &measured);
        match (&safety, watched) {
            (Some(safety), Watched::Peak) => {
                safety.voltage_lines(plot, left, &|volts| measure.coordinate(volts))
            }
            (Some(safety), Watched::Tip) => safety.tip_lines(plot, left),
            (_, Watched::Power) => super::design::bands::least_line(plot, view, study, &measure),
            _ => {}
        }
    });
    if let Some(at) = context.clicked(&shown) {
        let frequency = x.value(shown.transform.value_from_position(at).x);
        go_to(context, frequency.max(low).min(high));
    }
}
