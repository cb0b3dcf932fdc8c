//! The run of Figure 4 to t = 604.999982934 by our integrator, the paper's method and a public DOP853, and our
//! integrator on larger systems. `-- --table` prints minimum, median and error of each instead of divan's report.

#![allow(clippy::expect_used, reason = "a benchmark fails by panicking")]

#[path = "by_hand/mod.rs"]
mod by_hand;

use std::sync::Arc;
use std::time::Instant;

use by_hand::ByHand;
use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use divan::{Bencher, black_box};
use harvester_lab::dynamics::integration::Shaken;
use harvester_lab::dynamics::integration::rk4::{PAPER_STEPS_PER_PERIOD, RungeKutta4};
use harvester_lab::dynamics::{Collocation, Outcome, Settings, Trajectory};
use harvester_lab::model::base_motion::{Noise, Recorded, Shared, Signal};
use harvester_lab::model::{ForceLaw, ParameterSet, Parameters, ReducedSystem};
use harvester_lab::questions::shaken_run::dimensionless;
use harvester_lab::scenario::Scenario;

/// The state of the quadratic two-mode system at the end, by two independent integrators that agree in every digit.
const FIGURE_4: [f64; 5] = [1.2365676944e-2, 2.2433281133e-2, 8.7696801325e-2, 5.8895944582e-1, 27.811225437];
/// Steps of the paper's method to the end.
const PAPER_STEPS: u64 = 24_461_860;

fn figure_4(modes: usize, law: ForceLaw) -> ReducedSystem {
    let omega = 4.04845139686289 + 21.3562434253049;
    let set = ParameterSet { alpha: 1e-4, beta: 1e-2, omega, ..Default::default() };
    let parameters = Parameters::new(set).expect("the paper's parameters");
    ReducedSystem::new(parameters, modes, law).expect("the paper's device")
}

fn end_time(system: &ReducedSystem) -> f64 {
    PAPER_STEPS as f64 * system.parameters.period() / f64::from(PAPER_STEPS_PER_PERIOD)
}

/// A run by the collocation that keeps the last state only.
fn ours(system: &ReducedSystem, tolerance: f64) -> Vec<f64> {
    let initial = vec![0.0; system.dimension()];
    let mut run = Collocation::new(system, &initial, Settings { tolerance }).expect("from rest");
    run.advance(end_time(system), usize::MAX, &mut |_| ()).expect("a resolvable motion");
    run.state().to_vec()
}

fn paper(system: &ReducedSystem) -> Vec<f64> {
    let mut run = RungeKutta4::new(system, &[0.0; 5], PAPER_STEPS_PER_PERIOD).expect("from rest");
    for _ in 0..PAPER_STEPS {
        run.step();
    }
    run.state().to_vec()
}

fn dop853(system: &ReducedSystem, tolerance: f64) -> Vec<f64> {
    let method = ExplicitRungeKutta::dop853().rtol(tolerance).atol(tolerance).max_steps(1_000_000);
    let run = IVP::ode(&ByHand::new(system), 0.0, end_time(system), [0.0; 5]).method(method).solve();
    run.expect("a resolvable motion").y.last().map(|state| state.to_vec()).unwrap_or_default()
}

/// Tolerance with which DOP853 comes within about 1e-8.
const DOP853_TOLERANCE: f64 = 1e-11;

#[divan::bench]
fn collocation(bencher: Bencher<'_, '_>) {
    let system = figure_4(2, ForceLaw::Quadratic);
    bencher.bench(|| ours(black_box(&system), Settings::default().tolerance));
}

#[divan::bench]
fn collocation_recorded(bencher: Bencher<'_, '_>) {
    let system = figure_4(2, ForceLaw::Quadratic);
    let run = || Trajectory::compute(black_box(&system), &[0.0; 5], end_time(&system), Settings::default());
    bencher.bench(run);
}

#[divan::bench]
fn collocation_exact_law(bencher: Bencher<'_, '_>) {
    let system = figure_4(2, ForceLaw::Exact);
    bencher.bench(|| ours(black_box(&system), Settings::default().tolerance));
}

#[divan::bench]
fn collocation_exact_law_eight_modes(bencher: Bencher<'_, '_>) {
    let system = figure_4(8, ForceLaw::Exact);
    bencher.bench(|| ours(black_box(&system), Settings::default().tolerance));
}

