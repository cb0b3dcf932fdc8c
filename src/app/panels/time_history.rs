//! Voltage over time: the whole run, and its end from near.

use egui::{Rect, Ui, UiBuilder, vec2};
use egui_plot::PlotPoint;

use super::Context;
use super::spec::{Place, Spec};
use crate::app::session::Shown;
use crate::app::text::{marked, tr};
use crate::app::theme;
use crate::app::view::{Panel, Tab};
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Series, recorder};
use crate::dynamics::Outcome;

/// Periods in view below which the curve itself is drawn instead of its envelope.
const DENSE_PERIODS: f64 = 90.0;
const DENSE_POINTS: usize = 1600;
/// Share of the card's width and height that the close view takes.
const INSET: egui::Vec2 = vec2(0.46, 0.32);
/// The same when the card fills the page.
const INSET_LARGE: egui::Vec2 = vec2(0.42, 0.3);
/// Height of the card's inside below which there is no room for the close view.
const INSET_FROM: f32 = 190.0;

/// The history.
pub(super) const PANEL: Spec = Spec::new(Place::Tab(Tab::Explore), |_| tr("Time history"), contents)
    .hint(|_| tr("Ctrl + wheel or pinch zooms").to_owned())
    .embedded("time", marked("Time history"));

fn contents(context: &mut Context<'_>, ui: &mut Ui) {
    let Some(shown) = context.shown() else { return };
    let area = ui.available_rect_before_wrap();
    let inset = area.height() >= INSET_FROM && shown.run.outcome() == Outcome::Completed;
    let large = context.view.enlarged == Some(Panel::TimeHistory);
    let share = if large { INSET_LARGE } else { INSET };
    let taken = if inset { f64::from(share.y) + 0.06 } else { 0.05 };
    whole(context, ui, shown, taken);
    if inset {
        let size = area.size() * share;
        let corner = egui::pos2(area.right() - size.x - 4.0, area.top() + 2.0);
        close_view(ui, Rect::from_min_size(corner, size), shown);
    }
}

/// The whole run; the share `taken` of the plot's height is kept free at the top for the close view.
fn whole(context: &Context<'_>, ui: &mut Ui, shown: &Shown, taken: f64) {
    let (x, y) = (Axis::new(tr("time"), "t"), Axis::new(tr("voltage"), "v").unit("V"));
    let [times, low, high] = &shown.curves.envelope;
    let top = high.iter().copied().fold(0.0, f64::max);
    let bottom = low.iter().copied().fold(0.0, f64::min);
    let end = shown.curves.end;
    let id = ui.make_persistent_id("time history bounds");
    let seen: Option<[f64; 2]> = ui.data(|data| data.get_temp(id));
    let [from, to] = seen.unwrap_or([0.0, end]);
    let dense = dense_curve(shown, from, to);
    let response = plot_style::plot(ui, ("time history", taken.to_bits()), &x, &y)
        .allow_zoom([true, false])
        .allow_drag([true, false])
        .include_x(0.0)
        .include_x(end)
        .include_y(1.05 * bottom)
        .include_y(top + taken / (1.0 - taken) * (top - bottom))
        .show(ui, |plot| {
            if let Some(pinned) = &context.session.pinned {
                let [times, low, high] = &pinned.curves.envelope;
                plot_style::envelope(plot, Series::Ghost, tr("pinned"), times, low, high);
            }
            if dense.is_empty() {
                plot_style::envelope(plot, Series::Numeric, tr("voltage"), times, low, high);
            } else {
                plot_style::series(plot, Series::Numeric, tr("voltage"), &dense);
            }
        });
    let room = 0.06 * (top - bottom);
    recorder::show_upwards(ui.ctx(), bottom - room, top + room);
    let bounds = response.transform.bounds();
    ui.data_mut(|data| data.insert_temp(id, [bounds.min()[0], bounds.max()[0]]));
}

/// The voltage itself when few enough periods are in view.
fn dense_curve(shown: &Shown, from: f64, to: f64) -> Vec<PlotPoint> {
    let run = &shown.run;
    let (from, to) = (from.max(0.0), to.min(shown.curves.end));
    if !(to > from) || to - from > DENSE_PERIODS * run.system.parameters.period() {
        return Vec::new();
    }
    let voltage = run.system.dimension() - 1;
    let mut curve = Vec::with_capacity(DENSE_POINTS);
    run.trajectory
        .sample(from, to, DENSE_POINTS, |time, state| curve.push(PlotPoint::new(time, state[voltage])));
    curve
}

/// The last periods, with the theory's dots, in a corner.
fn close_view(ui: &mut Ui, rect: Rect, shown: &Shown) {
    let tokens = theme::tokens(ui);
    ui.painter().rect(rect, theme::radius::CONTROL, tokens.inset, tokens.edge(), egui::StrokeKind::Inside);
    let mut inner =
        ui.new_child(UiBuilder::new().max_rect(rect.shrink2(vec2(6.0, 4.0))).id_salt("close view"));
    let (x, y) = (Axis::new("", ""), Axis::new("", ""));
    plot_style::fixed(&inner, "close view", &x, &y).show(&mut inner, |plot| {
        plot_style::series(plot, Series::Numeric, tr("voltage"), &shown.curves.close);
        plot_style::points(plot, Series::Theory, tr("first-order theory"), &shown.curves.theory_close);
    });
}
