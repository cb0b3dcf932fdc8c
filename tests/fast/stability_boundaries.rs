//! The stability boundaries against numbers computed apart from the crate, and their properties.

#![allow(clippy::excessive_precision, reason = "reference values are given as they were printed")]

use crate::{Fallible, TestResult};
use harvester_lab::model::{ForceLaw, ParameterSet, Parameters, ReducedSystem};
use harvester_lab::theory::{CoupledModes, Published, Resonance, TheoryError};
use nalgebra::Complex;
use proptest::prelude::*;

fn system(set: ParameterSet, modes: usize) -> Fallible<ReducedSystem> {
    Ok(ReducedSystem::new(Parameters::new(set)?, modes, ForceLaw::Quadratic)?)
}

fn damped(alpha: f64, modes: usize) -> Fallible<ReducedSystem> {
    system(ParameterSet { alpha, ..Default::default() }, modes)
}

fn close(value: f64, reference: f64, tolerance: f64) -> bool {
    (value - reference).abs() <= tolerance * reference.abs()
}

/// alpha, omega, resonance, coupled-mode beta of this theory's formulas evaluated in 40-digit arithmetic with
/// a general eigenvalue routine and the phase condition solved for the common frequency, Floquet beta of the
/// forced orbit of the quadratic two-mode system computed by an independent program.
const COUPLED: [(f64, f64, Resonance, f64, f64); 8] = [
    (1e-4, 8.1569, Resonance::First, 0.000421323711331, 0.000421),
    (1e-4, 8.0969, Resonance::First, 0.00165727081341, 0.001628),
    (1e-4, 25.5047, Resonance::Sum, 0.00372754921848, 0.003707),
    (1e-4, 25.4047, Resonance::Sum, 0.01157806432, 0.010911),
    (1e-4, 25.3047, Resonance::Sum, 0.0204995442183, 0.018431),
    (1e-4, 42.8725, Resonance::Second, 0.0359373781403, 0.036027),
    (1e-3, 8.1569, Resonance::First, 0.000701284889417, 0.000701),
    (1e-3, 25.5047, Resonance::Sum, 0.0136025598588, 0.013608),
];

#[test]
fn the_published_detunings_at_exact_resonance() -> TestResult {
    // 40-digit arithmetic on Eqs. (56), (72), (81) for beta = 0.01; None is stable.
    for (alpha, sum, first, second) in [
        (0.0, Some(0.260352374693), 0.374632660311, Some(0.014622055048)),
        (1e-4, Some(0.259320588599), 0.374630894649, None),
        (1e-3, Some(0.119013550892), 0.374456052948, None),
        (2e-3, None, 0.373925730383, None),
    ] {
        let theory = Published::new(&damped(alpha, 2)?)?;
        for (resonance, reference) in
            [(Resonance::Sum, sum), (Resonance::First, Some(first)), (Resonance::Second, second)]
        {
            let value = theory.critical_detuning(resonance, 0.01, theory.frequency(resonance));
            match (value, reference) {
                (Some(value), Some(reference)) => assert!(close(value, reference, 1e-11), "{value}"),
                (value, reference) => assert_eq!(value, reference, "{alpha} {resonance:?}"),
            }
        }
    }
    Ok(())
}

#[test]
fn the_published_boundary_of_the_sum_resonance() -> TestResult {
    // 40-digit arithmetic on Eq. (57).
    for modes in [2, 4] {
        let theory = Published::new(&damped(1e-4, modes)?)?;
        for (omega, reference) in [(25.3047, 0.0037681965547), (25.5047, 0.00412413566131)] {
            let beta = theory.boundary(Resonance::Sum, omega);
            assert!(beta.is_some_and(|beta| close(beta, reference, 1e-11)), "{omega}: {beta:?}");
        }
    }
    Ok(())
}

#[test]
fn the_operating_points_of_the_figures_as_the_paper_classifies_them() -> TestResult {
    let (mild, strong) = (Published::new(&damped(1e-3, 2)?)?, Published::new(&damped(1e-4, 2)?)?);
    for omega in [25.0, 17.308, 8.0, 43.0] {
        assert_eq!(mild.stable(1e-3, omega), Some(true), "figures 3, 5, 8, 11");
    }
    assert_eq!(strong.stable(1e-2, strong.frequency(Resonance::Sum)), Some(false), "figure 4");
    assert_eq!(strong.stable(1e-2, strong.difference_frequency()), Some(true), "figure 6");
    assert_eq!(strong.stable(1e-2, strong.frequency(Resonance::First)), Some(false), "figure 9");
    // Figure 12 is shown as unstable, but Eq. (81) itself does not say so.
    assert_eq!(strong.stable(1e-2, strong.frequency(Resonance::Second)), Some(true), "figure 12");
    Ok(())
}

