//! The collocation against the classical method in small steps, against itself at tighter tolerance, and at the
//! ends a run can have.

use harvester_lab::dynamics::integration::rk4::RungeKutta4;
use harvester_lab::dynamics::{IntegrationError, Outcome, Settings, Trajectory};
use harvester_lab::model::{ForceLaw, ParameterSet, Parameters, ReducedSystem};
use harvester_lab::questions::solve;
use serde_json::Value;

fn system(set: ParameterSet, modes: usize, law: ForceLaw) -> ReducedSystem {
    let parameters = Parameters::new(set).expect("valid parameters");
    ReducedSystem::new(parameters, modes, law).expect("a valid device")
}

/// A strongly nonlinear motion: the tip starts at a quarter of the gap and moves on.
fn lively(modes: usize, law: ForceLaw) -> (ReducedSystem, Vec<f64>) {
    let system = system(ParameterSet { beta: 1e-2, omega: 9.0, ..Default::default() }, modes, law);
    let mut initial = vec![0.0; system.dimension()];
    (initial[0], initial[modes], initial[2 * modes]) = (-0.04, 0.15, 5.0);
    (system, initial)
}

fn collocation(system: &ReducedSystem, initial: &[f64], t_end: f64, tolerance: f64) -> Vec<f64> {
    let run =
        Trajectory::compute(system, initial, t_end, Settings { tolerance }).expect("a resolvable motion");
    assert_eq!(run.outcome, Outcome::Completed);
    run.final_state().to_vec()
}

/// The classical method over whole excitation periods.
fn classical_run(
    system: &ReducedSystem,
    initial: &[f64],
    steps_per_period: u32,
    periods: u32,
) -> (Vec<f64>, Option<Outcome>) {
    let mut run = RungeKutta4::new(system, initial, steps_per_period).expect("a valid start");
    let ended = (0..steps_per_period * periods).find_map(|_| run.step());
    (run.state().to_vec(), ended)
}

fn classical(system: &ReducedSystem, initial: &[f64], steps: u32, periods: u32) -> Vec<f64> {
    let (state, ended) = classical_run(system, initial, steps, periods);
    assert_eq!(ended, None);
    state
}

/// Largest difference of two states, each component relative to the sizes these motions reach.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    let n = (a.len() - 1) / 2;
    let scale = |i: usize| [0.05, 0.5, 20.0][(i / n).min(2)];
    (0..a.len()).map(|i| (a[i] - b[i]).abs() / scale(i)).fold(0.0, f64::max)
}

#[test]
fn both_methods_agree_for_one_to_eight_modes_under_every_law() {
    for law in [ForceLaw::Quadratic, ForceLaw::Taylor(5), ForceLaw::Exact] {
        // The highest mode needs the classical method's steps short: 1e-10 after six periods of the excitation.
        for (modes, steps) in [(1, 10_000), (2, 20_000), (4, 40_000), (8, 160_000)] {
            let (system, initial) = lively(modes, law);
            let periods = 6;
            let t_end = f64::from(periods) * system.parameters.period();
            let reference = classical(&system, &initial, steps, periods);
            let error = difference(&collocation(&system, &initial, t_end, 1e-5), &reference);
            assert!(error < 1e-9, "{law:?} N = {modes}: {error:e}");
            let error = difference(&collocation(&system, &initial, t_end, 1e-8), &reference);
            assert!(error < 1e-9, "{law:?} N = {modes}, tight: {error:e}");
        }
    }
}

#[test]
fn the_end_of_a_run_is_held_to_the_square_of_its_tolerance() {
    for law in [ForceLaw::Quadratic, ForceLaw::Exact] {
        for modes in [1, 2, 8] {
            let (system, initial) = lively(modes, law);
            let t_end = 37.0 * system.parameters.period() + 0.123;
            let reference = collocation(&system, &initial, t_end, 1e-9);
            // Some fifty steps of a motion that does not contract: a hundred times the bound of one step.
            for tolerance in [1e-3, 1e-4, 1e-5] {
                let error = difference(&collocation(&system, &initial, t_end, tolerance), &reference);
                assert!(error < 100.0 * tolerance * tolerance, "{law:?} N = {modes} {tolerance}: {error:e}");
            }
            let loose = difference(&collocation(&system, &initial, t_end, 1e-2), &reference);
            let tight = difference(&collocation(&system, &initial, t_end, 1e-6), &reference);
            assert!(tight < 1e-10 && loose > tight, "{law:?} N = {modes}: {loose:e} {tight:e}");
        }
    }
}

