//! The Floquet boundaries against an independent program, the coupled-mode theory and each other.

use crate::{Fallible, TestResult};
use harvester_lab::dynamics::bifurcations::tongue::{FlankEnd, Window};
use harvester_lab::dynamics::{
    Course, CriticalExcitation, Instability, Orbit, critical_excitation, follow_branch, largest_multipliers,
    trace_tongue,
};
use harvester_lab::model::{Along, ForceLaw, Parameter, ParameterSet, Parameters, ReducedSystem};
use harvester_lab::theory::{CoupledModes, Resonance};

fn system(alpha: f64, modes: usize, law: ForceLaw) -> Fallible<ReducedSystem> {
    let set = ParameterSet { alpha, ..Default::default() };
    Ok(ReducedSystem::new(Parameters::new(set)?, modes, law)?)
}

#[test]
fn the_lowest_unstable_excitations() -> TestResult {
    // alpha, resonance, detuning from the paper's centre (sum of the natural frequencies), and the boundaries under
    // c2 alone and c2 and c3, computed by an independent program to six decimals.
    for (alpha, resonance, detuning, quadratic, cubic) in [
        (1e-4, Resonance::First, 0.06, 0.000421, Some(0.000421)),
        (1e-4, Resonance::First, 0.0, 0.001628, Some(0.001735)),
        (1e-4, Resonance::Sum, 0.1, 0.003707, Some(0.003809)),
        (1e-4, Resonance::Sum, 0.0, 0.010911, Some(0.017355)),
        (1e-4, Resonance::Sum, -0.1, 0.018431, None),
        (1e-4, Resonance::Second, 0.16, 0.036027, Some(0.038133)),
        (1e-3, Resonance::First, 0.06, 0.000701, Some(0.000701)),
        (1e-3, Resonance::Sum, 0.1, 0.013608, Some(0.014025)),
    ] {
        for (law, reference) in [(ForceLaw::Quadratic, Some(quadratic)), (ForceLaw::Taylor(3), cubic)] {
            let system = system(alpha, 2, law)?;
            let (i, j) = resonance.pair();
            let omega = system.modes[i].omega + system.modes[j].omega + detuning;
            let found = critical_excitation(&system, omega, 0.04, Some(resonance.instability()))?;
            match (found, reference) {
                (CriticalExcitation::Unstable { beta, instability, multiplier }, Some(reference)) => {
                    assert!((beta - reference).abs() < 1e-6, "{alpha} {omega} {law:?}: {beta} {reference}");
                    assert_eq!(instability, resonance.instability());
                    assert!((multiplier.norm() - 1.0).abs() < 1e-7, "{multiplier}");
                }
                (found, reference) => {
                    assert_eq!((found, reference), (CriticalExcitation::Stable, None), "{omega} {law:?}");
                }
            }
            // No other instability comes first at these places.
            let any = critical_excitation(&system, omega, 0.04, None)?;
            assert_eq!(any.beta().is_some(), found.beta().is_some());
        }
    }
    Ok(())
}

#[test]
fn a_forced_motion_that_ends_first() -> TestResult {
    // At omega = 21.3 the quadratic law's forced motion meets another one; continuation passes through that fold.
    let system = system(1e-4, 2, ForceLaw::Quadratic)?.with_excitation(1e-6, 21.3)?;
    let CriticalExcitation::Ends { beta } = critical_excitation(&system, 21.3, 0.04, None)? else {
        return Err("the motion should end".into());
    };
    let course = Course {
        along: Along::default(),
        parameter: Parameter::Beta,
        range: (0.0, 0.04),
        periods: 1,
        upwards: true,
        most_points: 300,
    };
    let branch = follow_branch(&system, &[0.0; 5], &course)?;
    let fold = branch.bifurcations.first().ok_or("a fold")?;
    assert_eq!(fold.kind, Instability::Fold);
    assert!((fold.point.value - beta).abs() < 1e-7, "{} {beta}", fold.point.value);
    Ok(())
}

