//! Periodic orbits, their multipliers and boundaries: one column of a stability chart, one critical excitation, the
//! tongues of the paper, one curve of each kind. Quadratic law and two modes unless named otherwise.

#![allow(clippy::expect_used, reason = "a benchmark fails by panicking")]

use divan::{Bencher, black_box, counter::ItemsCount};
use harvester_lab::dynamics::bifurcations::curves::{Line, bifurcations_along_line, trace_curve};
use harvester_lab::dynamics::bifurcations::tongue::Window;
use harvester_lab::dynamics::{
    Axis, Instability, Orbit, Plane, critical_excitation, largest_multipliers, trace_tongue,
};
use harvester_lab::model::{ForceLaw, Parameter, ParameterSet, Parameters, ReducedSystem};
use harvester_lab::theory::Resonance;

fn system(modes: usize, law: ForceLaw) -> ReducedSystem {
    let set = ParameterSet { alpha: 1e-4, beta: 1e-2, omega: 8.0969, ..Default::default() };
    let parameters = Parameters::new(set).expect("the paper's parameters");
    ReducedSystem::new(parameters, modes, law).expect("the paper's device")
}

/// Frequencies near 2 omega_1 and near omega_1 + omega_2.
const FREQUENCIES: [f64; 2] = [8.0969, 25.3047];

#[divan::bench(args = FREQUENCIES)]
fn chart_column_of_1000_points(bencher: Bencher, omega: f64) {
    let betas: Vec<f64> = (1..=1000).map(|i| 4e-5 * f64::from(i)).collect();
    let system = system(2, ForceLaw::Quadratic);
    bencher
        .counter(ItemsCount::new(betas.len()))
        .bench(|| largest_multipliers(black_box(&system), omega, &betas).expect("a followed motion"));
}

#[divan::bench(args = FREQUENCIES)]
fn chart_column_of_1000_points_exact_four_modes(bencher: Bencher, omega: f64) {
    let betas: Vec<f64> = (1..=1000).map(|i| 4e-5 * f64::from(i)).collect();
    let system = system(4, ForceLaw::Exact);
    bencher
        .counter(ItemsCount::new(betas.len()))
        .bench(|| largest_multipliers(black_box(&system), omega, &betas).expect("a followed motion"));
}

#[divan::bench]
fn forced_orbit_of_figure_9(bencher: Bencher) {
    let system = system(2, ForceLaw::Quadratic);
    bencher.bench(|| Orbit::find(black_box(&system), None, 1).expect("a forced motion"));
}

#[divan::bench]
fn critical_excitation_of_the_sum(bencher: Bencher) {
    let system = system(2, ForceLaw::Quadratic);
    bencher.bench(|| critical_excitation(black_box(&system), 25.3047, 0.04, None).expect("a boundary"));
}

#[divan::bench(args = [Resonance::First, Resonance::Sum, Resonance::Second], sample_count = 20)]
fn tongue(bencher: Bencher, resonance: Resonance) {
    let system = system(2, ForceLaw::Quadratic);
    bencher.bench(|| trace_tongue(black_box(&system), resonance, Window::default()).expect("a tongue"));
}

/// The period doublings about 2 omega_1, the tori about omega_1 + omega_2, the folds about omega_2, each with its window.
const CURVES: [(Instability, f64); 3] =
    [(Instability::PeriodDoubling, 8.1565), (Instability::NeimarkSacker, 25.5148), (Instability::Fold, 21.5)];

#[divan::bench(args = CURVES, sample_count = 20)]
fn curve_in_omega_and_beta(bencher: Bencher, (kind, omega): (Instability, f64)) {
    let system = system(2, ForceLaw::Quadratic);
    let plane = Plane::new([
        Axis { parameter: Parameter::Omega, range: (omega - 0.6, omega + 0.6) },
        Axis { parameter: Parameter::Beta, range: (0.0, 0.04) },
    ])
    .expect("a window");
    let line = Line { along: 1, at: omega };
    let starts = bifurcations_along_line(&system, &plane, line, false).expect("a line");
    let start = starts.iter().find(|start| start.kind == kind).expect("a start");
    bencher.bench(|| trace_curve(black_box(&system), start, &plane).expect("a curve"));
}

fn main() {
    divan::main();
}
