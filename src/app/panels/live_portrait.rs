//! The phase portrait with a trail that fades, and the Poincaré points, which gather.

use egui::Ui;
use egui_plot::{PlotBounds, PlotPoint};

use super::Context;
use super::live::traced::Traced;
use super::spec::{Place, Spec};
use crate::app::live::{PORTRAIT, Sample};
use crate::app::text::{fill, marked, tr};
use crate::app::theme;
use crate::app::view::Tab;
use crate::app::widgets::{Series, legend, plot_style};
use crate::export::Pen;

/// Pieces of the trail, each fainter than the next.
const PIECES: usize = 12;
/// Strength of the oldest piece.
const FAINTEST: f32 = 0.08;
/// How many of the newest Poincaré points are drawn how strongly; older ones follow.
const AGES: [(usize, f32); 4] = [(16, 1.0), (120, 0.8), (600, 0.55), (usize::MAX, 0.3)];

/// The portrait.
pub(super) const PANEL: Spec = Spec::new(Place::Tab(Tab::Live), |_| tr("Live phase portrait"), plot)
    .hint(|context| fill("{count} Poincaré points", &[("count", &context.live.trail.strobe.len())]))
    .embedded("live_phase", marked("Live phase portrait"));

fn plot(context: &mut Context<'_>, ui: &mut Ui) {
    let Some(now) = context.live.present() else { return };
    let (traced, trail) = (Traced::of(context), &context.live.trail);
    let old = trail.strobe.partition_point(|sample| sample.turns < trail.changed);
    let entries = [
        (Series::Numeric, tr("motion")),
        (Series::Poincare, tr("at phase 0")),
        (Series::Ghost, tr("before the last change")),
    ];
    legend::legend(ui, if old > 0 { &entries } else { &entries[..2] });
    let place = |sample: &Sample| traced.point(sample).into();
    let mut motion: Vec<PlotPoint> = trail.since(now.turns - PORTRAIT).map(place).collect();
    motion.push(place(&now));
    let before: Vec<PlotPoint> = trail.strobe.range(..old).map(place).collect();
    let mut points: Vec<PlotPoint> = trail.strobe.range(old..).map(place).collect();
    // Newest first, so that ages count from the front.
    points.reverse();
    let kicks = trail.kicks.iter().filter(|kick| kick.turns >= now.turns - PORTRAIT);
    let kicks: Vec<PlotPoint> = kicks.map(place).collect();
    let [width, height] = traced.scales(context);
    let tokens = theme::tokens(ui);
    let [x, y] = &traced.axes;
    let length = motion.len().div_ceil(PIECES);
    plot_style::fixed(ui, "live phase portrait", x, y).show(ui, |plot| {
        plot.set_plot_bounds(PlotBounds::from_min_max([-width, -height], [width, height]));
        plot_style::points(plot, Series::Ghost, tr("before the last change"), &before);
        // From the newest backwards; pieces share an end, so that there are no gaps.
        for piece in 0..PIECES {
            let end = motion.len().saturating_sub(piece * length);
            let from = end.saturating_sub(length + 1);
            let strength = 1.0 - (1.0 - FAINTEST) * piece as f32 / (PIECES - 1) as f32;
            let colour = tokens.numeric.gamma_multiply(strength * strength);
            plot_style::curve(plot, tr("motion"), colour, Pen::Line(2.0), &motion[from..end]);
        }
        let mut newer = 0;
        for (until, strength) in AGES {
            let until = until.min(points.len());
            let aged = &points[newer.min(until)..until];
            plot_style::faded_points(plot, Series::Poincare, tr("at phase 0"), aged, strength);
            newer = until;
        }
        plot_style::points(plot, Series::FromRest, tr("kick"), &kicks);
        plot_style::points(plot, Series::Numeric, tr("now"), &motion[motion.len() - 1..]);
    });
}
