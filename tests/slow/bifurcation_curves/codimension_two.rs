//! Points of codimension two: their multipliers, the curves that meet in them, the branches on either side.

use harvester_lab::dynamics::bifurcations::curves::{
    Criticality, Curve, CurveEnd, CurvePoint, Line, SpecialKind, SpecialPoint, Start,
    bifurcations_along_line, trace_curve,
};
use harvester_lab::dynamics::orbits::floquet::multipliers;
use harvester_lab::dynamics::{
    Course, Instability, Orbit, OrbitError, PeriodMap, Plane, follow_branch, follow_doubled,
};
use harvester_lab::model::{Along, ForceLaw, Parameter, ParameterSet, ReducedSystem};
use nalgebra::Complex;

use super::support::*;

/// How far a state misses itself after a period, over the gap, and the multipliers: without Newton's iteration,
/// which knows no orbit at a fold.
fn miss_and_multipliers(
    system: &ReducedSystem,
    state: &[f64],
) -> Result<(f64, Vec<Complex<f64>>), OrbitError> {
    let mut map = PeriodMap::new(system);
    let beta = system.parameters.beta;
    while map.apply(state, beta, 1, |_, _| ())? > 1e-3 {
        map.refine()?;
    }
    let misses = map.image().iter().zip(state).zip(map.scales()).map(|((a, b), scale)| (a - b).abs() / scale);
    Ok((misses.fold(0.0, f64::max) / map.gap(), multipliers(&map.scaled_derivative())?))
}

/// The multipliers of the orbit at a point of codimension two, which is there.
fn multipliers_at(
    system: &ReducedSystem,
    plane: &Plane,
    point: &SpecialPoint,
) -> Fallible<Vec<Complex<f64>>> {
    let there = at(system, plane, point.at)?;
    let (missed, multipliers) = miss_and_multipliers(&there, &point.state)?;
    assert!(missed < 1e-8, "{} {:?}: {missed:e}", point.kind, point.at);
    Ok(multipliers)
}

#[test]
fn beyond_a_cusp_there_are_two_folds_and_before_it_none() -> TestResult {
    let (system, _, found) = bent_resonance(1e-6)?;
    let cusps = found.iter().flat_map(|curve| &curve.special).filter(|s| s.kind == SpecialKind::Cusp);
    let cusp = cusps.max_by(|a, b| a.at[0].total_cmp(&b.at[0])).ok_or("a cusp")?;
    let folds = |beta: f64| -> Fallible<Vec<f64>> {
        let there = system.with_excitation(beta, cusp.at[0] - 0.1)?;
        let orbit = Orbit::find(&there, None, 1)?;
        let range = (cusp.at[0] - 0.1, cusp.at[0] + 0.1);
        let course = Course {
            along: Along::default(),
            parameter: Parameter::Omega,
            range,
            periods: 1,
            upwards: true,
            most_points: 800,
        };
        let branch = follow_branch(&there, &orbit.state, &course)?;
        let folds = branch.bifurcations.iter().filter(|found| found.kind == Instability::Fold);
        Ok(folds.map(|found| found.point.value).collect())
    };
    let beyond = folds(cusp.at[1] * 1.001)?;
    assert_eq!(beyond.len(), 2);
    assert!(beyond.iter().all(|omega| (omega - cusp.at[0]).abs() < 1e-3), "{beyond:?} {:?}", cusp.at);
    assert_eq!(folds(cusp.at[1] * 0.999)?, [0.0; 0]);
    Ok(())
}

#[test]
fn neimark_sacker_curves_end_in_resonances() -> TestResult {
    // 1:1 on the fold curve of the quadratic law, 1:2 on the period doublings of the exact one.
    let (quadratic, window, found) = bent_resonance(1e-6)?;
    let exact = system(mild(1e-4), ForceLaw::Exact)?;
    let other = chart((8.4, 8.7), 0.02)?;
    let doublings = curves(&exact, &other)?;
    for (system, window, found, kind, base, critical) in [
        (&quadratic, &window, &found, SpecialKind::OneToOne, Instability::Fold, 1.0),
        (&exact, &other, &doublings, SpecialKind::OneToTwo, Instability::PeriodDoubling, -1.0),
    ] {
        let curve = of_kind(found, base)?;
        let resonances: Vec<_> = curve.special.iter().filter(|point| point.kind == kind).collect();
        assert_eq!(resonances.len(), 2, "{kind}");
        for resonance in resonances {
            // Two multipliers are there, as near as the root of the errors.
            let multipliers = multipliers_at(system, window, resonance)?;
            let near = multipliers.iter().filter(|mu| (*mu - critical).norm() < 1e-4);
            assert_eq!(near.count(), 2, "{kind}: {multipliers:?}");
            // A Neimark-Sacker curve ends in each, with its pair on the circle up to there.
            let torus = |curve: &&Curve| {
                let ends = [curve.points.first(), curve.points.last()];
                let meets = |end: &CurvePoint| window.distance(end.at, resonance.at) < 1e-7;
                curve.kind == Instability::NeimarkSacker && ends.iter().flatten().any(|end| meets(end))
            };
            let torus = found.iter().find(torus).ok_or_else(|| format!("no curve at {:?}", resonance.at))?;
            assert!(torus.ends.contains(&CurveEnd::Meeting { special: kind }));
            for point in torus.points.iter().skip(2).rev().skip(2).step_by(3) {
                let orbit = Orbit::find(&at(system, window, point.at)?, Some(&point.state), 1)?;
                let on_circle = |mu: &&Complex<f64>| {
                    (mu.norm() - 1.0).abs() < 1e-7 && Instability::of(**mu) == Instability::NeimarkSacker
                };
                assert_eq!(orbit.multipliers.iter().filter(on_circle).count(), 2, "{:?}", point.at);
            }
        }
    }
    Ok(())
}

