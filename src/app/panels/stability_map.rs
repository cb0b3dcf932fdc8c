//! The (omega, beta) plane with the boundaries of both theories and the operating point to drag.

use egui::Ui;
use egui_plot::{PlotBounds, PlotPoint, PlotResponse};

use super::Context;
use super::spec::{Place, Spec};
use crate::app::command::Command;
use crate::app::map::{Boundaries, HALF_WIDTH, Tongue};
use crate::app::text::{marked, tr};
use crate::app::view::{MapWindow, Tab, View};
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Series, chips, legend, row};
use crate::model::Parameter;
use crate::questions::tongues::Traced;
use crate::theory::Resonance;

/// Room that a region's name keeps from its border, points.
const MARGIN: f64 = 8.0;
/// Room that the legend needs to stand beside the choice.
const LEGEND: f32 = 300.0;

/// The map.
pub(super) const PANEL: Spec = Spec::new(Place::Tab(Tab::Explore), title, contents)
    .hint(|_| tr("drag or click to move").to_owned())
    .embedded("map", marked("Stability map"));

fn title(view: &View) -> &'static str {
    match view.map.resonance() {
        None => tr("Stability map"),
        Some(Resonance::First) => tr("Stability near 2ω₁"),
        Some(Resonance::Sum) => tr("Stability near ω₁+ω₂"),
        Some(Resonance::Second) => tr("Stability near 2ω₂"),
    }
}

fn contents(context: &mut Context<'_>, ui: &mut Ui) {
    let Some(boundaries) = &context.session.boundaries else { return };
    if boundaries.tongues.is_empty() {
        let rect = ui.available_rect_before_wrap();
        plot_style::no_data(ui, rect, tr("The resonances of the paper need at least two modes."));
        return;
    }
    header(context, ui);
    map(context, ui, boundaries);
}

fn header(context: &mut Context<'_>, ui: &mut Ui) {
    row(ui, |ui| {
        ui.spacing_mut().item_spacing = egui::vec2(6.0, 2.0);
        choose_window(context, ui);
        if ui.available_size_before_wrap().x < LEGEND {
            ui.end_row();
        }
        boundaries_legend(ui);
    });
}

/// The three theories' lines.
pub(super) fn boundaries_legend(ui: &mut Ui) {
    legend::legend(
        ui,
        &[
            (Series::Published, tr("published")),
            (Series::Coupled, tr("coupled modes")),
            (Series::Exact, tr("Floquet, this force law")),
        ],
    );
}

/// The choice of the resonance to look at.
pub(super) fn choose_window(context: &mut Context<'_>, ui: &mut Ui) {
    let mut window = context.view.map;
    let windows = [
        (MapWindow::All, tr("all")),
        (MapWindow::First, "2ω₁"),
        (MapWindow::Sum, "ω₁+ω₂"),
        (MapWindow::Second, "2ω₂"),
    ];
    if chips(ui, tr("Resonance"), &mut window, &windows) {
        context.commands.push(Command::LookAt(window));
    }
}

fn map(context: &mut Context<'_>, ui: &mut Ui, boundaries: &Boundaries) {
    let p = context.view.scenario.parameters;
    let window = context.view.map;
    let (low, high) = boundaries.range(window);
    let ceiling = boundaries.ceiling(window, p.beta);
    let (x, y) = (Axis::new(tr("excitation frequency"), "ω"), Axis::new(tr("excitation amplitude"), "β"));
    let plot = plot_style::fixed(ui, ("stability map", window), &x, &y);
    let pinned = context.session.pinned.as_ref().map(|pinned| {
        let p = &pinned.scenario.parameters;
        PlotPoint::new(p.omega, p.beta)
    });
    let (exact, current) = exact_borders(context, boundaries);
    let shown = plot.show(ui, |plot| {
        plot.set_plot_bounds(PlotBounds::from_min_max([low, -0.02 * ceiling], [high, ceiling]));
        for (border, tongue) in exact.iter().zip(&boundaries.tongues) {
            if current && !border.is_empty() {
                // Where a border turns back there is an end of the tongue above it, too.
                if border.is_sorted_by(|a, b| !(a.x > b.x)) || border.is_sorted_by(|a, b| !(a.x < b.x)) {
                    plot_style::area_above(plot, Series::Exact, border, ceiling);
                }
            } else {
                plot_style::area_above(plot, Series::Coupled, &tongue.coupled, ceiling);
            }
        }
        for tongue in &boundaries.tongues {
            plot_style::series(plot, Series::Published, tr("published boundary"), &tongue.published);
            plot_style::series(plot, Series::Coupled, tr("coupled-mode boundary"), &tongue.coupled);
        }
        let kind = if current { Series::Exact } else { Series::Ghost };
        for border in &exact {
            plot_style::series(plot, kind, tr("Floquet boundary"), border);
        }
        let region = if current { Series::Exact } else { Series::Coupled };
        label_regions(plot, boundaries, window, ceiling, region);
        plot_style::points(plot, Series::Ghost, tr("pinned"), pinned.as_slice());
    });
    let seen =
        |curve: &[PlotPoint]| curve.iter().any(|point| (low..=high).contains(&point.x) && point.y <= ceiling);
    let theories = |tongue: &Tongue| seen(&tongue.published) || seen(&tongue.coupled);
    if boundaries.gap.is_none() {
        let text = tr("Without magnets the device is linear: it follows the shaking everywhere.");
        plot_style::no_data(ui, shown.response.rect, text);
    } else if !exact.iter().any(|border| seen(border)) && !boundaries.tongues.iter().any(theories) {
        plot_style::no_data(ui, shown.response.rect, tr("No boundary is this low here."));
    }
    drag_point(context, ui, &shown, (low, high), ceiling);
}

