//! Devices to begin with: the paper's, published ones, and a small one of one's own.

use super::Context;
use crate::app::command::Command;
use crate::app::text::tr;
use crate::model::materials::Ceramic;
use crate::model::{Device, ElectricalScaling, Parameter, STANDARD_GRAVITY};
use crate::questions::design::published::{BIMORPH, PAPER, Published, UNIMORPH};
use crate::sentence::Sentence;

/// A steel beam of 60 mm with a ceramic patch and small neodymium magnets, shaken at 0.2 g near its first resonance
/// into its best load there.
const STEEL_BEAM: Device = Device {
    flux_density: 1.2,
    permeability: 1.256e-6,
    magnet_length: 5e-3,
    magnet_radius: 2.5e-3,
    magnet_area: 1.9635e-5,
    repelling: true,
    magnet_distance: 20e-3,
    beam_length: 60e-3,
    beam_mass: 1.41e-3,
    tip_mass: 0.74e-3,
    youngs_modulus: 200e9,
    second_moment: 2.25e-14,
    viscosity: 8.2e6,
    tip_inertia: 0.0,
    tip_offset: 0.0,
    air_damping: 0.0,
    gravity: STANDARD_GRAVITY,
    capacitance: 13e-9,
    resistance: 18e3,
    coupling: 25e-6,
    base_amplitude: 2.75051e-5,
    frequency: 42.5,
    ceramic_thickness: 0.2e-3,
    loss_tangent: 0.02,
    ceramic: Some(Ceramic::Apc850),
    layers: None,
};

/// What a published device is called.
pub(in crate::app::panels) fn name(published: &Published) -> &'static str {
    match published.name {
        name if name == UNIMORPH.name => tr("Unimorph of 2008"),
        name if name == BIMORPH.name => tr("Bimorph T226-A4"),
        _ => tr("Table 1: the paper's device"),
    }
}

/// The buttons.
pub(super) fn buttons(context: &mut Context<'_>, ui: &mut egui::Ui) {
    let mut taken = None;
    ui.horizontal_wrapped(|ui| {
        let small = |text: &str| egui::RichText::new(text.to_owned()).small();
        if ui.button(small(name(&PAPER))).on_hover_text(PAPER.source).clicked() {
            // It keeps its excitation.
            let own = context.view.scenario.parameters;
            let mut scenario = context.view.scenario.clone();
            scenario.model.residual_moment = false;
            taken = Some(scenario.set_device(Device::default(), ElectricalScaling::AsPrinted).map(|()| {
                for parameter in [Parameter::Omega, Parameter::Beta, Parameter::Alpha] {
                    *scenario.parameters.get_mut(parameter) = own.get(parameter);
                }
                scenario
            }));
        }
        for published in [UNIMORPH, BIMORPH] {
            if ui.button(small(name(&published))).on_hover_text(published.source).clicked() {
                let mut scenario = context.view.scenario.clone();
                scenario.model.residual_moment = true;
                taken = Some(published.put_into(&mut scenario).map(|()| scenario));
            }
        }
        let example = tr("An example, not published: a steel strip with a ceramic patch, shaken at 0.2 g.");
        if ui.button(small(tr("60 mm steel beam"))).on_hover_text(example).clicked() {
            let mut scenario = context.view.scenario.clone();
            scenario.model.residual_moment = true;
            taken = Some(scenario.set_device(STEEL_BEAM, ElectricalScaling::Consistent).map(|()| scenario));
        }
    });
    ui.add_space(6.0);
    if let Some(taken) = taken {
        context.commands.push(Command::Adopt(taken.map(Box::new).map_err(Sentence::from)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Limits;
    use crate::model::limits::{Check, Standing, sag};
    use crate::questions::design::{Plant, operating};
    use crate::scenario::Scenario;

    #[test]
    fn the_steel_beam_resonates_within_its_limits_and_delivers_microwatts() {
        let mut scenario = Scenario::default();
        scenario.model.residual_moment = true;
        scenario.set_device(STEEL_BEAM, ElectricalScaling::Consistent).expect("a device");
        let (system, _) = scenario.validate().expect("a device");
        let first = system.modes.iter().next().map(|mode| scenario.units().hertz(mode.omega));
        assert!(first.is_some_and(|hertz| (STEEL_BEAM.frequency / hertz - 1.0).abs() < 0.05), "{first:?}");
        assert!((STEEL_BEAM.acceleration() / 0.2 - 1.0).abs() < 0.01, "{}", STEEL_BEAM.acceleration());
        let harvest = operating(&scenario).expect("a device").reached.harvest.expect("it lasts");
        assert!((1e-6..1e-2).contains(&harvest.measures.power), "{}", harvest.measures.power);
        let checks = Limits::of(&STEEL_BEAM).checks(&harvest.demand, Plant::gap(&system));
        let within = |check: &Check| check.standing == Standing::Within;
        assert!(checks.len() > 2 && checks.iter().all(within) && within(&sag(&STEEL_BEAM)), "{checks:?}");
    }
}
