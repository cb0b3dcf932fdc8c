//! How far the model can be trusted at the present amplitude: force laws and numbers of modes against each other.

use egui::{Grid, RichText, Ui};

use super::beside::LEAST_HEIGHT;
use super::known;
use crate::app::panels::magnet_force::NAMES;
use crate::app::panels::spec::Place;
use crate::app::panels::{Context, grid, list, plots};
use crate::app::text::{fill, say, tr};
use crate::app::theme;
use crate::app::widgets::number::{significant, with_unit};
use crate::app::widgets::{Card, chips, touch};
use crate::dynamics::Motion;
use crate::model::{ForceLaw, MAX_MODES};
use crate::questions::design::trust::{
    LAWS, LawError, MomentError, Quantity, TrustEntry, law_error, moment_errors,
};
use crate::questions::trust::Entry;
use crate::scheduler::{Failure, Table};
use crate::theory::Resonance;

/// The model that stands for the truth.
const BEST: (usize, ForceLaw) = (4, ForceLaw::Exact);
/// Relative difference from the exact law with most modes that counts as a good one, and as a bad one.
const GOOD: f64 = 0.05;
const BAD: f64 = 0.25;
/// Width from which the cards stand side by side.
const TWO_COLUMNS: f32 = 900.0;
/// Width below which the table's columns stand close together.
const PHONE: f32 = 360.0;

/// Draws the page.
pub(super) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    let room = ui.available_size();
    let plots = |context: &mut Context<'_>, ui: &mut Ui, height: f32| {
        let size = [ui.available_width(), height];
        plots::column(context, ui, size, LEAST_HEIGHT);
    };
    if plots::alone(context, &list::at(Place::of(context.view))).is_some() {
        plots(context, ui, room.y);
    } else if room.x < TWO_COLUMNS {
        switch(context, ui);
        ui.add_space(grid::GAP);
        convergence(context, ui);
        ui.add_space(grid::GAP);
        known::show(ui);
        ui.add_space(grid::GAP);
        plots(context, ui, LEAST_HEIGHT);
    } else {
        ui.columns(2, |columns| {
            convergence(context, &mut columns[0]);
            columns[0].add_space(grid::GAP);
            switch(context, &mut columns[0]);
            columns[0].add_space(grid::GAP);
            known::show(&mut columns[0]);
            plots(context, &mut columns[1], room.y);
        });
    }
}

fn switch(context: &mut Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    Card::new(tr("At the present amplitude")).hugging().show(ui, |ui| {
        laws(context, ui);
        ui.add_space(8.0);
        let present = context.view.scenario.model;
        if (present.modes, present.force) == BEST {
            let back = context.bench.before;
            let text = fill("Back to {model}", &[("model", &in_words((back.modes, back.force)))]);
            if ui.button(text).clicked() {
                adopt(context, (back.modes, back.force));
            }
        } else if ui.button(tr("Switch the whole page to the exact law, 4 modes")).clicked() {
            adopt(context, BEST);
        }
        let text = fill(
            "The page computes with {model}. Click a number in the table to compute with that model.",
            &[("model", &in_words((present.modes, present.force)))],
        );
        ui.add(egui::Label::new(RichText::new(text).small().color(tokens.text_weak)).wrap());
    });
}

fn in_words((modes, force): (usize, ForceLaw)) -> String {
    let law = match force {
        ForceLaw::Quadratic => tr("the quadratic law").to_owned(),
        ForceLaw::Taylor(degree) => fill("Taylor {degree}", &[("degree", &degree)]),
        ForceLaw::Exact => tr("the exact law").to_owned(),
    };
    match modes {
        1 => fill("{law}, 1 mode", &[("law", &law)]),
        modes => fill("{law}, {modes} modes", &[("law", &law), ("modes", &modes)]),
    }
}

fn adopt(context: &mut Context<'_>, (modes, force): (usize, ForceLaw)) {
    context.edit(|scenario| {
        scenario.set_modes(modes);
        scenario.model.force = force;
    });
}