/// Growth rate by integrating the slow equations (49) with the classical Runge-Kutta method until the fastest
/// solution dominates.
fn growth_by_integration(damping: [f64; 2], gain: [f64; 2], detuning: f64) -> f64 {
    let rate = |y: [Complex<f64>; 2], t: f64| {
        let turn = Complex::from_polar(1.0, detuning * t);
        [gain[0] * y[1].conj() * turn - damping[0] * y[0], gain[1] * y[0].conj() * turn - damping[1] * y[1]]
    };
    let mut y = [Complex::new(1.0, 0.3), Complex::new(-0.2, 0.7)];
    let (step, steps) = (0.05, 40_000);
    let mut logarithm = [0.0; 2];
    for i in 0..steps {
        let t = step * f64::from(i);
        let add = |k: [Complex<f64>; 2], s: f64| [y[0] + k[0] * s, y[1] + k[1] * s];
        let k1 = rate(y, t);
        let k2 = rate(add(k1, step / 2.0), t + step / 2.0);
        let k3 = rate(add(k2, step / 2.0), t + step / 2.0);
        let k4 = rate(add(k3, step), t + step);
        for n in 0..2 {
            y[n] += (k1[n] + (k2[n] + k3[n]) * 2.0 + k4[n]) * (step / 6.0);
        }
        let size = y[0].norm().max(y[1].norm());
        y = [y[0] / size, y[1] / size];
        logarithm[usize::from(i >= steps / 2)] += size.ln();
    }
    logarithm[1] / (step * f64::from(steps / 2))
}

#[test]
fn the_published_growth_rates_are_those_of_the_slow_equations() -> TestResult {
    let system = damped(1e-3, 2)?;
    let theory = Published::new(&system)?;
    let c2 = -19.378543266710827;
    for (resonance, beta, detuning) in [
        (Resonance::Sum, 0.02, 0.05),
        (Resonance::Sum, 0.02, -0.1),
        (Resonance::First, 0.01, 0.1),
        (Resonance::Second, 0.15, 0.02),
    ] {
        let (i, j) = resonance.pair();
        let omega = system.modes[i].omega + system.modes[j].omega + detuning;
        let amplitudes = [0, 1].map(|k| {
            let mode = &system.modes[k];
            omega * omega * beta * mode.eta1 / (mode.eta2 * (mode.omega * mode.omega - omega * omega))
        });
        let g = c2 * (amplitudes[0] + amplitudes[1]);
        let pair = [i, j].map(|k| &system.modes[k]);
        let damping = pair.map(|mode| 5e-4 * (mode.omega * mode.omega - system.c1 / mode.eta2));
        let gain = pair.map(|mode| g / (2.0 * mode.omega * mode.eta2));
        let reference = growth_by_integration(damping, gain, detuning);
        let growth = theory.growth_rate(resonance, beta, omega).unwrap_or(f64::NAN);
        // Halfway through the run the slower solution has died out.
        assert!((growth - reference).abs() < 1e-6, "{resonance:?} {detuning}: {growth} {reference}");
    }
    Ok(())
}

#[test]
fn the_eigenvalues_of_beam_and_circuit() -> TestResult {
    // Eigenvalues of the unscaled matrix A in 40-digit arithmetic, alpha = 1e-4: first the circuit's, then
    // one a mode.
    let two = [
        (-0.978057761744196, 0.0),
        (-0.00780662006538647, 4.07827174622026),
        (-0.026320304751957, 21.4365186744992),
    ];
    let four = [
        (-0.974336273997493, 0.0),
        (-0.00775444839815114, 4.07816926022561),
        (-0.0262900149400073, 21.4361744165684),
        (-0.179050173097382, 59.7352988605237),
        (-0.685820359415701, 117.150815001317),
    ];
    for (modes, references) in [(2, &two[..]), (4, &four[..])] {
        let coupled = CoupledModes::new(&damped(1e-4, modes)?)?;
        let upper: Vec<_> = coupled.eigenvalues().iter().filter(|value| value.im >= 0.0).collect();
        assert_eq!((upper.len(), coupled.eigenvalues().len()), (modes + 1, 2 * modes + 1));
        for (value, (re, im)) in upper.into_iter().zip(references) {
            assert!(close(value.re, *re, 1e-13) && close(value.im, *im, 1e-14), "{value} {re} {im}");
        }
        for (mode, (re, im)) in coupled.modes().iter().zip(&references[1..]) {
            assert!(close(-mode.decay, *re, 1e-13) && close(mode.frequency, *im, 1e-14));
        }
    }
    Ok(())
}

