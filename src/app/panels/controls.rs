//! The left column: the three main controls, the folded structure, the beam.

use egui::Ui;

use super::design::shaken_by;
use super::frequency::resonance_marks;
use super::{Context, beam, device, facts, structure};
use crate::app::map::Boundaries;
use crate::app::text::fill;
use crate::app::view::Tab;
use crate::app::widgets::number::short;
use crate::model::{Parameter, ParameterSet, Part, Units};

/// Draws the column.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    above(context, ui);
    ui.add_space(4.0);
    below(context, ui);
}

/// What stands above the plots where there is one column: what is changed most.
pub(in crate::app) fn above(context: &mut Context<'_>, ui: &mut Ui) {
    let in_si = device::is_shown(context.view);
    let is_shaken = context.view.shaken().is_some();
    // Lessons are about the sine.
    let may_be = matches!(context.view.tab, Tab::Explore | Tab::Live) && context.view.lesson.is_none();
    if is_shaken || may_be {
        shaken_by::choose(context, ui, true);
    }
    if is_shaken {
        shaken_by::controls(context, ui);
        if !in_si {
            main_controls(context, ui, &[Parameter::Alpha]);
        }
    } else if in_si {
        device::excitation(context, ui);
    } else {
        device::choose_units(context, ui);
        main_controls(context, ui, &Parameter::of(&[Part::Main]));
    }
}

/// What stands below them: structure and beam.
pub(in crate::app) fn below(context: &mut Context<'_>, ui: &mut Ui) {
    if device::is_shown(context.view) {
        device::structure(context, ui);
    } else {
        structure::show(context, ui);
    }
    // The Live tab has its own, and this one moves with the sine.
    if context.view.tab != Tab::Live && context.view.shaken().is_none() {
        ui.add_space(4.0);
        beam::show(context, ui);
    }
}

/// Damping, excitation, frequency, or some of them.
fn main_controls(context: &mut Context<'_>, ui: &mut Ui, shown: &[Parameter]) {
    let mut set = context.view.scenario.parameters;
    let before = set;
    let units = context.view.scenario.units();
    let boundaries = context.session.boundaries.as_ref();
    let marks = boundaries.map_or_else(Vec::new, resonance_marks);
    for parameter in shown.iter().copied() {
        let (secondary, marks) = match parameter {
            Parameter::Alpha => (damping_in_words(boundaries, &set), &[][..]),
            Parameter::Beta => (excitation_in_words(&units, &set), &[][..]),
            Parameter::Omega => (frequency_in_words(&units, &set), &marks[..]),
            _ => (String::new(), &[][..]),
        };
        facts::of_parameter(&mut set, parameter).marks(marks).secondary(&secondary).show(ui);
    }
    if set != before {
        context.edit(|scenario| scenario.parameters = set);
    }
}

fn damping_in_words(boundaries: Option<&Boundaries>, set: &ParameterSet) -> String {
    // The paper's beam alone, then with the circuit: the decay of the coupled modes.
    let ratio = boundaries.and_then(|boundaries| boundaries.coupled.as_ref()).and_then(|coupled| {
        coupled.modes().first().map(|mode| 100.0 * mode.decay / mode.decay.hypot(mode.frequency))
    });
    match ratio {
        Some(percent) if set.alpha.is_finite() => fill(
            "mode 1 with its circuit: damping ratio {percent} %",
            &[("percent", &format!("{percent:.2}"))],
        ),
        _ => String::new(),
    }
}

fn excitation_in_words(units: &Units, set: &ParameterSet) -> String {
    let acceleration = units.acceleration(set.beta, set.omega);
    format!("B {} mm  ·  {} g", short(units.millimetres(set.beta)), short(acceleration))
}

fn frequency_in_words(units: &Units, set: &ParameterSet) -> String {
    let hertz = units.hertz(set.omega);
    fill("{hertz} Hz  ·  period {seconds} s", &[("hertz", &short(hertz)), ("seconds", &short(1.0 / hertz))])
}
