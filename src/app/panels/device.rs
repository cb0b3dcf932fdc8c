//! The device in SI units: every dimension on a slider, and the base's motion.

use std::f64::consts::TAU;

use egui::{RichText, Ui};

use super::Context;
use super::controls::{resonance_marks, short};
use super::structure;
use crate::app::command::Command;
use crate::app::text::{fill, reworded, tr};
use crate::app::view::{Tab, View};
use crate::app::widgets::{Fold, Mark, ParameterSlider, chips};
use crate::app::{bench, theme};
use crate::model::inverse::Magnets;
use crate::model::{Device, Dimension, ElectricalScaling, Parameter};
use crate::scenario::Scenario;

/// Largest acceleration (g) on the slider.
const MOST_ACCELERATION: f64 = 5.0;
const LEAST_ACCELERATION: f64 = 1e-3;

/// Whether the left column is the device.
pub(super) fn is_shown(view: &View) -> bool {
    view.tab == Tab::Design && !view.design.dimensionless
}

/// The switch between SI units and the ten numbers; only the Design tab has it.
pub(super) fn choose_units(context: &mut Context<'_>, ui: &mut Ui) {
    if context.view.tab != Tab::Design {
        return;
    }
    let mut dimensionless = context.view.design.dimensionless;
    let choices = [(false, tr("SI units")), (true, tr("dimensionless"))];
    if chips(ui, tr("Units"), &mut dimensionless, &choices) {
        context.redesign(|design| design.dimensionless = dimensionless);
    }
    ui.add_space(6.0);
}

/// How a dimension is called, written and shown: name, symbol, unit with its factor, what it is.
type Words = (&'static str, &'static str, &'static str, f64, &'static str);

/// The words of a dimension; the coupling's unit depends on the scaling.
pub(in crate::app) fn words(dimension: Dimension) -> Words {
    match dimension {
        Dimension::FluxDensity => {
            (tr("Flux density"), "ρ", "T", 1.0, tr("Residual flux density of the magnets."))
        }
        Dimension::Permeability => {
            (tr("Permeability"), "μ", "µH/m", 1e6, tr("Permeability of the air between them."))
        }
        Dimension::MagnetLength => (tr("Length"), "H", "mm", 1e3, tr("Length of each magnet.")),
        Dimension::MagnetRadius => (tr("Radius"), "R", "mm", 1e3, tr("Radius of each magnet.")),
        Dimension::MagnetArea => (tr("Area"), "S", "mm²", 1e6, tr("Common area of the magnets.")),
        Dimension::MagnetDistance => {
            (tr("Distance"), "D", "mm", 1e3, tr("Distance of the magnets before the beam sags."))
        }
        Dimension::BeamLength => (tr("Length"), "L", "mm", 1e3, tr("Length of the cantilever.")),
        Dimension::BeamMass => (tr("Mass"), "m", "g", 1e3, tr("Mass of the cantilever.")),
        Dimension::TipMass => (tr("Tip mass"), "", "g", 1e3, tr("Mass at the tip, magnet included.")),
        Dimension::YoungsModulus => (tr("Modulus"), "E", "GPa", 1e-9, tr("Young's modulus of the beam.")),
        Dimension::SecondMoment => {
            (tr("2nd moment"), "I", "mm⁴", 1e12, tr("Second moment of area of its section."))
        }
        Dimension::Viscosity => {
            (tr("Viscosity"), "Λ", "MPa s", 1e-6, tr("Kelvin-Voigt viscosity of the beam: its damping."))
        }
        Dimension::Gravity => {
            (tr("Gravity"), "g", "m/s²", 1.0, tr("Acceleration of gravity, which makes the beam sag."))
        }
        Dimension::Capacitance => (tr("Capacity"), "C", "nF", 1e9, tr("Capacitance C_eq of the ceramic.")),
        Dimension::Resistance => (tr("Load"), "R", "MΩ", 1e-6, tr("Load resistance R_eq.")),
        Dimension::Coupling => (tr("Coupling"), "Θ", "µN/V", 1e6, tr("Electromechanical coupling.")),
        Dimension::BaseAmplitude => (tr("Amplitude"), "B", "mm", 1e3, tr("Amplitude of the base's motion.")),
        Dimension::Frequency => (tr("Frequency"), "f", "Hz", 1.0, tr("Frequency of the base's motion.")),
        Dimension::CeramicThickness => (
            tr("Thickness"),
            "",
            "mm",
            1e3,
            tr("Thickness of the ceramic, which decides what voltage it bears."),
        ),
        Dimension::LossTangent => (
            tr("Loss"),
            "tan δ",
            "%",
            1e2,
            tr("Dielectric dissipation factor of the ceramic: a conductance beside the load."),
        ),
    }
}

