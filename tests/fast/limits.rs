//! Limits in which the answer is known: no coupling, no magnet, no tip mass, no damping; and the bounds that
//! hold for every beam.

#![allow(clippy::excessive_precision, reason = "reference values are given as they were printed")]

use crate::{Fallible, TestResult};
use harvester_lab::model::quadrature::gauss_legendre;
use harvester_lab::model::{ForceLaw, ModeSet, Parameter, ParameterSet, Parameters, ReducedSystem};
use harvester_lab::theory::spectrum::eigenvalues;
use harvester_lab::theory::{CoupledModes, LinearResponse, Published, Resonance, SteadyState, TheoryError};
use nalgebra::Complex;
use proptest::prelude::*;

fn system(set: ParameterSet, modes: usize) -> Fallible<ReducedSystem> {
    Ok(ReducedSystem::new(Parameters::new(set)?, modes, ForceLaw::Exact)?)
}

#[test]
fn without_magnet_the_full_system_runs_along_the_closed_form() -> TestResult {
    for (modes, omega) in [(1, 4.2), (2, 21.0), (4, 60.0)] {
        let set = ParameterSet { c0: 0.0, omega, beta: 0.05, ..Default::default() };
        let system = system(set, modes)?;
        let response = LinearResponse::new(&system)?;
        let force = system.rest_force();
        let mut state = response.state(0.0);
        let steps = 40_000;
        let step = 2.0 * system.parameters.period() / f64::from(steps);
        let rate = |state: &[f64], t: f64| {
            let mut rate = vec![0.0; state.len()];
            let rest = force.rest(system.tip_displacement(state));
            system.derivative(state, rest, (omega * t).sin(), &mut rate);
            rate
        };
        let add = |state: &[f64], rate: &[f64], h: f64| -> Vec<f64> {
            state.iter().zip(rate).map(|(state, rate)| state + h * rate).collect()
        };
        for i in 0..steps {
            let t = step * f64::from(i);
            let k1 = rate(&state, t);
            let k2 = rate(&add(&state, &k1, step / 2.0), t + step / 2.0);
            let k3 = rate(&add(&state, &k2, step / 2.0), t + step / 2.0);
            let k4 = rate(&add(&state, &k3, step), t + step);
            for (n, value) in state.iter_mut().enumerate() {
                *value += step / 6.0 * (k1[n] + 2.0 * k2[n] + 2.0 * k3[n] + k4[n]);
            }
            if i % 10_000 == 0 {
                let expected = response.state(t + step);
                let scale = expected.iter().fold(0.0_f64, |scale, value| scale.max(value.abs()));
                for (value, expected) in state.iter().zip(expected) {
                    assert!((value - expected).abs() < 1e-9 * scale, "{modes} {omega}");
                }
            }
        }
    }
    Ok(())
}

#[test]
fn with_little_coupling_and_damping_the_linear_response_is_the_papers_steady_state() -> TestResult {
    let set = ParameterSet { alpha: 1e-9, theta: 1e-9, omega: 10.0, ..Default::default() };
    let system = system(set, 4)?;
    let (exact, first_order) = (LinearResponse::new(&system)?, SteadyState::new(&system)?);
    assert!((exact.tip().re / first_order.tip.amplitude - 1.0).abs() < 1e-7);
    let voltage = exact.voltage_harmonic();
    for t in [0.0, 0.1, 0.2] {
        assert!((voltage.value(t) - first_order.voltage.value(t)).abs() < 1e-7 * voltage.amplitude);
        let slope = (voltage.value(t + 1e-6) - voltage.value(t - 1e-6)) / 2e-6;
        assert!((voltage.rate(t) - slope).abs() < 1e-7 * voltage.amplitude * voltage.omega);
    }
    assert!((voltage.root_mean_square() / voltage.amplitude - 0.5_f64.sqrt()).abs() < 1e-15);
    Ok(())
}

#[test]
fn without_coupling_the_two_theories_meet_as_the_damping_vanishes() -> TestResult {
    // What is left is of the order of the damping; in the sum resonance also the phase of the modes'
    // residues, which tilts the tongue by a fraction of detuning over frequency, beyond the first order of
    // the published theory.
    let system = system(ParameterSet { alpha: 1e-7, theta: 0.0, ..Default::default() }, 2)?;
    let (published, coupled) = (Published::new(&system)?, CoupledModes::new(&system)?);
    for resonance in Resonance::ALL {
        let centre = published.frequency(resonance);
        for detuning in [-0.3, -0.01, 0.1] {
            let omega = centre + detuning;
            let pair = published.boundary(resonance, omega).zip(coupled.boundary(resonance, omega));
            let ratio = pair.map_or(f64::NAN, |(published, coupled)| coupled / published);
            let tilt = if resonance == Resonance::Sum { 0.05 * f64::abs(detuning) / centre } else { 0.0 };
            assert!((ratio - 1.0).abs() < 3e-6 + tilt, "{resonance:?} {detuning}: {ratio}");
        }
    }
    Ok(())
}

