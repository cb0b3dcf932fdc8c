//! Branches of periodic orbits: reference values, and the same places reached in other ways.

use crate::{Fallible, TestResult};
use harvester_lab::dynamics::{
    Branch, BranchEnd, Course, Instability, Orbit, Settings, Trajectory, critical_excitation, follow_branch,
    follow_doubled,
};
use harvester_lab::model::{Along, ForceLaw, Parameter, ParameterSet, Parameters, ReducedSystem};

fn system(law: ForceLaw, beta: f64, omega: f64) -> Fallible<ReducedSystem> {
    let set = ParameterSet { alpha: 1e-4, beta, omega, ..Default::default() };
    Ok(ReducedSystem::new(Parameters::new(set)?, 2, law)?)
}

fn course(parameter: Parameter, range: (f64, f64)) -> Course {
    Course { parameter, along: Along::default(), range, periods: 1, upwards: true, most_points: 600 }
}

fn kinds(branch: &Branch) -> Vec<Instability> {
    branch.bifurcations.iter().map(|bifurcation| bifurcation.kind).collect()
}

#[test]
fn the_doubled_branch_of_figure_9() -> TestResult {
    let system = system(ForceLaw::Quadratic, 1e-5, 8.0969)?;
    let course = course(Parameter::Beta, (0.0, 0.01));
    let forced = follow_branch(&system, &[0.0; 5], &course)?;
    assert_eq!((kinds(&forced), &forced.end), (vec![Instability::PeriodDoubling], &BranchEnd::Range));
    let birth = &forced.bifurcations[0];
    assert!((birth.point.value - 0.001628).abs() < 5e-7, "{}", birth.point.value);
    assert!(forced.points[..birth.after].iter().all(|point| point.stable()));
    assert!(forced.points[birth.after..].iter().all(|point| !point.stable()));

    // Subcritical: it turns back at a fold, and only then is it stable.
    let doubled = follow_doubled(&system, birth, &course)?;
    assert_eq!((kinds(&doubled), &doubled.end), (vec![Instability::Fold], &BranchEnd::Range));
    let fold = &doubled.bifurcations[0];
    assert!(doubled.points[..fold.after].iter().all(|point| !point.stable()));
    assert!(doubled.points[fold.after..].iter().all(|point| point.stable()));
    assert!(doubled.points.iter().all(|point| point.value > fold.point.value));
    assert!((doubled.points[0].value / birth.point.value - 1.0).abs() < 1e-2);

    // At its end it is the motion of Figure 9, to which a run leads.
    let last = doubled.points.last().ok_or("points")?;
    assert_eq!(last.value, 0.01);
    let figure_9 = system.with_excitation(0.01, 8.0969)?;
    let settled = 600.0 * figure_9.parameters.period();
    let run = Trajectory::compute(&figure_9, &[0.0; 5], settled, Settings::default())?;
    let orbit = Orbit::find(&figure_9, Some(run.final_state()), 2)?;
    assert_eq!(orbit.periods, 2);
    assert!((last.measures.v_rms - orbit.measures.v_rms).abs() < 1e-8, "{:?}", last.measures);
    Ok(())
}

#[test]
fn a_doubled_branch_closes_where_the_forced_motion_is_stable_again() -> TestResult {
    let system = system(ForceLaw::Exact, 1e-3, 8.0)?;
    let course = course(Parameter::Omega, (7.5, 12.0));
    let forced = follow_branch(&system, &[0.0; 5], &course)?;
    assert_eq!(kinds(&forced), [Instability::PeriodDoubling; 2]);
    let [begin, end] = [0, 1].map(|i| forced.bifurcations[i].point.value);
    for omega in [begin, end] {
        let found = critical_excitation(&system, omega, 0.04, Some(Instability::PeriodDoubling))?;
        assert!(found.beta().is_some_and(|beta| (beta - 1e-3).abs() < 1e-8), "{omega}: {found:?}");
    }
    let doubled = follow_doubled(&system, &forced.bifurcations[0], &course)?;
    let BranchEnd::Halved { value } = doubled.end else {
        return Err(format!("{:?}", doubled.end).into());
    };
    assert!((value - end).abs() < 1e-7, "{value} {end}");
    Ok(())
}

