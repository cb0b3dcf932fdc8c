//! Figures 2, 7 and 10: the boundary of one resonance for four dampings, and the marked stable point.

use egui::Ui;
use egui_plot::{Line, LineStyle, PlotBounds, PlotPoint, PlotPoints};

use super::Context;
use crate::app::figures::{BoundaryFigure, MARKED_EXCITATION};
use crate::app::theme;
use crate::app::widgets::number::significant;
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Card, Series, legend};

const HEIGHT: f32 = 380.0;

/// Draws the figure as one card.
pub(super) fn show(context: &mut Context<'_>, ui: &mut Ui, figure: &BoundaryFigure) {
    let hint = "dotted, solid, dashed, dash-dotted: the four dampings, as in the paper";
    let height = ui.available_height().max(HEIGHT);
    Card::new("Stability boundaries").hint(hint).height(height).show(ui, |ui| {
        let tongues = &context.session.comparison.tongues;
        let dampings: Vec<String> = tongues.iter().map(|(alpha, _)| significant(*alpha, 1)).collect();
        ui.horizontal_wrapped(|ui| {
            legend::legend(ui, &[(Series::Published, "as printed"), (Series::Coupled, "coupled modes")]);
            let text = format!("α = {}", dampings.join(", "));
            ui.label(egui::RichText::new(text).small().color(theme::tokens(ui).text_weak));
        });
        let Some((_, first)) = tongues.first() else { return };
        let ceiling = figure.ceiling;
        let centre = first.published_frequency;
        let half = figure.half_width;
        let (x, y) = (Axis::new("excitation frequency", "ω"), Axis::new("excitation amplitude", "β"));
        let tokens = theme::tokens(ui);
        plot_style::plot(ui, ("figure boundaries", figure.point), &x, &y)
            .allow_drag(false)
            .allow_zoom(false)
            .allow_scroll(false)
            .show(ui, |plot| {
                let bounds =
                    PlotBounds::from_min_max([centre - half, -0.02 * ceiling], [centre + half, ceiling]);
                plot.set_plot_bounds(bounds);
                for (index, (alpha, tongue)) in tongues.iter().enumerate() {
                    let name = format!("α = {}", significant(*alpha, 1));
                    for (kind, curve) in
                        [(Series::Coupled, &tongue.coupled), (Series::Published, &tongue.published)]
                    {
                        boundary(plot, &name, index, kind.colour(tokens), curve);
                    }
                }
                let point = [figure.omega, MARKED_EXCITATION];
                plot_style::labelled_place(
                    plot,
                    figure.point,
                    [point[0], point[1] + 0.05 * ceiling],
                    Series::Numeric,
                );
                let marked = egui_plot::Points::new(figure.point, vec![point]).radius(5.0);
                plot.points(marked.color(Series::Numeric.colour(tokens)));
            });
    });
}

/// A curve in the line style that the paper gives the damping with this index.
fn boundary(
    plot: &mut egui_plot::PlotUi<'_>,
    name: &str,
    index: usize,
    colour: egui::Color32,
    curve: &[PlotPoint],
) {
    for run in plot_style::finite_runs(curve) {
        let line = |style, width: f32| {
            Line::new(name, PlotPoints::Owned(run.to_vec())).color(colour).width(width).style(style)
        };
        match index {
            0 => plot.line(line(LineStyle::Dotted { spacing: 6.0 }, 1.6)),
            1 => plot.line(line(LineStyle::Solid, 2.0)),
            2 => plot.line(line(LineStyle::Dashed { length: 9.0 }, 1.8)),
            _ => {
                // Dashes with dots in their gaps.
                plot.line(line(LineStyle::Dashed { length: 14.0 }, 1.6));
                plot.line(line(LineStyle::Dotted { spacing: 11.0 }, 1.2));
            }
        }
    }
}
