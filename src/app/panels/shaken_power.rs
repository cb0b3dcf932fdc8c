//! The mean power so far while the base is shaken, with magnets and without.

use egui::Ui;
use egui_plot::PlotPoint;

use super::Context;
use super::design::shaking::{ask, found, waiting};
use super::spec::{Place, Spec};
use crate::app::text::tr;
use crate::app::view::design::Page;
use crate::app::widgets::number::prefix;
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Series, legend};
use crate::questions::shaken_run::Found;

/// The means.
pub(super) const PANEL: Spec =
    Spec::new(Place::Page(Page::Shake), |_| tr("Mean power so far"), plot).asking(ask);

/// Time (s) and mean power (W) up to it, of a run's parts.
fn so_far(run: &Found) -> Vec<[f64; 2]> {
    let (mut duration, mut energy) = (0.0, 0.0);
    let mut points = Vec::new();
    for (length, square, _) in run.parts.iter().filter(|part| part.0 > 0.0) {
        duration += length;
        energy += length * run.watts * square;
        points.push([duration, energy / duration]);
    }
    points
}

fn plot(context: &mut Context<'_>, ui: &mut Ui) {
    let runs = found(context).and_then(Result::ok).unwrap_or_default();
    if runs.is_empty() {
        return plot_style::no_data(ui, ui.available_rect_before_wrap(), &waiting(context));
    }
    let curves: Vec<(bool, Vec<[f64; 2]>)> = runs.iter().map(|run| (run.magnets, so_far(run))).collect();
    let highest = curves.iter().flat_map(|(_, curve)| curve).map(|point| point[1]).fold(0.0, f64::max);
    let (factor, sign) = prefix(highest);
    legend::legend(ui, &[(Series::Numeric, tr("the device")), (Series::Linear, tr("without magnets"))]);
    let (x, y) = (
        Axis::new(tr("time"), "t").unit("s"),
        Axis::new(tr("mean power so far"), "P").unit(format!("{sign}W")),
    );
    let drawn: Vec<(bool, Vec<PlotPoint>)> = curves
        .into_iter()
        .map(|(magnets, curve)| {
            (magnets, curve.into_iter().map(|[time, power]| PlotPoint::new(time, factor * power)).collect())
        })
        .collect();
    plot_style::plot(ui, ("power so far", sign), &x, &y).include_y(0.0).show(ui, |plot| {
        for (magnets, curve) in &drawn {
            let (kind, name) = if *magnets {
                (Series::Numeric, tr("the device"))
            } else {
                (Series::Linear, tr("without magnets"))
            };
            plot_style::series(plot, kind, name, curve);
        }
    });
}