#[test]
fn with_no_damping_at_all_the_sum_tongue_is_narrower_than_in_the_limit_of_little() -> TestResult {
    let system = system(ParameterSet { alpha: 0.0, theta: 0.0, ..Default::default() }, 2)?;
    let (published, coupled) = (Published::new(&system)?, CoupledModes::new(&system)?);
    let damping = [0, 1].map(|k| system.modes[k].omega.powi(2) - system.c1 / system.modes[k].eta2);
    let destabilised = 0.5 * (damping[0] + damping[1]) / (damping[0] * damping[1]).sqrt();
    for (resonance, factor) in
        [(Resonance::Sum, destabilised), (Resonance::First, 1.0), (Resonance::Second, 1.0)]
    {
        let omega = published.frequency(resonance) + 0.1;
        assert!((coupled.frequency(resonance) / published.frequency(resonance) - 1.0).abs() < 1e-14);
        let pair = published.boundary(resonance, omega).zip(coupled.boundary(resonance, omega));
        let ratio = pair.map_or(f64::NAN, |(published, coupled)| coupled / published);
        assert!((ratio / factor - 1.0).abs() < 1e-10, "{resonance:?}: {ratio} {factor}");
        // The growth rate of the published theory knows the narrower tongue.
        let growth = |beta| published.growth_rate(resonance, beta, omega).unwrap_or(f64::NAN);
        let edge = coupled.boundary(resonance, omega).unwrap_or(f64::NAN);
        assert!(growth(0.99 * edge) == 0.0 && growth(1.01 * edge) > 0.0, "{resonance:?}");
    }
    Ok(())
}

#[test]
fn without_coupling_the_circuit_has_its_own_eigenvalue_and_the_modes_the_mechanical_ones() -> TestResult {
    let set = ParameterSet { theta: 0.0, kappa: 3e-6, c0: 0.0, alpha: 2e-3, ..Default::default() };
    let system = system(set, 4)?;
    let values = eigenvalues(&system)?;
    assert!((values[0] + 3.0).norm() < 1e-11);
    // c_1 = 0 uncouples the modes: s^2 + alpha omega^2 s + omega^2 = 0.
    for (mode, pair) in system.modes.iter().zip(values[1..].chunks(2)) {
        let ratio = 1e-3 * mode.omega;
        let expected = Complex::new(-ratio, (1.0 - ratio * ratio).sqrt()) * mode.omega;
        assert!((pair[0] - expected).norm() < 1e-12 * 120.0, "{} {expected}", pair[0]);
        assert_eq!(pair[1], pair[0].conj());
    }
    Ok(())
}

#[test]
fn a_circuit_far_faster_or_slower_than_the_beam_leaves_the_eigenvalues_their_digits() -> TestResult {
    // The matrix holds kappa/c = 2e6 beside the slowest mode's decay of 2e-6.
    let set = ParameterSet {
        c: 1e-9,
        kappa: 2e-3,
        alpha: 1e-6,
        theta: 0.0,
        c0: 0.0,
        eta: 90.0,
        ..Default::default()
    };
    let fast = system(set, 8)?;
    let values = eigenvalues(&fast)?;
    assert!((values[0] + 2e6).norm() < 1e-9);
    for (mode, pair) in fast.modes.iter().zip(values[1..].chunks(2)) {
        let decay = 5e-7 * mode.omega * mode.omega;
        assert!((pair[0].re + decay).abs() < 1e-8 * decay, "{} {decay}", pair[0]);
    }
    // An open circuit keeps any charge for ever.
    let open = system(ParameterSet { kappa: 0.0, ..Default::default() }, 8)?;
    assert!(eigenvalues(&open)?[0].norm() < 1e-12);
    Ok(())
}

#[test]
fn undamped_resonance_has_no_linear_steady_state() -> TestResult {
    let free = system(ParameterSet { alpha: 0.0, theta: 0.0, c0: 0.0, ..Default::default() }, 2)?;
    let resonant = free.with_excitation(1e-3, free.modes[1].omega)?;
    let omega = resonant.parameters.omega;
    assert_eq!(LinearResponse::new(&resonant), Err(TheoryError::Undamped { omega }));
    Ok(())
}

