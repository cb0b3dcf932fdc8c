//! The two end states the paper's own runs lead to, by its method and by ours.

use harvester_lab::dynamics::integration::rk4::RungeKutta4;
use harvester_lab::dynamics::{Settings, Trajectory};
use harvester_lab::model::{ForceLaw, ParameterSet, Parameters, ReducedSystem};

const FIGURE_3: [f64; 5] = [-1.521630082e-3, 2.841270618e-3, 7.724208224e-3, -1.957999388e-2, 2.449883949];
const FIGURE_4: [f64; 5] = [1.2365676944e-2, 2.2433281133e-2, 8.7696801325e-2, 5.8895944582e-1, 27.811225437];

fn system(set: ParameterSet) -> ReducedSystem {
    let parameters = Parameters::new(set).expect("valid parameters");
    ReducedSystem::new(parameters, 2, ForceLaw::Quadratic).expect("a valid device")
}

fn figure_3() -> ReducedSystem {
    system(ParameterSet::default())
}

fn figure_4() -> ReducedSystem {
    let rest = system(ParameterSet { alpha: 1e-4, beta: 1e-2, ..Default::default() });
    let sum = rest.modes[0].omega + rest.modes[1].omega;
    rest.with_excitation(1e-2, sum).expect("the sum frequency is in range")
}

fn paper_run(system: &ReducedSystem, steps: u64) -> Vec<f64> {
    let mut run = RungeKutta4::new(system, &[0.0; 5], 10_000).expect("from rest");
    for _ in 0..steps {
        assert_eq!(run.step(), None);
    }
    run.state().to_vec()
}

fn assert_close(state: &[f64], reference: &[f64], tolerance: f64) {
    for (value, reference) in state.iter().zip(reference) {
        let error = (value - reference).abs();
        assert!(error <= tolerance, "{value} instead of {reference}: {error:e}");
    }
}

#[test]
fn the_collocation_reproduces_figure_4() {
    let system = figure_4();
    let t_end = 24_461_860.0 * system.parameters.period() / 10_000.0;
    assert!((t_end - 604.999982934).abs() < 2e-9, "{t_end:.12}");
    let run = Trajectory::compute(&system, &[0.0; 5], t_end, Settings::default()).expect("the run completes");
    eprintln!("{} steps", run.len());
    assert_close(run.final_state(), &FIGURE_4, 1e-8);
}

#[test]
fn the_collocation_reproduces_figure_3() {
    let system = figure_3();
    let t_end = 23_952_818.0 * system.parameters.period() / 10_000.0;
    assert!((t_end - 601.999976493).abs() < 1e-9);
    let run = Trajectory::compute(&system, &[0.0; 5], t_end, Settings::default()).expect("the run completes");
    assert_close(run.final_state(), &FIGURE_3, 1e-9);
}

#[test]
fn a_circuit_ten_million_times_faster_than_the_beam_is_followed() {
    // kappa / c = 1e7, of which no step takes notice. The reference is tests/reference/stiff_circuit.py, whose runs
    // at tolerances 1e-9 and 1e-10 differ by 2e-11 at most.
    let set = ParameterSet {
        alpha: 1e-4,
        beta: 1e-2,
        omega: 8.0,
        c: 1e-9,
        kappa: 1e-2,
        theta: 1e-2,
        ..Default::default()
    };
    let parameters = Parameters::new(set).expect("valid parameters");
    let system = ReducedSystem::new(parameters, 2, ForceLaw::Exact).expect("a valid device");
    let run = Trajectory::compute(&system, &[0.0; 5], 20.0, Settings::default()).expect("the run completes");
    assert!(run.len() < 1000, "{} steps", run.len());
    let reference =
        [5.193320358039e-2, -3.203795891353e-4, 3.236445475533e-1, 1.344277384470e-2, 4.999675491383e-1];
    assert_close(run.final_state(), &reference, 1e-10);
}

#[test]
fn the_papers_method_reproduces_figure_3() {
    assert_close(&paper_run(&figure_3(), 23_952_818), &FIGURE_3, 1e-8);
}

#[test]
fn the_papers_method_reproduces_figure_4() {
    assert_close(&paper_run(&figure_4(), 24_461_860), &FIGURE_4, 1e-8);
}