/// Lets the operating point be dragged over a plot of the (omega, beta) plane that was just shown.
pub(super) fn drag_point<R>(
    context: &mut Context<'_>,
    ui: &Ui,
    shown: &PlotResponse<R>,
    (low, high): (f64, f64),
    ceiling: f64,
) {
    let p = context.view.scenario.parameters;
    let drag = plot_style::operating_point(ui, shown, tr("Operating point"), [p.omega, p.beta]);
    if let Some([omega, beta]) = drag.moved {
        let (least, most) = Parameter::Omega.range();
        context.edit(|scenario| {
            scenario.parameters.omega = round(omega.clamp(least.max(low), most.min(high)), 5);
            scenario.parameters.beta = round(beta.clamp(0.0, ceiling), 4);
        });
    }
}

/// The exact tongues' borders in the order of the boundaries' tongues, and whether they belong to the device in view.
pub(super) fn exact_borders(context: &Context<'_>, boundaries: &Boundaries) -> (Vec<Vec<PlotPoint>>, bool) {
    let found = context.studies.tongues(&boundaries.structure);
    let border = |resonance| match found.map(|(study, _)| study.tongue(resonance)) {
        Some(Traced::Done(Some(tongue))) => {
            tongue.points.iter().map(|point| PlotPoint::new(point.omega, point.beta)).collect()
        }
        _ => Vec::new(),
    };
    let borders = boundaries.tongues.iter().map(|tongue| border(tongue.resonance)).collect();
    (borders, found.is_some_and(|(_, current)| current))
}

/// Names of the regions where there is room for them: in the region, or to its right where it is narrower than its name.
fn label_regions(
    plot: &mut egui_plot::PlotUi<'_>,
    boundaries: &Boundaries,
    window: MapWindow,
    ceiling: f64,
    kind: Series,
) {
    let name = |resonance| match resonance {
        Resonance::Sum => tr("combination"),
        Resonance::First | Resonance::Second => tr("period doubling"),
    };
    let mut taken = Vec::new();
    for tongue in &boundaries.tongues {
        let lowest =
            tongue.coupled.iter().filter(|point| point.y.is_finite()).min_by(|a, b| a.y.total_cmp(&b.y));
        let Some(tip) = lowest.filter(|tip| tip.y < 0.8 * ceiling) else { continue };
        if window == MapWindow::All || window.resonance() == Some(tongue.resonance) {
            let height = tip.y + 0.82 * (ceiling - tip.y);
            let name = name(tongue.resonance);
            let inside = |point: &&PlotPoint| (point.x - tip.x).abs() <= HALF_WIDTH && point.y <= height;
            let within = tongue.coupled.iter().filter(inside).map(|point| point.x);
            let (left, right) =
                within.fold((tip.x, tip.x), |(left, right), x: f64| (left.min(x), right.max(x)));
            let per_point = plot.transform().dvalue_dpos()[0];
            let width = per_point * f64::from(plot_style::label_size(plot, name).x);
            let fits = right - left > width + MARGIN * per_point;
            let x = if fits { tip.x } else { right + 0.5 * width + MARGIN * per_point };
            let place = [x, height];
            if plot_style::has_room(plot, name, place, &mut taken) {
                plot_style::labelled_place(plot, name, place, kind);
            }
        }
    }
}

/// Rounds to significant digits, so that a dragged number stays short.
fn round(value: f64, digits: usize) -> f64 {
    crate::app::widgets::number::round_significant(value, digits)
}
