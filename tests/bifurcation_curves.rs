//! Curves of bifurcations in two parameters against one-parameter searches, an independent program's values, each
//! other, and charts computed point by point.

use harvester_lab::dynamics::curves::{
    Curve, CurveEnd, CurvePoint, Search, SpecialKind, SpecialPoint, Start, bifurcations_along_line,
    find_curves, search_lines, trace_curve,
};
use harvester_lab::dynamics::floquet::multipliers;
use harvester_lab::dynamics::{
    Axis, Course, Instability, Orbit, OrbitError, PeriodMap, Plane, critical_excitation, follow_branch,
    follow_doubled, largest_multipliers,
};
use harvester_lab::model::RestForce;
use harvester_lab::model::reduced::ForceVisitor;
use harvester_lab::model::{ForceLaw, Magnet, Parameter, ParameterSet, Parameters, ReducedSystem};

use nalgebra::Complex;

type TestResult = Result<(), Box<dyn std::error::Error>>;
type Fallible<T> = Result<T, Box<dyn std::error::Error>>;

fn system(set: ParameterSet, law: ForceLaw) -> Fallible<ReducedSystem> {
    Ok(ReducedSystem::new(Parameters::new(set)?, 2, law)?)
}

fn mild(alpha: f64) -> ParameterSet {
    ParameterSet { alpha, ..Default::default() }
}

fn plane(first: (Parameter, (f64, f64)), second: (Parameter, (f64, f64))) -> Fallible<Plane> {
    Ok(Plane::new([first, second].map(|(parameter, range)| Axis { parameter, range }))?)
}

/// The plane of omega, within the range, and beta up to `limit`.
fn chart(omega: (f64, f64), limit: f64) -> Fallible<Plane> {
    plane((Parameter::Omega, omega), (Parameter::Beta, (0.0, limit)))
}

fn curves(system: &ReducedSystem, plane: &Plane) -> Fallible<Vec<Curve>> {
    Ok(find_curves(system, plane, Search::default())?.curves)
}

fn only(curves: Vec<Curve>) -> Fallible<Curve> {
    <[Curve; 1]>::try_from(curves).map(|[curve]| curve).map_err(|all| format!("{} curves", all.len()).into())
}

fn of_kind(curves: &[Curve], kind: Instability) -> Fallible<&Curve> {
    curves.iter().find(|curve| curve.kind == kind).ok_or_else(|| format!("no curve of {kind:?}").into())
}

fn special(curve: &Curve, kind: SpecialKind) -> Fallible<&SpecialPoint> {
    curve.special.iter().find(|point| point.kind == kind).ok_or_else(|| format!("no {kind}").into())
}

/// `system` at a point of `plane`.
fn at(system: &ReducedSystem, plane: &Plane, point: [f64; 2]) -> Fallible<ReducedSystem> {
    let mut set = *system.parameters;
    for (axis, value) in plane.axes().iter().zip(point) {
        *axis.parameter.get_mut(&mut set) = value;
    }
    Ok(ReducedSystem::new(Parameters::new(set)?, system.modes.len(), system.law)?)
}

struct Multipliers<'a>(&'a ReducedSystem, &'a [f64]);

impl ForceVisitor for Multipliers<'_> {
    type Output = Result<(f64, Vec<Complex<f64>>), OrbitError>;
    /// How far a state misses itself after a period, over the gap, and the multipliers: without Newton's iteration,
    /// which knows no orbit at a fold.
    fn visit<F: RestForce + 'static>(self, force: F) -> Self::Output {
        let Self(system, state) = self;
        let mut map = PeriodMap::new(system, force)?;
        map.refine()?;
        map.apply(state, system.parameters.beta, 1, |_, _| ())?;
        let misses =
            map.image().iter().zip(state).zip(map.scales()).map(|((a, b), scale)| (a - b).abs() / scale);
        Ok((misses.fold(0.0, f64::max) / map.gap(), multipliers(&map.scaled_derivative())?))
    }
}

/// The multipliers of the orbit at a point of codimension two, which is there.
fn multipliers_at(
    system: &ReducedSystem,
    plane: &Plane,
    point: &SpecialPoint,
) -> Fallible<Vec<Complex<f64>>> {
    let there = at(system, plane, point.at)?;
    let (missed, multipliers) = there.dispatch(Multipliers(&there, &point.state))?;
    assert!(missed < 1e-8, "{} {:?}: {missed:e}", point.kind, point.at);
    Ok(multipliers)
}