#[test]
fn the_classical_method_is_of_fourth_order() {
    let (system, initial) = lively(2, ForceLaw::Exact);
    let reference = collocation(&system, &initial, 3.0 * system.parameters.period(), 1e-9);
    let errors = [200, 400, 800].map(|steps| difference(&classical(&system, &initial, steps, 3), &reference));
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((3.8..4.2).contains(&order), "{order}: {errors:?}");
    }
}

#[test]
fn within_a_step_the_dense_output_is_the_end_of_a_run_that_ends_there() {
    for (modes, law) in [(1, ForceLaw::Exact), (2, ForceLaw::Quadratic), (8, ForceLaw::Exact)] {
        let (system, initial) = lively(modes, law);
        let run = Trajectory::compute(&system, &initial, 9.0, Settings { tolerance: 1e-7 }).expect("a run");
        for i in 1..40 {
            let t = 0.2237 * f64::from(i);
            let error = difference(&run.state_at(t), &collocation(&system, &initial, t, 1e-9));
            assert!(error < 1e-6, "{law:?} N = {modes} t = {t}: {error:e}");
        }
        // Outside the record the times are clamped.
        assert_eq!(run.state_at(-1.0), initial);
        assert_eq!(run.state_at(100.0), run.final_state());
    }
}

fn ask(request: &str) -> Value {
    let answer = solve(request).expect("a good request");
    serde_json::from_str(&answer).expect("an answer is JSON")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|number| number.as_f64().expect("a number")).collect()
}

#[test]
fn simulate_requests_by_both_methods_agree() {
    for force in ["\"quadratic\"", "{\"taylor\":5}", "\"exact\""] {
        let request = |method: &str| {
            ask(&format!(
                "{{\"task\":\"simulate\",\"parameters\":{{\"beta\":0.01,\"omega\":9}},\"t_end\":6.283185307179586,
                  \"model\":{{\"modes\":3,\"force\":{force}}},\"initial\":[-0.04,0,0,0.1,0,0,2],\"samples\":10,
                  \"method\":\"{method}\",\"steps_per_period\":20000,\"tolerance\":1e-7}}"
            ))
        };
        let (rk4, adaptive) = (request("rk4"), request("adaptive"));
        for answer in [&rk4, &adaptive] {
            assert_eq!(answer["outcome"], "completed");
            assert_eq!(answer["state"].as_array().map(Vec::len), Some(10));
        }
        assert_eq!(rk4["steps"], 180_000);
        assert!(adaptive["steps"].as_u64().is_some_and(|steps| steps < 2000), "{}", adaptive["steps"]);
        for i in 0..10 {
            // Samples are a period apart, so both have them on their grids.
            let (t, other) = (rk4["t"][i].as_f64(), adaptive["t"][i].as_f64());
            assert!(t.zip(other).is_some_and(|(a, b)| (a - b).abs() < 1e-9), "{t:?} {other:?}");
            let error = difference(&numbers(&rk4["state"][i]), &numbers(&adaptive["state"][i]));
            assert!(error < 1e-9, "{force} {i}: {error:e}");
        }
    }
}

#[test]
fn figure_12_escapes_where_the_tip_passes_ten_lengths_by_both_methods() {
    let set = ParameterSet { alpha: 1e-4, beta: 1e-2, omega: 2.0 * 21.3562434253049, ..Default::default() };
    let system = system(set, 2, ForceLaw::Quadratic);
    // |s| = 10 at t = 1.138751, by an integration in 40 digits.
    let (_, ended) = classical_run(&system, &[0.0; 5], 10_000, 20);
    let Some(Outcome::Escaped { time }) = ended else { panic!("{ended:?}") };
    assert!((time - 1.138751).abs() < 1e-6, "{time}");
    for (tolerance, bound) in [(1e-5, 1e-6), (1e-3, 2e-5)] {
        let run = Trajectory::compute(&system, &[0.0; 5], 100.0, Settings { tolerance }).expect("a run");
        let Outcome::Escaped { time } = run.outcome else { panic!("{:?}", run.outcome) };
        assert!((time - 1.138751).abs() < bound, "{tolerance}: {time}");
        assert_eq!(run.end_time(), time);
        let tip = system.tip_displacement(run.final_state()).abs();
        assert!((tip - 10.0).abs() < 1e-3, "{tolerance}: {tip}");
        // Close before the end the dense output of the shortened step goes on to there.
        let before = system.tip_displacement(&run.state_at(time - 1e-6)).abs();
        assert!((9.9..10.0).contains(&before), "{tolerance}: {before}");
    }
}

