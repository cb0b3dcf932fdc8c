//! Frequency and motion of the base.

use std::f64::consts::TAU;

use egui::{RichText, Ui};

use super::{adopt, choose_units, device_of, presets};
use crate::app::panels::facts::round;
use crate::app::panels::frequency::resonance_marks;
use crate::app::panels::{Context, facts};
use crate::app::text::{fill, tr};
use crate::app::theme;
use crate::app::widgets::number::{round_significant, short};
use crate::app::widgets::{Mark, ParameterSlider, chips};
use crate::model::{Device, Dimension, Parameter};

/// Largest acceleration (g) on the slider.
const MOST_ACCELERATION: f64 = 5.0;
const LEAST_ACCELERATION: f64 = 1e-3;

/// Frequency and base motion.
pub(in crate::app::panels) fn excitation(context: &mut Context<'_>, ui: &mut Ui) {
    choose_units(context, ui);
    // A lesson has brought its device, and on a phone no room for others.
    if context.view.lesson.is_none() {
        presets::buttons(context, ui);
    }
    let Some(device) = device_of(context, ui) else { return };
    let mut changed = device;
    let scenario = &context.view.scenario;
    frequency(context, ui, &mut changed);
    let mut holds = context.view.design.holds_acceleration;
    if holds && changed.frequency != device.frequency {
        changed = changed.with_acceleration(device.acceleration());
    }
    if holds {
        let mut acceleration = round(device.acceleration());
        let amplitude =
            fill("amplitude {millimetres} mm", &[("millimetres", &short(1e3 * device.base_amplitude))]);
        ParameterSlider::new(
            tr("Shaking"),
            "a",
            &mut acceleration,
            0.0..=MOST_ACCELERATION.max(device.acceleration()),
        )
        .logarithmic_from(LEAST_ACCELERATION)
        .unit("g")
        .tooltip(tr("Amplitude of the base's acceleration, in units of standard gravity."))
        .secondary(&amplitude)
        .show(ui);
        if acceleration != round(device.acceleration()) {
            changed = changed.with_acceleration(acceleration);
        }
    } else {
        let fact = Dimension::BaseAmplitude.fact();
        let (unit, factor) = fact.shown;
        let mut amplitude = round(factor * device.base_amplitude);
        let acceleration = format!("{} g", short(device.acceleration()));
        facts::slider(fact, &mut amplitude).unit(unit).secondary(&acceleration).show(ui);
        if amplitude != round(factor * device.base_amplitude) {
            changed.base_amplitude = amplitude / factor;
        }
    }
    if changed != device {
        adopt(context, changed, scenario.scaling);
    }
    let choices = [(true, tr("hold the g")), (false, tr("hold the mm"))];
    if chips(ui, tr("When the frequency changes"), &mut holds, &choices) {
        context.redesign(|design| design.holds_acceleration = holds);
    }
    if let Some(reason) = &context.bench.refusal {
        let colour = theme::tokens(ui).danger;
        let text = fill("Not changed: {reason}.", &[("reason", reason)]);
        ui.add(egui::Label::new(RichText::new(text).small().color(colour)).wrap());
    }
    ui.add_space(6.0);
}

fn frequency(context: &Context<'_>, ui: &mut Ui, device: &mut Device) {
    let units = context.view.scenario.units();
    let present = round(device.frequency);
    let mut value = present;
    let boundaries = context.session.boundaries.as_ref();
    let mut marks: Vec<Mark> = boundaries.map_or_else(Vec::new, resonance_marks);
    for mark in &mut marks {
        mark.value = round_significant(units.hertz(mark.value), 6);
    }
    let (lowest, highest) = Parameter::Omega.fact().usual;
    let fact = Dimension::Frequency.fact();
    let low = round(units.hertz(lowest)).min(value);
    let high = round(units.hertz(highest)).max(value);
    let period = fill(
        "period {seconds} s  ·  ω = {omega}",
        &[
            ("seconds", &short(1.0 / device.frequency)),
            ("omega", &short(TAU * device.frequency * units.time)),
        ],
    );
    ParameterSlider::new(tr(fact.name), fact.symbol, &mut value, low..=high)
        .marks(&marks)
        .unit(fact.shown.0)
        .tooltip(tr(fact.explanation))
        .secondary(&period)
        .show(ui);
    if value != present {
        device.frequency = value;
    }
}
