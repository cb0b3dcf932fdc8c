//! Response curves: what a sweep reached, over the periodic motions that there are, stable and unstable.

use egui::Ui;
use egui_plot::{PlotPoint, VLine};

use super::orbit_diagram::settled;
use super::spec::{Asking, Place, Spec};
use super::{Context, facts, orbit_diagram};
use crate::app::crew::Followed;
use crate::app::questions;
use crate::app::text::{fill, marked, say, tr};
use crate::app::theme;
use crate::app::view::{Output, Tab};
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Series, legend};
use crate::dynamics::attractors::sweep::SweepPoint;
use crate::dynamics::{Instability, Measures};
use crate::model::ReducedSystem;
use crate::questions::response::ResponseCurve;
use crate::questions::sweep::{Direction, SweepStudy};
use crate::scenario::Scenario;

/// The curves.
pub(super) const PANEL: Spec = Spec::new(Place::Tab(Tab::Sweep), |_| tr("Response curves"), curves)
    .hint(hint)
    .asking(ask)
    .embedded("response", marked("Response curves"));

fn hint(context: &Context<'_>) -> String {
    match context.studies.response() {
        Some(Followed { newest: true, .. }) => tr("solid: stable, dashed: unstable").to_owned(),
        _ => tr("following the branches").to_owned(),
    }
}

fn ask(asking: &mut Asking<'_>) {
    orbit_diagram::ask(asking);
    let (scenario, sweep) = questions::sweep(asking.view, asking.session);
    asking.studies.offer(sweep.response(&scenario));
}

/// What the vertical axis measures, from the numbers of a point.
struct Measure {
    output: Output,
    /// Microwatts of a dimensionless power of 1.
    microwatts: f64,
    gap: f64,
}

impl Measure {
    fn new(output: Output, scenario: &Scenario, system: &ReducedSystem) -> Self {
        Self { output, microwatts: microwatts(scenario), gap: system.equilibrium.gap }
    }

    fn axis(&self) -> Axis {
        match self.output {
            Output::Voltage => Axis::new(tr("voltage, rms"), "v").unit("V"),
            Output::Power => Axis::new(tr("power in the load"), "P").unit("µW"),
            Output::Tip => Axis::new(tr("tip over the gap"), "s/s₀"),
        }
    }

    /// One value, or two where there is a range.
    fn values(&self, measures: &Measures) -> Vec<f64> {
        match self.output {
            Output::Voltage => vec![measures.v_rms],
            Output::Power => vec![self.microwatts * measures.power],
            Output::Tip => vec![measures.tip.0 / self.gap, measures.tip.1 / self.gap],
        }
    }
}

/// Microwatts of a dimensionless power of 1 in `scenario`'s device: V^2 / R over kappa v^2, the same for every load.
pub(super) fn microwatts(scenario: &Scenario) -> f64 {
    1e6 * scenario.units().power
}

