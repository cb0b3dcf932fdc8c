//! The linear response of the truncated system against that of the continuous beam, which no mode enters.

use crate::{Fallible, TestResult};
use harvester_lab::model::{ForceLaw, ParameterSet, Parameters, ReducedSystem};
use harvester_lab::theory::LinearResponse;
use nalgebra::{Complex, DMatrix, DVector};

fn system(set: ParameterSet, modes: usize) -> Fallible<ReducedSystem> {
    Ok(ReducedSystem::new(Parameters::new(set)?, modes, ForceLaw::Exact)?)
}

const I: Complex<f64> = Complex::new(0.0, 1.0);

/// Tip displacement and voltage per unit of beta of the continuous beam, without truncation: the closed form
/// z = a cos px + b sin px + c cosh px + d sinh px - beta under the boundary conditions of Eq. (15), where
/// the piezoelectric moment -theta v acts at the tip and a Kelvin-Voigt beam has the stiffness 1 + i alpha
/// omega.
fn continuous_beam(system: &ReducedSystem) -> Option<(Complex<f64>, Complex<f64>)> {
    let p = &system.parameters;
    let omega = Complex::from(p.omega);
    let stiffness = 1.0 + I * p.alpha * p.omega;
    let wave = (omega * omega / stiffness).powf(0.25);
    let (s, c, sh, ch) = (wave.sin(), wave.cos(), wave.sinh(), wave.cosh());
    let zero = Complex::from(0.0);
    // Columns a, b, c, d, v: clamp, tip moment, tip shear, circuit.
    let (w2, w3) = (wave * wave, wave * wave * wave);
    let tip = system.c1 - p.eta * omega * omega;
    let circuit = -I * p.omega * p.theta * wave;
    #[rustfmt::skip]
    let matrix = DMatrix::from_row_slice(5, 5, &[
        1.0.into(), zero, 1.0.into(), zero, zero,
        zero, wave, zero, wave, zero,
        -w2 * c, -w2 * s, w2 * ch, w2 * sh, Complex::from(p.theta) / stiffness,
        stiffness * w3 * s - tip * c, -stiffness * w3 * c - tip * s,
        stiffness * w3 * sh - tip * ch, stiffness * w3 * ch - tip * sh, zero,
        -circuit * s, circuit * c, circuit * sh, circuit * ch, p.kappa + I * p.omega * p.c,
    ]);
    // z(0) = 0; the shear balances -tip z(1) and the inertia -eta omega^2 of the base motion.
    let right =
        DVector::from_vec(vec![1.0.into(), zero, zero, -tip - Complex::from(p.eta) * omega * omega, zero]);
    let x = matrix.lu().solve(&right)?;
    Some((x[0] * c + x[1] * s + x[2] * ch + x[3] * sh - 1.0, x[4]))
}

#[test]
fn without_coupling_the_linear_response_converges_to_the_continuous_beam() -> TestResult {
    for (c0, eta, alpha, omega) in
        [(0.0, 0.0, 1e-3, 10.0), (0.0, 0.02, 0.01, 25.0), (0.5084, 0.02, 1e-3, 8.0), (-1e-4, 2.0, 0.05, 3.0)]
    {
        let set = ParameterSet { c0, eta, alpha, omega, beta: 0.01, theta: 0.0, ..Default::default() };
        let mut last = f64::INFINITY;
        for modes in [1, 2, 4, 8] {
            let system = system(set, modes)?;
            let (tip, voltage) = continuous_beam(&system).ok_or("singular")?;
            let response = LinearResponse::new(&system)?;
            assert_eq!((response.voltage, voltage), (0.0.into(), 0.0.into()));
            let error = (response.tip() / (tip * 0.01) - 1.0).norm();
            assert!(error < last, "{set:?} {modes}: {error}");
            last = error;
        }
        // What modes 9, 10, .. add falls off with the fifth power of their number.
        assert!(last < 1e-4, "{set:?}: {last}");
    }
    Ok(())
}

#[test]
fn with_coupling_the_voltage_converges_to_that_of_the_continuous_beam() -> TestResult {
    for (kappa, omega, c0) in [(1e-6, 8.0, 0.0), (1e-5, 25.0, 0.5084), (0.0, 3.0, 0.5084)] {
        let set = ParameterSet { kappa, omega, c0, alpha: 1e-4, beta: 0.01, ..Default::default() };
        let errors = |modes| -> Fallible<(f64, f64)> {
            let truncated = system(set, modes)?;
            let (_, voltage) = continuous_beam(&truncated).ok_or("singular")?;
            // A tip moment bends all modes, so the truncation converges only like 1/N. The missing modes
            // follow the moment statically and act as a capacitance: what they lack to the slope
            // 1 - (c_1/4) / (1 + c_1/3) that a unit moment gives the tip.
            let slope = 1.0 - 0.25 * truncated.c1 / (1.0 + truncated.c1 / 3.0);
            let kept: f64 =
                truncated.modes.iter().map(|mode| (mode.tip_slope / mode.omega).powi(2) / mode.eta2).sum();
            let completed = ParameterSet { c: set.c + set.theta.powi(2) * (slope - kept), ..set };
            let relative = |system: &ReducedSystem| {
                LinearResponse::new(system).map(|response| (response.voltage / (voltage * 0.01) - 1.0).norm())
            };
            Ok((relative(&truncated)?, relative(&system(completed, modes)?)?))
        };
        let mut last = f64::INFINITY;
        for modes in [2, 4, 8] {
            let (truncated, completed) = errors(modes)?;
            assert!(truncated < 0.1 / modes as f64, "{set:?} {modes}: {truncated}");
            // Left over is the base motion's drive of the missing modes, falling like 1/N^3.
            assert!(completed < 0.5 * (modes as f64).powi(-3), "{set:?} {modes}: {completed}");
            assert!(completed < 0.2 * last, "{set:?} {modes}: {completed} after {last}");
            last = completed;
        }
    }
    Ok(())
}