#[test]
fn the_classical_method_ends_at_the_end_with_a_shortened_step() {
    let set = ParameterSet { alpha: 1e-4, beta: 1e-2, omega: 9.0, ..Default::default() };
    let system = system(set, 2, ForceLaw::Exact);
    let request = r#"{"task":"simulate","method":"rk4","steps_per_period":1000,"t_end":2,"samples":4,
        "parameters":{"alpha":1e-4,"beta":0.01,"omega":9},"model":{"force":"exact"}}"#;
    let answer: serde_json::Value =
        serde_json::from_str(&harvester_lab::questions::solve(request).expect("an answer")).expect("JSON");
    assert_eq!((&answer["t"][3], &answer["t_outcome"]), (&2.0.into(), &2.0.into()));
    // Two whole steps a period short of 2 is 2.9e-4: the states differ by 1e-3 there.
    let run = Trajectory::compute(&system, &[0.0; 5], 2.0, Settings { tolerance: 1e-8 }).expect("a run");
    let error = difference(&numbers(&answer["state"][3]), run.final_state());
    assert!(error < 1e-8, "{error:e}");
}

#[test]
fn attracting_magnets_touch_when_the_tip_is_thrown_at_them() {
    let set = ParameterSet { c0: -0.1, beta: 0.0, omega: 9.0, ..Default::default() };
    let system = system(set, 2, ForceLaw::Exact);
    let gap = system.equilibrium.gap;
    let mut initial = vec![0.0; 5];
    initial[2] = -3.0;
    let run = Trajectory::compute(&system, &initial, 50.0, Settings::default()).expect("contact is a result");
    let (_, ended) = classical_run(&system, &initial, 200_000, 2);
    match (run.outcome, ended) {
        (Outcome::Contact { time }, Some(Outcome::Contact { time: other })) => {
            assert!((time - other).abs() < 1e-3 * other, "{time} {other}");
            // It cannot be faster than the gap at the speed to which the magnets pull it, nor much slower than
            // the gap at the starting speed.
            assert!((0.2 * gap / 3.0..2.0 * gap / 3.0).contains(&time), "{time}");
        }
        other => panic!("{other:?}"),
    }
    // Thrown gently it comes back: the beam holds it.
    initial[2] = -0.05;
    let run = Trajectory::compute(&system, &initial, 50.0, Settings::default()).expect("a run");
    assert_eq!(run.outcome, Outcome::Completed);
}

#[test]
fn repelling_magnets_never_touch() {
    let system = system(ParameterSet { beta: 0.0, omega: 9.0, ..Default::default() }, 1, ForceLaw::Exact);
    for speed in [-0.5, -2.0] {
        let run = Trajectory::compute(&system, &[0.0, speed, 0.0], 20.0, Settings::default()).expect("a run");
        assert_eq!(run.outcome, Outcome::Completed, "speed {speed}");
        run.sample(0.0, 20.0, 4001, |t, state| assert!(state[0] > -system.equilibrium.gap, "t = {t}"));
    }
}

#[test]
fn a_motion_that_needs_too_many_steps_is_given_up_in_time() {
    // Far outside the gap a polynomial of odd degree is a wall that throws the tip back at enormous speed.
    let system = system(ParameterSet { omega: 0.5, ..Default::default() }, 1, ForceLaw::Taylor(5));
    let start = std::time::Instant::now();
    let result = Trajectory::compute(&system, &[9.0, 0.0, 0.0], 1000.0, Settings::default());
    assert!(
        matches!(result, Err(IntegrationError::TooManySteps { .. })),
        "{:?}",
        result.map(|run| run.outcome)
    );
    assert!(start.elapsed().as_secs() < 20);
}