#[test]
fn a_fold_flip_is_found_on_both_of_its_curves() -> TestResult {
    let system = system(mild(1e-4), ForceLaw::Exact)?;
    let window = chart((21.4, 21.9), 0.01)?;
    let starts = bifurcations_along_line(&system, &window, Line { along: 1, at: 21.5 }, false)?;
    let trace = |start: &Start| trace_curve(&system, start, &window);
    let found = starts.iter().map(trace).collect::<Result<Vec<_>, _>>()?;
    let folds = of_kind(&found, Instability::Fold)?;
    assert_eq!(folds.ends, [CurveEnd::Closed, CurveEnd::Closed]);
    assert_eq!(folds.points.first().map(|point| point.at), folds.points.last().map(|point| point.at));
    assert_eq!(folds.special.iter().filter(|point| point.kind == SpecialKind::Cusp).count(), 2);
    let doublings = of_kind(&found, Instability::PeriodDoubling)?;
    let both: Vec<_> = [folds, doublings]
        .map(|curve| {
            curve.special.iter().filter(|point| point.kind == SpecialKind::FoldFlip).collect::<Vec<_>>()
        })
        .into();
    assert_eq!([both[0].len(), both[1].len()], [2, 2]);
    for point in &both[0] {
        let distance = both[1].iter().map(|other| window.distance(point.at, other.at));
        assert!(distance.fold(f64::INFINITY, f64::min) < 1e-7, "{:?}", point.at);
        let multipliers = multipliers_at(&system, &window, point)?;
        for critical in [1.0, -1.0] {
            assert!(multipliers.iter().any(|mu| (mu - critical).norm() < 1e-5), "{multipliers:?}");
        }
    }
    Ok(())
}

#[test]
fn a_strong_resonance_has_its_angle() -> TestResult {
    let system = system(mild(1e-4), ForceLaw::Exact)?;
    let window = chart((3.8, 3.9), 0.04)?;
    let found = curves(&system, &window)?;
    let quarter = special(of_kind(&found, Instability::NeimarkSacker)?, SpecialKind::OneToFour)?;
    let orbit = Orbit::find(&at(&system, &window, quarter.at)?, Some(&quarter.state), 1)?;
    let quarter_turn = Complex::new(0.0, 1.0);
    assert!(orbit.multipliers.iter().any(|mu| (mu - quarter_turn).norm() < 1e-7), "{:?}", orbit.multipliers);
    assert_eq!(quarter.kind.to_string(), "1:4 resonance");
    Ok(())
}

