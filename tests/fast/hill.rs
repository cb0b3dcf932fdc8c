//! Floquet multipliers against Hill's matrix: harmonic balance for the motion, an eigenproblem in frequency space for
//! its exponents. Nothing of the integrator is in it.

use crate::{Fallible, TestResult};
use std::f64::consts::TAU;

use harvester_lab::dynamics::{Orbit, Settings, Trajectory};
use harvester_lab::model::{ForceLaw, ParameterSet, Parameters, ReducedSystem};
use harvester_lab::theory::DynamicStiffness;
use nalgebra::{Complex, DMatrix, DVector};

fn system(set: ParameterSet, law: ForceLaw) -> Fallible<ReducedSystem> {
    Ok(ReducedSystem::new(Parameters::new(set)?, 2, law)?)
}

/// Number of harmonics and of points in time of the harmonic balance.
const HARMONICS: i32 = 24;
const POINTS: usize = 96;

/// Fourier coefficients -HARMONICS..=HARMONICS of values at POINTS equal times of a period.
fn fourier(values: &[f64], harmonics: i32) -> Vec<Complex<f64>> {
    let coefficient = |k: i32| {
        let turn = |i: usize| Complex::from_polar(1.0, -TAU * f64::from(k) * i as f64 / POINTS as f64);
        values.iter().enumerate().map(|(i, value)| turn(i) * *value).sum::<Complex<f64>>() / POINTS as f64
    };
    (-harmonics..=harmonics).map(coefficient).collect()
}

/// The tip's forced motion at POINTS times by harmonic balance: every harmonic of s answers the excitation and
/// that of R through the dynamic stiffness.
fn balanced_tip(system: &ReducedSystem) -> Option<Vec<f64>> {
    let force = system.rest_force();
    let stiffness = DynamicStiffness::new(system);
    let (beta, omega) = (system.parameters.beta, system.parameters.omega);
    let ones = DVector::from_element(system.modes.len(), Complex::from(1.0));
    let receptance = |k: i32| {
        let response = stiffness.matrix(Complex::new(0.0, f64::from(k) * omega)).lu().solve(&ones);
        response.map(|response| response.sum())
    };
    let receptances = (-HARMONICS..=HARMONICS).map(receptance).collect::<Option<Vec<_>>>()?;
    let drive = stiffness.tip_response(omega)? * beta;
    let mut tip = vec![0.0; POINTS];
    for _ in 0..400 {
        let rest: Vec<f64> = tip.iter().map(|s| force.rest(*s)).collect();
        let rest = fourier(&rest, HARMONICS);
        for (i, s) in tip.iter_mut().enumerate() {
            let phase = TAU * i as f64 / POINTS as f64;
            let answers = rest.iter().zip(&receptances).zip(-HARMONICS..);
            let answer = answers.map(|((r, t), k)| r * t * Complex::from_polar(1.0, phase * f64::from(k)));
            *s = (drive * Complex::from_polar(1.0, phase)).im - answer.sum::<Complex<f64>>().re;
        }
    }
    Some(tip)
}

/// Distance of the exponent `guess` from the nearest eigenvalue of Hill's matrix of the linearised motion.
fn distance_to_hill(system: &ReducedSystem, slope: &[Complex<f64>], guess: Complex<f64>) -> Option<f64> {
    let modulated = system.jacobian(1.0) - system.jacobian(0.0);
    let mean = system.jacobian(0.0);
    let n = mean.nrows();
    let count = (HARMONICS + 1) as usize;
    let half = HARMONICS / 2;
    // The voltage is scaled to the size of the others, or rounding would decide.
    let scale = |i: usize| if i + 1 == n { 1e3 } else { 1.0 };
    let hill = DMatrix::from_fn(n * count, n * count, |row, column| {
        let ((a, i), (b, j)) = ((row / n, row % n), (column / n, column % n));
        let harmonic = (a as i32 - b as i32 + HARMONICS) as usize;
        let mut entry = slope[harmonic] * modulated[(i, j)];
        if a == b {
            entry += mean[(i, j)];
            if i == j {
                let frequency = system.parameters.omega * f64::from(a as i32 - half);
                entry -= Complex::new(0.0, frequency) + guess;
            }
        }
        entry * (scale(j) / scale(i))
    });
    let solver = hill.lu();
    let mut x = DVector::from_fn(n * count, |i, _| Complex::from_polar(1.0, i as f64));
    let mut nearest = Complex::from(f64::INFINITY);
    for _ in 0..30 {
        x = x.normalize();
        let y = solver.solve(&x)?;
        nearest = y.dotc(&x) / y.norm_squared();
        x = y;
    }
    Some(nearest.norm())
}

#[test]
fn the_multipliers_are_those_of_hills_matrix() -> TestResult {
    for (law, alpha, beta, omega) in [
        (ForceLaw::Quadratic, 1e-4, 1e-2, 8.0969),
        (ForceLaw::Exact, 1e-4, 1e-2, 8.0969),
        (ForceLaw::Taylor(3), 1e-3, 1e-2, 25.4047),
    ] {
        let system = system(ParameterSet { alpha, beta, omega, ..Default::default() }, law)?;
        let tip = balanced_tip(&system).ok_or("a response")?;
        let orbit = Orbit::find(&system, None, 1)?;
        assert!((system.tip_displacement(&orbit.state) - tip[0]).abs() < 1e-11, "{law:?}");
        let force = system.rest_force();
        let slope: Vec<f64> = tip.iter().map(|s| force.slope(*s)).collect();
        let slope = fourier(&slope, HARMONICS);
        let period = system.parameters.period();
        for multiplier in &orbit.multipliers {
            let distance = distance_to_hill(&system, &slope, multiplier.ln() / period).ok_or("a solution")?;
            assert!(distance * period * multiplier.norm() < 1e-8, "{law:?} {multiplier}: {distance:e}");
        }
    }
    Ok(())
}

#[test]
fn without_a_load_the_charge_is_kept_and_left_out() -> TestResult {
    let set = ParameterSet { alpha: 1e-4, beta: 1e-2, omega: 8.3, kappa: 0.0, ..Default::default() };
    let open = system(set, ForceLaw::Exact)?;
    let orbit = Orbit::find(&open, Some(&[0.0; 5]), 1)?;
    let charge: f64 = open.theta.iter().zip(&orbit.state).map(|(theta, q)| theta * q).sum();
    assert!((open.parameters.c * orbit.state[4] - charge).abs() < 1e-16, "{charge}");
    assert_eq!(orbit.multipliers.len(), 4);
    // The integrator returns to the state, and Hill's matrix has these exponents.
    let period = open.parameters.period();
    let run = Trajectory::compute(&open, &orbit.state, period, Settings { tolerance: 1e-6 })?;
    for (end, start) in run.final_state().iter().zip(&orbit.state) {
        assert!((end - start).abs() < 1e-9 * (1.0 + start.abs()), "{end} {start}");
    }
    let force = open.rest_force();
    let times: Vec<f64> = (0..POINTS).map(|i| period * i as f64 / POINTS as f64).collect();
    let mut slope = Vec::new();
    run.read_at(&times, |_, state| slope.push(force.slope(open.tip_displacement(state))));
    let slope = fourier(&slope, HARMONICS);
    for multiplier in &orbit.multipliers {
        let distance = distance_to_hill(&open, &slope, multiplier.ln() / period).ok_or("a solution")?;
        assert!(distance * period * multiplier.norm() < 1e-8, "{multiplier}: {distance:e}");
    }
    Ok(())
}
