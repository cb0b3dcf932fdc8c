//! The phase portrait with a trail that fades, and the Poincaré points, which gather.

use egui::Ui;
use egui_plot::{PlotBounds, PlotPoint};

use super::Context;
use super::live::traced::Traced;
use super::spec::{Place, Spec};
use crate::app::live::{PORTRAIT, Sample};
use crate::app::text::{fill, marked, tr};
use crate::app::theme;
use crate::app::view::shake::ShakenBy;
use crate::app::view::{Tab, View};
use crate::app::widgets::plot_style::Axis;
use crate::app::widgets::{Series, legend, plot_style};
use crate::export::Pen;
use crate::model::base_motion::{BaseMotion, Chirp};

/// Pieces of the trail, each fainter than the next.
const PIECES: usize = 12;
/// Strength of the oldest piece.
const FAINTEST: f32 = 0.08;
/// How many of the newest Poincaré points are drawn how strongly; older ones follow.
const AGES: [(usize, f32); 4] = [(16, 1.0), (120, 0.8), (600, 0.55), (usize::MAX, 0.3)];

/// The portrait.
pub(super) const PANEL: Spec = Spec::new(Place::Tab(Tab::Live), title, contents)
    .hint(hint)
    .embedded("live_phase", marked("Live phase portrait"));

fn title(view: &View) -> &'static str {
    match view.shaken() {
        Some(ShakenBy::Chirp) => tr("Voltage over the frequency of the chirp"),
        _ => tr("Live phase portrait"),
    }
}

fn hint(context: &Context<'_>) -> String {
    if context.live.shaken().is_some() {
        return String::new();
    }
    fill("{count} Poincaré points", &[("count", &context.live.trail.strobe.len())])
}

fn contents(context: &mut Context<'_>, ui: &mut Ui) {
    match context.live.shaken().map(|(shaking, _)| &shaking.motion) {
        Some(BaseMotion::Chirp(chirp)) => over_frequency(context, ui, chirp),
        _ => plot(context, ui),
    }
}

/// The largest voltage of each vibration over the frequency that the chirp had there.
fn over_frequency(context: &Context<'_>, ui: &mut Ui, chirp: &Chirp) {
    legend::legend(ui, &[(Series::Up, tr("going up")), (Series::Down, tr("going down"))]);
    let unit = context.view.scenario.units().time;
    let way = |back: bool| -> Vec<PlotPoint> {
        let peaks = context.live.trail.peaks.iter().map(|(place, peak)| (place * unit, *peak));
        let part = peaks.filter(|(time, _)| (*time > 0.5 * chirp.duration) == back);
        part.map(|(time, peak)| PlotPoint::new(chirp.frequency(time), peak)).collect()
    };
    let (up, down) = (way(false), way(true));
    let highest = up.iter().chain(&down).map(|point| point.y).fold(0.0, f64::max);
    let (x, y) = (Axis::new(tr("frequency"), "f").unit("Hz"), Axis::new(tr("voltage"), "|v|").unit("V"));
    let (low, high) = (chirp.from.min(chirp.to), chirp.from.max(chirp.to));
    let here = context.live.shaken().map(|(_, time)| chirp.frequency(time));
    let colour = theme::tokens(ui).ruler;
    plot_style::fixed(ui, "live chirp", &x, &y).show(ui, |plot| {
        plot.set_plot_bounds(PlotBounds::from_min_max([low, 0.0], [high, 1.08 * highest.max(1e-3)]));
        if let Some(here) = here {
            plot_style::rule(plot, true, "", here, colour, Pen::Line(1.0));
        }
        plot_style::points(plot, Series::Up, tr("going up"), &up);
        plot_style::points(plot, Series::Down, tr("going down"), &down);
    });
}

fn plot(context: &mut Context<'_>, ui: &mut Ui) {
    let repeats = context.live.shaken().is_none();
    let Some(now) = context.live.present() else { return };
    let (traced, trail) = (Traced::of(context), &context.live.trail);
    let old = trail.strobe.partition_point(|sample| sample.turns < trail.changed);
    let entries = [
        (Series::Numeric, tr("motion")),
        (Series::Poincare, tr("at phase 0")),
        (Series::Ghost, tr("before the last change")),
    ];
    let told = match (repeats, old > 0) {
        (false, _) => 1,
        (true, false) => 2,
        (true, true) => 3,
    };
    legend::legend(ui, &entries[..told]);
    let place = |sample: &Sample| traced.point(sample).into();
    let mut motion: Vec<PlotPoint> = trail.since(now.turns - PORTRAIT).map(place).collect();
    motion.push(place(&now));
    let (old, end) = if repeats { (old, trail.strobe.len()) } else { (0, 0) };
    let before: Vec<PlotPoint> = trail.strobe.range(..old).map(place).collect();
    let mut points: Vec<PlotPoint> = trail.strobe.range(old..end).map(place).collect();
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
