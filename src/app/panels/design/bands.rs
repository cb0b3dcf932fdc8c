//! Where enough power is delivered: bands of the curves over frequency, and the least power that counts.

use egui::{Color32, Grid, RichText, Ui};
use egui_plot::PlotUi;

use super::held::held;
use super::measure::Measure;
use super::safety::Safety;
use crate::app::bench::questions;
use crate::app::bench::variant::highest;
use crate::app::panels::{Context, grid};
use crate::app::text::{fill, tr};
use crate::app::theme::{self, Tokens};
use crate::app::view::View;
use crate::app::widgets::number::{prefix, round_significant, significant, with_unit};
use crate::app::widgets::{Card, ParameterSlider, chips, plot_style};
use crate::export::Pen;
use crate::questions::design::band::{half_power, total, usable};
use crate::questions::design::point::powers;
use crate::questions::design::{Bounds, HarvestPoint, Interval};
use crate::questions::harvest::HarvestStudy;
use crate::questions::sweep::Direction;

/// Least power (W) on the slider.
const LEAST: f64 = 1e-9;

/// Draws the cards beside the curves.
pub(super) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    Card::new(tr("Bands")).hint(&held(context.view)).hugging().show(ui, |ui| table(context, ui));
    ui.add_space(grid::GAP);
    Card::new(tr("Frequencies")).hugging().show(ui, |ui| window(context, ui));
    ui.add_space(grid::GAP);
    Card::new(tr("Best load")).hugging().show(ui, |ui| super::best_load::brief(context, ui));
    ui.add_space(grid::GAP);
    Card::new(tr("Limits")).hugging().show(ui, |ui| super::limits::controls(context, ui));
}

