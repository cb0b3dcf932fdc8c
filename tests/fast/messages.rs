//! What page and workers send each other arrives as it was sent.

use harvester_lab::dynamics::attractors::sweep::Dwell;
use harvester_lab::dynamics::bifurcations::curves::Line;
use harvester_lab::dynamics::bifurcations::tongue::Window;
use harvester_lab::dynamics::{Axis, Plane};
use harvester_lab::jobs::design::work::DesignWork;
use harvester_lab::jobs::work::{Finding, Work};
use harvester_lab::model::{Parameter, ParameterSet, Shaking};
use harvester_lab::scenario::Scenario;
use harvester_lab::theory::Resonance;
use nanoserde::{DeBin, SerBin};

/// Figure 4's device and excitation.
fn scenario() -> Scenario {
    let parameters = ParameterSet { alpha: 1e-4, beta: 0.01, omega: 25.4047, ..Default::default() };
    Scenario { parameters, ..Default::default() }
}

fn works() -> Vec<Work> {
    let plane = Plane::new([
        Axis { parameter: Parameter::Omega, range: (25.3, 25.7) },
        Axis { parameter: Parameter::Beta, range: (1e-4, 0.02) },
    ])
    .expect("a plane");
    let window = Window { span: 0.3, limit: 0.02 };
    let state = Some(vec![0.0, 1e-3, 0.0, -1e-3, 0.5]);
    vec![
        Work::Answer { request: "{\"task\":\"modes\"}".to_owned() },
        Work::Tongue { scenario: scenario(), resonance: Resonance::Sum, window },
        Work::Columns { scenario: scenario(), omegas: vec![25.4, 25.5], betas: vec![1e-3, 1e-2, 2.0] },
        Work::Sweep {
            scenario: scenario(),
            parameter: Parameter::Omega,
            shaking: Shaking::Amplitude,
            values: vec![25.3, 25.4],
            state,
            dwell: Dwell { discarded: 20, kept: 8 },
        },
        Work::Response {
            scenario: scenario(),
            parameter: Parameter::Omega,
            shaking: Shaking::Acceleration,
            range: (7.5, 8.6),
        },
        Work::Inspect { scenario: scenario() },
        Work::Line { scenario: scenario(), plane, line: Line { along: 0, at: 0.01 } },
        Work::Design(DesignWork::Operating { scenario: scenario() }),
    ]
}

#[test]
fn work_and_what_it_finds_arrive_as_they_were_sent() {
    for work in works() {
        let sent = Work::deserialize_bin(&work.serialize_bin()).expect("a message");
        assert_eq!(sent, work);
        let found = work.carry_out().expect("a finding");
        let arrived = Finding::deserialize_bin(&found.serialize_bin()).expect("a message");
        assert_eq!(arrived, found);
    }
}

#[test]
fn a_message_cut_short_is_refused() {
    for work in works() {
        let message = work.serialize_bin();
        assert!(Work::deserialize_bin(&message[..message.len() - 1]).is_err());
    }
}