/// One compact slider for a dimension; its range is the usual one, widened to the present value.
fn slider(ui: &mut Ui, device: &mut Device, dimension: Dimension) -> bool {
    let (name, symbol, unit, factor, tooltip) = words(dimension);
    let (low, high) = dimension.usual();
    let present = dimension.get(device);
    let present = if present.is_finite() { present } else { high };
    let mut value = round(factor * present);
    let (low, high) = (round(factor * low).min(value), round(factor * high).max(value));
    let default = round(factor * dimension.get(&Device::default()));
    let slider = ParameterSlider::new(name, symbol, &mut value, low..=high)
        .default_value(default)
        .unit(unit)
        .tooltip(tooltip)
        .compact();
    let slider = match dimension {
        _ if dimension.logarithmic() && low > 0.0 => slider.logarithmic(),
        Dimension::TipMass => slider.logarithmic_from(1e-2),
        Dimension::Viscosity | Dimension::Coupling | Dimension::BaseAmplitude => {
            slider.logarithmic_from(1e-4 * high)
        }
        _ => slider,
    };
    let changed = slider.show(ui).changed;
    if changed {
        *dimension.get_mut(device) = value / factor;
    }
    changed
}

/// The slider for one dimension where there is nothing else of the device.
pub(super) fn alone(context: &mut Context<'_>, ui: &mut Ui, dimension: Dimension) {
    let Some(mut device) = device_of(context, ui) else { return };
    if slider(ui, &mut device, dimension) {
        adopt(context, device, context.view.scenario.scaling);
    }
}

/// Without the last digits, which are what is left of the factor.
fn round(value: f64) -> f64 {
    crate::app::widgets::number::round_significant(value, 12)
}

/// Takes a changed device over.
fn adopt(context: &mut Context<'_>, device: Device, scaling: ElectricalScaling) {
    let mut scenario = context.view.scenario.clone();
    let changed = scenario.set_device(device, scaling).and_then(|()| scenario.validate().map(|_| ()));
    let taken = changed.map(|()| Box::new(scenario)).map_err(|error| error.to_string());
    context.commands.push(Command::Adopt(taken));
}

/// The device, or a sentence about the numbers that belong to none.
fn device_of(context: &Context<'_>, ui: &mut Ui) -> Option<Device> {
    match bench::device(&context.view.scenario) {
        Ok(device) => Some(device),
        Err(error) => {
            let colour = theme::tokens(ui).danger;
            let text = fill(
                "These numbers belong to no device: {error}.",
                &[("error", &reworded(&error.to_string()))],
            );
            ui.add(egui::Label::new(RichText::new(text).small().color(colour)).wrap());
            None
        }
    }
}

/// Frequency and base motion.
pub(super) fn excitation(context: &mut Context<'_>, ui: &mut Ui) {
    choose_units(context, ui);
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
        let (name, symbol, unit, factor, tooltip) = words(Dimension::BaseAmplitude);
        let mut amplitude = round(factor * device.base_amplitude);
        let high = (factor * Dimension::BaseAmplitude.usual().1).max(amplitude);
        let acceleration = format!("{} g", short(device.acceleration()));
        ParameterSlider::new(name, symbol, &mut amplitude, 0.0..=high)
            .logarithmic_from(1e-3)
            .unit(unit)
            .tooltip(tooltip)
            .secondary(&acceleration)
            .show(ui);
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
        let text = fill("Not changed: {reason}.", &[("reason", &reworded(reason))]);
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
        mark.value = crate::app::widgets::number::round_significant(units.hertz(mark.value), 6);
    }
    let (lowest, highest) = (super::controls::FREQUENCIES.0, super::controls::FREQUENCIES.1);
    let low = round(units.hertz(lowest)).min(value);
    let high = round(units.hertz(highest)).max(value);
    let period = fill(
        "period {seconds} s  ·  ω = {omega}",
        &[
            ("seconds", &short(1.0 / device.frequency)),
            ("omega", &short(TAU * device.frequency * units.time)),
        ],
    );
    ParameterSlider::new(tr("Frequency"), "f", &mut value, low..=high)
        .marks(&marks)
        .unit("Hz")
        .tooltip(tr("Frequency of the base's motion. Click a mark to go to a resonance."))
        .secondary(&period)
        .show(ui);
    if value != present {
        device.frequency = value;
    }
}