#[test]
fn the_coupled_boundaries_of_two_modes() -> TestResult {
    for (alpha, omega, resonance, reference, _) in COUPLED {
        let beta = CoupledModes::new(&damped(alpha, 2)?)?.boundary(resonance, omega);
        assert!(beta.is_some_and(|beta| close(beta, reference, 1e-10)), "{alpha} {omega}: {beta:?}");
    }
    Ok(())
}

#[test]
fn the_coupled_boundaries_of_more_modes() -> TestResult {
    // 40-digit arithmetic, as for two modes.
    for (alpha, omega, resonance, four, eight) in [
        (1e-4, 8.1569, Resonance::First, 0.000420705680595, 0.00041963107364),
        (1e-4, 25.3047, Resonance::Sum, 0.0192382682583, 0.0191902330878),
        (1e-4, 42.8725, Resonance::Second, 0.274136390739, 0.311308453211),
        (1e-3, 25.5047, Resonance::Sum, 0.0127083934849, 0.0126835213047),
    ] {
        for (modes, reference) in [(4, four), (8, eight)] {
            let beta = CoupledModes::new(&damped(alpha, modes)?)?.boundary(resonance, omega);
            assert!(beta.is_some_and(|beta| close(beta, reference, 1e-9)), "{modes} {omega}: {beta:?}");
        }
    }
    Ok(())
}

#[test]
fn near_the_tips_of_the_tongues_the_coupled_boundary_is_floquets_to_one_per_cent() -> TestResult {
    for (alpha, omega, resonance, _, floquet) in COUPLED {
        // Elsewhere it lies at amplitudes where a first-order theory is only good to about eleven per cent.
        let tip = [8.1569, 25.5047, 42.8725].contains(&omega);
        let beta = CoupledModes::new(&damped(alpha, 2)?)?.boundary(resonance, omega);
        let tolerance = if tip { 0.01 } else { 0.12 };
        assert!(beta.is_some_and(|beta| close(beta, floquet, tolerance)), "{alpha} {omega}: {beta:?}");
    }
    Ok(())
}

#[test]
fn equation_57_is_five_times_too_low_where_the_circuit_has_moved_the_tongue() -> TestResult {
    let system = damped(1e-4, 2)?;
    let published = Published::new(&system)?.boundary(Resonance::Sum, 25.3047);
    let coupled = CoupledModes::new(&system)?.boundary(Resonance::Sum, 25.3047);
    let ratio = coupled.zip(published).map(|(coupled, published)| coupled / published);
    assert!(ratio.is_some_and(|ratio| (5.0..6.0).contains(&ratio)), "{ratio:?}");
    Ok(())
}

#[test]
fn the_difference_resonance_couples_with_the_other_sign_and_never_grows() -> TestResult {
    for alpha in [1e-4, 1e-3] {
        let coupled = CoupledModes::new(&damped(alpha, 4)?)?;
        let [first, second] = [coupled.modes()[0], coupled.modes()[1]];
        let centre = second.frequency - first.frequency;
        for step in -10..=10 {
            let detuning = 0.05 * f64::from(step);
            let coupling = coupled.difference_coupling(0, 1, centre + detuning).unwrap_or_default();
            assert!(coupling.re < 0.0 && coupling.im.abs() < 0.02 * coupling.re.abs(), "{coupling}");
            for beta in [0.001, 0.01, 0.05, 0.2] {
                // Roots of (rho + r_1)(rho + r_2 + i sigma) = beta^2 K.
                let other = Complex::new(second.decay, detuning);
                let mean = -0.5 * (other + first.decay);
                let half = 0.5 * (other - first.decay);
                let root = (half * half + coupling * (beta * beta)).sqrt();
                assert!((mean + root).re < 0.0 && (mean - root).re < 0.0, "{alpha} {detuning} {beta}");
            }
        }
    }
    Ok(())
}

