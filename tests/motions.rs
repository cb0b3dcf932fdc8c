//! What motion a start leads to: the paper's figures and the cases in which evidence is easily misread.

#![allow(clippy::excessive_precision, reason = "reference values are given as they were printed")]

use harvester_lab::dynamics::lyapunov::Sign;
use harvester_lab::dynamics::motion::{Reached, Undecided};
use harvester_lab::dynamics::{
    Horizon, Motion, Orbit, Search, Settings, Trajectory, critical_excitation, reach,
};
use harvester_lab::model::{ForceLaw, ParameterSet, Parameters, ReducedSystem};

type TestResult = Result<(), Box<dyn std::error::Error>>;
type Answer<T> = Result<T, Box<dyn std::error::Error>>;

/// The paper's omega_1, omega_2 and gap in 40-digit arithmetic.
const OMEGA_1: f64 = 4.04845139686289;
const OMEGA_2: f64 = 21.3562434253049;
const GAP: f64 = 0.169450341372524;

fn with(set: ParameterSet, law: ForceLaw) -> Answer<ReducedSystem> {
    Ok(ReducedSystem::new(Parameters::new(set)?, 2, law)?)
}

fn system(alpha: f64, beta: f64, omega: f64, law: ForceLaw) -> Answer<ReducedSystem> {
    with(ParameterSet { alpha, beta, omega, ..Default::default() }, law)
}

fn from_rest(system: &ReducedSystem, horizon: Horizon) -> Answer<Reached> {
    Ok(reach(system, &[0.0; 5], horizon)?)
}

const PERIOD_1: Motion = Motion::Periodic { periods: 1 };

#[test]
fn the_stable_figures_have_period_1() -> TestResult {
    // With the largest multiplier of the motion by an independent program, where there is one.
    for (name, alpha, beta, omega, modulus) in [
        ("3", 1e-3, 1e-3, 25.0, Some(0.996743)),
        ("5", 1e-3, 1e-3, OMEGA_2 - OMEGA_1, None),
        ("6", 1e-4, 1e-2, OMEGA_2 - OMEGA_1, Some(0.994786)),
        ("8", 1e-3, 1e-3, 8.0, Some(0.989845)),
        ("11", 1e-3, 1e-3, 43.0, Some(0.998103)),
    ] {
        let system = system(alpha, beta, omega, ForceLaw::Quadratic)?;
        for horizon in [Horizon::chart(600.0), Horizon::full(600.0)] {
            let reached = from_rest(&system, horizon)?;
            assert_eq!(reached.motion, PERIOD_1, "figure {name}");
            let orbit = reached.orbit.as_ref().ok_or("an orbit")?;
            if let Some(modulus) = modulus {
                assert!((orbit.largest_multiplier().norm() - modulus).abs() < 1e-6, "figure {name}");
            }
            // A run that may end early ends while the motion, small as it is, is still far away by its own measure.
            let near = reached.distance.is_some_and(|distance| distance < 0.05);
            assert!(horizon.ends_early || near, "figure {name}: {:?}", reached.distance);
            assert!(horizon.ends_early || reached.time >= 600.0 - system.parameters.period());
            assert_eq!(reached.cell().motion, PERIOD_1);
        }
        // The run itself, long after, is the motion found.
        let reached = from_rest(&system, Horizon::chart(600.0))?;
        let period = system.parameters.period();
        let end = (6000.0 / period).ceil() * period;
        let run = Trajectory::compute(&system, &[0.0; 5], end, Settings::default())?;
        let mut square = 0.0;
        run.sample(end - period, end - period / 64.0, 64, |_, state| square += state[4] * state[4] / 64.0);
        let v_rms = reached.cell().v_rms;
        assert!((square.sqrt() / v_rms - 1.0).abs() < 1e-6, "figure {name}: {} {v_rms}", square.sqrt());
    }
    Ok(())
}

#[test]
fn figure_9_has_period_2() -> TestResult {
    let system = system(1e-4, 1e-2, 2.0 * OMEGA_1, ForceLaw::Quadratic)?;
    for horizon in [Horizon::chart(600.0), Horizon::full(600.0)] {
        let reached = from_rest(&system, horizon)?;
        assert_eq!(reached.motion, Motion::Periodic { periods: 2 });
        // Another program's values.
        let measures = reached.measures.ok_or("measures")?;
        assert!((measures.v_rms - 14.1783).abs() < 1e-4, "{measures:?}");
        assert!((measures.power - 1e-6 * 14.1783 * 14.1783).abs() < 1e-8, "{measures:?}");
        assert!((measures.tip_min / GAP + 0.4930).abs() < 1e-4, "{measures:?}");
        assert!((measures.tip_max / GAP - 0.3896).abs() < 1e-4, "{measures:?}");
    }
    Ok(())
}

