//! Stroboscopic points along a sweep, up and down.

use egui::{RichText, Ui};
use egui_plot::{PlotPoint, VLine};

use super::spec::{Asking, Place, Spec};
use super::{Context, facts};
use crate::app::questions;
use crate::app::text::{fill, marked, say, tr};
use crate::app::theme;
use crate::app::view::Tab;
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Series, legend, row};
use crate::dynamics::Motion;
use crate::dynamics::attractors::sweep::SweepPoint;
use crate::questions::sweep::{Direction, SweepStudy};

/// The diagram.
pub(super) const PANEL: Spec = Spec::new(Place::Tab(Tab::Sweep), |_| tr("Orbit diagram"), diagram)
    .hint(|context| context.computing::<SweepStudy>(tr("click to go there")))
    .asking(ask)
    .embedded("orbit", marked("Orbit diagram"));

/// Asks for the sweep in view.
pub(super) fn ask(Asking { view, session, studies, .. }: &mut Asking<'_>) {
    studies.lanes.ask(questions::sweep(view, session), |(scenario, sweep)| {
        Some(SweepStudy::new(scenario, sweep, &[Direction::Up, Direction::Down]))
    });
}

fn diagram(context: &mut Context<'_>, ui: &mut Ui) {
    let Some(study) = context.studies.lanes.study::<SweepStudy>() else { return };
    row(ui, |ui| {
        ui.spacing_mut().item_spacing.x = 14.0;
        legend::legend_entry(ui, Series::Up, tr("upwards"));
        legend::legend_entry(ui, Series::Down, tr("downwards"));
        if any_unsettled(study) {
            legend::legend_entry(ui, Series::Unsettled, tr("not settled"));
        }
        ui.label(RichText::new(said(study)).small().color(theme::tokens(ui).text_weak));
    });
    if let Some(failure) = study.failure() {
        let rect = ui.available_rect_before_wrap();
        plot_style::no_data(ui, rect, &say(failure));
        return;
    }
    let ways = [Direction::Up, Direction::Down].map(|direction| strobe(study, direction, settled));
    let open = both(|direction| strobe(study, direction, |point| !settled(point)));
    let x = facts::axis(study.question().parameter.fact());
    let y = Axis::new(tr("voltage at t = 2πk/ω"), "v").unit("V");
    let range = study.question().range();
    let colour = theme::tokens(ui).ruler;
    let value = context.view.scenario.parameters.get(study.question().parameter);
    let response = plot_style::plot(ui, ("orbit diagram", study.question().parameter), &x, &y)
        .include_x(range.0)
        .include_x(range.1)
        .show(ui, |plot| {
            plot.vline(VLine::new("", value).color(colour).width(1.0).allow_hover(false));
            plot_style::points(plot, Series::Down, tr("downwards"), &ways[1]);
            plot_style::points(plot, Series::Up, tr("upwards"), &ways[0]);
            plot_style::points(plot, Series::Unsettled, tr("not settled"), &open);
        });
    go_where_clicked(context, &response, study);
}

/// What is carried over and thrown away, in a few words.
fn said(study: &SweepStudy) -> String {
    let dwell = study.question().dwell();
    let restarts = [Direction::Up, Direction::Down]
        .iter()
        .flat_map(|direction| study.points(*direction).iter().skip(1))
        .filter(|point| point.restarted)
        .count();
    let mut text = fill(
        "state carried from value to value; {dropped} periods dropped or more, until settled; {kept} kept",
        &[("dropped", &dwell.discarded), ("kept", &dwell.kept)],
    );
    if restarts > 0 {
        text += &fill("; {restarts} restarted after an escape or contact", &[("restarts", &restarts)]);
    }
    text
}

/// Whether the motion there is known.
pub(super) fn settled(point: &SweepPoint) -> bool {
    !matches!(point.motion, Motion::Undecided { .. })
}

/// Whether one is not.
pub(super) fn any_unsettled(study: &SweepStudy) -> bool {
    both(|direction| study.points(direction).to_vec()).iter().any(|point| !settled(point))
}

/// What there is of the ways up and down together.
pub(super) fn both<T>(of: impl Fn(Direction) -> Vec<T>) -> Vec<T> {
    [of(Direction::Up), of(Direction::Down)].into_iter().flatten().collect()
}

fn strobe(study: &SweepStudy, direction: Direction, which: impl Fn(&SweepPoint) -> bool) -> Vec<PlotPoint> {
    let points = study.points(direction).iter().filter(|point| which(point));
    points.flat_map(|point| point.strobe.iter().map(|v| PlotPoint::new(point.value, *v))).collect()
}

/// A click sets the swept parameter to the value clicked at.
pub(super) fn go_where_clicked<R>(
    context: &mut Context<'_>,
    plot: &egui_plot::PlotResponse<R>,
    study: &SweepStudy,
) {
    let Some(at) = context.clicked(plot) else { return };
    let (low, high) = study.question().range();
    let value = plot.transform.value_from_position(at).x.clamp(low, high);
    let parameter = study.question().parameter;
    context.edit(|scenario| {
        *scenario.parameters.get_mut(parameter) = crate::app::widgets::number::round_significant(value, 5);
    });
}
