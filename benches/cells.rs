//! Cells of charts of the motion reached and of basins, by one core: what one costs, against the number of modes, the force law
//! and the size of the picture. `-- --table` prints that as a table.

#![allow(clippy::expect_used, reason = "a benchmark fails by panicking")]

use std::time::Instant;

use divan::{Bencher, black_box, counter::ItemsCount};
use harvester_lab::model::{ForceLaw, ModelChoice, Parameter, ParameterSet};
use harvester_lab::questions::motions::{Coordinate, MotionPlane};
use harvester_lab::scenario::Scenario;

/// About the first subharmonic of a lightly damped device: periodic motions of one period and of two.
fn chart(size: usize, modes: usize, force: ForceLaw) -> MotionPlane {
    let omega = (Coordinate::Parameter(Parameter::Omega), (7.9, 8.3));
    let beta = (Coordinate::Parameter(Parameter::Beta), (1e-4, 4e-3));
    let parameters = ParameterSet { alpha: 1e-4, ..Default::default() };
    plane(parameters, (modes, force), [omega, beta], size)
}

/// Its starts within the gap, in that tongue: period two, or with the quadratic law escape.
fn basin(size: usize, modes: usize, force: ForceLaw) -> MotionPlane {
    let displacement = (Coordinate::Start(0), (-0.14, 0.14));
    let velocity = (Coordinate::Start(modes), (-0.57, 0.57));
    let parameters = ParameterSet { alpha: 1e-4, beta: 2.5e-3, omega: 8.0969, ..Default::default() };
    plane(parameters, (modes, force), [displacement, velocity], size)
}

fn plane(
    parameters: ParameterSet,
    (modes, force): (usize, ForceLaw),
    [x, y]: [(Coordinate, (f64, f64)); 2],
    size: usize,
) -> MotionPlane {
    let model = ModelChoice { modes, force, ..Default::default() };
    let scenario = Scenario { parameters, model, ..Default::default() };
    MotionPlane { scenario, x, y, size: (size, size) }
}

/// Follows the start of every cell, column by column.
fn fill(plane: &MotionPlane) -> usize {
    let (columns, rows) = plane.size;
    let cells = (0..columns).flat_map(|column| (0..rows).map(move |row| (column, row)));
    let places: Vec<[f64; 2]> = cells.map(|cell| plane.place(cell)).collect();
    plane.motions(&places).expect("a plane within its limits").len()
}

#[divan::bench(args = [16, 32], sample_count = 5)]
fn chart_of_motions(bencher: Bencher, size: usize) {
    let plane = chart(size, 2, ForceLaw::Quadratic);
    bencher.counter(ItemsCount::new(size * size)).bench(|| fill(black_box(&plane)));
}

#[divan::bench(args = [16, 32], sample_count = 5)]
fn basin_of_attraction(bencher: Bencher, size: usize) {
    let plane = basin(size, 2, ForceLaw::Quadratic);
    bencher.counter(ItemsCount::new(size * size)).bench(|| fill(black_box(&plane)));
}

/// Runs of which the shortest counts.
const RUNS: usize = 5;

/// Milliseconds a cell.
fn cost(plane: &MotionPlane) -> f64 {
    let run = || {
        let start = Instant::now();
        let cells = fill(black_box(plane));
        1e3 * start.elapsed().as_secs_f64() / cells as f64
    };
    (0..RUNS).map(|_| run()).fold(f64::INFINITY, f64::min)
}

fn table() {
    println!("Milliseconds a cell, the shortest of {RUNS} runs\n");
    println!("| modes | force law | cells | chart of motions | basin |\n|---|---|---|---|---|");
    let line = |modes, force: ForceLaw, size| {
        let (chart, basin) = (cost(&chart(size, modes, force)), cost(&basin(size, modes, force)));
        println!("| {modes} | {force:?} | {size} x {size} | {chart:.2} | {basin:.2} |");
    };
    for modes in [1, 2, 4, 8] {
        line(modes, ForceLaw::Quadratic, 16);
    }
    for force in [ForceLaw::Taylor(5), ForceLaw::Exact] {
        line(2, force, 16);
    }
    for size in [32, 64] {
        line(2, ForceLaw::Quadratic, size);
    }
}

fn main() {
    if std::env::args().any(|argument| argument == "--table") {
        table();
    } else {
        divan::main();
    }
}