/// The lowest unstable beta of a device as it is, found along beta.
fn critical(system: &ReducedSystem, kind: Instability) -> Fallible<f64> {
    let limit = (1.5 * system.parameters.beta).max(1e-3);
    let found = critical_excitation(system, system.parameters.omega, limit, Some(kind))?;
    Ok(found.beta().ok_or("a boundary")?)
}

#[test]
fn a_curve_meets_the_border_where_an_independent_program_has_the_boundary() -> TestResult {
    // The table of tests/floquet_boundaries.rs: detuning from the sum of the two natural frequencies, and beta.
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

/// The curves near the second natural frequency, where the quadratic law's forced motion ends.
fn bent_resonance() -> Fallible<(ReducedSystem, Plane, Vec<Curve>)> {
    let system = system(mild(1e-4), ForceLaw::Quadratic)?;
    let window = chart((20.5, 22.5), 0.04)?;
    let found = curves(&system, &window)?;
    Ok((system, window, found))
}

#[test]
fn the_fold_curve_holds_the_folds_of_the_branches() -> TestResult {
    let (system, _, found) = bent_resonance()?;
    let curve = of_kind(&found, Instability::Fold)?;
    let course = Course {
        parameter: Parameter::Beta,
        range: (0.0, 0.04),
        periods: 1,
        upwards: true,
        most_points: 800,
    };
    let rightmost = curve.points.iter().filter(|point| point.at[1] > 1e-3);
    let mut compared = 0;
    for point in rightmost.step_by(4) {
        let there = system.with_excitation(0.0, point.at[0])?;
        let branch = follow_branch(&there, &[0.0; 5], &course)?;
        let folds = branch.bifurcations.iter().filter(|found| found.kind == Instability::Fold);
        let nearest =
            folds.map(|found| (found.point.value - point.at[1]).abs()).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-8, "{:?}: {nearest:e}", point.at);
        compared += 1;
    }
    assert!(compared > 10, "{compared}");
    Ok(())
}