/// 600,000 samples at 1 kHz, under which the paper's device of two modes stays below its barrier to the end.
fn ten_minutes_at_1_khz() -> (ReducedSystem, Arc<Signal>) {
    let set = ParameterSet { alpha: 1e-3, ..Default::default() };
    let system = Parameters::new(set).and_then(|p| ReducedSystem::new(p, 2, ForceLaw::Quadratic));
    let noise =
        Noise { from: Some(0.3), to: Some(10.0), rms: Some(2e-3), duration: 600.0, ..Noise::default() };
    let noise = noise.signal(0).expect("a noise");
    let time: Vec<f64> = (0..600_000).map(|i| 1e-3 * f64::from(i)).collect();
    let acceleration = time.iter().map(|t| noise.at(*t)).collect();
    let recorded =
        Recorded { time: Shared::new(time), acceleration: Shared::new(acceleration), ..Recorded::default() };
    let signal = recorded.signal().expect("a signal");
    (system.expect("a device"), Arc::new(dimensionless(&signal, &Scenario::default().units())))
}

#[divan::bench(sample_count = 20)]
fn shaken_for_ten_minutes_at_1_khz(bencher: Bencher<'_, '_>) {
    let (system, signal) = ten_minutes_at_1_khz();
    bencher.bench(|| {
        let mut run = Shaken::new(&system, signal.clone(), &[0.0; 5], (2000, 20)).expect("from rest");
        assert_eq!(run.advance(usize::MAX), Ok(Some(Outcome::Completed)));
        run.state().to_vec()
    });
}

#[divan::bench(sample_count = 20)]
fn dop853_of_differential_equations(bencher: Bencher<'_, '_>) {
    let system = figure_4(2, ForceLaw::Quadratic);
    bencher.bench(|| dop853(black_box(&system), DOP853_TOLERANCE));
}

#[divan::bench(sample_count = 3)]
fn the_papers_runge_kutta(bencher: Bencher<'_, '_>) {
    let system = figure_4(2, ForceLaw::Quadratic);
    bencher.bench(|| paper(black_box(&system)));
}

fn largest_error(state: &[f64], reference: &[f64]) -> f64 {
    state.iter().zip(reference).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// One line of the table: minimum and median of `count` runs in milliseconds, and the error of the end state.
fn line(name: &str, count: usize, reference: &[f64], run: impl Fn() -> Vec<f64>) {
    let error = largest_error(&run(), reference);
    let mut times: Vec<f64> = (0..count)
        .map(|_| {
            let start = Instant::now();
            black_box(run());
            1e3 * start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!("{name:<42} {:>10.3} {:>10.3}   {error:.1e}", times[0], times[count / 2]);
}

fn table() {
    println!("{:<42} {:>10} {:>10}   error", "", "min [ms]", "median");
    let system = figure_4(2, ForceLaw::Quadratic);
    let tolerance = Settings::default().tolerance;
    line("collocation", 201, &FIGURE_4, || ours(&system, tolerance));
    line("collocation, recorded", 101, &FIGURE_4, || {
        let run = Trajectory::compute(&system, &[0.0; 5], end_time(&system), Settings::default());
        run.map(|run| run.final_state().to_vec()).unwrap_or_default()
    });
    line("DOP853 of differential-equations", 21, &FIGURE_4, || dop853(&system, DOP853_TOLERANCE));
    line("the paper's Runge-Kutta", 3, &FIGURE_4, || paper(&system));
    // For the other systems the error is the difference from a run at a hundred times tighter tolerance.
    for modes in [2, 8] {
        let system = figure_4(modes, ForceLaw::Exact);
        let reference = ours(&system, 0.01 * tolerance);
        let name = format!("collocation, exact law, {modes} modes");
        line(&name, 51, &reference, || ours(&system, tolerance));
    }
}

fn main() {
    let system = figure_4(2, ForceLaw::Quadratic);
    let error = largest_error(&ours(&system, Settings::default().tolerance), &FIGURE_4);
    assert!(error <= 1e-8, "the collocation ends {error:e} away from the exact motion");
    if std::env::args().any(|argument| argument == "--table") {
        table();
    } else {
        let error = largest_error(&dop853(&system, DOP853_TOLERANCE), &FIGURE_4);
        println!("error of the end state: DOP853 {error:.1e}; of the others see --table");
        divan::main();
    }
}