#[test]
fn figure_4_is_a_torus_beside_a_stable_forced_motion() -> TestResult {
    let system = system(1e-4, 1e-2, OMEGA_1 + OMEGA_2, ForceLaw::Quadratic)?;
    for horizon in [Horizon::chart(600.0), Horizon::full(600.0)] {
        let reached = from_rest(&system, horizon)?;
        assert_eq!(reached.motion, Motion::Quasiperiodic);
        let exponent = reached.exponent.ok_or("an exponent")?;
        assert_eq!(exponent.sign(), Sign::Zero, "{exponent:?}");
        assert!(reached.dimension.is_some_and(|dimension| (0.9..1.2).contains(&dimension)));
        // A long run by its last half, in samples.
        let end = 4000.0;
        let run = Trajectory::compute(&system, &[0.0; 5], end, Settings::default())?;
        let (mut square, mut low, mut high) = (0.0, 0.0_f64, 0.0_f64);
        run.sample(0.5 * end, end, 400_000, |_, state| {
            square += state[4] * state[4] / 400_000.0;
            let s = system.tip_displacement(state);
            (low, high) = (low.min(s), high.max(s));
        });
        let measures = reached.measures.ok_or("measures")?;
        assert!((measures.v_rms / square.sqrt() - 1.0).abs() < 2e-3, "{measures:?} {}", square.sqrt());
        assert!((measures.tip_min - low).abs() < 0.01 * GAP, "{measures:?} {low}");
        assert!((measures.tip_max - high).abs() < 0.01 * GAP, "{measures:?} {high}");
    }
    let forced = Orbit::find(&system, None, 1)?;
    assert!((forced.largest_multiplier().norm() - 0.999378).abs() < 1e-6);
    let reached = reach(&system, &forced.state, Horizon::full(600.0))?;
    assert_eq!(reached.motion, PERIOD_1);
    Ok(())
}

#[test]
fn figure_12_escapes_over_the_barrier_that_the_exact_law_has_not() -> TestResult {
    for horizon in [Horizon::chart(600.0), Horizon::full(600.0)] {
        let truncated = from_rest(&system(1e-4, 1e-2, 2.0 * OMEGA_2, ForceLaw::Quadratic)?, horizon)?;
        assert!(
            matches!(truncated.motion, Motion::Escape { time } if (time - 1.14).abs() < 0.01),
            "{:?}",
            truncated.motion
        );
        assert_eq!((truncated.measures, truncated.cell().v_rms), (None, 0.0));
        let exact = from_rest(&system(1e-4, 1e-2, 2.0 * OMEGA_2, ForceLaw::Exact)?, horizon)?;
        assert!(exact.measures.is_some_and(|measures| measures.tip_min > -GAP), "{:?}", exact.motion);
        // It settles on a motion of nine periods: beyond what recurrence looks for.
        assert_eq!(exact.motion, Motion::Periodic { periods: 9 });
    }
    // A run of its own, three times as long: the states repeat after nine periods and no fewer.
    let system = system(1e-4, 1e-2, 2.0 * OMEGA_2, ForceLaw::Exact)?;
    let period = system.parameters.period();
    let run = Trajectory::compute(&system, &[0.0; 5], 14_000.0 * period, Settings::default())?;
    let state = |k: f64| run.state_at((14_000.0 - k) * period - 1e-9);
    let last = state(1.0);
    for k in 1..=9 {
        let before = state(1.0 + f64::from(k));
        let off = (before[4] - last[4]).abs() / 26.5;
        assert_eq!(off < 1e-4, k == 9, "{k}: {off}");
    }
    Ok(())
}

#[test]
fn slices_find_the_same_as_the_whole() -> TestResult {
    for omega in [OMEGA_1 + OMEGA_2, 2.0 * OMEGA_1] {
        let system = system(1e-4, 1e-2, omega, ForceLaw::Quadratic)?;
        let whole = from_rest(&system, Horizon::full(600.0))?;
        let mut search = Search::new(&system, &[0.0; 5], Horizon::full(600.0))?;
        let mut slices = 0;
        let sliced = loop {
            let before = search.progress();
            if let Some(reached) = search.advance(320)? {
                break reached;
            }
            assert!(search.progress() >= before);
            slices += 1;
        };
        assert!(slices > 10, "{slices}");
        assert_eq!(sliced, whole);
    }
    Ok(())
}