#[test]
fn a_system_the_theories_do_not_cover_is_an_error() -> TestResult {
    let single = damped(1e-3, 1)?;
    assert_eq!(Published::new(&single), Err(TheoryError::TooFewModes { found: 1 }));
    assert_eq!(CoupledModes::new(&single), Err(TheoryError::TooFewModes { found: 1 }));
    assert_eq!(CoupledModes::new(&damped(0.1, 2)?), Err(TheoryError::Overdamped { found: 1 }));
    // At a natural frequency the published theory has no answer; without magnets nothing is unstable.
    let theory = Published::new(&damped(1e-3, 2)?)?;
    let natural = theory.frequency(Resonance::First) / 2.0;
    assert_eq!(theory.boundary(Resonance::Sum, natural), None);
    assert_eq!(theory.growth_rate(Resonance::Sum, 0.01, natural), None);
    assert_eq!(theory.stable(0.01, natural), None);
    let plain = system(ParameterSet { c0: 0.0, ..Default::default() }, 2)?;
    for resonance in Resonance::ALL {
        assert_eq!(Published::new(&plain)?.boundary(resonance, 25.0), None);
        assert_eq!(CoupledModes::new(&plain)?.boundary(resonance, 25.0), None);
    }
    assert_eq!(Published::new(&plain)?.stable(0.2, 25.0), Some(true));
    Ok(())
}

#[test]
fn air_that_takes_what_the_material_took_leaves_the_published_boundary_where_it_was() -> TestResult {
    for (resonance, mode) in [(Resonance::First, 0), (Resonance::Second, 1)] {
        let material = damped(1e-3, 2)?;
        let shape = &material.modes[mode];
        // Of the one mode of a subharmonic: alpha m_k = a_m eta_2k.
        let air = 1e-3 * (shape.omega.powi(2) - material.c1 / shape.eta2);
        let breeze = system(ParameterSet { alpha: 0.0, air, ..Default::default() }, 2)?;
        let (a, b) = (Published::new(&material)?, Published::new(&breeze)?);
        for detuning in [-0.2, 0.0, 0.3] {
            let omega = a.frequency(resonance) + detuning;
            for (x, y) in [
                (a.boundary(resonance, omega), b.boundary(resonance, omega)),
                (a.growth_rate(resonance, 0.01, omega), b.growth_rate(resonance, 0.01, omega)),
            ] {
                let (x, y) = (x.ok_or("none")?, y.ok_or("none")?);
                assert!((x / y - 1.0).abs() < 1e-10, "{resonance:?} {detuning}: {x} {y}");
            }
        }
    }
    // Both together: growth ends at the boundary of the sum, too.
    let both = Published::new(&system(ParameterSet { alpha: 5e-4, air: 0.03, ..Default::default() }, 2)?)?;
    let omega = both.frequency(Resonance::Sum) + 0.1;
    let beta = both.boundary(Resonance::Sum, omega).ok_or("none")?;
    let growth = both.growth_rate(Resonance::Sum, beta, omega).ok_or("none")?;
    assert!(growth.abs() < 1e-12, "{growth}");
    Ok(())
}

fn any_resonance() -> impl Strategy<Value = Resonance> {
    proptest::sample::select(&Resonance::ALL[..])
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn published_growth_vanishes_exactly_at_the_boundary(
        alpha in 1e-5..0.01f64, c0 in 0.01..2.0f64, eta in 0.0..2.0f64, detuning in -1.0..1.0f64,
        resonance in any_resonance(),
    ) {
        let set = ParameterSet { alpha, c0, eta, ..Default::default() };
        let system = system(set, 2).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let theory = Published::new(&system).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let omega = theory.frequency(resonance) + detuning;
        if let Some(beta) = theory.boundary(resonance, omega) {
            let growth =
                |factor: f64| theory.growth_rate(resonance, factor * beta, omega).unwrap_or(f64::NAN);
            let scale = -growth(0.0) + detuning.abs();
            prop_assert!(growth(1.0).abs() < 1e-11 * scale, "{} of {scale}", growth(1.0));
            prop_assert!(growth(0.999) < 0.0 && growth(1.001) > 0.0);
            let critical = theory.critical_detuning(resonance, beta * (1.0 + 1e-12), omega);
            prop_assert!(critical.is_some_and(|sigma| sigma >= detuning.abs() * (1.0 - 1e-9)));
        }
    }

    #[test]
    fn coupled_growth_vanishes_exactly_at_the_boundary(
        alpha in 0.0..0.01f64, theta in 0.0..5e-4f64, kappa in 1e-9..1e-5f64, detuning in -1.0..1.0f64,
        modes in 2..5usize, resonance in any_resonance(),
    ) {
        let set = ParameterSet { alpha, theta, kappa, ..Default::default() };
        let system = system(set, modes).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let theory = CoupledModes::new(&system).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let omega = theory.frequency(resonance) + detuning;
        if let Some(beta) = theory.boundary(resonance, omega) {
            let growth =
                |factor: f64| theory.growth_rate(resonance, factor * beta, omega).unwrap_or(f64::NAN);
            prop_assert!(growth(0.99) < 0.0 && growth(1.01) > 0.0, "{} {}", growth(0.99), growth(1.01));
        }
    }
}
