//! A map of any result over two dimensions of the device, and the search for the best.

pub(in crate::app::panels) mod digits;
mod varied;

use egui::{RichText, Ui};

use self::digits::in_digits;
use crate::app::bench::questions;
use crate::app::command::Command;
use crate::app::panels::{Context, grid};
use crate::app::text::{fill, say, tr};
use crate::app::theme;
use crate::app::view::design::Aim;
use crate::app::widgets::number::significant;
use crate::app::widgets::{Card, chips};
use crate::questions::design::space::Objective;
use crate::questions::find::{Candidate, FindStudy};
use crate::scheduler::Study as _;
use crate::sentence::Sentence;

/// The cards beside the map.
pub(super) fn cards(context: &mut Context<'_>, ui: &mut Ui) {
    let held = if context.view.design.holds_acceleration {
        tr("at the base's acceleration")
    } else {
        tr("at the base's amplitude")
    };
    Card::new(tr("Varied")).hint(held).hugging().show(ui, |ui| varied::sides(context, ui));
    ui.add_space(grid::GAP);
    Card::new(tr("Search")).hugging().show(ui, |ui| search(context, ui));
    ui.add_space(grid::GAP);
    Card::new(tr("Limits")).hugging().show(ui, |ui| super::limits::controls(context, ui));
}

fn search(context: &mut Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let small = |text: String| RichText::new(text).small();
    let mut generations = context.view.design.search.generations;
    ui.horizontal_wrapped(|ui| {
        ui.label(small(tr("generations").to_owned()).color(tokens.text_weak));
        if chips(ui, tr("Generations"), &mut generations, &[(10, "10"), (20, "20"), (60, "60")]) {
            context.redesign(|design| design.search.generations = generations);
        }
    });
    if context.view.design.search.aim == Aim::Band {
        let least = context.view.design.least.unwrap_or(questions::LEAST);
        super::bands::least_slider(context, ui, least);
    }
    let found = context.studies.found();
    let label =
        if found.is_some() { tr("Search again from here") } else { tr("Find the best within the limits") };
    if ui.button(label).clicked() {
        context.commands.push(Command::Find(true));
    }
    if let Some(reason) = &context.bench.refusal {
        ui.add(egui::Label::new(small(say(reason) + ".").color(tokens.danger)).wrap());
    }
    let Some(study) = found else {
        let text = tr(
            "Varies what is chosen above by differential evolution, then by small steps from the best places; the \
             device in view is among the first candidates, and the same search goes the same way again.",
        );
        ui.add(egui::Label::new(small(text.to_owned()).color(tokens.text_weak)).wrap());
        return;
    };
    if !study.finished() {
        ui.horizontal(|ui| {
            if ui.button(tr("Stop")).clicked() {
                context.commands.push(Command::Find(false));
            }
            ui.add(egui::ProgressBar::new(study.progress() as f32).desired_height(8.0));
        });
    }
    if let Some(why) = study.failure() {
        ui.add(egui::Label::new(small(say(why)).color(tokens.danger)).wrap());
    }
    let Some(best) = study.best() else { return };
    result(context, ui, study, best);
}

fn result(context: &mut Context<'_>, ui: &mut Ui, study: &FindStudy, best: &Candidate) {
    let tokens = theme::tokens(ui);
    let aim = match study.question().objective {
        Objective::Power => Aim::Power,
        Objective::PowerPerG2 => Aim::PerG2,
        Objective::Voltage => Aim::Voltage,
        Objective::Band { .. } => Aim::Band,
        Objective::Threshold(_) => Aim::Threshold,
    };
    let value =
        best.evaluation.value.map_or(tr("no lasting motion").to_owned(), |value| in_digits(value, aim));
    let kept = best.evaluation.violation == 0.0;
    let colour = if kept { tokens.ok } else { tokens.danger };
    ui.label(RichText::new(value).font(crate::app::fonts::semibold(theme::size::HEADING)).color(colour));
    let text = fill(
        "best of {count} candidates, {kept}",
        &[
            ("count", &study.visited().len()),
            ("kept", &if kept { tr("within the limits") } else { tr("none keeps the limits") }),
        ],
    );
    ui.label(RichText::new(text).small().color(tokens.text_weak));
    for (variable, value) in study.question().variables.iter().zip(&best.values) {
        if let crate::questions::motions::Coordinate::Dimension(dimension) = variable.coordinate {
            let fact = dimension.fact();
            let unit = study.question().scenario.scaling.unit(fact.shown.0);
            let text = format!("{}: {} {unit}", tr(fact.title), significant(fact.shown.1 * value, 4));
            ui.label(RichText::new(text).small().color(tokens.text));
        }
    }
    for (variable, found) in study.question().variables.iter().zip(study.sensitivities()) {
        let crate::questions::motions::Coordinate::Dimension(dimension) = variable.coordinate else {
            continue;
        };
        if found.cliff() {
            let percent = significant(100.0 * found.loss, 2);
            let text = fill(
                "On a cliff: a change by 0.1 % takes {percent} % of it: {variable}",
                &[("percent", &percent), ("variable", &tr(dimension.fact().title))],
            );
            ui.add(egui::Label::new(RichText::new(text).small().color(tokens.danger)).wrap());
        }
    }
    ui.horizontal(|ui| {
        if ui.button(tr("Use it")).clicked() {
            let taken = study.scenario(best).map(Box::new).map_err(Sentence::from);
            context.commands.push(Command::Adopt(taken));
        }
        if study.finished() && ui.button(tr("Close")).clicked() {
            context.commands.push(Command::Find(false));
        }
    });
}
