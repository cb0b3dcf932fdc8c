//! The coefficients of the normal forms against the motions that branch off: doubled branches, tori, and the multipliers
//! beside folds.

use std::f64::consts::TAU;

use harvester_lab::dynamics::bifurcations::curves::{
    Criticality, Curve, CurvePoint, SpecialKind, Start, trace_curve,
};
use harvester_lab::dynamics::{Branch, Course, Instability, Orbit, PeriodMap, follow_branch, follow_doubled};
use harvester_lab::model::{Along, ForceLaw, Parameter, ReducedSystem};
use nalgebra::{Complex, DMatrix, DVector};

use super::support::*;

fn along_beta(limit: f64, most_points: usize) -> Course {
    Course {
        along: Along::default(),
        parameter: Parameter::Beta,
        range: (0.0, limit),
        periods: 1,
        upwards: true,
        most_points,
    }
}

/// A difference of states in the components that compare, over the gap.
fn scaled(system: &ReducedSystem, a: &[f64], b: &[f64]) -> DVector<f64> {
    let map = PeriodMap::new(system);
    let parts = a.iter().zip(b).zip(map.scales()).map(|((a, b), scale)| (a - b) / (scale * map.gap()));
    DVector::from_iterator(a.len(), parts)
}

/// The map of `system` on a grid that is fine enough for `state`.
fn map_at(system: &ReducedSystem, state: &[f64]) -> Fallible<PeriodMap> {
    let mut map = PeriodMap::new(system);
    while map.apply(state, system.parameters.beta, 1, |_, _| ())? > 1.0 {
        map.refine()?;
    }
    Ok(map)
}

/// Right and left eigenvector to `multiplier`, with <p, q> = 1 and |q| = 1.
fn eigenvectors(matrix: &DMatrix<f64>, multiplier: Complex<f64>) -> Fallible<[DVector<Complex<f64>>; 2]> {
    let n = matrix.nrows();
    let complex = matrix.map(Complex::from);
    let vector = |matrix: DMatrix<Complex<f64>>, value: Complex<f64>| -> Fallible<_> {
        let moved = matrix - DMatrix::identity(n, n) * (value + Complex::from(1e-10));
        let solver = moved.lu();
        let mut vector = DVector::from_fn(n, |i, _| Complex::new(1.0, 0.1 * i as f64));
        for _ in 0..6 {
            vector = solver.solve(&vector).ok_or("a vector")?.normalize();
        }
        Ok(vector)
    };
    let right = vector(complex.clone(), multiplier)?;
    let left = vector(complex.transpose(), multiplier.conj())?;
    let product = left.dotc(&right);
    Ok([right, left / product.conj()])
}

/// The value at 0 of the line through two points.
fn at_zero([(x, a), (y, b)]: [(f64, f64); 2]) -> f64 {
    (a * y - b * x) / (y - x)
}

fn origin(curve: &Curve) -> &CurvePoint {
    &curve.points[curve.origin]
}

/// On the branch of x -> -(1 + nu) x + c x^3 the doubled orbit is at x^2 = nu/c.
#[test]
fn a_doubled_orbit_grows_as_the_coefficient_of_the_doubling_says() -> TestResult {
    let system = system(mild(1e-4), ForceLaw::Quadratic)?;
    let window = chart((7.6, 8.8), 0.04)?;
    for (omega, expected) in [(8.0969, Criticality::Subcritical), (8.4, Criticality::Supercritical)] {
        let there = system.with_excitation(1e-5, omega)?;
        let course = along_beta(0.04, 600);
        let forced = follow_branch(&there, &[0.0; 5], &course)?;
        let birth = forced.bifurcations.first().ok_or("a doubling")?;
        let at = [omega, birth.point.value];
        let start = Start { kind: birth.kind, periods: 1, at, state: birth.point.state.clone() };
        let coefficient = origin(&trace_curve(&system, &start, &window)?).coefficient.ok_or("a value")?;
        assert_eq!(Criticality::of(birth.kind, coefficient), Some(expected), "{omega}");
        let doubled = follow_doubled(&there, birth, &Course { most_points: 3, ..course })?;
        let ratio = |i: usize| -> Fallible<(f64, f64)> {
            let point = doubled.points.get(i).ok_or("points")?;
            let here = there.with_excitation(point.value, omega)?;
            let mut map = map_at(&here, &point.state)?;
            map.apply(&point.state, point.value, 1, |_, _| ())?;
            let square = scaled(&here, &point.state, map.image()).norm_squared() / 4.0;
            let around = Orbit::find(&here, Some(&birth.point.state), 1)?;
            let distance = |mu: &&Complex<f64>| (*mu + 1.0).norm();
            let nearest = around.multipliers.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
            Ok((square, (-nearest.ok_or("a multiplier")?.re - 1.0) / square))
        };
        let found = at_zero([ratio(0)?, ratio(1)?]);
        assert!((found / coefficient - 1.0).abs() < 5e-3, "{omega}: {found} {coefficient}");
    }
    Ok(())
}

