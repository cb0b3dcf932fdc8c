//! Beam, magnets, circuit and ceramic, and devices to begin with.

use egui::{RichText, Ui};

use super::{adopt, damping, device_of, layers, slider};
use crate::app::panels::Context;
use crate::app::panels::structure::model_and_start;
use crate::app::text::tr;
use crate::app::widgets::number::{short, with_unit};
use crate::app::widgets::{Fold, chips};
use crate::app::{bench, theme};
use crate::model::inverse::Magnets;
use crate::model::{Device, Dimension, ElectricalScaling, Layers, Part};
use crate::scenario::Scenario;

/// Beam, magnets, circuit, ceramic, model and start.
pub(in crate::app::panels) fn structure(context: &mut Context<'_>, ui: &mut Ui) {
    if let Some(device) = device_of(context, ui) {
        let before = context.view.scenario.scaling;
        let (mut changed, mut scaling) = (device, before);
        beam(context, ui, &mut changed, scaling);
        magnets(ui, &mut changed, scaling);
        circuit(ui, &mut changed, &mut scaling);
        if (changed, scaling) != (device, before) {
            adopt(context, changed, scaling);
        }
    }
    let scenario: Scenario = context.view.scenario.clone();
    let mut changed = scenario.clone();
    model_and_start(ui, &mut changed);
    if changed != scenario {
        context.edit(|scenario| *scenario = changed);
    }
}

fn sliders(ui: &mut Ui, device: &mut Device, parts: &[Part], scaling: ElectricalScaling) {
    let decided = |dimension: &Dimension| device.layers.is_some() && Layers::DECIDED.contains(dimension);
    let mut own = Dimension::of(parts);
    own.retain(|dimension| !decided(dimension));
    for dimension in own {
        slider(ui, device, dimension, scaling);
    }
}

fn beam(context: &mut Context<'_>, ui: &mut Ui, device: &mut Device, scaling: ElectricalScaling) {
    let of = |dimension: Dimension, device: &Device| short(dimension.fact().shown.1 * device.get(dimension));
    let summary =
        format!("L {} mm  ·  {} g", of(Dimension::BeamLength, device), of(Dimension::BeamMass, device));
    Fold::new(tr("Beam")).summary(&summary).default_open(true).show(ui, |ui| {
        layers::show(ui, device);
        sliders(ui, device, &[Part::Beam], scaling);
        damping::show(context, ui);
    });
}

fn magnets(ui: &mut Ui, device: &mut Device, scaling: ElectricalScaling) {
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
        ui.push_id("magnets", |ui| sliders(ui, device, &[Part::Magnets], scaling));
    });
}

fn circuit(ui: &mut Ui, device: &mut Device, scaling: &mut ElectricalScaling) {
    let load = with_unit(device.resistance, "Ω");
    Fold::new(tr("Circuit and ceramic")).summary(&load).default_open(true).show(ui, |ui| {
        sliders(ui, device, &[Part::Circuit, Part::Ceramic], *scaling);
        if device.layers.is_some() {
            return;
        }
        let choices = [
            (ElectricalScaling::AsPrinted, tr("as printed")),
            (ElectricalScaling::Consistent, tr("consistent units")),
        ];
        ui.add_space(4.0);
        chips(ui, tr("Electrical scaling"), scaling, &choices);
        let text = match scaling {
            ElectricalScaling::AsPrinted => tr(
                "As the paper prints it: capacitance, load and coupling are scaled with L², which gives the paper's \
                 numbers from the paper's device but counts the coupling in N/V.",
            ),
            ElectricalScaling::Consistent => tr(
                "Consistent in its units: capacitance, load and coupling are scaled with L, as a moment ΘV with Θ in \
                 N m/V demands; choose it for a device of your own.",
            ),
        };
        let text = RichText::new(text).small().color(theme::tokens(ui).text_weak);
        ui.add(egui::Label::new(text).wrap());
        if bench::printed_for_own(device, *scaling) {
            let colour = theme::tokens(ui).warning;
            let text = tr("This beam is not the paper's: choose consistent units.");
            ui.add(egui::Label::new(RichText::new(text).small().color(colour)).wrap());
        }
    });
}
