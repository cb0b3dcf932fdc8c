//! The search in pieces, as several workers do it.

use harvester_lab::dynamics::bifurcations::curves::{
    Search, Start, bifurcations_along_line, find_curves, search_lines, trace_curve,
};
use harvester_lab::dynamics::{Instability, Orbit, OrbitError, Plane};
use harvester_lab::model::{ForceLaw, ParameterSet};

use super::support::*;

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
fn without_any_damping_no_modulation_sets_in() -> TestResult {
    let set = ParameterSet { theta: 0.0, ..mild(0.0) };
    let system = system(set, ForceLaw::Quadratic)?;
    let window = chart((25.0, 26.0), 0.02)?;
    let found = find_curves(&system, &window, Search::default())?;
    assert_eq!((found.curves.len(), found.failures.len()), (0, 0));
    let (kind, at) = (Instability::NeimarkSacker, [25.6, 0.01]);
    let state = Orbit::find(&system.with_excitation(at[1], at[0])?, None, 1)?.state;
    let start = Start { kind, periods: 1, at, state };
    assert_eq!(trace_curve(&system, &start, &window), Err(OrbitError::Undamped));
    Ok(())
}