#[test]
fn the_doubled_branch_of_figure_9_ends_on_the_forced_motion() -> TestResult {
    // The forced motion doubles twice on its way up; the branch born at the first closes at the second.
    let system = system(ForceLaw::Quadratic, 1e-5, 8.0969)?;
    let course = course(Parameter::Beta, (0.0, 0.1));
    let forced = follow_branch(&system, &[0.0; 5], &course)?;
    let doublings: Vec<f64> = forced
        .bifurcations
        .iter()
        .filter(|bifurcation| bifurcation.kind == Instability::PeriodDoubling)
        .map(|bifurcation| bifurcation.point.value)
        .collect();
    assert_eq!(doublings.len(), 2);
    let doubled = follow_doubled(&system, &forced.bifurcations[0], &course)?;
    let BranchEnd::Halved { value } = doubled.end else {
        return Err(format!("{:?}", doubled.end).into());
    };
    assert!((value - doublings[1]).abs() < 1e-7, "{value} {doublings:?}");
    Ok(())
}

#[test]
fn every_parameter_can_be_followed_to_its_border() -> TestResult {
    let system = system(ForceLaw::Exact, 1e-3, 8.4)?;
    for (parameter, range) in [
        (Parameter::Alpha, (0.0, 2e-4)),
        (Parameter::Beta, (0.0, 2e-3)),
        (Parameter::Omega, (8.3, 8.5)),
        (Parameter::C0, (0.4, 0.6)),
        (Parameter::D, (0.14, 0.16)),
        (Parameter::H, (0.003, 0.005)),
        (Parameter::Eta, (0.0, 0.03)),
        (Parameter::C, (5e-7, 2e-6)),
        (Parameter::Kappa, (1e-8, 2e-6)),
        (Parameter::Theta, (0.0, 4e-4)),
    ] {
        for (upwards, border) in [(false, range.0), (true, range.1)] {
            let branch = follow_branch(&system, &[0.0; 5], &Course { upwards, ..course(parameter, range) })?;
            assert_eq!(branch.end, BranchEnd::Range, "{parameter:?}");
            let last = branch.points.last().ok_or("points")?;
            assert_eq!(last.value, border);
            // The orbit of the system made there directly.
            let mut set = *system.parameters;
            *set.get_mut(parameter) = border;
            let there = ReducedSystem::new(Parameters::new(set)?, 2, ForceLaw::Exact)?;
            let orbit = Orbit::find(&there, None, 1)?;
            assert!((orbit.measures.v_rms - last.measures.v_rms).abs() < 1e-7, "{parameter:?} {upwards}");
            let modulus = orbit.largest_multiplier().norm();
            assert!((modulus - last.multipliers[0].norm()).abs() < 1e-7, "{parameter:?} {upwards}");
        }
    }
    Ok(())
}

#[test]
fn both_folds_of_the_bent_resonance_are_found() -> TestResult {
    // Near omega_2 the exact law hardens: three forced motions coexist between two folds.
    let system = system(ForceLaw::Exact, 1e-3, 21.0)?;
    let branch = follow_branch(&system, &[0.0; 5], &course(Parameter::Omega, (20.5, 22.5)))?;
    let folds: Vec<f64> = branch
        .bifurcations
        .iter()
        .filter(|bifurcation| bifurcation.kind == Instability::Fold)
        .map(|bifurcation| bifurcation.point.value)
        .collect();
    assert_eq!((folds.len(), &branch.end), (2, &BranchEnd::Range));
    let [upper, lower] = [folds[0], folds[1]];
    assert!(lower < upper);
    let crossings = |omega: f64| {
        let pairs = branch.points.windows(2);
        pairs.filter(|pair| (pair[0].value < omega) != (pair[1].value < omega)).count()
    };
    assert_eq!([lower - 0.05, 0.5 * (lower + upper), upper + 0.05].map(crossings), [1, 3, 1]);
    Ok(())
}
