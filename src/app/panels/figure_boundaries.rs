//! Figures 2, 7 and 10: the boundary of one resonance for four dampings, and the marked stable point.

use egui::Ui;
use egui_plot::{PlotBounds, PlotPoint};

use super::Context;
use crate::app::figures::{BoundaryFigure, MARKED_EXCITATION};
use crate::app::text::tr;
use crate::app::theme;
use crate::app::widgets::number::significant;
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Card, Icon, Series, legend, row};
use crate::export::Pen;

const HEIGHT: f32 = 380.0;

/// Draws the figure as one card.
pub(super) fn show(context: &mut Context<'_>, ui: &mut Ui, figure: &BoundaryFigure) {
    let hint = tr("dotted, solid, dashed, dash-dotted: the four dampings, as in the paper");
    let least = if context.on_top.is_some() { 0.0 } else { HEIGHT };
    let height = ui.available_height().max(least);
    let title = tr("Stability boundaries");
    let shown = Card::new(title).hint(hint).exports().height(height).show(ui, |ui| {
        let tongues = &context.session.comparison.tongues;
        let dampings: Vec<String> = tongues.iter().map(|(alpha, _)| significant(*alpha, 1)).collect();
        row(ui, |ui| {
            let thin = [
                (Series::Published, tr("as printed (thin)")),
                (Series::Coupled, tr("coupled modes (thick)")),
            ];
            legend::legend(ui, &thin);
            let text = format!("α = {}", dampings.join(", "));
            ui.label(egui::RichText::new(text).small().color(theme::tokens(ui).text_weak));
        });
        let Some((_, first)) = tongues.first() else { return };
        let ceiling = figure.ceiling;
        let centre = first.published_frequency;
        let half = figure.half_width;
        let (x, y) = (Axis::new(tr("excitation frequency"), "ω"), Axis::new(tr("excitation amplitude"), "β"));
        let tokens = theme::tokens(ui);
        let marked = PlotPoint::new(figure.omega, MARKED_EXCITATION);
        plot_style::fixed(ui, ("figure boundaries", figure.point), &x, &y).show(ui, |plot| {
            let bounds = PlotBounds::from_min_max([centre - half, -0.02 * ceiling], [centre + half, ceiling]);
            plot.set_plot_bounds(bounds);
            for (index, (alpha, tongue)) in tongues.iter().enumerate() {
                let alpha = significant(*alpha, 1);
                for (kind, curve) in
                    [(Series::Coupled, &tongue.coupled), (Series::Published, &tongue.published)]
                {
                    let whose = if kind == Series::Coupled { tr("coupled modes") } else { tr("as printed") };
                    let name = format!("α = {alpha}, {whose}");
                    for pen in pens(index) {
                        // The style is the paper's and tells the dampings apart, the weight the theories.
                        let pen = if kind == Series::Coupled { heavy(*pen) } else { *pen };
                        plot_style::curve(plot, &name, kind.colour(tokens), pen, curve);
                    }
                }
            }
            let point = [figure.omega, MARKED_EXCITATION];
            plot_style::labelled_place(
                plot,
                figure.point,
                [point[0], point[1] + 0.05 * ceiling],
                Series::Numeric,
            );
            plot_style::points(plot, Series::Numeric, figure.point, std::slice::from_ref(&marked));
        });
    });
    context.export(title, shown.export);
    if shown.pressed == Some(Icon::Record) {
        context.record(ui, title, shown.rect);
    }
}

/// The same pen with twice the weight.
const fn heavy(pen: Pen) -> Pen {
    match pen {
        Pen::Line(width) => Pen::Line(2.0 * width),
        Pen::Dashes(width, length) => Pen::Dashes(2.0 * width, length),
        Pen::Dots(radius, spacing) => Pen::Dots(2.0 * radius, spacing),
        mark => mark,
    }
}

/// The line style that the paper gives the damping with this index.
const fn pens(index: usize) -> &'static [Pen] {
    match index {
        0 => &[Pen::Dots(1.6, 6.0)],
        1 => &[Pen::Line(2.0)],
        2 => &[Pen::Dashes(1.8, 9.0)],
        // Dashes with dots in their gaps.
        _ => &[Pen::Dashes(1.6, 14.0), Pen::Dots(1.2, 11.0)],
    }
}