/// How far each force law is off where the motion goes.
fn laws(context: &Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let found = context.studies.operating(&context.view.scenario);
    let Some((Ok(operating), _)) = found else { return };
    let Some(harvest) = &operating.reached.harvest else {
        ui.label(tr("The motion ends: there is no amplitude to judge."));
        return;
    };
    let Ok((system, _)) = context.view.scenario.validate() else { return };
    let units = context.view.scenario.units();
    let (low, high) = harvest.demand.tip;
    ui.spacing_mut().interact_size.y = 20.0;
    Grid::new("laws").num_columns(3).spacing([18.0, 4.0]).show(ui, |ui| {
        let heads = [
            tr("force law").to_owned(),
            fill("closest, {distance} mm", &[("distance", &significant(units.millimetres(low), 3))]),
            fill("farthest, {distance} mm", &[("distance", &significant(units.millimetres(high), 3))]),
        ];
        for head in heads {
            ui.label(RichText::new(head).small().color(tokens.text_weak));
        }
        ui.end_row();
        for (law, name) in LAWS.into_iter().zip(NAMES).take(3) {
            ui.label(tr(name));
            for tip in [low, high] {
                let error = law_error(&system, law, tip);
                let colour = error.rest.map_or(tokens.danger, |off| shade(off.abs(), tokens));
                let label = ui.label(RichText::new(off(&error)).color(colour));
                if let Some(whole) = error.whole {
                    let percent = significant(100.0 * whole, 2);
                    label.on_hover_text(fill(
                        "{percent} % of the whole restoring force at the tip",
                        &[("percent", &percent)],
                    ));
                }
            }
            ui.end_row();
        }
    });
    let text = tr(
        "How much more (+) or less (−) than the magnets' own force each law gives beyond its linear part.",
    );
    ui.add(egui::Label::new(RichText::new(text).small().color(tokens.text_weak)).wrap());
}

fn off(error: &LawError) -> String {
    error.rest.map_or(tr("contact").to_owned(), |rest| {
        let sign = if rest > 0.0 { "+" } else { "" };
        format!("{sign}{} %", significant(100.0 * rest, 2))
    })
}

fn shade(off: f64, tokens: &theme::Tokens) -> egui::Color32 {
    if off <= GOOD {
        tokens.ok
    } else if off <= BAD {
        tokens.warning
    } else {
        tokens.danger
    }
}

/// The quantity in view over modes and laws.
fn convergence(context: &mut Context<'_>, ui: &mut Ui) {
    let hint = context.computing::<Table<Entry>>("");
    Card::new(tr("Over modes and force laws")).hint(&hint).hugging().show(ui, |ui| {
        choose(context, ui);
        ui.add_space(4.0);
        table(context, ui);
        ui.add_space(4.0);
        moment(context, ui);
    });
}

/// How far the modes left out are missed in the circuit, with and without what stands for them.
fn moment(context: &Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let model = context.view.scenario.model;
    let found = moment_errors(&context.view.scenario, model.modes);
    let Some(MomentError { without: Some(without), with: Some(with), .. }) = found.ok() else { return };
    let percent = |error: f64| {
        let sign = if error > 0.0 { "+" } else { "" };
        format!("{sign}{}", significant(100.0 * error, 2))
    };
    let present = if model.residual_moment { with } else { without };
    let text = fill(
        "Modes left out: the voltage of the linear device is off by {without} % here, by {with} % when they count in the \
         circuit (see Model). Measured against the whole beam.",
        &[("without", &percent(without)), ("with", &percent(with))],
    );
    let colour = shade(present.abs(), tokens);
    ui.add(egui::Label::new(RichText::new(text).small().color(colour)).wrap());
}