#[test]
fn the_doubled_motions_fold_ends_where_the_doubling_turns_supercritical() -> TestResult {
    let set = ParameterSet { beta: 1e-5, omega: 8.0969, ..mild(1e-4) };
    let system = system(set, ForceLaw::Quadratic)?;
    let course = Course {
        along: Along::default(),
        parameter: Parameter::Beta,
        range: (0.0, 0.01),
        periods: 1,
        upwards: true,
        most_points: 600,
    };
    let births = |omega: f64| -> Fallible<_> {
        let there = system.with_excitation(1e-5, omega)?;
        let forced = follow_branch(&there, &[0.0; 5], &course)?;
        let birth = forced.bifurcations.first().ok_or("a doubling")?.clone();
        let doubled = follow_doubled(&there, &birth, &course)?;
        Ok((birth, doubled))
    };
    let (birth, doubled) = births(8.0969)?;
    assert!((birth.point.value - 0.001_627_73).abs() < 1e-8);
    let fold = doubled.bifurcations.first().ok_or("a fold")?;
    assert!((fold.point.value - 0.000425).abs() < 5e-7, "{}", fold.point.value);
    let window = chart((7.6, 8.8), 0.04)?;
    let start = Start {
        kind: fold.kind,
        periods: 2,
        at: [8.0969, fold.point.value],
        state: fold.point.state.clone(),
    };
    let curve = trace_curve(&system, &start, &window)?;
    let meeting = CurveEnd::Meeting { special: SpecialKind::GeneralizedPeriodDoubling };
    assert_eq!(curve.ends, [CurveEnd::Window, meeting]);
    let end = special(&curve, SpecialKind::GeneralizedPeriodDoubling)?;

    // The other curve of it, by the cubic coefficient, and the direction of the branches on both sides.
    let doublings = only(curves(&system, &window)?)?;
    let turn = special(&doublings, SpecialKind::GeneralizedPeriodDoubling)?;
    assert!(window.distance(end.at, turn.at) < 1e-7, "{:?} {:?}", end.at, turn.at);
    for (omega, supercritical) in [(turn.at[0] - 3e-3, false), (turn.at[0] + 3e-3, true)] {
        let (birth, doubled) = births(omega)?;
        let next = doubled.points.get(1).ok_or("points")?;
        assert_eq!(next.value > birth.point.value, supercritical, "{omega}");
    }
    // Points between are folds of the doubled branches there.
    for point in curve.points.iter().filter(|point| point.at[0] > 7.8 && point.at[0] < 8.14).step_by(4) {
        let (_, doubled) = births(point.at[0])?;
        let fold = doubled.bifurcations.first().ok_or("a fold")?;
        assert!((fold.point.value - point.at[1]).abs() < 1e-9, "{:?}: {}", point.at, fold.point.value);
    }
    Ok(())
}

/// AUTO-07p's values. In some of these windows both resonances lie within one step.
#[test]
fn two_resonances_within_a_step_are_named() -> TestResult {
    let system = system(mild(1e-4), ForceLaw::Quadratic)?;
    for (omega, limit) in [((6.0, 10.0), 0.1), ((7.0, 10.0), 0.1), ((6.0, 12.0), 0.1), ((8.0, 9.0), 0.1)] {
        let window = chart(omega, limit)?;
        let found = curves(&system, &window)?;
        for reference in [[8.461662, 0.078580], [8.503841, 0.077610]] {
            for kind in [Instability::PeriodDoubling, Instability::NeimarkSacker] {
                let points = found.iter().filter(|curve| curve.kind == kind).flat_map(|curve| &curve.special);
                let near = points.filter(|point| point.kind == SpecialKind::OneToTwo).filter(|point| {
                    (point.at[0] - reference[0]).abs() < 1e-6 && (point.at[1] - reference[1]).abs() < 1e-6
                });
                assert_eq!(near.count(), 1, "{omega:?} {kind:?} {reference:?}");
            }
        }
    }
    Ok(())
}

/// AUTO-07p's values.
#[test]
fn cusps_are_found_in_narrow_and_wide_windows() -> TestResult {
    let system = system(mild(1e-4), ForceLaw::Quadratic)?;
    for (omega, limit) in [((20.5, 22.5), 0.04), ((18.0, 24.0), 0.04), ((18.0, 24.0), 0.1)] {
        let found = curves(&system, &chart(omega, limit)?)?;
        let cusps = found.iter().flat_map(|curve| &curve.special).filter(|s| s.kind == SpecialKind::Cusp);
        let mut omegas: Vec<f64> = cusps.map(|cusp| cusp.at[0]).collect();
        omegas.sort_by(f64::total_cmp);
        assert_eq!(omegas.len(), 2, "{omega:?}");
        for (found, reference) in omegas.iter().zip([20.838_120_174, 21.392_103_698]) {
            assert!((found - reference).abs() < 2e-9, "{omega:?}: {found}");
        }
    }
    Ok(())
}

/// AUTO-07p's value, and on its two sides what the branches of the test above do.
#[test]
fn a_doubling_changes_its_criticality_in_the_generalized_one_only() -> TestResult {
    let system = system(mild(1e-4), ForceLaw::Quadratic)?;
    let curve = only(curves(&system, &chart((7.6, 8.8), 0.04)?)?)?;
    let turn = special(&curve, SpecialKind::GeneralizedPeriodDoubling)?;
    assert!((turn.at[0] - 8.156_414_9).abs() < 6e-8 && (turn.at[1] - 4.212_066_6e-4).abs() < 6e-11);
    assert!(turn.coefficient.ok_or("a value")?.abs() < 1e-6);
    for (i, point) in curve.points.iter().enumerate() {
        let criticality = Criticality::of(curve.kind, point.coefficient.ok_or("a value")?);
        let expected = if i < turn.after { Criticality::Subcritical } else { Criticality::Supercritical };
        assert_eq!(criticality, Some(expected), "{:?}", point.at);
    }
    Ok(())
}
