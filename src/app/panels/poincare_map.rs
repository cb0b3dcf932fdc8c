//! Voltage and rate once an excitation period.

use egui::Ui;

use super::{Context, phase_plane};
use crate::app::text::{fill, tr};
use crate::app::view::Panel;
use crate::app::widgets::{Series, legend, plot_style};

/// Draws the card.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    let hint = match context.shown() {
        Some(shown) => {
            fill("t = 2πk/ω · {count} points, grey: earlier", &[("count", &shown.curves.strobe.len())])
        }
        None => String::new(),
    };
    context.plot_card(ui, Panel::PoincareMap, tr("Poincaré map"), &hint, map);
}

fn map(context: &mut Context<'_>, ui: &mut Ui) {
    let Some(shown) = context.shown() else { return };
    let curves = &shown.curves;
    legend::legend(
        ui,
        &[(Series::Poincare, tr("last quarter")), (Series::TheoryPoint, tr("first-order theory"))],
    );
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
