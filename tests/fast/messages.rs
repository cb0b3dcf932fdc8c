//! What page and workers send each other arrives as it was sent, and every question is on the list.

use std::cell::RefCell;
use std::fmt::Debug;

use harvester_lab::dynamics::attractors::sweep::Dwell;
use harvester_lab::dynamics::bifurcations::curves::Line;
use harvester_lab::dynamics::bifurcations::tongue::Window;
use harvester_lab::dynamics::{Axis, Plane};
use harvester_lab::model::base_motion::BaseMotion;
use harvester_lab::model::materials::Ceramic;
use harvester_lab::model::{Along, Dimension, ForceLaw, Limits, Parameter, ParameterSet, Shaking};
use harvester_lab::questions::answers::Solve;
use harvester_lab::questions::continuation::{Continue, Response};
use harvester_lab::questions::curves::{Crossings, Trace};
use harvester_lab::questions::design::change::Way;
use harvester_lab::questions::design::space::{DesignSpace, Objective, Variable};
use harvester_lab::questions::design::trust::Quantity;
use harvester_lab::questions::find::Evaluate;
use harvester_lab::questions::fit::Voltages;
use harvester_lab::questions::harvest::{Between, Branches, Deliver, Starts};
use harvester_lab::questions::inspection::Inspect;
use harvester_lab::questions::list::{self, HANDS, TASKS};
use harvester_lab::questions::load::{BestAt, Forced, Reached};
use harvester_lab::questions::materials::Fitted;
use harvester_lab::questions::motions::{Coordinate, MotionPlane, Motions};
use harvester_lab::questions::multiplier_chart::Columns;
use harvester_lab::questions::rectifier::{BestVoltage, OpenCircuit, Rectified};
use harvester_lab::questions::shake::AtLevel;
use harvester_lab::questions::shaken_run::ShakenRun;
use harvester_lab::questions::sweep::Stretch;
use harvester_lab::questions::tolerances::{Leaning, Meant};
use harvester_lab::questions::tongues::Border;
use harvester_lab::questions::trust::Entry;
use harvester_lab::scenario::Scenario;
use harvester_lab::scheduler::{Finding, Piece};
use harvester_lab::theory::Resonance;

/// Figure 4's device and excitation.
fn scenario() -> Scenario {
    let parameters = ParameterSet { alpha: 1e-4, beta: 0.01, omega: 25.4047, ..Default::default() };
    Scenario { parameters, ..Default::default() }
}

fn plane() -> Plane {
    Plane::new([
        Axis { parameter: Parameter::Omega, range: (25.3, 25.7) },
        Axis { parameter: Parameter::Beta, range: (1e-4, 0.02) },
    ])
    .expect("a plane")
}

/// Sends a piece to a worker, and what it found back; the piece's name.
fn sent<P: Piece + PartialEq + Debug>(piece: &P) -> &'static str
where
    P::Found: PartialEq + Debug,
{
    let message = piece.serialize_bin();
    assert_eq!(&P::deserialize_bin(&message).expect("a message"), piece);
    let parts = RefCell::new(Vec::new());
    let tell = |part| parts.borrow_mut().push(part);
    let cut_short = &message[..message.len() - 1];
    assert!(list::carry_out(P::NAME, cut_short, &tell).is_err(), "a message cut short");
    let found = piece.carry_out().expect("a finding");
    let answer = list::carry_out(P::NAME, &message, &tell).expect("a finding");
    assert_eq!(Finding::Message(answer.clone()).open::<P::Found>().expect("a message"), found);
    assert!(Finding::Message(answer[..answer.len() - 1].to_vec()).open::<P::Found>().is_err());
    let parts = parts.into_inner();
    assert!(parts.is_sorted() && parts.iter().all(|part| (0.0..=1.0).contains(part)), "{parts:?}");
    P::NAME
}

