//! Lyapunov exponents against Floquet multipliers, against diverging Runge-Kutta runs, and zero on a torus.

#![allow(clippy::excessive_precision, reason = "reference values are given as they were printed")]

use crate::{Fallible, OMEGA_1, OMEGA_2, TestResult};
use harvester_lab::dynamics::attractors::lyapunov::{LEAST_PERIODS, Record, Sign, exponents};
use harvester_lab::dynamics::integration::rk4::RungeKutta4;
use harvester_lab::dynamics::{Effort, Exponent, Orbit, Outcome, Settings, Trajectory, reach};
use harvester_lab::model::{ForceLaw, ParameterSet, Parameters, ReducedSystem};

fn system(alpha: f64, beta: f64, omega: f64, law: ForceLaw) -> Fallible<ReducedSystem> {
    let set = ParameterSet { alpha, beta, omega, ..Default::default() };
    Ok(ReducedSystem::new(Parameters::new(set)?, 2, law)?)
}

fn exponent(system: &ReducedSystem, state: &[f64], periods: usize) -> Fallible<Exponent> {
    match exponents(system, state, (periods, periods), &|_| false)? {
        Record::Exponents(Some(exponent)) => Ok(exponent),
        other => Err(format!("{other:?}").into()),
    }
}

#[test]
fn on_a_stable_orbit_it_is_that_of_the_multipliers() -> TestResult {
    // Largest moduli over one or two periods: an independent program's, and for figure 9 the orbit's own.
    for (alpha, beta, omega, modulus) in [
        (1e-3, 1e-3, 25.0, Some(0.996743)),
        (1e-4, 1e-2, OMEGA_2 - OMEGA_1, Some(0.994786)),
        (1e-4, 1e-2, 2.0 * OMEGA_1, None),
    ] {
        let system = system(alpha, beta, omega, ForceLaw::Quadratic)?;
        let reached = reach(&system, &[0.0; 5], Effort::full())?;
        let orbit = reached.orbit.ok_or("periodic")?;
        let found = exponent(&system, &orbit.state, 4096)?;
        let time = system.parameters.period() * orbit.periods as f64;
        let expected = orbit.largest_multiplier().norm().ln() / time;
        assert!((found.value / expected - 1.0).abs() < 1e-4, "{omega}: {found:?} {expected}");
        // The interval is honest and narrow.
        assert!((found.value - expected).abs() <= found.half_width.max(1e-12), "{found:?} {expected}");
        assert!(found.half_width < 1e-3 * expected.abs() && found.converged, "{found:?}");
        assert_eq!(found.sign(), Sign::Negative);
        if let Some(modulus) = modulus {
            // The reference has six digits, of which its logarithm keeps four.
            assert!((found.value * time - f64::ln(modulus)).abs() < 1e-6, "{found:?}");
        }
        // The second exponent is that of the next multiplier: the other of a pair, or another one.
        let second = orbit.multipliers[1].norm().ln() / time;
        assert!((found.second - second).abs() < 1e-3 * second.abs(), "{omega}: {found:?} {second}");
    }
    Ok(())
}

#[test]
fn without_a_load_the_conserved_charge_is_left_out() -> TestResult {
    let set = ParameterSet { kappa: 0.0, ..Default::default() };
    let system = ReducedSystem::new(Parameters::new(set)?, 2, ForceLaw::Quadratic)?;
    let orbit = Orbit::find(&system, None, 1)?;
    let found = exponent(&system, &orbit.state, 4096)?;
    let expected = orbit.largest_multiplier().norm().ln() / system.parameters.period();
    assert!((found.value / expected - 1.0).abs() < 1e-4, "{found:?} {expected}");
    Ok(())
}

#[test]
fn on_the_torus_of_figure_4_it_is_zero() -> TestResult {
    let system = system(1e-4, 1e-2, OMEGA_1 + OMEGA_2, ForceLaw::Quadratic)?;
    let period = system.parameters.period();
    let run = Trajectory::compute(&system, &[0.0; 5], 4000.0 * period, Settings::default())?;
    let found = exponent(&system, run.final_state(), 4096)?;
    assert_eq!(found.sign(), Sign::Zero, "{found:?}");
    assert!(found.value.abs() <= found.half_width && found.half_width < 1e-4, "{found:?}");
    // It attracts: one zero exponent, not two.
    assert_eq!(found.second_sign(), Sign::Negative, "{found:?}");
    Ok(())
}

