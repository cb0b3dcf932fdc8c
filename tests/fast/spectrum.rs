//! Spectra against closed forms, and that of a motion against the Fourier coefficients of its orbit.

#![allow(clippy::excessive_precision, reason = "reference values are given as they were printed")]

use crate::{Fallible, OMEGA_1, OMEGA_2, TestResult};
use std::f64::consts::{PI, TAU};

use harvester_lab::dynamics::attractors::motion::Motion;
use harvester_lab::dynamics::attractors::spectral_label::{Frequencies, Label};
use harvester_lab::dynamics::attractors::spectrum::{Spectrum, SpectrumError};
use harvester_lab::dynamics::integration::rk4::RungeKutta4;
use harvester_lab::dynamics::{Effort, VoltageSpectrum, reach};
use harvester_lab::model::{ForceLaw, ParameterSet, Parameters, ReducedSystem};
use nalgebra::Complex;

const COUNT: usize = 4096;
const INTERVAL: f64 = 0.05;
/// Distance of the bins.
const BIN: f64 = TAU / (INTERVAL * COUNT as f64);

/// The spectrum of a sum of sines (bin, amplitude, phase) about a mean.
fn sines(parts: &[(f64, f64, f64)], mean: f64) -> Fallible<Spectrum> {
    let sample = |n: usize| {
        let t = INTERVAL * n as f64;
        mean + parts.iter().map(|(bin, a, phase)| a * (bin * BIN * t + phase).sin()).sum::<f64>()
    };
    Ok(Spectrum::new(&(0..COUNT).map(sample).collect::<Vec<_>>(), INTERVAL)?)
}

#[test]
fn a_sine_between_bins_has_its_frequency_and_amplitude() -> TestResult {
    for offset in [0.0, 0.01, 0.25, 0.5, 0.77, 0.99] {
        for phase in [0.0, 0.9, 2.5] {
            let spectrum = sines(&[(300.0 + offset, 2.3, phase)], 0.4)?;
            assert!((spectrum.spacing - BIN).abs() < 1e-15);
            let lines = spectrum.lines(1e-3);
            assert_eq!(lines.len(), 1, "{offset} {phase}: {lines:?}");
            assert!((lines[0].amplitude - 2.3).abs() < 1e-6, "{offset} {phase}: {lines:?}");
            assert!((lines[0].omega / BIN - 300.0 - offset).abs() < 1e-6, "{offset} {phase}: {lines:?}");
            // The mean of a sine over no whole periods is not quite zero, and counts as such.
            assert!((spectrum.mean - 0.4).abs() < 1e-6, "{}", spectrum.mean);
        }
    }
    Ok(())
}

#[test]
fn a_strong_line_does_not_hide_a_weak_one() -> TestResult {
    let spectrum = sines(&[(300.37, 1.0, 0.2), (311.81, 2e-3, 1.0), (700.5, 0.3, 0.0)], 0.0)?;
    let lines = spectrum.lines(1e-3);
    let found: Vec<(f64, f64)> = lines.iter().map(|line| (line.omega / BIN, line.amplitude)).collect();
    assert_eq!(found.len(), 3, "{found:?}");
    for ((bin, amplitude), (expected, a)) in found.iter().zip([(300.37, 1.0), (700.5, 0.3), (311.81, 2e-3)]) {
        // What the strong line leaks eleven bins away, 1/(pi 11^3), is an eighth of the weak one.
        assert!((bin - expected).abs() < 0.15 && (amplitude / a - 1.0).abs() < 0.1, "{found:?}");
    }
    Ok(())
}

#[test]
fn a_beat_is_two_lines_when_they_are_further_apart_than_the_resolution() -> TestResult {
    let spectrum = sines(&[(300.2, 1.0, 0.0), (304.7, 1.0, 1.0)], 0.0)?;
    let lines = spectrum.lines(1e-2);
    assert_eq!(lines.len(), 2, "{lines:?}");
    // The neighbour's side lobes, about 1/(pi 4.5^3) high, are left in each.
    assert!(lines.iter().all(|line| (line.amplitude - 1.0).abs() < 0.01), "{lines:?}");
    assert!((spectrum.resolution() - 2.0 * BIN).abs() < 1e-12);
    let merged = sines(&[(300.2, 1.0, 0.0), (301.2, 1.0, 1.0)], 0.0)?;
    assert_eq!(merged.lines(1e-2).len(), 1);
    Ok(())
}