/// Beam, magnets, circuit, ceramic, model and start.
pub(super) fn structure(context: &mut Context<'_>, ui: &mut Ui) {
    if let Some(device) = device_of(context, ui) {
        let before = context.view.scenario.scaling;
        let (mut changed, mut scaling) = (device, before);
        beam(ui, &mut changed);
        magnets(ui, &mut changed);
        circuit(ui, &mut changed, &mut scaling);
        if (changed, scaling) != (device, before) {
            adopt(context, changed, scaling);
        }
    }
    let scenario: Scenario = context.view.scenario.clone();
    let mut changed = scenario.clone();
    structure::model_and_start(ui, &mut changed);
    if changed != scenario {
        context.edit(|scenario| *scenario = changed);
    }
    paper(context, ui);
}

fn beam(ui: &mut Ui, device: &mut Device) {
    let of = |dimension: Dimension, device: &Device| short(words(dimension).3 * dimension.get(device));
    let summary =
        format!("L {} mm  ·  {} g", of(Dimension::BeamLength, device), of(Dimension::BeamMass, device));
    Fold::new(tr("Beam")).summary(&summary).default_open(true).show(ui, |ui| {
        for dimension in [
            Dimension::BeamLength,
            Dimension::BeamMass,
            Dimension::TipMass,
            Dimension::YoungsModulus,
            Dimension::SecondMoment,
            Dimension::Viscosity,
            Dimension::Gravity,
        ] {
            slider(ui, device, dimension);
        }
    });
}

fn magnets(ui: &mut Ui, device: &mut Device) {
    let kinds = [
        (Magnets::Repelling, tr("repelling")),
        (Magnets::Attracting, tr("attracting")),
        (Magnets::Absent, tr("absent")),
    ];
    let mut kind = device.magnets();
    let word = kinds.iter().find(|(of, _)| *of == kind).map_or("", |(_, word)| *word);
    let summary = format!("{word}  ·  D {} mm", short(1e3 * device.magnet_distance));
    Fold::new(tr("Magnets")).summary(&summary).default_open(true).show(ui, |ui| {
        if chips(ui, tr("Magnets"), &mut kind, &kinds) {
            *device = device.with_magnets(kind, &Device::default());
        }
        ui.push_id("magnets", |ui| {
            for dimension in [
                Dimension::MagnetDistance,
                Dimension::FluxDensity,
                Dimension::MagnetLength,
                Dimension::MagnetRadius,
                Dimension::MagnetArea,
                Dimension::Permeability,
            ] {
                slider(ui, device, dimension);
            }
        });
    });
}

fn circuit(ui: &mut Ui, device: &mut Device, scaling: &mut ElectricalScaling) {
    let load = crate::app::widgets::number::with_unit(device.resistance, "Ω");
    Fold::new(tr("Circuit and ceramic")).summary(&load).default_open(true).show(ui, |ui| {
        for dimension in [
            Dimension::Resistance,
            Dimension::Capacitance,
            Dimension::Coupling,
            Dimension::CeramicThickness,
            Dimension::LossTangent,
        ] {
            slider(ui, device, dimension);
        }
        let choices = [
            (ElectricalScaling::AsPrinted, tr("as printed")),
            (ElectricalScaling::Consistent, tr("consistent units")),
        ];
        ui.add_space(4.0);
        chips(ui, tr("Electrical scaling"), scaling, &choices);
        let text = RichText::new(scaling.explanation()).small().color(theme::tokens(ui).text_weak);
        ui.add(egui::Label::new(text).wrap());
    });
}

/// Back to the paper's device, which keeps its excitation.
fn paper(context: &mut Context<'_>, ui: &mut Ui) {
    ui.add_space(4.0);
    if ui.button(tr("Table 1: the paper's device")).clicked() {
        let own = context.view.scenario.parameters;
        let mut scenario = context.view.scenario.clone();
        let taken = scenario.set_device(Device::default(), ElectricalScaling::AsPrinted).map(|()| {
            for parameter in [Parameter::Omega, Parameter::Beta, Parameter::Alpha] {
                *parameter.get_mut(&mut scenario.parameters) = parameter.get(&own);
            }
            Box::new(scenario)
        });
        context.commands.push(Command::Adopt(taken.map_err(|error| error.to_string())));
    }
}
