//! The Floquet multipliers and the unit circle.

use std::f64::consts::TAU;

use egui::Ui;
use egui_plot::{PlotBounds, PlotPoint};

use super::Context;
use super::spec::{Place, Spec};
use crate::app::text::{fill, marked, tr};
use crate::app::theme;
use crate::app::view::Tab;
use crate::app::widgets::number::significant;
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Series, legend};
use crate::questions::inspection::Multipliers;
use crate::spacing::equally_spaced;

/// Points of the circle.
const CIRCLE: usize = 181;

/// The multipliers.
pub(super) const PANEL: Spec = Spec::new(Place::Tab(Tab::Stability), |_| tr("Floquet multipliers"), plot)
    .hint(|_| tr("inside the circle: stable").to_owned())
    .embedded("multipliers", marked("Multipliers"));

fn plot(context: &mut Context<'_>, ui: &mut Ui) {
    let Some((found, current)) = context.studies.inspection(&context.view.scenario) else { return };
    if !current {
        ui.multiply_opacity(0.55);
    }
    // A motion of period 1 that is the forced one is drawn once.
    let reached = found.reached.as_ref().filter(|reached| found.forced.as_ref() != Some(*reached));
    let reached = reached.filter(|reached| !same(reached, found.forced.as_ref()));
    let name = reached.map(|reached| fill("period {periods} reached", &[("periods", &reached.periods)]));
    let mut entries = vec![(Series::Forced, tr("forced motion"))];
    entries.extend(name.as_deref().map(|name| (Series::Reached, name)));
    legend::legend(ui, &entries);
    if let Some(forced) = &found.forced {
        ui.label(egui::RichText::new(in_words(forced)).small().color(theme::tokens(ui).text_weak));
    }
    let circle: Vec<PlotPoint> =
        equally_spaced((0.0, TAU), CIRCLE).map(|angle| PlotPoint::new(angle.cos(), angle.sin())).collect();
    let places = |found: Option<&Multipliers>| -> Vec<PlotPoint> {
        found
            .map_or_else(Vec::new, |found| found.values.iter().map(|[x, y]| PlotPoint::new(*x, *y)).collect())
    };
    let (forced, reached) = (places(found.forced.as_ref()), places(reached));
    let all = forced.iter().chain(&reached);
    let farthest = all.map(|place| place.x.hypot(place.y)).fold(1.0, f64::max);
    let reach = 1.18 * farthest.min(4.0);
    let (x, y) = (Axis::new("", "Re μ"), Axis::new("", "Im μ"));
    plot_style::fixed(ui, "multipliers", &x, &y).data_aspect(1.0).show(ui, |plot| {
        plot.set_plot_bounds(PlotBounds::from_min_max([-reach, -reach], [reach, reach]));
        plot_style::series(plot, Series::Ghost, tr("unit circle"), &circle);
        plot_style::points(plot, Series::Forced, tr("forced motion"), &forced);
        plot_style::points(plot, Series::Reached, tr("motion reached"), &reached);
    });
}

fn same(a: &Multipliers, b: Option<&Multipliers>) -> bool {
    let close = |x: &[f64; 2], y: &[f64; 2]| (x[0] - y[0]).hypot(x[1] - y[1]) < 1e-6;
    b.is_some_and(|b| a.periods == b.periods && a.values.iter().zip(&b.values).all(|(x, y)| close(x, y)))
}

/// The largest multiplier with what it means.
fn in_words(forced: &Multipliers) -> String {
    let Some([re, im]) = forced.values.first() else { return String::new() };
    let modulus = re.hypot(*im);
    let value = if *im == 0.0 {
        format!("μ = {}", significant(*re, 5))
    } else {
        format!("μ = {} ± {} i", significant(*re, 4), significant(im.abs(), 4))
    };
    let meaning = match (modulus < 1.0, *im == 0.0, *re < 0.0) {
        (true, ..) => tr("stable"),
        (false, false, _) => tr("unstable: a torus grows"),
        (false, true, true) => tr("unstable: every second period repeats, the period doubles"),
        (false, true, false) => tr("unstable: it is left in one direction"),
    };
    fill(
        "forced motion: largest {value}, |μ| = {modulus} · {meaning}",
        &[("value", &value), ("modulus", &significant(modulus, 5)), ("meaning", &meaning)],
    )
}
