//! Voltage and rate once an excitation period.

use egui::Ui;

use super::Context;
use super::phase_portrait::axes;
use crate::app::view::Panel;
use crate::app::widgets::plot_style;
use crate::app::widgets::{Series, legend};

/// Draws the card.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    let hint = match context.shown() {
        Some(shown) => format!("t = 2πk/ω · {} points, grey: earlier", shown.curves.strobe.len()),
        None => String::new(),
    };
    context.plot_card(ui, Panel::PoincareMap, "Poincaré map", &hint, map);
}

fn map(context: &mut Context<'_>, ui: &mut Ui) {
    let Some(shown) = context.shown() else { return };
    let curves = &shown.curves;
    let (x, y) = axes();
    legend::legend(ui, &[(Series::Poincare, "last quarter"), (Series::Theory, "first-order theory")]);
    let [width, height] = curves.extent;
    plot_style::plot(ui, "poincare map", &x, &y)
        .include_x(-1.05 * width)
        .include_x(1.05 * width)
        .include_y(-1.05 * height)
        .include_y(1.05 * height)
        .show(ui, |plot| {
            if let Some(pinned) = &context.session.pinned {
                plot_style::points(plot, Series::Ghost, "pinned", &pinned.curves.strobe);
            }
            plot_style::points(plot, Series::Ghost, "before", &curves.strobe_before);
            plot_style::points(plot, Series::Poincare, "last quarter", &curves.strobe);
            if let Some(point) = &curves.theory_strobe {
                let place = std::slice::from_ref(point);
                plot_style::points(plot, Series::Theory, "first-order theory", place);
            }
        });
}
