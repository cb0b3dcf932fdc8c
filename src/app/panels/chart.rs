//! The chart over (omega, beta): how stable the forced motion is, or which motion is reached, cell by cell.

use egui::{Color32, Id, TextureHandle, Ui};
use egui_plot::PlotBounds;

use super::Context;
use super::design::safety::Safety;
use super::spec::{Asking, Place, Spec};
use super::stability_map::{self, drag_point};
use crate::app::command::Command;
use crate::app::map::Boundaries;
use crate::app::questions;
use crate::app::text::{marked, say, tr};
use crate::app::theme::{self, Tokens};
use crate::app::view::Tab;
use crate::app::widgets::number::{self, significant};
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{
    Filling, Hatched, Series, chips, colour_bar, draw_raster, fading, hatched, raster, recorder, row,
    swatches,
};
use crate::app::{colours, panels::response::microwatts};
use crate::dynamics::Instability;
use crate::dynamics::attractors::motion::{Cell, Motion, Undecided};
use crate::questions::chart::Quantity;
use crate::questions::motion_chart::MotionChart;
use crate::questions::multiplier_chart::MultiplierChart;
use crate::scheduler::{Asked as _, Study as _};

/// The chart.
pub(super) const PANEL: Spec = Spec::new(Place::Tab(Tab::Stability), |_| tr("Stability chart"), contents)
    .hint(hint)
    .asking(ask)
    .embedded("chart", marked("Stability chart"));

fn hint(context: &Context<'_>) -> String {
    let usual = tr("drag or click to move");
    match context.view.layer {
        Quantity::Multiplier => context.computing::<MultiplierChart>(usual),
        _ => context.computing::<MotionChart>(usual),
    }
}

fn ask(Asking { view, session, studies, .. }: &mut Asking<'_>) {
    let Some(boundaries) = &session.boundaries else { return };
    let (scenario, chart) = questions::chart(view, boundaries);
    if chart.quantity == Quantity::Multiplier {
        let asked = (scenario, chart.omega, chart.beta);
        studies
            .lanes
            .offer(asked, |(scenario, omega, beta)| Some(MultiplierChart::new(scenario, omega, beta)));
    } else {
        studies.lanes.offer(chart.plane(scenario), |plane| Some(MotionChart::new(plane)));
    }
}

fn contents(context: &mut Context<'_>, ui: &mut Ui) {
    let Some(boundaries) = &context.session.boundaries else { return };
    header(context, ui);
    plot(context, ui, boundaries);
}

fn header(context: &mut Context<'_>, ui: &mut Ui) {
    let mut layer = context.view.layer;
    row(ui, |ui| {
        stability_map::choose_window(context, ui);
        ui.add_space(6.0);
        let layers = [
            (Quantity::Multiplier, tr("forced motion")),
            (Quantity::Motion, tr("motion reached")),
            (Quantity::VRms, tr("voltage")),
            (Quantity::Power, tr("power")),
        ];
        chips(ui, tr("Chart"), &mut layer, &layers);
    });
    if layer != context.view.layer {
        context.commands.push(Command::Chart(layer));
    }
    let tokens = theme::tokens(ui);
    match context.view.layer {
        Quantity::Multiplier => multiplier_legend(ui, tokens),
        Quantity::Motion => {
            let undecided = |cell: Cell| matches!(cell.motion, Motion::Undecided { .. });
            let chart = context.studies.lanes.study::<MotionChart>();
            motion_legend(ui, tokens, chart.is_some_and(|chart| known(chart).any(undecided)));
        }
        layer @ (Quantity::VRms | Quantity::Power) => {
            let top = context.studies.lanes.study::<MotionChart>().map_or(0.0, |chart| highest(chart, layer));
            let (top, unit) = if layer == Quantity::VRms {
                (top, tr("V rms"))
            } else {
                (microwatts(&context.view.scenario) * top, "µW")
            };
            ui.horizontal(|ui| {
                colour_bar(ui, "0", &format!("{} {unit}", significant(top, 3)), &colours::sequential);
                swatches(ui, &[(Filling::Hatching, tr("beyond a limit"))]);
            });
        }
    }
    stability_map::boundaries_legend(ui);
}