#[test]
fn without_magnet_and_tip_mass_it_is_the_textbook_cantilever() -> TestResult {
    let modes = ModeSet::new(0.0, 0.0, 8)?;
    // Roots of cos x cosh x = -1 and the tabulated constants sigma_n, by which the average of a shape of unit
    // tip is sigma_n / lambda_n with alternating sign.
    for (n, (wave_number, sigma)) in [
        (1.8751040687119611, 0.734095514),
        (4.6940911329741746, -1.018467319),
        (7.8547574382376126, 0.999224497),
    ]
    .into_iter()
    .enumerate()
    {
        let mode = &modes[n];
        assert!((mode.wave_number - wave_number).abs() < 1e-14 * wave_number);
        assert!((mode.eta2 - 0.25).abs() < 1e-13);
        assert!((mode.eta1 - sigma / wave_number).abs() < 1e-9, "{}", mode.eta1);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn two_modes_overlap_by_minus_eta(c1 in -2.9..200.0f64, eta in 0.0..50.0f64) {
        // Eq. (23), by a quadrature of another order than the model's own.
        let modes = ModeSet::new(c1, eta, 8).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let (nodes, weights) = gauss_legendre(64);
        for n in 0..8 {
            for k in 0..n {
                let overlap: f64 = nodes
                    .iter()
                    .zip(&weights)
                    .map(|(x, weight)| weight * modes[n].shape(*x) * modes[k].shape(*x))
                    .sum();
                let scale = (modes[n].eta2 * modes[k].eta2).sqrt();
                prop_assert!((overlap + eta).abs() < 1e-10 * scale, "{n} {k}: {overlap} {eta}");
            }
        }
    }

    #[test]
    fn a_spring_raises_and_a_mass_lowers_every_frequency_within_its_bounds(
        c1 in -2.9..100.0f64, eta in 0.0..10.0f64,
    ) {
        let set = |c1, eta| ModeSet::new(c1, eta, 8).map_err(|error| TestCaseError::fail(error.to_string()));
        let (modes, stiffer, heavier) = (set(c1, eta)?, set(c1 + 1.0, eta)?, set(c1, eta + 0.1)?);
        for n in 0..8 {
            prop_assert!(stiffer[n].omega > modes[n].omega && heavier[n].omega < modes[n].omega);
            // One constraint more (the pinned tip, tan x = tanh x) separates the roots.
            let pinned = |n: f64| std::f64::consts::PI * (n + 0.25);
            prop_assert!(modes[n].wave_number < pinned(n as f64 + 1.0));
            prop_assert!(n == 0 || modes[n].wave_number > pinned(n as f64) - 1e-3);
        }
    }

    #[test]
    fn every_accepted_system_has_its_eigenvalues(
        alpha in 0.0..0.1f64, c0 in -0.1..10.0f64, d in 0.1..2.0f64, eta in 0.0..100.0f64, c in -9.0..-2.0f64,
        kappa in 0.0..1e-2f64, theta in 0.0..1e-2f64, modes in 1..9usize, undamped: bool, uncoupled: bool,
    ) {
        let set = ParameterSet {
            alpha: if undamped { 0.0 } else { alpha },
            theta: if uncoupled { 0.0 } else { theta },
            c: 10f64.powf(c), c0, d, eta, kappa, ..Default::default()
        };
        for parameter in Parameter::ALL {
            let (low, high) = parameter.range();
            prop_assert!((low..=high).contains(&set.get(parameter)));
        }
        let Ok(system) = system(set, modes) else { return Ok(()) };
        let values = eigenvalues(&system).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let matrix = system.jacobian(0.0);
        let size = values.iter().fold(0.0, |size: f64, value| size.max(value.norm()));
        let sum: Complex<f64> = values.iter().sum();
        prop_assert!((sum - matrix.trace()).norm() < 1e-11 * size, "sum {sum} trace {}", matrix.trace());
        let grows = values.iter().any(|value| value.re > 1e-12 * size);
        prop_assert!(!grows, "a passive system cannot grow: {values:?}");
        match CoupledModes::new(&system) {
            Ok(coupled) => {
                for mode in coupled.modes() {
                    prop_assert!(mode.decay >= 0.0 && mode.residue.norm().is_finite());
                }
            }
            Err(error) => prop_assert!(matches!(
                error, TheoryError::TooFewModes { .. } | TheoryError::Overdamped { .. }
            ), "{error}"),
        }
    }
}
