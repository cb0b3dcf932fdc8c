//! The places of the curves against an independent program, and against searches along one parameter.

use harvester_lab::dynamics::bifurcations::curves::{Curve, CurveEnd, Search, SpecialKind, find_curves};
use harvester_lab::dynamics::{Course, Instability, Orbit, critical_excitation, follow_branch};
use harvester_lab::model::{Along, ForceLaw, Magnet, Parameter, ParameterSet, Parameters, ReducedSystem};

use super::support::*;

/// The lowest unstable beta of a device as it is, found along beta.
fn critical(system: &ReducedSystem, kind: Instability) -> Fallible<f64> {
    let limit = (1.5 * system.parameters.beta).max(1e-3);
    let found = critical_excitation(system, system.parameters.omega, limit, Some(kind))?;
    Ok(found.beta().ok_or("a boundary")?)
}

#[test]
fn a_curve_meets_the_border_where_an_independent_program_has_the_boundary() -> TestResult {
    // The table of tests/slow/floquet_boundaries.rs: detuning from the sum of the two natural frequencies, and beta.
    for (alpha, modes, kind, detuning, quadratic, cubic) in [
        (1e-4, [0, 0], Instability::PeriodDoubling, 0.06, 0.000421, 0.000421),
        (1e-4, [0, 0], Instability::PeriodDoubling, 0.0, 0.001628, 0.001735),
        (1e-4, [0, 1], Instability::NeimarkSacker, 0.1, 0.003707, 0.003809),
        (1e-4, [0, 1], Instability::NeimarkSacker, 0.0, 0.010911, 0.017355),
        (1e-4, [1, 1], Instability::PeriodDoubling, 0.16, 0.036027, 0.038133),
        (1e-3, [0, 0], Instability::PeriodDoubling, 0.06, 0.000701, 0.000701),
        (1e-3, [0, 1], Instability::NeimarkSacker, 0.1, 0.013608, 0.014025),
    ] {
        for (law, reference) in [(ForceLaw::Quadratic, quadratic), (ForceLaw::Taylor(3), cubic)] {
            let system = system(mild(alpha), law)?;
            let omega = modes.map(|mode| system.modes[mode].omega).iter().sum::<f64>() + detuning;
            // The window ends there, on the side away from the tongue's tip or just beyond it.
            let side = if detuning == 0.0 { 0.4 } else { -0.3 };
            let window = chart((omega.min(omega + side), omega.max(omega + side)), 0.05)?;
            let found = curves(&system, &window)?;
            let points = found.iter().filter(|curve| curve.kind == kind).flat_map(|curve| &curve.points);
            let ends = points.filter(|point| (point.at[0] - omega).abs() < 1e-9);
            let nearest = ends.map(|point| (point.at[1] - reference).abs()).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-6, "{alpha} {omega} {law:?}: {nearest:e}");
        }
    }
    Ok(())
}

#[test]
fn curves_in_every_plane_are_the_boundaries_found_along_beta() -> TestResult {
    use Parameter::{Alpha, Beta, D, Kappa, Omega};
    let low = ParameterSet { alpha: 1e-4, beta: 1e-2, omega: 8.0969, ..Default::default() };
    for (set, law, first, second, kind) in [
        (low, ForceLaw::Exact, (Omega, (7.7, 8.5)), (Beta, (0.0, 0.02)), Instability::PeriodDoubling),
        (low, ForceLaw::Quadratic, (Omega, (25.0, 26.0)), (Beta, (0.0, 0.03)), Instability::NeimarkSacker),
        (low, ForceLaw::Quadratic, (Alpha, (0.0, 3e-3)), (Omega, (7.5, 8.8)), Instability::PeriodDoubling),
        (low, ForceLaw::Quadratic, (D, (0.12, 0.2)), (Omega, (7.0, 9.0)), Instability::PeriodDoubling),
        (low, ForceLaw::Quadratic, (Kappa, (0.0, 1e-4)), (Beta, (0.0, 0.04)), Instability::PeriodDoubling),
        (low, ForceLaw::Quadratic, (Alpha, (0.0, 1e-3)), (Beta, (0.0, 0.04)), Instability::PeriodDoubling),
        (low, ForceLaw::Exact, (Alpha, (0.0, 4e-3)), (D, (0.12, 0.2)), Instability::PeriodDoubling),
    ] {
        let system = system(set, law)?;
        let window = plane(first, second)?;
        let found = curves(&system, &window)?;
        let mut compared = 0;
        for curve in found.iter().filter(|curve| curve.kind == kind) {
            assert!(curve.ends.iter().all(|end| *end == CurveEnd::Window), "{first:?}: {:?}", curve.ends);
            for point in curve.points.iter().step_by(5) {
                let there = at(&system, &window, point.at)?;
                let beta = critical(&there, kind)?;
                assert!((beta - there.parameters.beta).abs() < 1e-8, "{first:?} {:?}: {beta}", point.at);
                compared += 1;
            }
        }
        assert!(compared >= 8, "{first:?} {second:?}: {compared}");
    }
    Ok(())
}