fn curves(context: &mut Context<'_>, ui: &mut Ui) {
    let Some(study) = context.studies.lanes.study::<SweepStudy>() else { return };
    let Some(shown) = context.shown() else { return };
    let measure = Measure::new(context.view.sweep.output, &shown.scenario, &shown.run.system);
    let mut entries = vec![
        (Series::Up, tr("upwards")),
        (Series::Down, tr("downwards")),
        (Series::Stable, tr("stable")),
        (Series::Unstable, tr("unstable")),
    ];
    if orbit_diagram::any_unsettled(study) {
        entries.push((Series::Unsettled, tr("not settled")));
    }
    legend::legend(ui, &entries);
    let swept = study.question().parameter;
    let found = context.studies.response().filter(|response| response.question.parameter == swept);
    let (branches, current): (&[ResponseCurve], bool) = match found {
        Some(Followed { curves: Ok(curves), newest, .. }) => (curves, newest),
        Some(Followed { curves: Err(failure), newest: true, .. }) => {
            ui.label(egui::RichText::new(say(failure)).small().color(theme::tokens(ui).warning));
            (&[], true)
        }
        _ => (&[], false),
    };
    super::say_cut(ui, branches.iter().any(|branch| branch.cut));
    let lines: Vec<(Series, String, Vec<PlotPoint>)> =
        branches.iter().flat_map(|curve| lines(curve, &measure)).collect();
    let marks: Vec<(String, PlotPoint)> = branches.iter().flat_map(|curve| marks(curve, &measure)).collect();
    let ways = [Direction::Up, Direction::Down].map(|direction| reached(study, direction, &measure, settled));
    let open = orbit_diagram::both(|direction| reached(study, direction, &measure, |point| !settled(point)));
    let (x, y) = (facts::axis(study.question().parameter.fact()), measure.axis());
    let range = study.question().range();
    let colour = theme::tokens(ui).ruler;
    let value = context.view.scenario.parameters.get(study.question().parameter);
    let id = ("response", study.question().parameter, context.view.sweep.output as u8);
    let response = plot_style::plot(ui, id, &x, &y)
        .include_x(range.0)
        .include_x(range.1)
        .include_y(0.0)
        .show(ui, |plot| {
            plot.vline(VLine::new("", value).color(colour).width(1.0).allow_hover(false));
            for (kind, name, line) in &lines {
                plot_style::series(plot, if current { *kind } else { Series::Ghost }, name, line);
            }
            plot_style::points(plot, Series::Down, tr("downwards"), &ways[1]);
            plot_style::points(plot, Series::Up, tr("upwards"), &ways[0]);
            plot_style::points(plot, Series::Unsettled, tr("not settled"), &open);
            plot_style::special_points(plot, &marks);
        });
    orbit_diagram::go_where_clicked(context, &response, study);
}

fn reached(
    study: &SweepStudy,
    direction: Direction,
    measure: &Measure,
    which: impl Fn(&SweepPoint) -> bool,
) -> Vec<PlotPoint> {
    let values = |point: &SweepPoint| {
        measure.values(&point.measures).into_iter().map(move |y| (point.value, y)).collect::<Vec<_>>()
    };
    let points = study.points(direction).iter().filter(|point| !point.ended && which(point));
    points.flat_map(values).map(|(x, y)| PlotPoint::new(x, y)).collect()
}

/// The stable and unstable stretches of a branch; neighbours share their border.
fn lines(curve: &ResponseCurve, measure: &Measure) -> Vec<(Series, String, Vec<PlotPoint>)> {
    let name = match curve.periods {
        1 => tr("forced motion").to_owned(),
        periods => fill("period {periods}", &[("periods", &periods)]),
    };
    let sides = curve.points.first().map_or(0, |point| measure.values(&point.measures).len());
    let mut lines = Vec::new();
    for side in 0..sides {
        let mut rest = curve.points.as_slice();
        while let Some(first) = rest.first() {
            let stable = first.multiplier < 1.0;
            let count = rest.iter().take_while(|point| (point.multiplier < 1.0) == stable).count();
            let reach = (count + 1).min(rest.len());
            let line = rest[..reach]
                .iter()
                .map(|point| PlotPoint::new(point.value, measure.values(&point.measures)[side]));
            let kind = if stable { Series::Stable } else { Series::Unstable };
            lines.push((kind, name.clone(), line.collect()));
            rest = &rest[count..];
        }
    }
    lines
}

/// Short names of the bifurcations, beside where they are.
fn marks(curve: &ResponseCurve, measure: &Measure) -> Vec<(String, PlotPoint)> {
    let name = |kind| match kind {
        Instability::Fold => tr("fold"),
        Instability::PeriodDoubling => tr("period doubling"),
        Instability::NeimarkSacker => tr("Neimark–Sacker (torus)"),
    };
    let place = |change: &crate::questions::response::Change| {
        let y = measure.values(&change.point.measures).first().copied().unwrap_or_default();
        (name(change.kind).to_owned(), PlotPoint::new(change.point.value, y))
    };
    curve.changes.iter().map(place).collect()
}