#[test]
fn the_power_in_the_bins_is_that_of_the_signal() -> TestResult {
    // Parseval for any samples: the sum over the bins is the mean square of the windowed signal over the window's.
    let mut seed = 7_u64;
    let samples: Vec<f64> = (0..1000)
        .map(|_| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        })
        .collect();
    for count in [999, 1000] {
        let spectrum = Spectrum::new(&samples[..count], 0.1)?;
        let window = |n: usize| (PI * n as f64 / count as f64).sin().powi(2);
        let total: f64 = (0..count).map(window).sum();
        let mean = (0..count).map(|n| window(n) * samples[n]).sum::<f64>() / total;
        let squares: f64 = (0..count).map(|n| (window(n) * (samples[n] - mean)).powi(2)).sum();
        let gain: f64 = (0..count).map(|n| window(n) * window(n)).sum();
        assert!((spectrum.power / (squares / gain) - 1.0).abs() < 1e-12, "{count}");
    }
    // And for steady lines it is half the squared amplitudes.
    let spectrum = sines(&[(300.3, 2.0, 0.0), (500.0, 1.0, 0.0)], 5.0)?;
    assert!((spectrum.power - 2.5).abs() < 1e-4, "{}", spectrum.power);
    assert!((spectrum.mean_square - 2.5).abs() < 1e-4);
    assert!(spectrum.share_of(&[300.3 * BIN, 500.0 * BIN]) > 0.9999);
    assert!((spectrum.share_of(&[500.0 * BIN]) - 0.2).abs() < 1e-4);
    Ok(())
}

#[test]
fn samples_without_a_spectrum_are_refused() {
    assert_eq!(Spectrum::new(&[0.0; 31], 0.1), Err(SpectrumError::Samples { got: 31 }));
    assert_eq!(Spectrum::new(&[f64::NAN; 64], 0.1), Err(SpectrumError::NotFinite));
    assert_eq!(Spectrum::new(&[0.0; 64], 0.0), Err(SpectrumError::NotFinite));
    assert!(Spectrum::new(&[0.0; 64], 0.1).is_ok_and(|flat| flat.lines(1e-3).is_empty()));
}

fn system(beta: f64, omega: f64) -> Fallible<ReducedSystem> {
    let set = ParameterSet { alpha: 1e-4, beta, omega, ..Default::default() };
    Ok(ReducedSystem::new(Parameters::new(set)?, 2, ForceLaw::Quadratic)?)
}

#[test]
fn the_lines_of_figure_9_are_the_fourier_coefficients_of_its_orbit() -> TestResult {
    let system = system(1e-2, 2.0 * OMEGA_1)?;
    let reached = reach(&system, &[0.0; 5], Effort::full())?;
    let orbit = reached.orbit.ok_or("periodic")?;
    // Equal samples of the orbit by Runge-Kutta: their sums converge faster than any power.
    let steps = 2000;
    let mut run = RungeKutta4::new(&system, &orbit.state, steps)?;
    let count = 2 * steps;
    let mut voltage = Vec::new();
    for _ in 0..count {
        voltage.push(run.state()[4]);
        assert!(run.step().is_none());
    }
    let coefficient = |harmonic: usize| {
        let turn = |n: usize| Complex::from_polar(1.0, -TAU * (harmonic * n) as f64 / f64::from(count));
        let sum: Complex<f64> = voltage.iter().enumerate().map(|(n, v)| turn(n) * v).sum();
        2.0 * sum.norm() / f64::from(count)
    };
    let found = VoltageSpectrum::of(&system, &orbit.state, Motion::Periodic { periods: 2 })?;
    assert!(found.share > 0.999_999, "{}", found.share);
    let names: Vec<String> =
        found.peaks.iter().filter_map(|peak| peak.label.map(|label| label.to_string())).collect();
    assert_eq!(names, ["ω/2", "ω", "3ω/2", "2ω"]);
    for (peak, harmonic) in found.peaks.iter().zip([1, 2, 3, 4]) {
        let (amplitude, expected) = (peak.amplitude, coefficient(harmonic));
        assert!((amplitude / expected - 1.0).abs() < 1e-5, "{harmonic}: {amplitude} {expected}");
        let omega = system.parameters.omega * harmonic as f64 / 2.0;
        assert!((peak.omega - omega).abs() < 1e-4 * found.spectrum.spacing, "{harmonic}: {}", peak.omega);
    }
    // The squares of the lines make up the mean square of the orbit.
    let squares: f64 = found.peaks.iter().map(|peak| 0.5 * peak.amplitude.powi(2)).sum();
    assert!((squares.sqrt() / orbit.measures.v_rms - 1.0).abs() < 1e-5);
    Ok(())
}