#[test]
fn work_and_what_it_finds_arrive_as_they_were_sent() {
    let (scenario, window) = (scenario(), Window { span: 0.3, limit: 0.02 });
    let state = Some(vec![0.0, 1e-3, 0.0, -1e-3, 0.5]);
    let (parameter, shaking) = (Parameter::Omega, Shaking::Acceleration);
    let resistances = vec![1e6, 1e7];
    let coordinate = Coordinate::Parameter(Parameter::Kappa);
    let space = DesignSpace {
        scenario: scenario.clone(),
        variables: vec![Variable { coordinate, range: (1e-6, 1e-3), logarithmic: true }],
        objective: Objective::Power,
        limits: Limits::default(),
        acceleration: Some(0.15),
    };
    let line = Line { along: 0, at: 0.01 };
    let crossings = Crossings { scenario: scenario.clone(), plane: plane(), line, doubled: false };
    let starts = crossings.carry_out().expect("starts");
    let noise: BaseMotion =
        serde_json::from_str(r#"{"kind":"noise","from":1,"to":5,"rms":0.01,"duration":20}"#).expect("noise");
    let mut names = vec![
        sent(&Solve { request: "{\"task\":\"modes\"}".to_owned() }),
        sent(&Deliver { scenario: scenario.clone() }),
        sent(&Border { scenario: scenario.clone(), resonance: Resonance::Sum, window }),
        sent(&Inspect { scenario: scenario.clone() }),
        sent(&Columns { scenario: scenario.clone(), omegas: vec![25.4, 25.5], betas: vec![1e-3, 1e-2, 2.0] }),
        sent(&Response {
            scenario: scenario.clone(),
            question: Continue {
                parameter,
                from: 7.5,
                to: 8.6,
                hold: shaking,
                guess: None,
                periods: 1,
                doublings: 1,
            },
        }),
        sent(&Stretch {
            scenario: scenario.clone(),
            parameter,
            along: Along { shaking, dielectric: 1e-8 },
            values: vec![25.3, 25.4],
            state: state.clone(),
            dwell: Dwell { discarded: 20, kept: 8 },
        }),
        sent(&crossings),
        sent(&Trace {
            scenario: scenario.clone(),
            plane: plane(),
            start: starts.first().expect("a bifurcation").clone(),
        }),
        sent(&Motions {
            plane: MotionPlane {
                scenario: scenario.clone(),
                x: (Coordinate::Start(0), (0.0, 0.1)),
                y: (Coordinate::Parameter(Parameter::Beta), (0.0, 2e-3)),
                size: (3, 5),
            },
            places: vec![[0.0, 1e-3]],
        }),
        sent(&Branches { scenario: scenario.clone(), shaking, window: (8.0, 8.2) }),
        sent(&Starts { scenario: scenario.clone(), shaking, omegas: vec![25.2, 25.3] }),
        sent(&Between {
            scenario: scenario.clone(),
            shaking,
            way: Way::FromRest,
            neighbours: (25.2, 25.3),
            difference: 1e-3,
        }),
        sent(&Forced { scenario: scenario.clone(), resistances: resistances.clone() }),
        sent(&Reached { scenario: scenario.clone(), resistances, state }),
        sent(&BestAt {
            scenario: scenario.clone(),
            resistance: 1e7,
            window: (7.9, 8.2),
            shaking,
            limits: Limits::default(),
        }),
        sent(&Fitted {
            scenario: scenario.clone(),
            ceramic: Ceramic::Apc840,
            mode: 1,
            resonance: Resonance::First,
            window,
        }),
        sent(&OpenCircuit { scenario: scenario.clone() }),
        sent(&Rectified { scenario: scenario.clone(), voltage: 2.0, drop: 0.3 }),
        sent(&BestVoltage { scenario: scenario.clone(), between: (1.0, 1.5), drop: 0.0 }),
        sent(&Entry { scenario, modes: 2, law: ForceLaw::Exact, quantity: Quantity::Power }),
        sent(&Meant { space: space.clone(), resonance: Resonance::First }),
        sent(&Leaning {
            scenario: space.scenario.clone(),
            dimension: Coordinate::Dimension(Dimension::BeamLength),
            resonance: Resonance::First,
        }),
        sent(&Voltages {
            scenario: space.scenario.clone(),
            shaking,
            dimensions: vec![(Dimension::TipMass, 6e-4)],
            frequencies: vec![2.8, 2.9],
        }),
        sent(&ShakenRun {
            scenario: space.scenario.clone(),
            excitation: noise.clone(),
            realisation: 1,
            magnets: false,
            points: 50,
        }),
        sent(&AtLevel { scenario: space.scenario.clone(), excitation: noise, realisations: 1 }),
        sent(&Evaluate { space, values: vec![1e-5] }),
    ];
    let mut known: Vec<&str> = HANDS.iter().map(|hand| hand.name).collect();
    names.sort_unstable();
    known.sort_unstable();
    assert_eq!(names, known, "every piece has one hand");
    assert!(list::carry_out("nothing", &[], &|_| ()).is_err());
}

/// The README's table and the order of its rows.
#[test]
fn the_readme_has_a_row_for_every_task() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
    let readme = std::fs::read_to_string(path).expect("the README");
    let table = readme.split("| task | further fields | answer |").nth(1).expect("the table of tasks");
    let rows = table.lines().skip(2).take_while(|line| line.starts_with('|'));
    let names: Vec<&str> = rows.filter_map(|row| row.split('`').nth(1)).collect();
    assert_eq!(names, TASKS.iter().map(|task| task.name).collect::<Vec<_>>());
}
