//! Voltage and rate once an excitation period.

use egui::Ui;

use super::spec::{Place, Spec};
use super::{Context, phase_plane};
use crate::app::text::{fill, marked, tr};
use crate::app::view::Tab;
use crate::app::widgets::{Series, plot_style};

/// The map.
pub(super) const PANEL: Spec = Spec::new(Place::Tab(Tab::Explore), |_| tr("Poincaré map"), map)
    .hint(hint)
    .embedded("poincare", marked("Poincaré map"));

fn hint(context: &Context<'_>) -> String {
    let count = context.shown().map(|shown| shown.curves.strobe.len());
    count.map_or_else(String::new, |count| {
        fill("t = 2πk/ω · {count} points, grey: earlier", &[("count", &count)])
    })
}

fn map(context: &mut Context<'_>, ui: &mut Ui) {
    let Some(shown) = context.shown() else { return };
    let curves = &shown.curves;
    let entries = [(Series::Poincare, tr("last quarter")), (Series::TheoryPoint, tr("first-order theory"))];
    phase_plane::legend(ui, &entries, curves);
    phase_plane::plot_around(ui, "poincare map", curves.extent).show(ui, |plot| {
        if let Some(pinned) = &context.session.pinned {
            plot_style::points(plot, Series::Ghost, tr("pinned"), &pinned.curves.strobe);
        }
        plot_style::points(plot, Series::Ghost, tr("before"), &curves.strobe_before);
        if let Some(point) = &curves.theory_strobe {
            let place = std::slice::from_ref(point);
            plot_style::points(plot, Series::TheoryPoint, tr("first-order theory"), place);
        }
        plot_style::points(plot, Series::Poincare, tr("last quarter"), &curves.strobe);
    });
}
