//! The beam itself, in slow motion.

use egui::Ui;

use super::Context;
use crate::app::command::Command;
use crate::app::curves;
use crate::app::text::{fill, tr};
use crate::app::widgets::number::short;
use crate::app::widgets::{BeamView, Card, Icon};
use crate::dynamics::Outcome;

/// Seconds an excitation period takes on the screen.
const SECONDS_PER_PERIOD: f64 = 1.6;
const HEIGHT: f32 = 210.0;

/// Draws the card with the moving beam.
pub(super) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    show_in(context, ui, HEIGHT);
}

/// The same with a picture of this height.
pub(super) fn show_in(context: &mut Context<'_>, ui: &mut Ui, height: f32) {
    let Some(shown) = context.shown() else { return };
    let run = &shown.run;
    let slower = SECONDS_PER_PERIOD / (run.system.parameters.period() * shown.scenario.units().time);
    let hint = match run.outcome() {
        Outcome::Completed if slower >= 1.05 => fill("{factor} times slower", &[("factor", &short(slower))]),
        Outcome::Completed => String::new(),
        Outcome::Escaped { .. } => tr("after the escape").to_owned(),
        Outcome::Contact { .. } => tr("at contact").to_owned(),
    };
    let (icon, label) =
        if context.moves { (Icon::Pause, tr("Hold")) } else { (Icon::Play, tr("Let it move")) };
    let card = Card::new(tr("The beam"))
        .hint(&hint)
        .button(icon, label)
        .hugging()
        .show(ui, |ui| picture(context, ui, height, false));
    if card.pressed.is_some() {
        context.commands.push(Command::MoveBeam(!context.moves));
    }
}

/// The moving picture alone, this high, its parts named where it is to be `labelled`.
pub(super) fn picture(context: &Context<'_>, ui: &mut Ui, height: f32, labelled: bool) {
    let Some(shown) = context.shown() else { return };
    let (run, curves) = (&shown.run, &shown.curves);
    let moves = context.moves && run.outcome() == Outcome::Completed;
    let period = run.system.parameters.period();
    let [from, to] = curves.repeat;
    let clock = if context.moves { ui.input(|input| input.time) } else { 0.0 };
    let time = match run.outcome() {
        Outcome::Completed => from + (clock / SECONDS_PER_PERIOD * period).rem_euclid((to - from).max(1e-9)),
        Outcome::Escaped { .. } | Outcome::Contact { .. } => to,
    };
    let state = run.trajectory.state_at(time);
    let p = &run.system.parameters;
    let shape = curves::beam(&curves.shapes, &state);
    let gap = run.system.equilibrium.gap;
    let open = (gap + run.system.tip_displacement(&state)) / gap;
    let within = |shape: &[[f64; 2]]| shape.iter().all(|point| point[1].abs() < 1.0);
    if !within(&shape) {
        ui.label(tr("The tip has left the picture: the truncated force lets it go."));
        return;
    }
    let extremes: Vec<&[[f64; 2]]> = curves
        .extremes
        .iter()
        .map(Vec::as_slice)
        .filter(|shape| !shape.is_empty() && within(shape))
        .collect();
    let base = p.beta * (p.omega * time).sin();
    let mut beam = BeamView::new(&shape).base(base).extremes(&extremes);
    if p.c0 != 0.0 {
        beam = beam.magnet(-gap, p.c0 < 0.0);
        if run.outcome() == Outcome::Completed {
            beam = beam.gap(open);
        }
    }
    if labelled {
        let found = context.studies.inspection(&shown.scenario).filter(|(_, current)| *current);
        beam = beam.labelled(found.and_then(|(found, _)| found.verdict.v_rms));
    }
    beam.show(ui, height);
    if moves {
        // Every frame takes time from the workers where there are few cores.
        let pause = if context.studies.is_busy() { 160 } else { 33 };
        ui.ctx().request_repaint_after(std::time::Duration::from_millis(pause));
    }
}
