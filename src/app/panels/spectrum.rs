//! The spectrum of the voltage, its lines named.

use egui::Ui;
use egui_plot::PlotPoint;

use super::Context;
use super::spec::{Place, Spec};
use crate::app::text::{marked, tr};
use crate::app::view::Tab;
use crate::app::widgets::plot_style::{self, Axis, to_log};
use crate::app::widgets::{Series, legend};

/// Lines that are named, and decades that are shown below the highest.
const NAMED: usize = 7;
const DECADES: f64 = 5.0;
/// Names keep this distance from each other, as fractions of the width shown.
const APART: f64 = 0.06;

/// The spectrum.
pub(super) const PANEL: Spec = Spec::new(Place::Tab(Tab::Stability), |_| tr("Spectrum"), plot)
    .hint(|_| tr("of the motion reached").to_owned())
    .embedded("spectrum", marked("Spectrum"));

fn plot(context: &mut Context<'_>, ui: &mut Ui) {
    let Some((found, current)) = context.studies.inspection(&context.view.scenario) else { return };
    if found.spectrum.is_empty() || found.verdict.peaks.is_empty() {
        let rect = ui.available_rect_before_wrap();
        plot_style::no_data(ui, rect, tr("The motion ends, or there is no voltage: no spectrum."));
        return;
    }
    if !current {
        ui.multiply_opacity(0.55);
    }
    legend::legend(ui, &[(Series::Numeric, tr("amplitude of v"))]);
    let highest = found.spectrum.iter().map(|[_, amplitude]| *amplitude).fold(0.0, f64::max);
    let floor = to_log(highest) - DECADES;
    let log = |amplitude: f64| if amplitude > 0.0 { to_log(amplitude).max(floor) } else { floor };
    let line: Vec<PlotPoint> =
        found.spectrum.iter().map(|[omega, amplitude]| PlotPoint::new(*omega, log(*amplitude))).collect();
    let width = line.last().map_or(1.0, |point| point.x);
    let mut named: Vec<(String, [f64; 2])> = Vec::new();
    for peak in found.verdict.peaks.iter().take(2 * NAMED) {
        let free = named.iter().all(|(_, place)| (place[0] - peak.omega).abs() > APART * width);
        if let (Some(label), true, true) = (peak.label, free, named.len() < NAMED) {
            named.push((label.to_string(), [peak.omega, log(peak.amplitude) + 0.32]));
        }
    }
    let (x, y) =
        (Axis::new(tr("angular frequency"), ""), Axis::new(tr("amplitude"), "").unit("V").logarithmic());
    plot_style::plot(ui, "spectrum", &x, &y)
        .include_x(0.0)
        .include_y(floor)
        .include_y(to_log(highest) + 0.8)
        .show(ui, |plot| {
            plot_style::series(plot, Series::Numeric, tr("amplitude"), &line);
            for (name, place) in &named {
                plot_style::labelled_place(plot, name, *place, Series::Theory);
            }
        });
}