#[test]
fn beyond_a_cusp_there_are_two_folds_and_before_it_none() -> TestResult {
    let (system, _, found) = bent_resonance()?;
    let cusps = found.iter().flat_map(|curve| &curve.special).filter(|s| s.kind == SpecialKind::Cusp);
    let cusp = cusps.max_by(|a, b| a.at[0].total_cmp(&b.at[0])).ok_or("a cusp")?;
    let folds = |beta: f64| -> Fallible<Vec<f64>> {
        let there = system.with_excitation(beta, cusp.at[0] - 0.1)?;
        let orbit = Orbit::find(&there, None, 1)?;
        let range = (cusp.at[0] - 0.1, cusp.at[0] + 0.1);
        let course =
            Course { parameter: Parameter::Omega, range, periods: 1, upwards: true, most_points: 800 };
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
    let (quadratic, window, found) = bent_resonance()?;
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
    let found = curves(&system, &window)?;
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

/// Cells of a chart along each side.
const CELLS: usize = 48;

#[test]
fn charts_computed_point_by_point_change_on_the_curves_and_only_there() -> TestResult {
    for (law, centre) in
        [(ForceLaw::Quadratic, 8.1565), (ForceLaw::Quadratic, 25.5148), (ForceLaw::Exact, 25.5148)]
    {
        let system = system(mild(1e-4), law)?;
        let window = chart((centre - 0.3, centre + 0.3), 0.03)?;
        let [omegas, betas] = [0, 1].map(|k| {
            let axis = window.axes()[k];
            (0..CELLS).map(|i| axis.at((i as f64 + 0.5) / CELLS as f64)).collect::<Vec<f64>>()
        });
        let mut stable = Vec::new();
        for omega in &omegas {
            let column = largest_multipliers(&system, *omega, &betas)?;
            stable.push(column.iter().map(|mu| mu.is_some_and(|mu| mu.norm() < 1.0)).collect::<Vec<bool>>());
        }
        let curve = only(curves(&system, &window)?)?;
        let cell = |at: [f64; 2]| {
            let [a, b] = [0, 1].map(|k| {
                let axis = window.axes()[k];
                (at[k] - axis.range.0) / axis.width() * CELLS as f64 - 0.5
            });
            (a, b)
        };
        // Every change between neighbours has the curve between or beside them.
        let near = |i: f64, j: f64| {
            curve.points.windows(2).any(|pair| {
                let ((a, b), (c, d)) = (cell(pair[0].at), cell(pair[1].at));
                (0..=8).any(|k| {
                    let t = f64::from(k) / 8.0;
                    (a + t * (c - a) - i).abs().max((b + t * (d - b) - j).abs()) <= 1.0
                })
            })
        };
        let mut changes = 0;
        for i in 0..CELLS {
            for j in 0..CELLS {
                for (k, l) in [(i + 1, j), (i, j + 1)] {
                    if k < CELLS && l < CELLS && stable[i][j] != stable[k][l] {
                        changes += 1;
                        assert!(
                            near((i + k) as f64 / 2.0, (j + l) as f64 / 2.0),
                            "{law:?} {centre}: {i} {j}"
                        );
                    }
                }
            }
        }
        assert!(changes > CELLS, "{changes}");
        // Every point of the curve has a change within a cell, where it is wider than the cells.
        for point in curve.points.iter().filter(|point| point.at[1] > betas[2]) {
            let (a, b) = cell(point.at);
            let within = 0.0..=(CELLS - 1) as f64;
            if !(within.contains(&a) && within.contains(&b)) {
                continue;
            }
            let range = |x: f64| ((x - 1.0).ceil().max(0.0) as usize)..=((x + 1.0) as usize).min(CELLS - 1);
            let around = range(a).flat_map(|i| range(b).map(move |j| (i, j)));
            let classes: Vec<bool> = around.map(|(i, j)| stable[i][j]).collect();
            assert!(classes.contains(&true) && classes.contains(&false), "{law:?} {centre}: {:?}", point.at);
        }
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
        assert!((orbit.measures.v_rms - point.v_rms).abs() < 1e-7, "{:?}", point.at);
    }
    Ok(())
}

#[test]
fn a_search_can_be_shared_out() -> TestResult {
    let system = system(mild(1e-4), ForceLaw::Quadratic)?;
    let window = chart((7.6, 8.8), 0.03)?;
    let lines = search_lines(&system, &window, Search { lines: 2, doubled: true })?;
    // Two along each side, and the one through twice the first coupled mode's frequency.
    assert_eq!(lines.len(), 5);
    let mut starts = Vec::new();
    for line in &lines {
        starts.extend(bifurcations_along_line(&system, &window, *line, true)?);
    }
    assert!(starts.iter().any(|start| start.periods == 2));
    for start in &starts {
        let there = at(&system, &window, start.at)?;
        let orbit = Orbit::find(&there, Some(&start.state), start.periods)?;
        let modulus =
            orbit.multipliers.iter().map(|mu| (mu.norm() - 1.0).abs()).fold(f64::INFINITY, f64::min);
        assert!(modulus < 1e-5, "{start:?}: {modulus:e}");
    }
    // A start travels as text, and leads to the same curve.
    let start: Start = serde_json::from_str(&serde_json::to_string(&starts[0])?)?;
    let plane: Plane = serde_json::from_str(&serde_json::to_string(&window)?)?;
    let (there, here) = (trace_curve(&system, &start, &plane)?, trace_curve(&system, &starts[0], &window)?);
    assert_eq!((there.points.len(), &there.ends), (here.points.len(), &here.ends));
    assert!(serde_json::from_str::<Plane>(&serde_json::to_string(&window)?.replace("0.03", "-1.0")).is_err());
    Ok(())
}

#[test]
fn a_start_that_is_no_bifurcation_is_an_error() -> TestResult {
    let system = system(mild(1e-4), ForceLaw::Quadratic)?;
    let window = chart((7.6, 8.8), 0.03)?;
    let there = at(&system, &window, [7.65, 0.001])?;
    let state = Orbit::find(&there, None, 1)?.state;
    let start = Start { kind: Instability::Fold, periods: 1, at: [7.65, 0.001], state };
    assert!(trace_curve(&system, &start, &window).is_err());
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