fn multiplier_legend(ui: &mut Ui, tokens: &Tokens) {
    let kind = |kind| Filling::Plain(colours::instability(kind, tokens));
    let entries = [
        (Filling::Plain(colours::multiplier(Some((0.999, 0.0)), tokens)), tr("stable")),
        (kind(Instability::PeriodDoubling), tr("period doubling")),
        (kind(Instability::NeimarkSacker), tr("torus")),
        (kind(Instability::Fold), tr("fold")),
        (Filling::Plain(colours::multiplier(None, tokens)), tr("no forced motion")),
    ];
    swatches(ui, &entries);
}

/// What is `undecided` somewhere is named, too.
fn motion_legend(ui: &mut Ui, tokens: &Tokens, undecided: bool) {
    let colour = |motion| Filling::Plain(colours::motion(motion, tokens));
    let mut entries = vec![
        (colour(Motion::Periodic { periods: 1 }), tr("period 1")),
        (colour(Motion::Periodic { periods: 2 }), "2"),
        (colour(Motion::Periodic { periods: 3 }), tr("longer")),
        (colour(Motion::Quasiperiodic), tr("torus")),
        (colour(Motion::Chaotic), tr("chaotic")),
        (colour(Motion::Escape { time: 0.0 }), tr("escape or contact")),
        (Filling::Hatching, tr("beyond a limit")),
    ];
    if undecided {
        let motion = Motion::Undecided { why: Undecided::EvidenceDisagrees };
        entries.insert(entries.len() - 1, (colour(motion), tr("undecided")));
    }
    swatches(ui, &entries);
}

/// The cells of a chart that are known.
fn known(chart: &MotionChart) -> impl Iterator<Item = Cell> {
    let (columns, rows) = chart.asked().size;
    let cells = (0..rows).flat_map(move |row| (0..columns).map(move |column| (column, row)));
    cells.filter_map(|(column, row)| chart.cell(column, row).flatten())
}

/// The largest value of a chart, in the unit of its cells.
fn highest(chart: &MotionChart, layer: Quantity) -> f64 {
    known(chart).map(|cell| value(&cell, layer)).fold(0.0, f64::max)
}

fn value(cell: &Cell, layer: Quantity) -> f64 {
    if layer == Quantity::Power { cell.measures.power } else { cell.measures.v_rms }
}

/// Cells of one pixel, or such that can be hatched.
enum Cells {
    Plain(TextureHandle),
    Hatched(Hatched),
}

/// What is drawn under the curves.
struct Picture {
    cells: Cells,
    omega: (f64, f64),
    beta: (f64, f64),
    /// Less where it is that of the last question, still.
    opacity: f32,
}

/// The picture of the layer in view.
fn picture(context: &Context<'_>, ui: &Ui, layer: Quantity) -> Option<Picture> {
    let tokens = theme::tokens(ui);
    let revision = |version: u64, generation: u64| {
        version ^ (generation << 32) ^ ((layer as u64) << 60) ^ (tokens.number() << 62)
    };
    if layer == Quantity::Multiplier {
        let chart = context.studies.lanes.study::<MultiplierChart>()?;
        let (_, omega, beta) = chart.asked();
        let revision = revision(chart.version(), context.studies.lanes.generation::<MultiplierChart>());
        let known = chart.is_replaceable();
        let shown = |column, row| chart.shown(column, row).filter(|_| known);
        let paint = |column, row| shown(column, row).map(|value| colours::multiplier(value, tokens));
        let texture =
            raster(ui, Id::unique("multiplier chart"), revision, (omega.count, beta.count), &paint)?;
        let (omega, beta) = (omega.range(), beta.range());
        return Some(Picture {
            cells: Cells::Plain(texture),
            omega,
            beta,
            opacity: fading(ui, Id::unique("multiplier chart"), known),
        });
    }
    let chart = context.studies.lanes.study::<MotionChart>()?;
    let question = chart.asked();
    let top = highest(chart, layer).max(f64::MIN_POSITIVE);
    let colour = |cell: Cell| -> Color32 {
        let ended = matches!(cell.motion, Motion::Escape { .. } | Motion::Contact { .. });
        if layer == Quantity::Motion || ended {
            colours::motion(cell.motion, tokens)
        } else {
            colours::sequential(value(&cell, layer) / top)
        }
    };
    let safety = Safety::of(context.view, context.session);
    let unsafe_in = |cell: &Cell| match (&safety, cell.demand()) {
        (Some(Safety(bounds)), Some(demand)) => !bounds.limits.allow(&demand, bounds.gap),
        _ => false,
    };
    let known = chart.is_replaceable();
    let paint = |column: usize, row: usize| {
        let cell = chart.shown(column, row).filter(|_| known)?;
        Some((cell.map_or(tokens.inset, colour), cell.as_ref().is_some_and(unsafe_in)))
    };
    let limits = safety.as_ref().map_or(0, Safety::fingerprint);
    let revision = revision(chart.version(), context.studies.lanes.generation::<MotionChart>()) ^ limits;
    let cells = Cells::Hatched(hatched(ui, Id::unique("motion chart"), revision, question.size, &paint)?);
    Some(Picture {
        cells,
        omega: question.x.1,
        beta: question.y.1,
        opacity: fading(ui, Id::unique("motion chart"), known),
    })
}