#[test]
fn tongues_near_their_tips_are_those_of_the_coupled_modes() -> TestResult {
    // The theory is of first order; near the tips it is good to a hundredth.
    for (alpha, resonance) in [(1e-4, Resonance::First), (1e-4, Resonance::Sum), (1e-3, Resonance::First)] {
        let system = system(alpha, 2, ForceLaw::Quadratic)?;
        let theory = CoupledModes::new(&system)?;
        let tongue = trace_tongue(&system, resonance, Window::default())?.ok_or("a tongue")?;
        assert_eq!(tongue.ends, [FlankEnd::Window; 2]);
        let tip = tongue.tip().ok_or("points")?;
        let near: Vec<_> = tongue.points.iter().filter(|point| point.beta < 1.1 * tip.beta).collect();
        assert!(near.len() >= 3);
        for point in near {
            let beta = theory.boundary(resonance, point.omega).ok_or("a boundary")?;
            assert!((point.beta / beta - 1.0).abs() < 0.01, "{resonance:?} {point:?}: {beta}");
        }
    }
    Ok(())
}

#[test]
fn every_point_of_a_tongue_is_on_the_boundary() -> TestResult {
    for (law, modes, alpha, resonance) in [
        (ForceLaw::Quadratic, 2, 1e-4, Resonance::First),
        (ForceLaw::Quadratic, 2, 1e-4, Resonance::Second),
        (ForceLaw::Taylor(3), 2, 1e-4, Resonance::Sum),
        (ForceLaw::Exact, 3, 1e-3, Resonance::Sum),
        (ForceLaw::Exact, 2, 1e-4, Resonance::First),
    ] {
        let system = system(alpha, modes, law)?;
        let tongue = trace_tongue(&system, resonance, Window::default())?.ok_or("a tongue")?;
        assert!((20..=250).contains(&tongue.points.len()), "{}", tongue.points.len());
        for point in tongue.points.iter().step_by(7) {
            // Found anew from the linear response, without what the trace knows.
            let orbit = Orbit::find(&system.with_excitation(point.beta, point.omega)?, None, 1)?;
            let critical = orbit.multipliers.iter().filter(|mu| Instability::of(**mu) == tongue.instability);
            let distance = critical.map(|mu| (mu.norm() - 1.0).abs()).fold(f64::INFINITY, f64::min);
            assert!(distance < 2e-6, "{law:?} {resonance:?} {point:?}: {distance:e}");
        }
    }
    Ok(())
}

#[test]
fn a_tongue_out_of_reach_is_none() -> TestResult {
    let tongue = trace_tongue(&system(1e-3, 2, ForceLaw::Quadratic)?, Resonance::Second, Window::default())?;
    assert_eq!(tongue, None);
    Ok(())
}

#[test]
fn without_any_damping_the_boundary_is_the_undamped_theorys() -> TestResult {
    let set = ParameterSet { alpha: 0.0, theta: 0.0, ..Default::default() };
    let system = ReducedSystem::new(Parameters::new(set)?, 2, ForceLaw::Quadratic)?;
    let theory = CoupledModes::new(&system)?;
    for resonance in [Resonance::First, Resonance::Sum] {
        let omega = theory.frequency(resonance) + 2e-3;
        let reference = theory.boundary(resonance, omega).ok_or("a boundary")?;
        let found = critical_excitation(&system, omega, 1e-3, Some(resonance.instability()))?;
        let beta = found.beta().ok_or("a boundary")?;
        assert!((beta / reference - 1.0).abs() < 0.01, "{resonance:?}: {beta} {reference}");
    }
    Ok(())
}

#[test]
fn a_column_of_a_chart_is_its_single_points() -> TestResult {
    let system = system(1e-4, 2, ForceLaw::Exact)?;
    let betas: Vec<f64> = (1..=10).map(|i| 2e-3 * f64::from(i)).collect();
    let column = largest_multipliers(&system, 25.4047, &betas)?;
    for (beta, value) in betas.iter().zip(column) {
        let orbit = Orbit::find(&system.with_excitation(*beta, 25.4047)?, None, 1)?;
        let value = value.ok_or("a followed motion")?;
        assert!((value - orbit.largest_multiplier()).norm() < 1e-8, "{beta}: {value}");
    }
    Ok(())
}
