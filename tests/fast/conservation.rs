//! Exact facts every solution must keep: the energy balance, Liouville's formula, decoupling, the linear limit.

use harvester_lab::dynamics::integration::rk4::RungeKutta4;
use harvester_lab::dynamics::{Outcome, Settings, Trajectory};
use harvester_lab::model::energy::{energy, powers};
use harvester_lab::model::{ForceLaw, ParameterSet, Parameters, ReducedSystem};
use harvester_lab::theory::LinearResponse;
use nalgebra::DMatrix;

const LAWS: [ForceLaw; 3] = [ForceLaw::Quadratic, ForceLaw::Taylor(5), ForceLaw::Exact];

fn system(set: ParameterSet, modes: usize, law: ForceLaw) -> ReducedSystem {
    let parameters = Parameters::new(set).expect("valid parameters");
    ReducedSystem::new(parameters, modes, law).expect("a valid device")
}

fn completed(system: &ReducedSystem, initial: &[f64], t_end: f64, tolerance: f64) -> Trajectory {
    let run =
        Trajectory::compute(system, initial, t_end, Settings { tolerance }).expect("a resolvable motion");
    assert_eq!(run.outcome, Outcome::Completed);
    run
}

/// Starts with the tip displaced by `s` and moving.
fn displaced(system: &ReducedSystem, s: f64) -> Vec<f64> {
    let n = system.modes.len();
    let mut state = vec![0.0; system.dimension()];
    state[0] = s;
    for k in 0..n {
        state[n + k] = 0.1 / (1.0 + k as f64).powi(2);
    }
    state[2 * n] = 3.0;
    state
}

/// Gauss-Legendre points of order ten on (0, 1), from their closed form.
const POINTS: [(f64, f64); 5] = [
    (0.046_910_077_030_668_0, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_23),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_23),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];

/// Integrals of input, viscous and electrical power along the dense output.
fn works(system: &ReducedSystem, run: &Trajectory, t_end: f64) -> [f64; 3] {
    let omega = system.parameters.omega;
    // A tenth of a radian of the fastest motion that carries energy.
    let fastest = omega.max(system.modes.iter().last().map_or(0.0, |mode| mode.omega));
    let intervals = (t_end * fastest / 0.5).ceil();
    let width = t_end / intervals;
    let times = (0..intervals as usize).flat_map(|i| POINTS.map(|(x, _)| (i as f64 + x) * width));
    let times: Vec<f64> = times.collect();
    let mut sum = [0.0; 3];
    let mut weights = POINTS.iter().map(|(_, weight)| weight * width).cycle();
    run.read_at(&times, |t, state| {
        let weight = weights.next().expect("a cycle has no end");
        let power = powers(system, state, (omega * t).sin());
        for (sum, value) in sum.iter_mut().zip([power.input, power.viscous, power.electrical]) {
            *sum += weight * value;
        }
    });
    sum
}

#[test]
fn energy_changes_by_the_work_done_along_the_collocation() {
    let set = ParameterSet { beta: 5e-3, omega: 9.0, ..Default::default() };
    for law in LAWS {
        for (modes, residual_moment) in [(1, false), (2, false), (2, true), (4, true), (8, false)] {
            let system = system(set, modes, law).with_residual_moment(residual_moment);
            let (initial, t_end) = (displaced(&system, -0.05), 12.3);
            let run = completed(&system, &initial, t_end, 1e-7);
            let [input, viscous, electrical] = works(&system, &run, t_end);
            let change = energy(&system, run.final_state()) - energy(&system, &initial);
            let scale = input.abs() + viscous + electrical;
            let residual = (change - (input - viscous - electrical)) / scale;
            assert!(viscous > 0.0 && electrical > 0.0 && change.abs() > 1e-3 * scale);
            assert!(residual.abs() < 1e-9, "{law:?} N = {modes}: {residual:e} of {scale}");
        }
    }
}

/// A run by the classical method, which integrates the work as well, by the same method's quadrature (Simpson's rule
/// on pairs of steps).
fn classical(system: &ReducedSystem, initial: &[f64], steps_per_period: u32, pairs: u32) -> (Vec<f64>, f64) {
    let mut run = RungeKutta4::new(system, initial, steps_per_period).expect("a valid start");
    let h = run.step_length();
    let net = |time: f64, state: &[f64]| {
        let power = powers(system, state, (system.parameters.omega * time).sin());
        power.input - power.viscous - power.electrical
    };
    let mut work = 0.0;
    for _ in 0..pairs {
        let mut weighted = net(run.time(), run.state());
        assert_eq!(run.step(), None);
        weighted += 4.0 * net(run.time(), run.state());
        assert_eq!(run.step(), None);
        weighted += net(run.time(), run.state());
        work += weighted * h / 3.0;
    }
    (run.state().to_vec(), work)
}

#[test]
fn energy_changes_by_the_work_done_along_the_classical_method() {
    let set = ParameterSet { beta: 5e-3, omega: 9.0, ..Default::default() };
    for law in LAWS {
        for (modes, steps) in [(1, 2_000), (2, 4_000), (4, 20_000), (8, 100_000)] {
            let system = system(set, modes, law);
            let initial = displaced(&system, -0.05);
            // Four periods of the excitation.
            let (state, work) = classical(&system, &initial, steps, 2 * steps);
            let change = energy(&system, &state) - energy(&system, &initial);
            let error = (change - work) / energy(&system, &initial);
            assert!(error.abs() < 1e-9, "{law:?} N = {modes}: {error:e}");
        }
    }
}