/// Notes the values behind the picture for files.
fn record(context: &Context<'_>, plot: &egui_plot::PlotUi<'_>, ranges: [(f64, f64); 2]) {
    let layer = context.view.layer;
    if layer == Quantity::Multiplier {
        // Before that, columns that are not known look like their neighbours.
        let found = context.studies.lanes.study::<MultiplierChart>().filter(|chart| chart.finished());
        let Some(chart) = found else { return };
        let value = |column, row| {
            chart
                .shown(column, row)
                .map(|found| found.map_or_else(String::new, |(modulus, _)| number::exact(modulus)))
        };
        let (_, omega, beta) = chart.asked();
        let size = (omega.count, beta.count);
        recorder::cells(plot, tr("largest multiplier of the forced motion"), size, ranges, &value);
        return;
    }
    let Some(chart) = context.studies.lanes.study::<MotionChart>() else { return };
    let factor = microwatts(&context.view.scenario);
    let value = |column, row| {
        let cell = chart.cell(column, row)??;
        Some(match layer {
            Quantity::VRms => number::exact(cell.measures.v_rms),
            Quantity::Power => number::exact(factor * cell.measures.power),
            _ => say(&cell.motion),
        })
    };
    let name = match layer {
        Quantity::VRms => tr("voltage of the motion reached, rms [V]"),
        Quantity::Power => tr("power of the motion reached [µW]"),
        _ => tr("motion reached"),
    };
    recorder::cells(plot, name, chart.asked().size, ranges, &value);
}

fn plot(context: &mut Context<'_>, ui: &mut Ui, boundaries: &Boundaries) {
    let p = context.view.scenario.parameters;
    let window = context.view.map;
    let (low, high) = boundaries.range(window);
    let ceiling = boundaries.ceiling(window, p.beta);
    let picture = picture(context, ui, context.view.layer);
    let (x, y) = (Axis::new(tr("excitation frequency"), "ω"), Axis::new(tr("excitation amplitude"), "β"));
    let (exact, current) = stability_map::exact_borders(context, boundaries);
    let shown = plot_style::fixed(ui, ("chart", window), &x, &y).show_grid(false).show(ui, |plot| {
        plot.set_plot_bounds(PlotBounds::from_min_max([low, 0.0], [high, ceiling]));
        if let Some(Picture { cells, omega, beta, opacity }) = &picture {
            match cells {
                Cells::Plain(texture) => draw_raster(plot, texture, *omega, *beta, *opacity),
                Cells::Hatched(picture) => picture.draw(plot, *omega, *beta, *opacity),
            }
            record(context, plot, [*omega, *beta]);
        }
        for tongue in &boundaries.tongues {
            plot_style::series_on_picture(
                plot,
                Series::Published,
                tr("published boundary"),
                &tongue.published,
            );
            plot_style::series_on_picture(
                plot,
                Series::Coupled,
                tr("coupled-mode boundary"),
                &tongue.coupled,
            );
        }
        for border in &exact {
            let kind = if current { Series::Exact } else { Series::Ghost };
            plot_style::series_on_picture(plot, kind, tr("Floquet boundary"), border);
        }
    });
    drag_point(context, ui, &shown, (low, high), ceiling);
}
