//! Right at the edge: random points around the tips of the tongues, where transients last thousands of periods, against
//! long runs closed by Newton's iteration.

mod truth;

use self::truth::{Length, Run, Standing, Truth, standing};
use harvester_lab::dynamics::attractors::sweep::{Dwell, SweepCourse, SweepPoint, sweep};
use harvester_lab::dynamics::bifurcations::tongue::Window;
use harvester_lab::dynamics::{Collocation, Inquiry, Settings, trace_tongue};
use harvester_lab::model::{Along, ForceLaw, ModelChoice, Parameter, ParameterSet, ReducedSystem};
use harvester_lab::theory::Resonance;

/// How far around a tip, relative.
const AROUND: (f64, f64) = (0.004, 0.1);
/// Allowed errors of the voltage by verdict and by sweep, relative.
const VOLTS: (f64, f64) = (0.01, 0.02);

/// A run by our own integrator.
struct Own {
    system: ReducedSystem,
    run: Collocation,
    state: Vec<f64>,
}

impl Own {
    fn new(system: &ReducedSystem, state: Vec<f64>) -> Self {
        let run = Collocation::new(system, &state, Settings { tolerance: 1e-9 }).expect("a start");
        Self { system: system.clone(), run, state }
    }
}

impl Run for Own {
    fn beside(&self, by: f64) -> Self {
        let mut state = self.state.clone();
        state[0] += by;
        let mut other = Self::new(&self.system, state);
        // Its own start counts as the first instant that it passes.
        other.advance(1).expect("a step");
        other
    }

    fn advance(&mut self, periods: usize) -> Option<f64> {
        let Self { run, state, .. } = self;
        let width = state.len();
        let (mut passed, mut square) = (0, 0.0);
        while passed < periods {
            let outcome = run.advance(f64::INFINITY, 1, &mut |step| {
                if step.index == 0 {
                    passed += 1;
                    state.copy_from_slice(&step.start[..width]);
                }
                let v = step.start[width - 1];
                square += v * v * step.tables.step;
            });
            if outcome.expect("a run").is_some() {
                return None;
            }
        }
        Some(square)
    }

    fn state(&self) -> Vec<f64> {
        self.state.clone()
    }
}

/// Follows the start of `system` at rest to a dimensionless time of 20,000.
fn from_rest(system: &ReducedSystem) -> Truth {
    let mut run = Own::new(system, vec![0.0; system.dimension()]);
    let least = (20_000.0 / system.parameters.period()).ceil() as usize;
    truth::follow(system, &mut run, Length { first: least, least, most: 4_000_000 })
}

/// Points about the tips, so many for each device, law and resonance.
fn points(seed: u64, each: usize) -> Vec<(ParameterSet, ModelChoice)> {
    let mut random = fastrand::Rng::with_seed(seed);
    let paper = ParameterSet { alpha: 1e-4, ..Default::default() };
    let devices = [
        paper,
        ParameterSet { alpha: 2e-4, eta: 0.05, ..paper },
        ParameterSet { c0: 0.4, d: 0.14, kappa: 2e-6, ..paper },
    ];
    let mut points = Vec::new();
    for device in devices {
        for force in [ForceLaw::Quadratic, ForceLaw::Exact] {
            let model = ModelChoice { force, ..Default::default() };
            let system = model.system(device).expect("a device");
            for resonance in [Resonance::First, Resonance::Sum] {
                let tongue = trace_tongue(&system, resonance, Window::default()).expect("a tongue");
                let tip = tongue.as_ref().and_then(|tongue| tongue.tip()).expect("a tip");
                for _ in 0..each {
                    let part = |random: &mut fastrand::Rng| 2.0 * random.f64() - 1.0;
                    let omega = tip.omega * (1.0 + AROUND.0 * part(&mut random));
                    let beta = tip.beta * (1.0 + AROUND.1 * part(&mut random));
                    points.push((ParameterSet { omega, beta, ..device }, model));
                }
            }
        }
    }
    points
}

/// The motion that a sweep of two values reaches at the first.
fn swept(set: &ParameterSet, model: ModelChoice, system: &ReducedSystem) -> SweepPoint {
    let course = SweepCourse {
        set,
        model,
        parameter: Parameter::Beta,
        along: Along::default(),
        start: &vec![0.0; system.dimension()],
        dwell: Dwell::default(),
    };
    sweep(course, &[set.beta], None).expect("a sweep").0.remove(0)
}

fn check(seed: u64, each: usize) {
    let points = points(seed, each);
    let mut undecided = (0, 0);
    let mut wrong = Vec::new();
    for (set, model) in &points {
        let system = model.system(*set).expect("a device");
        let truth = from_rest(&system);
        let inquiry = Inquiry::new(&system, &vec![0.0; system.dimension()], 600.0);
        let verdict = inquiry.expect("a verdict").verdict;
        let by_verdict = standing(&truth, verdict.motion, verdict.v_rms.unwrap_or(0.0), VOLTS.0);
        let point = swept(set, *model, &system);
        let by_sweep = standing(&truth, point.motion, point.measures.v_rms, VOLTS.1);
        undecided.0 += usize::from(by_verdict == Standing::Undecided);
        undecided.1 += usize::from(by_sweep == Standing::Undecided);
        if by_verdict != Standing::Right || by_sweep != Standing::Right {
            let expected = match &truth {
                Truth::Periodic(orbit) => format!(
                    "period {}, {} V, {:?}",
                    orbit.periods,
                    orbit.measures.v_rms,
                    orbit.largest_multiplier()
                ),
                other => format!("{other:?}"),
            };
            println!(
                "{set:?} {model:?}: {expected}; verdict {by_verdict:?} {} {:?}; sweep {by_sweep:?} {} {}",
                verdict.motion, verdict.v_rms, point.motion, point.measures.v_rms
            );
        }
        if by_verdict == Standing::Wrong || by_sweep == Standing::Wrong {
            wrong.push(*set);
        }
    }
    println!("{} points: undecided {undecided:?}, wrong {}", points.len(), wrong.len());
    assert!(wrong.is_empty(), "{wrong:?}");
    let most = (3 * points.len()).div_ceil(100);
    assert!(undecided.0 <= most && undecided.1 <= most, "{undecided:?} of {}", points.len());
}

#[test]
fn answers_around_the_tips_are_those_of_long_runs() {
    check(1, 6);
}

#[test]
#[ignore = "a quarter of an hour"]
fn many_answers_around_the_tips_are_those_of_long_runs() {
    check(2, 25);
}