fn choose(context: &mut Context<'_>, ui: &mut Ui) {
    let mut quantity = context.view.design.quantity;
    let threshold = match quantity {
        Quantity::Threshold(resonance) => resonance,
        _ => context.view.design.resonance,
    };
    let choices = [
        (Quantity::Power, tr("power")),
        (Quantity::Voltage, tr("voltage")),
        (Quantity::Tip, tr("tip")),
        (Quantity::Threshold(threshold), tr("threshold")),
    ];
    ui.horizontal_wrapped(|ui| {
        let mut changed = chips(ui, tr("Compared"), &mut quantity, &choices);
        if let Quantity::Threshold(resonance) = &mut quantity {
            let resonances =
                [(Resonance::First, "2ω₁"), (Resonance::Sum, "ω₁+ω₂"), (Resonance::Second, "2ω₂")];
            changed |= chips(ui, tr("Threshold of"), resonance, &resonances);
        }
        if changed {
            context.redesign(|design| design.quantity = quantity);
        }
    });
}

fn table(context: &mut Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let Some(study) = context.studies.lanes.study::<Table<Entry>>() else { return };
    let entries: Vec<Option<Result<&TrustEntry, &Failure>>> = study.found().collect();
    let value = |index: usize| entries.get(index).and_then(|entry| entry.as_ref()?.as_ref().ok()?.value);
    let truth = value(entries.len().saturating_sub(1));
    let quantity = context.view.design.quantity;
    ui.spacing_mut().interact_size.y = 24.0;
    let gap = if ui.available_width() < PHONE { 5.0 } else { 16.0 };
    touch::sideways(ui.ctx()).id_salt("trust").show(ui, |ui| {
        Grid::new("trust").num_columns(LAWS.len() + 1).spacing([gap, 3.0]).show(ui, |ui| {
            ui.label(RichText::new(tr("modes")).small().color(tokens.text_weak));
            for name in NAMES {
                ui.label(RichText::new(tr(name)).small().color(tokens.text_weak));
            }
            ui.end_row();
            for (row, modes) in (1..=MAX_MODES).enumerate() {
                ui.label(modes.to_string());
                for (column, law) in LAWS.into_iter().enumerate() {
                    let entry = entries.get(row * LAWS.len() + column).copied().flatten();
                    let (text, said) = in_a_cell(entry, quantity);
                    let known = entry.and_then(Result::ok).and_then(|entry| entry.value);
                    let colour = match (known, truth) {
                        (Some(value), Some(truth)) if truth != 0.0 => {
                            shade((value / truth - 1.0).abs(), tokens)
                        }
                        _ => tokens.text_weak,
                    };
                    let chosen = context.view.scenario.model;
                    let present = (chosen.modes, chosen.force) == (modes, law);
                    let button = egui::Button::new(RichText::new(text).color(colour)).frame(present);
                    if ui.add(button).on_hover_text(said).clicked() {
                        adopt(context, (modes, law));
                    }
                }
                ui.end_row();
            }
        });
    });
    let text = tr(
        "From the start in view. Coloured by the difference from 8 modes under the exact law: green to 5 %, amber to 25 %. \
         Motions of different classes do not converge to each other.",
    );
    ui.add(egui::Label::new(RichText::new(text).small().color(tokens.text_weak)).wrap());
}

/// An entry in digits, and what to say about it.
fn in_a_cell(entry: Option<Result<&TrustEntry, &Failure>>, quantity: Quantity) -> (String, String) {
    let entry = match entry {
        None => return ("…".to_owned(), tr("computing").to_owned()),
        Some(Err(failure)) => return ("–".to_owned(), say(failure)),
        Some(Ok(entry)) => entry,
    };
    let said = entry.motion.map_or(String::new(), |motion| say(&motion));
    let text = match (entry.value, quantity, entry.motion) {
        (Some(value), Quantity::Power, _) => with_unit(value, "W"),
        (Some(value), Quantity::Voltage, _) => with_unit(value, "V"),
        (Some(value), Quantity::Tip, _) => format!("{} mm", significant(value, 3)),
        (Some(value), Quantity::Threshold(_), _) => significant(value, 4),
        (None, _, Some(Motion::Contact { .. })) => tr("contact").to_owned(),
        (None, _, Some(_)) => tr("escape").to_owned(),
        (None, _, None) => tr("none").to_owned(),
    };
    (text, said)
}
