//! The chart over (omega, beta): how stable the forced motion is, or which motion is reached, cell by cell.

use egui::{Id, Ui};
use egui_plot::PlotBounds;

use super::Context;
use super::stability_map::{self, drag_point};
use crate::app::command::Command;
use crate::app::map::{Boundaries, ceiling};
use crate::app::view::{Layer, Panel};
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Series, chips, draw_raster, raster, swatches};
use crate::app::{colours, theme};
use crate::dynamics::Instability;
use crate::jobs::study::Study as _;

/// Draws the card.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    let hint = match context.studies.multipliers.study() {
        Some(chart) if !chart.finished() => format!("computing {:.0} %", 100.0 * chart.progress()),
        _ => "drag or click to move".to_owned(),
    };
    context.plot_card(ui, Panel::Chart, "Stability chart", &hint, |context, ui| {
        let Some(boundaries) = &context.session.boundaries else { return };
        header(context, ui);
        plot(context, ui, boundaries);
    });
}

fn header(context: &mut Context<'_>, ui: &mut Ui) {
    let mut layer = context.view.layer;
    ui.horizontal_wrapped(|ui| {
        stability_map::choose_window(context, ui);
        ui.add_space(6.0);
        let layers = [
            (Layer::Multiplier, "forced motion"),
            (Layer::Motion, "motion reached"),
            (Layer::Voltage, "voltage"),
            (Layer::Power, "power"),
        ];
        chips(ui, "Chart", &mut layer, &layers);
    });
    if layer != context.view.layer {
        context.commands.push(Command::Chart(layer));
    }
    let tokens = theme::tokens(ui);
    let stable = colours::multiplier(Some((0.999, 0.0)), tokens);
    let kind = |kind| colours::instability(kind, tokens);
    swatches(
        ui,
        &[
            (stable, "stable"),
            (kind(Instability::PeriodDoubling), "period doubling"),
            (kind(Instability::NeimarkSacker), "torus"),
            (kind(Instability::Fold), "fold"),
            (colours::multiplier(None, tokens), "no forced motion"),
        ],
    );
}

fn plot(context: &mut Context<'_>, ui: &mut Ui, boundaries: &Boundaries) {
    let p = context.view.scenario.parameters;
    let window = context.view.map;
    let (low, high) = boundaries.range(window);
    let ceiling = ceiling(window, p.beta);
    let tokens = theme::tokens(ui);
    let chart = context.studies.multipliers.study();
    let picture = chart.and_then(|chart| {
        let revision =
            chart.version() ^ (context.studies.multipliers.generation() << 32) ^ u64::from(tokens.dark) << 63;
        let paint = |column, row| chart.shown(column, row).map(|value| colours::multiplier(value, tokens));
        raster(ui, Id::unique("multiplier chart"), revision, chart.question().size, paint)
    });
    let (x, y) = (Axis::new("excitation frequency", "ω"), Axis::new("excitation amplitude", "β"));
    let (exact, current) = stability_map::exact_borders(context, boundaries);
    let shown = plot_style::plot(ui, ("chart", window), &x, &y)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_double_click_reset(false)
        .show(ui, |plot| {
            plot.set_plot_bounds(PlotBounds::from_min_max([low, 0.0], [high, ceiling]));
            if let (Some(picture), Some(chart)) = (&picture, chart) {
                let opacity = if chart.version() == 0 { 0.5 } else { 1.0 };
                draw_raster(plot, picture, chart.question().omega, chart.question().beta, opacity);
            }
            for tongue in &boundaries.tongues {
                plot_style::series(plot, Series::Published, "published boundary", &tongue.published);
                plot_style::series(plot, Series::Coupled, "coupled-mode boundary", &tongue.coupled);
            }
            for border in &exact {
                let kind = if current { Series::Exact } else { Series::Ghost };
                plot_style::series(plot, kind, "exact boundary", border);
            }
        });
    drag_point(context, ui, &shown, (low, high), ceiling);
}