#[test]
fn the_second_frequency_of_figure_4_is_the_turning_of_its_stroboscopic_points() -> TestResult {
    let system = system(1e-2, OMEGA_1 + OMEGA_2)?;
    let reached = reach(&system, &[0.0; 5], Effort::full())?;
    let found = VoltageSpectrum::of(&system, &reached.state, Motion::Quasiperiodic)?;
    let basic = found.basic.ok_or("a torus has a second frequency")?;
    assert!(found.share > 0.999, "{}", found.share);
    assert!(found.peaks.iter().take(5).all(|peak| peak.label.is_some()), "{:?}", found.peaks);
    // Points of the closed curve about their centre in the plane of q_1 and its rate: turns a period.
    let period = system.parameters.period();
    let laps = 4000;
    let run = harvester_lab::dynamics::Trajectory::compute(
        &system,
        &reached.state,
        f64::from(laps) * period,
        Default::default(),
    )?;
    let mut points = Vec::new();
    let times: Vec<f64> = (0..laps).map(|k| f64::from(k) * period).collect();
    run.read_at(&times, |_, state| points.push(Complex::new(state[0], -state[2] / OMEGA_1)));
    let centre: Complex<f64> = points.iter().sum::<Complex<f64>>() / f64::from(laps);
    let turns: f64 = points
        .windows(2)
        .map(|pair| ((pair[1] - centre) / (pair[0] - centre)).arg().rem_euclid(TAU) / TAU)
        .sum::<f64>()
        / f64::from(laps - 1);
    let omega = system.parameters.omega;
    let expected = (basic / omega).rem_euclid(1.0);
    let off = (turns - expected).abs().min((turns - 1.0 + expected).abs());
    assert!(off < 1e-3, "{turns} turns a period, {basic} / {omega}");
    // Close to, but not on, the linear own frequency of beam and circuit, 4.0783: the magnet shifts it.
    assert!((basic - 4.0783).abs() > 0.05 && (basic - 4.0783).abs() < 0.3, "{basic}");
    Ok(())
}

#[test]
fn a_dying_transient_leaves_its_own_frequencies() -> TestResult {
    // Free vibration about a weak forced motion, from a start at rest, read as it is.
    let system = system(1e-5, 10.0)?;
    let found = VoltageSpectrum::of(
        &system,
        &[1e-5, 0.0, 0.0, 0.0, 0.0],
        Motion::Undecided { why: harvester_lab::dynamics::attractors::motion::Undecided::TransientNotGone },
    )?;
    let names: Vec<String> =
        found.peaks.iter().filter_map(|peak| peak.label.map(|label| label.to_string())).collect();
    assert!(names.contains(&"ω".to_owned()) && names.contains(&"ω₁′".to_owned()), "{names:?}");
    Ok(())
}

#[test]
fn labels_are_exact_relations_or_near_combinations() {
    let frequencies = Frequencies {
        excitation: 25.4047,
        own: vec![4.0783, 21.4365],
        tolerance: 0.015,
        largest_denominator: 8,
    };
    let name = |omega: f64| frequencies.label(omega).map(|label| label.to_string());
    for (omega, expected) in [
        (25.4047, Some("ω")),
        (12.70235, Some("ω/2")),
        (50.81, Some("2ω")),
        (76.2141 / 4.0, Some("3ω/4")),
        (4.06, Some("ω₁′")),
        (21.5, Some("ω₂′")),
        (8.1, Some("2ω₁′")),
        (29.45, Some("ω + ω₁′")),
        (17.4, Some("ω₂′ − ω₁′")),
        // Within the resolution of nothing, and too far from any combination.
        (12.75, None),
        (6.2, None),
        (31.0, None),
    ] {
        assert_eq!(name(omega).as_deref(), expected, "{omega}");
    }
    let Some(Label::Own { shift, .. }) = frequencies.own_label(4.0375) else { panic!("near the first") };
    assert!((shift + 0.01).abs() < 1e-4, "{shift}");
    for (label, text) in [
        (Label::Torus { excitation: 1, denominator: 1, basic: -2 }, "ω − 2ν"),
        (Label::Torus { excitation: 3, denominator: 2, basic: 1 }, "3ω/2 + ν"),
        (Label::Torus { excitation: -1, denominator: 1, basic: 3 }, "3ν − ω"),
        (Label::Excitation { numerator: 5, denominator: 2 }, "5ω/2"),
        (Label::Own { excitation: 1, first: -1, second: 0, shift: 0.0 }, "ω − ω₁′"),
    ] {
        assert_eq!(label.to_string(), text);
    }
}
