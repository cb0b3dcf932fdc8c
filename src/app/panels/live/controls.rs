//! What drives the run.

use egui::{Button, RichText, Ui};

use super::readout;
use super::traced::{look, si};
use crate::app::command::Command;
use crate::app::live::{End, LiveAction, kick, settled};
use crate::app::panels::Context;
use crate::app::text::{fill, tr};
use crate::app::view::live::{LiveView, SPEEDS};
use crate::app::widgets::number::short;
use crate::app::widgets::{Card, ParameterSlider, chips, chips_after};
use crate::app::{fonts, theme};
use crate::dynamics::Outcome;

/// Kicks to choose from, in gaps.
const KICKS: [(f64, &str); 4] = [(0.05, "5 %"), (0.2, "20 %"), (0.5, "50 %"), (1.0, "100 %")];
/// Excitation periods a second from which the voltage can be heard, and a speed at which it sounds well.
const AUDIBLE: f64 = 20.0;
const SOUNDS_WELL: f64 = 110.0;
/// Width of the speed's slider.
const SPEED_WIDTH: f32 = 380.0;
/// Room between the groups of buttons: a line would be left over where a row ends.
const GROUP_GAP: f32 = 12.0;

/// Draws the card.
pub(in crate::app::panels) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    Card::new("").hugging().show(ui, |ui| {
        ui.horizontal_wrapped(|ui| buttons(context, ui));
        ui.add_space(2.0);
        ui.horizontal_wrapped(|ui| choices(context, ui));
        ui.add_space(6.0);
        readout::show(context, ui);
        state(context, ui);
    });
}

fn button(context: &mut Context<'_>, ui: &mut Ui, label: &str, hint: &str, action: LiveAction) {
    // Only a new start drives a run that has ended.
    let starts = matches!(action, LiveAction::FromRest | LiveAction::FromSettled | LiveAction::Clear);
    let enabled = starts || context.live.ended.is_none();
    if ui.add_enabled(enabled, Button::new(label)).on_hover_text(hint).clicked() {
        context.commands.push(Command::Live(action));
    }
}

fn buttons(context: &mut Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let label = if context.live.running { tr("Pause") } else { tr("Run") };
    let text = RichText::new(label).font(fonts::semibold(theme::size::BODY)).color(tokens.on_accent);
    let run = Button::new(text).fill(tokens.accent).min_size(egui::vec2(74.0, 0.0));
    if ui.add_enabled(context.live.ended.is_none(), run).on_hover_text(tr("Space")).clicked() {
        context.commands.push(Command::Live(LiveAction::Toggle));
    }
    button(context, ui, tr("Step a period"), tr("Key: full stop"), LiveAction::StepPeriod);
    button(context, ui, tr("Step a frame"), tr("Key: comma"), LiveAction::StepFrame);
    ui.add_space(GROUP_GAP);
    button(context, ui, tr("Kick up"), tr("Away from the magnet. Key: K"), LiveAction::Kick(1.0));
    button(context, ui, tr("Kick down"), tr("Towards the magnet. Key: J"), LiveAction::Kick(-1.0));
    ui.add_space(GROUP_GAP);
    button(context, ui, tr("From rest"), tr("Key: R"), LiveAction::FromRest);
    if settled(context.view, context.session).is_some() {
        let hint = tr("Start where the run of the other tabs ends");
        button(context, ui, tr("Settled"), hint, LiveAction::FromSettled);
    }
    button(context, ui, tr("Clear trail"), tr("Key: C"), LiveAction::Clear);
    ui.add_space(GROUP_GAP);
    let mut sounds = context.live.sounds();
    if ui.checkbox(&mut sounds, tr("Sound")).on_hover_text(tr("The voltage, to be heard. Key: S")).changed() {
        context.commands.push(Command::Live(LiveAction::Sound));
    }
    if sounds && context.view.live.speed < AUDIBLE {
        let label = fill("Audible from {speed} periods a second", &[("speed", &AUDIBLE)]);
        note(ui, &label, tokens.warning);
    }
    let label = fill("{speed} periods/s", &[("speed", &SOUNDS_WELL)]);
    if sounds && context.view.live.speed < SOUNDS_WELL && ui.button(label).clicked() {
        look(context, |live| live.speed = SOUNDS_WELL);
    }
}

fn choices(context: &mut Context<'_>, ui: &mut Ui) {
    let mut live = context.view.live;
    let width = SPEED_WIDTH.min(ui.available_width());
    ui.allocate_ui(egui::vec2(width, 26.0), |ui| {
        ParameterSlider::new(tr("Speed"), "", &mut live.speed, SPEEDS.0..=SPEEDS.1)
            .logarithmic()
            .unit("/s")
            .default_value(LiveView::default().speed)
            .tooltip(tr("Excitation periods that pass in a second."))
            .compact()
            .show(ui);
    });
    let weak = theme::tokens(ui).text_weak;
    chips_after(ui, tr("kick"), tr("Strength of a kick"), &mut live.kick, &KICKS);
    if let Some((system, _, _)) = context.live.now() {
        let velocity = kick(&live, system);
        let text = match si(context) {
            Some(units) => {
                let speed = 1e-3 * units.millimetres(velocity) / units.time;
                fill("of the gap: {speed} m/s", &[("speed", &short(speed))])
            }
            None => fill("of the gap: dq₁/dt {speed}", &[("speed", &short(velocity))]),
        };
        let hint = tr("Mode 1 gets this velocity, with which it alone would swing out so far.");
        note(ui, &text, weak).on_hover_text(hint);
    }
    let mut dimensionless = context.view.design.dimensionless;
    let units = [(false, tr("SI units")), (true, tr("dimensionless"))];
    if chips(ui, tr("Units"), &mut dimensionless, &units) {
        context.redesign(|design| design.dimensionless = dimensionless);
    }
    if live != context.view.live {
        look(context, |view| *view = live);
    }
}

/// A small text that goes to the next row as a whole.
fn note(ui: &mut Ui, text: &str, colour: egui::Color32) -> egui::Response {
    ui.add(egui::Label::new(RichText::new(text).small().color(colour)).extend())
}

/// Why the run stands still, and the ways on.
fn state(context: &mut Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let time = |time: f64| match si(context) {
        Some(units) => format!("{} s", short(time * units.time)),
        None => short(time),
    };
    let text = match (&context.live.ended, &context.live.refusal) {
        (Some(End::Outcome(Outcome::Contact { time: at })), _) => {
            fill("The magnets touched at t = {time}: there the model ends.", &[("time", &time(*at))])
        }
        (Some(End::Outcome(outcome)), _) => {
            let at = time(outcome.early_end().unwrap_or_default());
            fill("The tip escaped at t = {time}: this force law lets it go.", &[("time", &at)])
        }
        (Some(End::Failed(reason)), _) => fill("The run cannot go on: {reason}.", &[("reason", reason)]),
        (None, Some(reason)) => fill("Not taken over: {reason}.", &[("reason", reason)]),
        (None, None) => return,
    };
    ui.add_space(6.0);
    ui.add(egui::Label::new(RichText::new(text).color(tokens.danger)).wrap());
    if context.live.ended.is_some() {
        ui.horizontal_wrapped(|ui| {
            button(context, ui, tr("Start again from rest"), tr("Key: R"), LiveAction::FromRest);
            if settled(context.view, context.session).is_some() {
                let hint = tr("Start where the run of the other tabs ends");
                button(context, ui, tr("Start again settled"), hint, LiveAction::FromSettled);
            }
        });
    }
}
