//! The pinned variants and the present design over frequency, in one plot.

use egui::Ui;
use egui_plot::PlotPoint;

use super::Context;
use super::design::measure::{self, Measure, values};
use super::spec::{Place, Spec};
use crate::app::bench::variant::Variant;
use crate::app::text::tr;
use crate::app::view::design::{Page, Watched};
use crate::app::widgets::{Series, legend, plot_style};
use crate::questions::harvest::HarvestStudy;

/// The curves.
pub(super) const PANEL: Spec =
    Spec::new(Place::Page(Page::Variants), |_| tr("Variants over frequency"), contents)
        .hint(|context| context.computing::<HarvestStudy>(""))
        .asking(|asking| asking.studies.harvest(asking.view, asking.session));

/// The present design, where something is known of it, and the variants, each with what it is called and how it is drawn.
pub(super) fn designs(context: &Context<'_>) -> Vec<(Series, String, Variant)> {
    let present = Variant::present(context.view, context.session, context.studies);
    let present = present.map(|(variant, _)| (Series::Stable, tr("present").to_owned(), variant));
    let pinned = context.bench.variants.iter().zip(0..);
    let pinned =
        pinned.map(|(variant, index)| (Series::Variant(index), variant.name.clone(), variant.clone()));
    present.into_iter().chain(pinned).collect()
}

fn contents(context: &mut Context<'_>, ui: &mut Ui) {
    measure::choose(context, ui);
    let designs = designs(context);
    let entries: Vec<(Series, &str)> = designs.iter().map(|(kind, name, _)| (*kind, name.as_str())).collect();
    legend::legend(ui, &entries);
    let design = &context.view.design;
    let watched = design.watched;
    let pieces: Vec<_> = designs.iter().map(|(_, _, variant)| variant.pieces()).collect();
    let all = pieces.iter().flatten().flatten();
    let highest = all.map(|point| values(watched, point)[1].abs()).fold(0.0, f64::max);
    let measure = Measure::new(design, highest);
    let sides = if watched == Watched::Tip { 2 } else { 1 };
    let mut drawn: Vec<(Series, &str, Vec<PlotPoint>)> = Vec::new();
    for ((kind, name, _), pieces) in designs.iter().zip(&pieces) {
        for piece in pieces {
            drawn.extend((0..sides).map(|side| (*kind, name.as_str(), measure.line(piece, side))));
        }
    }
    if drawn.is_empty() {
        return plot_style::no_data(
            ui,
            ui.available_rect_before_wrap(),
            tr("Nothing is pinned, and the present curve is not known yet."),
        );
    }
    let x = measure.frequency();
    let id = ("variants", watched as u8, measure.axis().title(), x.is_logarithmic());
    let mut plot = plot_style::plot(ui, id, x, measure.axis());
    if watched != Watched::Tip && !design.logarithmic {
        plot = plot.include_y(0.0);
    }
    plot.show(ui, |plot| {
        for (kind, name, line) in &drawn {
            plot_style::series(plot, *kind, name, line);
        }
    });
}
