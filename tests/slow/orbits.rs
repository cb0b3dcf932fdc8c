//! Periodic orbits and their multipliers against reference values and closed forms.

#![allow(clippy::excessive_precision, reason = "reference values are given as they were printed")]

use crate::{Fallible, TestResult};
use harvester_lab::dynamics::{Instability, Orbit, OrbitError, PeriodMap, Settings, Trajectory};
use harvester_lab::model::{ForceLaw, ParameterSet, Parameters, ReducedSystem};
use harvester_lab::questions::Run;
use harvester_lab::scenario::{ModelChoice, Scenario};
use harvester_lab::theory::LinearResponse;
use harvester_lab::theory::spectrum::eigenvalues;
use nalgebra::Complex;

const LAWS: [ForceLaw; 3] = [ForceLaw::Quadratic, ForceLaw::Taylor(5), ForceLaw::Exact];

fn system(set: ParameterSet, modes: usize, law: ForceLaw) -> Fallible<ReducedSystem> {
    Ok(ReducedSystem::new(Parameters::new(set)?, modes, law)?)
}

fn strong() -> ParameterSet {
    ParameterSet { alpha: 1e-4, beta: 1e-2, ..Default::default() }
}

fn figure_9(law: ForceLaw) -> Fallible<ReducedSystem> {
    let system = system(strong(), 2, law)?;
    Ok(system.with_excitation(1e-2, 2.0 * system.modes[0].omega)?)
}

#[test]
fn the_forced_motions_of_the_figures() -> TestResult {
    // Largest moduli from an independent program.
    let low = system(strong(), 2, ForceLaw::Quadratic)?;
    let mild = system(ParameterSet::default(), 2, ForceLaw::Quadratic)?;
    let (first, second) = (low.modes[0].omega, low.modes[1].omega);
    for (base, beta, omega, reference) in [
        (&mild, 1e-3, 25.0, 0.996743),
        (&low, 1e-2, first + second, 0.999378),
        (&low, 1e-2, second - first, 0.994786),
        (&mild, 1e-3, 8.0, 0.989845),
        (&low, 1e-2, 2.0 * first, 1.148382),
        (&mild, 1e-3, 43.0, 0.998103),
        (&low, 1e-2, 2.0 * second, 0.998852),
    ] {
        let orbit = Orbit::find(&base.with_excitation(beta, omega)?, None, 1)?;
        let modulus = orbit.largest_multiplier().norm();
        assert!((modulus - reference).abs() < 1e-6, "omega = {omega}: {modulus}");
        assert_eq!(orbit.stable(), reference < 1.0);
        assert!(orbit.residual < 1e-12, "{}", orbit.residual);
    }
    let orbit = Orbit::find(&figure_9(ForceLaw::Quadratic)?, None, 1)?;
    assert!((orbit.largest_multiplier() - Complex::from(-1.148382)).norm() < 1e-6);
    assert_eq!(orbit.instability(), Some(Instability::PeriodDoubling));
    Ok(())
}

#[test]
fn the_period_two_motion_of_figure_9() -> TestResult {
    let system = figure_9(ForceLaw::Quadratic)?;
    let period = system.parameters.period();
    let run = Trajectory::compute(&system, &[0.0; 5], 600.0 * period, Settings::default())?;
    // Asked for four periods, the iteration finds the orbit of two and says so.
    for periods in [2, 4] {
        let orbit = Orbit::find(&system, Some(run.final_state()), periods)?;
        assert_eq!(orbit.periods, 2);
        assert!(orbit.stable());
        let measures = orbit.measures;
        // The orbit by tests/reference/figures.py.
        for (value, reference) in [
            (measures.v_rms, 14.178327664385),
            (measures.tip.1, 0.066011694910454),
            (measures.tip.0, -0.083537564726360),
        ] {
            assert!((value / reference - 1.0).abs() < 1e-9, "{value} instead of {reference}");
        }
        assert!((orbit.largest_multiplier().norm() - 0.988).abs() < 1e-3);
        // Means of a periodic function by equal samples converge faster than any power: a second way to v_rms.
        let lap = Trajectory::compute(&system, &orbit.state, 2.0 * period, Settings { tolerance: 1e-8 })?;
        let times: Vec<f64> = (0..400).map(|i| 2.0 * period * f64::from(i) / 400.0).collect();
        let mut square = 0.0;
        lap.read_at(&times, |_, state| square += state[4] * state[4] / 400.0);
        assert!((measures.v_rms - square.sqrt()).abs() < 1e-7, "{} {}", measures.v_rms, square.sqrt());
    }
    // From the linear response it finds the forced motion.
    assert_eq!(Orbit::find(&system, None, 2)?.periods, 1);
    Ok(())
}

