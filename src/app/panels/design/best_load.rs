//! The best load, at the frequency in view and at the best one, and what of it keeps the limits.

use egui::{RichText, Ui};

use super::going::{go_to, use_load};
use super::held::held;
use super::optimum::Optimum;
use super::safety::Safety;
use crate::app::bench::questions;
use crate::app::panels::load::best_frequencies;
use crate::app::panels::{Context, computing, grid, say_cut};
use crate::app::text::{fill, tr};
use crate::app::theme;
use crate::app::widgets::Card;
use crate::app::widgets::number::{significant, with_unit};
use crate::questions::design::Plant;
use crate::questions::design::load::{BestFrequency, LoadPoint};
use crate::questions::design::peak::{Kept, Peak};
use crate::questions::load::{BestAt, LoadStudy};
use crate::scheduler::{Study as _, Table};

/// Draws the cards beside the curves over the load.
pub(super) fn cards(context: &mut Context<'_>, ui: &mut Ui) {
    Card::new(tr("Best load")).hugging().show(ui, |ui| brief(context, ui));
    ui.add_space(grid::GAP);
    Card::new(tr("Best load and frequency")).hugging().show(ui, |ui| both(context, ui));
    ui.add_space(grid::GAP);
    Card::new(tr("Rectifier")).hugging().show(ui, |ui| super::store::controls(context, ui));
    ui.add_space(grid::GAP);
    Card::new(tr("Limits")).hugging().show(ui, |ui| super::limits::controls(context, ui));
}

/// The best load in a few words, with a button to take it.
pub(super) fn brief(context: &mut Context<'_>, ui: &mut Ui) {
    let Some(study) = context.studies.lanes.study::<LoadStudy>() else { return };
    let [resistance, power] = study.linear_best();
    line(ui, &fill("without magnets: {what}", &[("what", &gives(resistance, power))]));
    let bounds = Safety::of(context.view, context.session).map(|safety| safety.0);
    match Optimum::of(study, bounds).filter(|_| study.finished()) {
        Some(best) => {
            let of = |point: &LoadPoint| (gives(point.resistance, point.measures.power), point.resistance);
            let all = of(&best.of_all);
            let within = best.within_limits.as_ref().map(of);
            line(ui, &fill("the motion reached: {what}", &[("what", &all.0)]));
            safe_part(ui, &all, within.as_ref());
            let load = best.to_use().resistance;
            let own = Plant::new(&context.view.scenario).map_or(f64::NAN, |plant| plant.resistance());
            let button = egui::Button::new(fill("Use {load}", &[("load", &with_unit(load, "Ω"))]));
            if ui.add_enabled((own / load - 1.0).abs() > 1e-3, button).clicked() {
                use_load(context, load);
            }
        }
        None => line(
            ui,
            &fill(
                "the motion reached: computing {percent} %",
                &[("percent", &format!("{:.0}", 100.0 * study.progress()))],
            ),
        ),
    }
}

/// What of the best keeps the limits, where that is another one, or none.
fn safe_part<T: PartialEq>(ui: &mut Ui, all: &(String, T), within: Option<&(String, T)>) {
    let tokens = theme::tokens(ui);
    let (text, colour) = match within {
        Some(within) if within.1 == all.1 => return,
        Some((what, _)) => (fill("within the limits: {what}", &[("what", what)]), tokens.ok),
        None => (tr("beyond a limit, as is every other").to_owned(), tokens.danger),
    };
    ui.add(egui::Label::new(RichText::new(text).small().color(colour)).wrap());
}

fn gives(resistance: f64, power: f64) -> String {
    fill("{load} gives {power}", &[("load", &with_unit(resistance, "Ω")), ("power", &with_unit(power, "W"))])
}

fn line(ui: &mut Ui, text: &str) {
    let colour = theme::tokens(ui).text;
    ui.add(egui::Label::new(RichText::new(text).small().color(colour)).wrap());
}

/// The best of all loads at the best of all frequencies.
fn both(context: &mut Context<'_>, ui: &mut Ui) {
    let best = best_frequencies(context);
    let unfinished = context.studies.lanes.study::<Table<BestAt>>().filter(|table| !table.finished());
    if let Some(table) = unfinished {
        line(ui, &computing(table.progress()));
    }
    let finished = unfinished.is_none();
    let (low, high) = questions::window(context.view, context.session);
    let units = context.view.scenario.units();
    let (low, high) = (units.hertz(low), units.hertz(high));
    let place = |frequency: f64, resistance: f64, power: f64| {
        let inside = (frequency - low).min(high - frequency) > 1e-6 * (high - low);
        let (what, hertz) = (gives(resistance, power), significant(frequency, 4));
        let text = fill("{what} at {hertz} Hz", &[("what", &what), ("hertz", &hertz)]);
        text + if inside { "" } else { tr(", at the window's end") }
    };
    let linear = best.iter().max_by(|a, b| a.linear[1].total_cmp(&b.linear[1]));
    if let Some(best) = linear {
        let what = place(best.linear[0], best.resistance, best.linear[1]);
        line(ui, &fill("without magnets: {what}", &[("what", &what)]));
    }
    let highest = |pick: fn(&BestFrequency) -> Option<Peak>| {
        let peaks = best.iter().filter_map(|best| Some((best.resistance, pick(best)?)));
        peaks.max_by(|a, b| a.1.measures.power.total_cmp(&b.1.measures.power))
    };
    if let Some(all) = highest(|best| best.stable) {
        let within = highest(|best| best.within_limits);
        let described = |(resistance, peak): (f64, Peak)| {
            let text = place(peak.frequency, resistance, peak.measures.power);
            let text = fill("{text}, period {periods}", &[("text", &text), ("periods", &peak.periods)]);
            let why = match peak.kept {
                Kept::Limit => tr(", where a limit is just met"),
                Kept::Stability => tr(", where the motion ends or loses its stability"),
                Kept::Peak | Kept::End => "",
            };
            (text + why, (resistance, peak))
        };
        let (all, within) = (described(all), within.map(described));
        line(ui, &fill("stable motions: {what}", &[("what", &all.0)]));
        safe_part(ui, &all, within.as_ref());
        let (_, (resistance, peak)) = within.unwrap_or(all);
        // Half of a search may be far from the best.
        if ui.add_enabled(finished, egui::Button::new(tr("Use both"))).clicked() {
            go_to(context, peak.frequency);
            use_load(context, resistance);
        }
        line(ui, tr("A start at rest may lead to another motion."));
    }
    say_cut(ui, best.iter().any(|best| best.cut));
    let held = held(context.view);
    line(ui, &fill("Within the window of frequencies of the page Harvest, {held}.", &[("held", &held)]));
}