#[test]
fn a_start_on_an_unstable_motion_is_not_called_that_motion() -> TestResult {
    // A multiplier of -1.148: left within the record.
    let strong = system(1e-4, 1e-2, 2.0 * OMEGA_1, ForceLaw::Quadratic)?;
    let orbit = Orbit::find(&strong, None, 1)?;
    assert!(!orbit.stable());
    // Exactly on the orbit rounding can hold the motion for ever, so it starts a billionth beside it.
    let beside: Vec<f64> = orbit.state.iter().map(|value| value * (1.0 + 1e-9)).collect();
    let reached = reach(&strong, &beside, Horizon::full(100.0))?;
    assert_eq!(reached.motion, Motion::Periodic { periods: 2 });
    // Just beyond the loss of stability it is not left for very long, and the exponent is positive: no chaos.
    let beta = critical_excitation(&strong, 2.0 * OMEGA_1, 0.01, None)?.beta().ok_or("unstable")?;
    let weak = strong.with_excitation(1.01 * beta, 2.0 * OMEGA_1)?;
    let orbit = Orbit::find(&weak, None, 1)?;
    assert!((1.0..1.01).contains(&orbit.largest_multiplier().norm()));
    let horizon = Horizon { doublings: 0, ..Horizon::full(100.0) };
    let reached = reach(&weak, &orbit.state, horizon)?;
    assert!(reached.exponent.is_some_and(|exponent| exponent.sign() == Sign::Positive));
    assert_eq!(reached.motion, Motion::Undecided { why: Undecided::NearUnstable });
    Ok(())
}

#[test]
fn rest_silence_and_free_decay_are_periodic() -> TestResult {
    let strong = ParameterSet { alpha: 1e-4, beta: 1e-2, ..Default::default() };
    for (set, initial) in [
        // At rest and left alone; decaying to rest; without coupling, so without voltage.
        (ParameterSet { beta: 0.0, ..strong }, [0.0; 5]),
        (ParameterSet { beta: 0.0, ..strong }, [0.01, 0.0, 0.0, 0.0, 0.0]),
        (ParameterSet { theta: 0.0, alpha: 1e-3, omega: 15.0, ..strong }, [0.0; 5]),
    ] {
        let system = with(set, ForceLaw::Quadratic)?;
        let reached = reach(&system, &initial, Horizon::full(600.0))?;
        assert_eq!(reached.motion, PERIOD_1, "{set:?} {reached:?}");
        assert!(reached.cell().v_rms < 1e-9, "{:?}", reached.measures);
    }
    // Without magnets everything is linear and its forced motion is the only one.
    let linear = with(ParameterSet { c0: 0.0, omega: 7.3, ..strong }, ForceLaw::Exact)?;
    assert_eq!(from_rest(&linear, Horizon::chart(600.0))?.motion, PERIOD_1);
    Ok(())
}

#[test]
fn without_a_load_a_charge_at_the_start_is_no_obstacle() -> TestResult {
    let system = with(ParameterSet { kappa: 0.0, ..Default::default() }, ForceLaw::Quadratic)?;
    assert_eq!(from_rest(&system, Horizon::chart(600.0))?.motion, PERIOD_1);
    // The charge stays, so the motion is another one than the one that Newton's iteration finds.
    let charged = reach(&system, &[0.0, 0.0, 0.0, 0.0, 2.0], Horizon::full(1500.0))?;
    assert_eq!((charged.motion, charged.orbit), (PERIOD_1, None));
    assert!(charged.measures.is_some_and(|measures| measures.v_rms > 1.0));
    Ok(())
}

#[test]
fn chaos_is_found_where_it_lasts() -> TestResult {
    let system = system(1e-4, 0.008, 20.0, ForceLaw::Exact)?;
    for horizon in [Horizon::chart(400.0), Horizon::full(600.0)] {
        let reached = from_rest(&system, horizon)?;
        assert_eq!(reached.motion, Motion::Chaotic);
        assert!(reached.exponent.is_some_and(|exponent| exponent.value > 2.0 * exponent.half_width));
        assert!(reached.dimension.is_some_and(|dimension| dimension > 1.5));
    }
    Ok(())
}

#[test]
fn slow_and_fast_excitation_are_classified_too() -> TestResult {
    for (beta, omega) in [(1e-3, 0.3), (1e-5, 400.0)] {
        let system = system(1e-4, beta, omega, ForceLaw::Quadratic)?;
        assert_eq!(from_rest(&system, Horizon::chart(600.0))?.motion, PERIOD_1, "{omega}");
    }
    Ok(())
}

#[test]
fn a_motion_is_written_in_snake_case() -> TestResult {
    assert_eq!(
        serde_json::to_string(&Motion::Periodic { periods: 2 })?,
        r#"{"kind":"periodic","periods":2}"#
    );
    let undecided = Motion::Undecided { why: Undecided::TransientNotGone };
    let text = serde_json::to_string(&undecided)?;
    assert_eq!(text, r#"{"kind":"undecided","why":"transient_not_gone"}"#);
    assert_eq!(serde_json::from_str::<Motion>(&text)?, undecided);
    Ok(())
}
