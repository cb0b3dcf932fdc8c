//! Periodic orbits, their multipliers and boundaries: one column of a stability chart, one critical excitation, the
//! tongues of the paper, one doubled branch. Quadratic law and two modes unless named otherwise.

#![allow(clippy::expect_used, reason = "a benchmark fails by panicking")]

use divan::{Bencher, black_box, counter::ItemsCount};
use harvester_lab::dynamics::tongue::Window;
use harvester_lab::dynamics::{Orbit, critical_excitation, largest_multipliers, trace_tongue};
use harvester_lab::model::{ForceLaw, ParameterSet, Parameters, ReducedSystem};
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

fn main() {
    divan::main();
}
