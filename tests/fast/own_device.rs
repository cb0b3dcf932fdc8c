//! A device of one's own is typed in dimension by dimension, from that of the paper.

use harvester_lab::model::{Device, Dimension, ElectricalScaling};
use harvester_lab::scenario::Scenario;

/// A steel beam of 60 mm, in the order of the page.
const TYPED: [(Dimension, f64); 13] = [
    (Dimension::BeamLength, 60e-3),
    (Dimension::BeamMass, 1.41e-3),
    (Dimension::TipMass, 0.74e-3),
    (Dimension::YoungsModulus, 200e9),
    (Dimension::SecondMoment, 2.25e-14),
    (Dimension::Viscosity, 8.2e6),
    (Dimension::MagnetDistance, 20e-3),
    (Dimension::MagnetLength, 5e-3),
    (Dimension::MagnetRadius, 2.5e-3),
    (Dimension::FluxDensity, 1.2),
    (Dimension::Capacitance, 13e-9),
    (Dimension::Coupling, 25e-6),
    (Dimension::Resistance, 1e5),
];

/// The steps that are refused, when each change keeps the frequency and the base's amplitude or its acceleration.
fn refused(scaling: ElectricalScaling, holds_acceleration: bool) -> Vec<String> {
    let mut scenario = Scenario::default();
    let mut device = scenario.device().expect("the paper's");
    let acceleration = device.acceleration();
    scenario.set_device(device, scaling).expect("the paper's under both scalings");
    let mut refused = Vec::new();
    for (dimension, value) in TYPED {
        let mut changed = device;
        *changed.get_mut(dimension) = value;
        if holds_acceleration {
            changed = changed.with_acceleration(acceleration);
        }
        let taken = scenario.set_device(changed, scaling).and_then(|()| scenario.validate().map(|_| ()));
        match taken {
            Ok(()) => device = changed,
            Err(error) => refused.push(format!("{}: {error}", dimension.field())),
        }
    }
    refused
}

#[test]
fn every_step_to_a_small_beam_is_accepted() {
    for scaling in ElectricalScaling::ALL {
        for holds in [true, false] {
            let refused = refused(scaling, holds);
            assert!(refused.is_empty(), "{scaling:?}, acceleration held: {holds}: {refused:#?}");
        }
    }
}

#[test]
fn magnets_far_away_leave_the_beam_alone() {
    let frequencies = |device: &Device| {
        let mut scenario = Scenario::default();
        scenario.set_device(*device, ElectricalScaling::Consistent).expect("a device");
        let (system, _) = scenario.validate().expect("a device");
        system.modes.iter().map(|mode| mode.omega).collect::<Vec<_>>()
    };
    let far = Device { magnet_distance: 47.0, ..Device::default() };
    let none = Device { flux_density: 0.0, ..far };
    for (with, without) in frequencies(&far).iter().zip(frequencies(&none)) {
        assert!((with / without - 1.0).abs() < 1e-6, "{with} {without}");
    }
}