/// Growth of the distance between two Runge-Kutta runs, brought back to its first size once a period.
fn divergence(system: &ReducedSystem, state: &[f64], periods: usize, steps: u32) -> Vec<f64> {
    let first = &system.modes[0];
    let volt = first.omega * (first.eta2 / system.parameters.c).sqrt();
    let omega = |k: usize| system.modes[k].omega;
    let scales = [1.0, 1.0, omega(0), omega(1), volt];
    let distance = |a: &[f64], b: &[f64]| -> f64 {
        a.iter().zip(b).zip(scales).map(|((a, b), scale)| ((a - b) / scale).powi(2)).sum::<f64>().sqrt()
    };
    let lap = |state: &[f64]| {
        let mut run = RungeKutta4::new(system, state, steps).expect("a finite state");
        for _ in 0..steps {
            assert!(run.step().is_none());
        }
        run.state().to_vec()
    };
    let size = 1e-7;
    let mut here = state.to_vec();
    let mut beside: Vec<f64> =
        here.iter().zip(scales).map(|(x, scale)| x + size * scale / 5.0_f64.sqrt()).collect();
    (0..periods)
        .map(|_| {
            here = lap(&here);
            let moved = lap(&beside);
            let growth = distance(&moved, &here) / size;
            beside = here.iter().zip(&moved).map(|(a, b)| a + (b - a) / growth).collect();
            growth.ln()
        })
        .collect()
}

#[test]
fn on_a_chaotic_motion_it_is_the_divergence_of_runge_kutta_runs() -> TestResult {
    // Both last; at alpha 1e-4, beta 0.008, omega 20 chaos is a transient, and how long depends on rounding.
    for (alpha, beta, omega) in [(5e-4, 0.02, 20.0), (1e-3, 0.02, 20.0)] {
        let system = system(alpha, beta, omega, ForceLaw::Exact)?;
        let period = system.parameters.period();
        let run = Trajectory::compute(&system, &[0.0; 5], 1000.0 * period, Settings::default())?;
        assert_eq!(run.outcome, Outcome::Completed);
        let found = exponent(&system, run.final_state(), 6000)?;
        assert_eq!(found.sign(), Sign::Positive, "{found:?}");
        assert!(found.converged, "{found:?}");

        let growth = divergence(&system, run.final_state(), 1200, 2000);
        let rates: Vec<f64> =
            growth.chunks_exact(150).map(|block| block.iter().sum::<f64>() / (150.0 * period)).collect();
        let mean = rates.iter().sum::<f64>() / rates.len() as f64;
        let variance = rates.iter().map(|rate| (rate - mean).powi(2)).sum::<f64>() / 56.0;
        let error = 2.3646 * variance.sqrt();
        // Two independent estimates, each with its 95 % interval.
        assert!(mean > 2.0 * error, "{mean} {error}");
        assert!((mean - found.value).abs() < 1.5 * error.hypot(found.half_width), "{mean} {error} {found:?}");
    }
    Ok(())
}

#[test]
fn a_record_that_grew_gives_the_same_numbers_as_the_whole() -> TestResult {
    let system = system(1e-4, 1e-2, OMEGA_1 + OMEGA_2, ForceLaw::Quadratic)?;
    let whole = exponent(&system, &[0.0; 5], 300)?;
    for by in [1, 7, 92, 299] {
        let grown = exponents(&system, &[0.0; 5], (by, 300), &|_| false)?;
        assert_eq!(grown, Record::Exponents(Some(whole)), "{by}");
    }
    // It ends when its exponents are known.
    let early = exponents(&system, &[0.0; 5], (100, 400), &|found| found.periods > 150)?;
    assert_eq!(early, Record::Exponents(Some(whole)));
    Ok(())
}

#[test]
fn a_short_record_is_not_called_converged() -> TestResult {
    let system = system(1e-4, 1e-2, OMEGA_1 + OMEGA_2, ForceLaw::Quadratic)?;
    let short = LEAST_PERIODS - 1;
    assert_eq!(exponents(&system, &[0.0; 5], (short, short), &|_| false)?, Record::Exponents(None));
    // From rest: the transient is in the record.
    let short = exponent(&system, &[0.0; 5], LEAST_PERIODS)?;
    assert_eq!((short.sign(), short.converged), (Sign::Open, false), "{short:?}");
    Ok(())
}

#[test]
fn escape_and_contact_are_answers() -> TestResult {
    let escaping = system(1e-4, 1e-2, 2.0 * OMEGA_2, ForceLaw::Quadratic)?;
    let found = exponents(&escaping, &[0.0; 5], (100, 200), &|_| false)?;
    assert!(
        matches!(found, Record::Ended(Outcome::Escaped { time }) if (1.0..1.3).contains(&time)),
        "{found:?}"
    );
    let touching = system(1e-4, 1e-2, 25.0, ForceLaw::Exact)?;
    let found = exponents(&touching, &[-0.1694503, 0.0, 0.0, 0.0, 0.0], (10, 10), &|_| false);
    assert!(!matches!(found, Ok(Record::Exponents(Some(_)))), "{found:?}");
    Ok(())
}