/// Where a branch folds its multiplier is 1 + 2 b x.
#[test]
fn the_multiplier_beside_a_fold_changes_as_its_coefficient_says() -> TestResult {
    let (system, window, _) = bent_resonance(1e-6)?;
    for omega in [20.9, 21.5, 22.2] {
        let there = system.with_excitation(0.0, omega)?;
        let branch: Branch = follow_branch(&there, &[0.0; 5], &along_beta(0.04, 800))?;
        let fold = branch.bifurcations.iter().find(|found| found.kind == Instability::Fold);
        let fold = fold.ok_or("a fold")?;
        let at = [omega, fold.point.value];
        let start = Start { kind: fold.kind, periods: 1, at, state: fold.point.state.clone() };
        let coefficient = origin(&trace_curve(&system, &start, &window)?).coefficient.ok_or("a value")?;
        let here = there.with_excitation(fold.point.value, omega)?;
        let matrix = map_at(&here, &fold.point.state)?.scaled_derivative();
        let [_, left] = eigenvectors(&matrix, Complex::from(1.0))?;
        // On either side of the fold the orbit much nearer to it, at a distance that falls as the square root.
        let beside = |i: usize, below: f64| -> Fallible<(Vec<f64>, f64)> {
            let point = branch.points.get(i).ok_or("points")?;
            let share = below * fold.point.value / (fold.point.value - point.value);
            let near = there.with_excitation(fold.point.value * (1.0 - below), omega)?;
            let ends = fold.point.state.iter().zip(&point.state);
            let guess: Vec<f64> = ends.map(|(fold, end)| fold + (end - fold) * share.sqrt()).collect();
            let orbit = Orbit::find(&near, Some(&guess), 1)?;
            let distance = |mu: &&Complex<f64>| (*mu - 1.0).norm();
            let nearest = orbit.multipliers.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
            let multiplier = nearest.ok_or("a multiplier")?.re;
            Ok((orbit.state, multiplier))
        };
        let slope = |below: f64| -> Fallible<(f64, f64)> {
            let (before, after) = (beside(fold.after - 1, below)?, beside(fold.after, below)?);
            let apart = left.dotc(&scaled(&here, &before.0, &after.0).map(Complex::from)).norm();
            Ok((below, (before.1 - after.1) / (2.0 * apart)))
        };
        let found = at_zero([slope(1e-9)?, slope(1e-10)?]);
        assert!((found.abs() / coefficient.abs() - 1.0).abs() < 1e-4, "{omega}: {found} {coefficient}");
    }
    Ok(())
}

/// The torus of |z| -> (1 + nu) |z| (1 + d |z|^2) has |z|^2 = -nu/d: stable or a threshold, on the side the sign says.
#[test]
fn tori_branch_off_as_the_coefficient_says() -> TestResult {
    let system = system(mild(1e-4), ForceLaw::Quadratic)?;
    let window = chart((25.0, 26.0), 0.04)?;
    let found = curves(&system, &window)?;
    let curve = of_kind(&found, Instability::NeimarkSacker)?;
    let turn = special(curve, SpecialKind::Chenciner)?;
    assert!(turn.coefficient.ok_or("a value")?.abs() < 1e-6);
    for (omega, expected) in [(25.35, Criticality::Subcritical), (25.62, Criticality::Supercritical)] {
        assert_eq!(omega < turn.at[0], expected == Criticality::Subcritical);
        let nearer =
            |a: &&CurvePoint, b: &&CurvePoint| (a.at[0] - omega).abs().total_cmp(&(b.at[0] - omega).abs());
        let point = curve.points.iter().min_by(nearer).ok_or("points")?;
        let d = point.coefficient.ok_or("a value")?;
        assert_eq!(Criticality::of(curve.kind, d), Some(expected), "{:?}", point.at);
        // A little beyond or before the curve, where -nu/d is positive.
        for change in [-0.01, 0.01] {
            let beta = point.at[1] * (1.0 + change);
            let here = system.with_excitation(beta, point.at[0])?;
            let orbit = Orbit::find(&here, Some(&point.state), 1)?;
            let pair = orbit.multipliers.iter().filter(|mu| mu.im > 0.0);
            let pair = pair.max_by(|a, b| a.norm().total_cmp(&b.norm())).ok_or("a pair")?;
            let square = -(pair.norm() - 1.0) / d;
            if square < 0.0 {
                continue;
            }
            let radius = square.sqrt();
            let mut map = map_at(&here, &orbit.state)?;
            let [right, left] = eigenvectors(&map.scaled_derivative(), *pair)?;
            let gap = map.gap();
            let scales = map.scales().to_vec();
            let mut amplitudes = |start: f64, count: usize| -> Fallible<Vec<f64>> {
                let parts = orbit.state.iter().zip(&right).zip(&scales);
                let mut state: Vec<f64> =
                    parts.map(|((y, q), scale)| y + 2.0 * start * q.re * scale * gap).collect();
                let mut found = Vec::new();
                for _ in 0..count {
                    map.apply(&state, beta, 1, |_, _| ())?;
                    state = map.image().to_vec();
                    let z = left.dotc(&scaled(&here, &state, &orbit.state).map(Complex::from));
                    found.push(z.norm());
                }
                Ok(found)
            };
            let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
            let periods = (4.0 / (pair.norm() - 1.0).abs()) as usize;
            if expected == Criticality::Supercritical {
                for start in [0.7, 1.3] {
                    let course = amplitudes(start * radius, 2 * periods)?;
                    let last = mean(&course[course.len() - 500..]);
                    assert!((last / radius - 1.0).abs() < 0.03, "{start}: {last} {radius}");
                }
            } else {
                let [low, high] = [0.9, 1.1].map(|start| amplitudes(start * radius, periods / 2));
                let (low, high) = (low?, high?);
                let window = (TAU / pair.arg()).ceil() as usize * 20;
                let grows = |course: &[f64]| mean(&course[course.len() - window..]) > mean(&course[..window]);
                assert!(!grows(&low) && grows(&high), "{:?}: {radius}", point.at);
            }
        }
    }
    Ok(())
}