#[test]
fn liouville_holds_for_every_law_and_number_of_modes() -> TestResult {
    for law in LAWS {
        for modes in 1..=8 {
            for alpha in [0.0, 1e-4, 1e-3] {
                for (beta, omega) in [(1e-3, 25.0), (1e-2, 8.0969), (2e-3, 3.0)] {
                    let set = ParameterSet { alpha, beta, omega, ..Default::default() };
                    let orbit = Orbit::find(&system(set, modes, law)?, None, 1)?;
                    let defect = orbit.liouville_defect;
                    assert!(
                        defect.is_some_and(|defect| defect < 1e-9),
                        "{law:?} {modes} {set:?}: {defect:?}"
                    );
                }
            }
        }
    }
    // Where no multiplier is tiny, their product says the same.
    let system = figure_9(ForceLaw::Exact)?;
    let orbit = Orbit::find(&system, None, 1)?;
    let product: Complex<f64> = orbit.multipliers.iter().product();
    let expected = (system.jacobian(0.0).trace() * system.parameters.period()).exp();
    assert!((product / expected - 1.0).norm() < 1e-9, "{product} {expected}");
    Ok(())
}

/// Largest deviation of the map's derivative from central differences, in comparable components.
fn largest_deviation(system: &ReducedSystem, periods: usize) -> Result<f64, OrbitError> {
    let mut map = PeriodMap::new(system);
    map.refine()?;
    let beta = system.parameters.beta;
    let n = map.dimension();
    let scales = map.scales().to_vec();
    let state: Vec<f64> = (0..n).map(|i| 0.01 * scales[i] * (1.0 + i as f64).sin()).collect();
    let mut image = |state: &[f64], beta: f64| {
        map.apply(state, beta, periods, |_, _| ())?;
        Ok::<Vec<f64>, OrbitError>(map.image().to_vec())
    };
    let step = 5e-5;
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let units: Vec<f64> = scales.iter().copied().chain([1.0]).collect();
    for (j, unit) in units.iter().enumerate() {
        let mut moved = |steps: f64| {
            let (mut state, mut beta) = (state.clone(), beta);
            let value = state.get_mut(j).unwrap_or(&mut beta);
            *value += steps * step * unit;
            image(&state, beta)
        };
        let [a, b, c, d] = [moved(-2.0)?, moved(-1.0)?, moved(1.0)?, moved(2.0)?];
        let fourth_order = |i: usize| (a[i] - d[i] + 8.0 * (c[i] - b[i])) / (12.0 * step);
        columns.push((0..n).map(fourth_order).collect());
    }
    map.apply(&state, beta, periods, |_, _| ())?;
    let mut worst: f64 = 0.0;
    for (j, (column, unit)) in columns.iter().zip(&units).enumerate() {
        for i in 0..n {
            worst = worst.max((map.derivative(i, j) * unit - column[i]).abs() / scales[i]);
        }
    }
    Ok(worst)
}

#[test]
fn the_derivative_of_the_map_is_that_by_finite_differences() -> TestResult {
    for law in LAWS {
        for (modes, periods) in [(1, 1), (2, 2), (4, 1)] {
            let system = system(ParameterSet { omega: 8.0, ..strong() }, modes, law)?;
            let worst = largest_deviation(&system, periods)?;
            assert!(worst < 1e-8, "{law:?} {modes}: {worst:e}");
        }
    }
    Ok(())
}

#[test]
fn without_magnets_everything_is_known_in_closed_form() -> TestResult {
    for modes in [1, 2, 5] {
        let set = ParameterSet { c0: 0.0, omega: 7.3, ..strong() };
        let system = system(set, modes, ForceLaw::Exact)?;
        let orbit = Orbit::find(&system, Some(&vec![0.0; system.dimension()]), 1)?;
        let response = LinearResponse::new(&system)?;
        for (value, expected) in orbit.state.iter().zip(response.state(0.0)) {
            assert!((value - expected).abs() < 1e-10 * (1.0 + expected.abs()), "{value} {expected}");
        }
        let (tip, volts) = (response.tip().norm(), response.voltage.norm());
        assert!((orbit.measures.v_rms - volts / 2.0_f64.sqrt()).abs() < 1e-10 * volts);
        assert!((orbit.measures.tip.1 - tip).abs() < 1e-10 * tip, "{} {tip}", orbit.measures.tip.1);
        assert!((orbit.measures.tip.0 + tip).abs() < 1e-10 * tip, "{} {tip}", orbit.measures.tip.0);
        for eigenvalue in eigenvalues(&system)? {
            let expected = (eigenvalue * system.parameters.period()).exp();
            let nearest =
                orbit.multipliers.iter().map(|mu| (mu - expected).norm()).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-11, "{expected}: {nearest:e}");
        }
    }
    Ok(())
}