#[test]
fn without_damping_load_and_excitation_energy_stays() {
    let set = ParameterSet { alpha: 0.0, beta: 0.0, kappa: 0.0, omega: 10.0, ..Default::default() };
    let system = system(set, 2, ForceLaw::Exact);
    for s in [-0.08, 0.05, 0.15] {
        let initial = displaced(&system, s);
        let before = energy(&system, &initial);
        let run = completed(&system, &initial, 2000.0, 1e-8);
        let mut drift: f64 = 0.0;
        let mut travelled: f64 = 0.0;
        run.sample(0.0, 2000.0, 5003, |_, state| {
            drift = drift.max((energy(&system, state) / before - 1.0).abs());
            travelled = travelled.max((system.tip_displacement(state) - s).abs());
        });
        let end = (energy(&system, run.final_state()) / before - 1.0).abs();
        assert!(travelled > 0.05, "the motion must be far from linear: {travelled}");
        assert!(end < 1e-9 && drift < 1e-9, "s = {s}: {end:e} at the end, {drift:e} at most");
    }
}

#[test]
fn phase_volume_shrinks_at_the_rate_of_the_trace() {
    for law in LAWS {
        for (modes, alpha) in [(1, 1e-3), (2, 1e-3), (2, 1e-4), (4, 1e-4)] {
            let set = ParameterSet { alpha, beta: 1e-2, omega: 9.0, ..Default::default() };
            let system = system(set, modes, law);
            let period = system.parameters.period();
            let start = displaced(&system, -0.04);
            let map = |state: &[f64]| completed(&system, state, period, 1e-8).final_state().to_vec();
            let dimension = system.dimension();
            let mut monodromy = DMatrix::zeros(dimension, dimension);
            for j in 0..dimension {
                // Central differences on two scales, extrapolated to fourth order.
                let scale = if j == dimension - 1 { 1.0 } else { 1e-2 };
                let difference = |step: f64| {
                    let (mut low, mut high) = (start.clone(), start.clone());
                    low[j] -= step;
                    high[j] += step;
                    let (low, high) = (map(&low), map(&high));
                    high.iter().zip(low).map(|(a, b)| (a - b) / (2.0 * step)).collect::<Vec<_>>()
                };
                let (fine, coarse) = (difference(1e-3 * scale), difference(2e-3 * scale));
                for i in 0..dimension {
                    monodromy[(i, j)] = (4.0 * fine[i] - coarse[i]) / 3.0;
                }
            }
            // tr A by hand: every mode's damping, the magnet's part of it, and the circuit's own rate.
            let trace = -system.parameters.kappa / system.parameters.c
                + system
                    .modes
                    .iter()
                    .map(|mode| alpha * (system.c1 / mode.eta2 - mode.omega * mode.omega))
                    .sum::<f64>();
            let ratio = monodromy.determinant() / (period * trace).exp();
            assert!((ratio - 1.0).abs() < 1e-6, "{law:?} N = {modes} alpha = {alpha}: {ratio}");
        }
    }
}

#[test]
fn without_coupling_the_circuit_only_discharges_and_does_not_act_back() {
    for law in LAWS {
        let set = ParameterSet { theta: 0.0, beta: 1e-2, omega: 9.0, kappa: 2e-6, ..Default::default() };
        let alone = system(set, 2, law);
        let mut initial = displaced(&alone, -0.03);
        let charged = completed(&alone, &initial, 5.0, 1e-7);
        initial[4] = -200.0;
        let other = completed(&alone, &initial, 5.0, 1e-7);
        for (run, v) in [(&charged, 3.0), (&other, -200.0)] {
            let exact = v * (-2.0_f64 * 5.0).exp();
            assert!((run.final_state()[4] / exact - 1.0).abs() < 1e-11, "{law:?}");
        }
        assert_eq!(charged.final_state()[..4], other.final_state()[..4]);
    }
}

#[test]
fn without_magnets_every_amplitude_gives_the_linear_response() {
    for law in LAWS {
        for (modes, omega, beta) in [(1, 3.0, 1e-4), (2, 3.4, 0.2), (4, 21.0, 0.05), (8, 40.0, 0.2)] {
            // Damping that brings even the first mode's transient below rounding within the run.
            let set = ParameterSet { c0: 0.0, alpha: 2e-2, beta, omega, ..Default::default() };
            let system = system(set, modes, law);
            let linear = LinearResponse::new(&system).expect("damped");
            let t_end = 300.0;
            let run = completed(&system, &displaced(&system, 0.01), t_end, 1e-5);
            for t in [280.0, 291.37, t_end] {
                let expected = linear.state(t);
                for (i, value) in run.state_at(t).iter().enumerate() {
                    let scale = if i < modes {
                        linear.displacements[i].norm()
                    } else if i < 2 * modes {
                        omega * linear.displacements[i - modes].norm()
                    } else {
                        linear.voltage.norm()
                    };
                    let error = (value - expected[i]).abs() / scale;
                    assert!(error < 1e-10, "{law:?} N = {modes} t = {t} component {i}: {error:e}");
                }
            }
        }
    }
}
