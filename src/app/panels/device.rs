//! The device in SI units: every dimension on a slider, and the base's motion.

mod damping;
mod excitation;
mod layers;
mod parts;
mod presets;
mod refusal;

use egui::{RichText, Ui};

pub(super) use self::excitation::excitation;
pub(super) use self::parts::structure;
pub(super) use self::presets::name as published_name;
use super::{Context, facts};
use crate::app::command::Command;
use crate::app::text::{fill, tr};
use crate::app::view::{Tab, View, opening};
use crate::app::widgets::chips;
use crate::app::widgets::number::prefix;
use crate::app::{bench, theme};
use crate::model::{Device, Dimension, ElectricalScaling, Layers};

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

/// The unit in which a dimension of this value is read, and how many of them one of its SI unit is. Loads go over many
/// powers of ten, each with a unit of its own.
fn shown(dimension: Dimension, value: f64) -> (&'static str, f64) {
    let usual = dimension.fact().shown;
    match (dimension, prefix(value)) {
        (Dimension::Resistance, (factor, "k")) => ("kΩ", factor),
        (Dimension::Resistance, (factor, "")) => ("Ω", factor),
        _ => usual,
    }
}

/// One compact slider for a dimension; its range is the usual one, widened to the present value.
fn slider(ui: &mut Ui, device: &mut Device, dimension: Dimension, scaling: ElectricalScaling) -> bool {
    let fact = dimension.fact();
    let present = device.get(dimension);
    let (unit, factor) = shown(dimension, present);
    let mut value = facts::round(factor * if present.is_finite() { present } else { fact.usual.1 });
    let opening = opening().device().unwrap_or_default();
    let default = facts::round(factor * opening.get(dimension));
    let slider = facts::slider_in(fact, factor, &mut value).default_value(default).unit(scaling.unit(unit));
    let changed = slider.compact().show(ui).changed;
    if changed {
        *device = device.with(dimension, value / factor);
    }
    changed
}

/// The slider for one dimension where there is nothing else of the device.
pub(super) fn alone(context: &mut Context<'_>, ui: &mut Ui, dimension: Dimension) {
    let Some(mut device) = device_of(context, ui) else { return };
    let scaling = context.view.scenario.scaling;
    if slider(ui, &mut device, dimension, scaling) {
        adopt(context, device, scaling);
    }
}

/// Takes a changed device over, or says why it is none. The consistent scaling is that of a device of one's own, for
/// which the modes left out count in the circuit; the printed one is the paper's, where they do not.
pub(super) fn adopt(context: &mut Context<'_>, device: Device, scaling: ElectricalScaling) {
    let scaling = if device.layers.is_some() { Layers::SCALING } else { scaling };
    let mut scenario = context.view.scenario.clone();
    if scaling != scenario.scaling {
        scenario.model.residual_moment = scaling == ElectricalScaling::Consistent;
    }
    let changed = scenario.set_device(device, scaling).and_then(|()| scenario.validate().map(|_| ()));
    let refused = |error| refusal::in_words(&device, scaling, &error);
    let taken = changed.map(|()| Box::new(scenario)).map_err(refused);
    context.commands.push(Command::Adopt(taken));
}

/// The device, or a sentence about the numbers that belong to none.
fn device_of(context: &Context<'_>, ui: &mut Ui) -> Option<Device> {
    match bench::device(&context.view.scenario) {
        Ok(device) => Some(device),
        Err(error) => {
            let colour = theme::tokens(ui).danger;
            let text = fill("These numbers belong to no device: {error}.", &[("error", &error)]);
            ui.add(egui::Label::new(RichText::new(text).small().color(colour)).wrap());
            None
        }
    }
}