#[test]
fn the_fold_curve_holds_the_folds_of_the_branches() -> TestResult {
    let course = Course {
        along: Along::default(),
        parameter: Parameter::Beta,
        range: (0.0, 0.04),
        periods: 1,
        upwards: true,
        most_points: 800,
    };
    // Without a load the conserved charge adds a multiplier 1 everywhere.
    for kappa in [1e-6, 0.0] {
        let (system, _, found) = bent_resonance(kappa)?;
        let curve = of_kind(&found, Instability::Fold)?;
        assert_eq!(curve.ends, [CurveEnd::Window, CurveEnd::Window]);
        let strong = curve.points.iter().filter(|point| point.at[1] > 1e-3);
        let mut compared = 0;
        for point in strong.step_by(4) {
            let there = system.with_excitation(0.0, point.at[0])?;
            let branch = follow_branch(&there, &[0.0; 5], &course)?;
            let folds = branch.bifurcations.iter().filter(|found| found.kind == Instability::Fold);
            let distances = folds.map(|found| (found.point.value - point.at[1]).abs());
            let nearest = distances.fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-8, "{kappa} {:?}: {nearest:e}", point.at);
            compared += 1;
        }
        assert!(compared > 10, "{compared}");
    }
    Ok(())
}

#[test]
fn without_material_damping_a_tongue_goes_on_past_its_special_points() -> TestResult {
    let system = system(mild(0.0), ForceLaw::Exact)?;
    let window = chart((7.6, 8.8), 0.04)?;
    let found = curves(&system, &window)?;
    let curve = of_kind(&found, Instability::PeriodDoubling)?;
    assert_eq!(curve.ends, [CurveEnd::Window, CurveEnd::Window]);
    special(curve, SpecialKind::FlipNeimarkSacker)?;
    for point in curve.points.iter().step_by(4) {
        let orbit = Orbit::find(&at(&system, &window, point.at)?, Some(&point.state), 1)?;
        let nearest = orbit.multipliers.iter().map(|mu| (mu + 1.0).norm()).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-6, "{:?}: {nearest:e}", point.at);
        assert!((orbit.measures.v_rms - point.measures.v_rms).abs() < 1e-7, "{:?}", point.at);
    }
    Ok(())
}

#[test]
fn a_curve_ends_where_there_is_no_device() -> TestResult {
    // Attracting magnets pull the tip in when they come too near.
    let set = ParameterSet { c0: -0.01, d: 0.3, beta: 5e-3, ..mild(1e-4) };
    let system = system(set, ForceLaw::Quadratic)?;
    let window = plane((Parameter::D, (0.05, 0.4)), (Parameter::Beta, (0.0, 0.1)))?;
    let omega = 2.0 * system.modes[0].omega;
    let system = system.with_excitation(5e-3, omega)?;
    let found = find_curves(&system, &window, Search::default())?;
    assert_eq!(found.failures, []);
    let lost = |curve: &Curve| match &curve.ends[0] {
        CurveEnd::Lost { reason } => curve.points.first().map(|point| (point.at[0], reason.clone())),
        _ => None,
    };
    let (d, reason) = found.curves.iter().find_map(lost).ok_or("a lost curve")?;
    assert!(reason.contains("pull-in"), "{reason}");
    // It is lost next to where the magnets themselves say that the tip is pulled in.
    let device = |d: f64| {
        Parameters::new(ParameterSet { d, ..set })
            .and_then(|set| Magnet { c0: set.c0, h: set.h }.equilibrium(set.d))
    };
    assert!(device(d).is_ok() && device(d - 1e-5).is_err(), "{d}");
    Ok(())
}