#[test]
fn a_run_along_an_orbit_measures_the_orbit() -> TestResult {
    let quadratic = |modes| ModelChoice { modes, ..Default::default() };
    let figure_9 = ParameterSet { omega: figure_9(ForceLaw::Quadratic)?.parameters.omega, ..strong() };
    // The end of a run need not be that of a period; the second orbit has two.
    for (set, model, periods, t_end) in [
        (ParameterSet::default(), quadratic(2), 1, 602.0),
        (figure_9, quadratic(2), 2, 601.3),
        (
            ParameterSet { omega: 12.0, ..strong() },
            ModelChoice { modes: 4, force: ForceLaw::Exact, ..Default::default() },
            1,
            100.0,
        ),
    ] {
        let system = model.system(set)?;
        let settled =
            Trajectory::compute(&system, &vec![0.0; system.dimension()], 2000.0, Settings::default())?;
        let period = system.parameters.period();
        let whole = (2000.0 / period / 2.0).floor() * 2.0;
        let orbit = Orbit::find(&system, Some(&settled.state_at(whole * period)), periods)?;
        assert_eq!((orbit.periods, orbit.stable()), (periods, true));
        let initial = Some(orbit.state.clone());
        let run = Run::compute(&Scenario { parameters: set, model, initial, t_end, ..Default::default() })?;
        let summary = run.summary.ok_or("a completed run has a summary")?;
        // Whole pairs of periods, to the last one that is complete, and hardly more than the last tenth.
        let lasts = [summary.to - summary.from, summary.to].map(|time| time / period);
        assert!((lasts[0] / 2.0 - (lasts[0] / 2.0).round()).abs() < 1e-9, "{lasts:?}");
        assert!((lasts[1] - (t_end / period).floor()).abs() < 1e-9, "{lasts:?}");
        assert!((0.0..2.0).contains(&(lasts[0] - 0.1 * t_end / period)), "{lasts:?}");
        let measures = orbit.measures;
        for (value, reference) in [
            (summary.measures.v_rms, measures.v_rms),
            (summary.measures.tip.1, measures.tip.1),
            (summary.measures.tip.0, measures.tip.0),
        ] {
            assert!((value / reference - 1.0).abs() < 1e-9, "{set:?}: {value} instead of {reference}");
        }
        // Voltage and rate against plain sampling of the same motion: a maximum between samples is lower by the
        // square of their distance.
        let (mut peak, mut steepest) = (0.0_f64, 0.0_f64);
        run.trajectory.sample(summary.to - 2.0 * period, summary.to, 20_001, |_, state| {
            peak = peak.max(state[2 * model.modes].abs());
            steepest = steepest.max(system.voltage_rate(state).abs());
        });
        for (value, reference) in [(summary.measures.v_peak, peak), (summary.dv_dt_peak, steepest)] {
            assert!((-1e-9..2e-6).contains(&(value / reference - 1.0)), "{set:?}: {value} {reference}");
        }
    }
    Ok(())
}

#[test]
fn motions_that_end_within_the_period_are_errors() -> TestResult {
    let escaping = Orbit::find(&figure_9(ForceLaw::Quadratic)?, Some(&[2.0, 0.0, 0.0, 0.0, 0.0]), 1);
    assert!(matches!(escaping, Err(OrbitError::Escaped { .. })), "{escaping:?}");
    let touching = Orbit::find(&figure_9(ForceLaw::Exact)?, Some(&[-0.2, 0.0, 0.0, 0.0, 0.0]), 1);
    assert!(matches!(touching, Err(OrbitError::Contact { .. })), "{touching:?}");
    let short = Orbit::find(&figure_9(ForceLaw::Exact)?, Some(&[0.0; 3]), 1);
    assert!(matches!(short, Err(OrbitError::Integration(_))), "{short:?}");
    let never = Orbit::find(&figure_9(ForceLaw::Exact)?, None, 0);
    assert!(matches!(never, Err(OrbitError::Periods { .. })), "{never:?}");
    Ok(())
}