/// The pieces of the curves that have bands; the first is the linear device, the second are the stable motions.
fn curves(study: &HarvestStudy) -> [(&'static str, Vec<Vec<HarvestPoint>>); 5] {
    [
        (tr("without magnets"), vec![study.linear_points()]),
        (tr("stable motions"), study.stable_pieces()),
        (tr("from rest"), study.rest_pieces()),
        (tr("swept up"), study.swept_pieces(Direction::Up)),
        (tr("swept down"), study.swept_pieces(Direction::Down)),
    ]
}

/// Whether a frequency (Hz) is an end of the window, beyond which what meets it may go on.
pub(super) fn at_end((low, high): (f64, f64), hertz: f64) -> bool {
    (hertz - low).min(high - hertz) < 1e-6 * (high - low)
}

/// Where a curve gives enough, and where it does so within the limits.
pub(super) struct Enough {
    pub bands: Vec<Interval>,
    safe: Option<Vec<Interval>>,
}

impl Enough {
    pub(super) fn new(pieces: &[Vec<HarvestPoint>], least: f64, bounds: Option<Bounds>) -> Self {
        let safe = bounds.map(|bounds| usable(&bounds.powers_within(pieces), least));
        Self { bands: usable(&powers(pieces), least), safe }
    }

    /// What of them is safe, where that is not all: none, or these.
    fn cut(&self) -> Option<&[Interval]> {
        self.safe.as_deref().filter(|safe| *safe != self.bands.as_slice())
    }

    /// In words, when the limits cut something away.
    pub(super) fn in_words(&self, window: (f64, f64)) -> Option<String> {
        Some(match self.cut()? {
            [] => tr("none of it within the limits").to_owned(),
            safe => fill("within the limits: {what}", &[("what", &hertz_list(window, safe))]),
        })
    }

    /// How its width is to be coloured.
    fn colour(&self, tokens: &Tokens) -> Color32 {
        match self.cut() {
            None => tokens.text_strong,
            Some([]) => tokens.danger,
            Some(_) => tokens.warning,
        }
    }
}

/// Intervals of frequency in a row, with a sign where one may go on beyond the window.
pub(super) fn hertz_list(window: (f64, f64), intervals: &[Interval]) -> String {
    let end = |sign: &str, hertz: f64| {
        let sign = if at_end(window, hertz) { sign } else { "" };
        format!("{sign}{}", significant(hertz, 4))
    };
    let text = |band: &Interval| {
        fill("{from} to {to} Hz", &[("from", &end("≤\u{a0}", band.from)), ("to", &end("≥\u{a0}", band.to))])
    };
    intervals.iter().map(text).collect::<Vec<_>>().join(", ")
}

/// The power (W) that counts as usable: the one chosen, or half of the highest.
pub(super) fn least(view: &View, study: &HarvestStudy) -> f64 {
    view.design.least.unwrap_or_else(|| {
        let all = curves(study);
        let top = all
            .iter()
            .filter_map(|(_, pieces)| highest(pieces))
            .map(|point| point.measures.power)
            .fold(0.0, f64::max);
        round_significant(0.5 * top, 2)
    })
}

/// Draws that power into a plot of powers.
pub(in crate::app::panels) fn least_line(
    plot: &mut PlotUi<'_>,
    view: &View,
    study: &HarvestStudy,
    measure: &Measure,
) {
    let at = measure.coordinate(least(view, study));
    let colour = theme::tokens_in(plot.ctx()).ruler;
    plot_style::rule(plot, false, tr("least power that counts"), at, colour, Pen::Dots(1.4, 6.0));
}

fn table(context: &mut Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let Some(study) = context.studies.lanes.study::<HarvestStudy>() else { return };
    let present = least(context.view, study);
    let small = |text: &str| RichText::new(text.to_owned()).small();
    least_slider(context, ui, present);
    if context.view.design.least.is_some() && ui.button(small(tr("half of the highest"))).clicked() {
        context.redesign(|design| design.least = None);
    }
    ui.add_space(4.0);
    let all = curves(study);
    let bounds = Safety::of(context.view, context.session).map(|safety| safety.0);
    let enough: [Enough; 5] = std::array::from_fn(|index| {
        // The linear device has no magnets to touch.
        let bounds = if index == 0 { bounds.as_ref().map(Bounds::without_magnets) } else { bounds };
        Enough::new(&all[index].1, present, bounds)
    });
    let at_end = |hertz: f64| at_end(study.window(), hertz);
    ui.spacing_mut().interact_size.y = 18.0;
    Grid::new("bands").num_columns(4).spacing([12.0, 4.0]).show(ui, |ui| {
        for text in ["", tr("highest"), tr("half power"), tr("enough")] {
            ui.label(small(text).color(tokens.text_weak));
        }
        ui.end_row();
        for (index, ((name, pieces), enough)) in all.iter().zip(&enough).enumerate() {
            let Some(top) = highest(pieces) else { continue };
            let half = if index == 0 { Some(study.linear().half_power) } else { half_power(&powers(pieces)) };
            ui.label(small(name).color(tokens.text));
            let at_least = |reached: bool| if reached { "≥\u{a0}" } else { "" };
            let shown = format!("{}{}", at_least(at_end(top.frequency)), with_unit(top.measures.power, "W"));
            let peak = ui.label(small(&shown).color(tokens.text_strong));
            peak.on_hover_text(fill("at {hertz} Hz", &[("hertz", &significant(top.frequency, 5))]));
            let cut_off = |band: &Interval| at_least(at_end(band.from) || at_end(band.to));
            let shown = half
                .map_or("–".to_owned(), |half| format!("{}{}", cut_off(&half), hertz(half.to - half.from)));
            let label = ui.label(small(&shown).color(tokens.text));
            if let Some(half) = half {
                label.on_hover_text(interval(&half));
            }
            let bands = &enough.bands;
            let further = bands.iter().map(cut_off).max().unwrap_or_default();
            let shown = match total(bands) {
                width if bands.is_empty() || width == 0.0 => tr("none").to_owned(),
                width => format!("{further}{}", hertz(width)),
            };
            let label = ui.label(small(&shown).color(enough.colour(tokens)));
            if !bands.is_empty() {
                let said = enough.in_words(study.window()).map_or(String::new(), |text| format!("\n{text}"));
                label.on_hover_text(hertz_list(study.window(), bands) + &said);
            }
            ui.end_row();
        }
    });
}

/// Chooses the power (W) that counts.
pub(super) fn least_slider(context: &mut Context<'_>, ui: &mut Ui, present: f64) {
    // Microwatts at the smallest: no power at all would be counted in watts.
    let (factor, sign) = prefix(present.max(1e-6));
    let (mut power, unit) = (round_significant(factor * present, 6), format!("{sign}W"));
    let slider = ParameterSlider::new(tr("Enough is"), "P", &mut power, 0.0..=factor)
        .logarithmic_from(factor * LEAST)
        .unit(&unit)
        .tooltip(tr(
            "Power from which a frequency counts as usable: half of the highest unless you choose it.",
        ))
        .compact();
    if slider.show(ui).changed {
        context.redesign(|design| design.least = Some(power / factor));
    }
}

fn hertz(width: f64) -> String {
    format!("{} Hz", significant(width, 3))
}

fn interval(interval: &Interval) -> String {
    fill(
        "{from} to {to} Hz",
        &[("from", &significant(interval.from, 5)), ("to", &significant(interval.to, 5))],
    )
}

/// The window of the curves.
fn window(context: &mut Context<'_>, ui: &mut Ui) {
    let units = context.view.scenario.units();
    let (low, high) = questions::window(context.view, context.session);
    let (mut from, mut to) = (units.hertz(low), units.hertz(high));
    let before = (from, to);
    let mut automatic = context.view.design.window.is_none();
    if chips(ui, tr("Window"), &mut automatic, &[(true, tr("about the present")), (false, tr("own"))]) {
        context.redesign(|design| design.window = (!automatic).then_some(before));
    }
    presets(context, ui);
    let (least, most) = (units.hertz(0.1), units.hertz(80.0).max(to));
    for (name, value) in [(tr("From"), &mut from), (tr("To"), &mut to)] {
        *value = round_significant(*value, 6);
        ParameterSlider::new(name, "", value, least..=most).logarithmic().unit("Hz").compact().show(ui);
    }
    let rounded = (round_significant(before.0, 6), round_significant(before.1, 6));
    if (from, to) != rounded {
        context.redesign(|design| design.window = Some((from, to)));
    }
}

/// Buttons for the windows about the natural frequencies, and for one over all of them.
fn presets(context: &mut Context<'_>, ui: &mut Ui) {
    let Some(boundaries) = &context.session.boundaries else { return };
    let units = context.view.scenario.units();
    let natural = &boundaries.frequencies;
    let first = natural.first().copied().unwrap_or(4.0);
    let last = natural.iter().copied().fold(2.0 * first, f64::max);
    let sum = natural.get(1).map(|second| (first + second, "ω₁+ω₂"));
    let places = [(first, "ω₁"), (2.0 * first, "2ω₁")].into_iter().chain(sum);
    let windows = places.map(|(omega, name)| (name, (0.85 * omega, 1.15 * omega)));
    ui.horizontal_wrapped(|ui| {
        for (name, (low, high)) in windows.chain([(tr("all resonances"), (0.7 * first, 1.3 * last))]) {
            if ui.button(RichText::new(name).small()).clicked() {
                context.redesign(|design| design.window = Some((units.hertz(low), units.hertz(high))));
            }
        }
    });
}
