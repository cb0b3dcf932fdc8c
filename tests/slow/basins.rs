//! Basins of attraction at the paper's figures.

use crate::{Fallible, OMEGA_1, OMEGA_2, TestResult};
use std::collections::BTreeSet;

use harvester_lab::dynamics::{Effort, Motion, Orbit, reach};
use harvester_lab::model::{ParameterSet, ReducedSystem};
use harvester_lab::questions::basin::{Attractor, Basin, BasinStudy, Side};
use harvester_lab::scenario::Scenario;
use harvester_lab::scheduler::{Asked, Study, complete};

fn scenario(omega: f64, initial: Option<Vec<f64>>) -> Scenario {
    let parameters = ParameterSet { alpha: 1e-4, beta: 0.01, omega, ..Default::default() };
    Scenario { parameters, initial, ..Default::default() }
}

/// The basins, with what must hold of all: shares that add up, in descending order, and each attractor's own start
/// leading to it.
fn basins(scenario: Scenario, question: Basin) -> Fallible<(BasinStudy, Vec<Attractor>)> {
    let (system, _): (ReducedSystem, _) = scenario.validate()?;
    let mut basin = BasinStudy::new(scenario, question)?;
    let (columns, rows) = basin.chart().asked().size;
    complete(&mut basin);
    assert!(basin.finished() && basin.chart().failure().is_none());
    let attractors = basin.attractors();
    let sum: f64 = attractors.iter().map(|attractor| attractor.fraction).sum();
    assert!((sum - 1.0).abs() < 1e-12, "{sum}");
    assert!(attractors.windows(2).all(|pair| pair[0].cells >= pair[1].cells));
    assert_eq!(attractors.iter().map(|attractor| attractor.cells).sum::<usize>(), columns * rows);
    let numbers: BTreeSet<usize> = attractors.iter().map(|attractor| attractor.number).collect();
    assert_eq!(numbers, (0..attractors.len()).collect());
    for attractor in &attractors {
        let reached = reach(&system, &attractor.start, Effort::cell())?.cell();
        assert!(reached.motion.same_class(&attractor.cell.motion), "{attractor:?}: {reached:?}");
        assert!(
            (reached.measures.v_rms - attractor.cell.measures.v_rms).abs() <= 0.05 * reached.measures.v_rms,
            "{attractor:?}"
        );
    }
    Ok((basin, attractors))
}

/// Displacement and velocity of the first mode, on so many values each.
fn first_mode(count: usize) -> Basin {
    Basin { count: Some(count), ..Basin::default() }
}

fn side(component: &str, from: f64, to: f64) -> Option<Side> {
    Some(Side { component: component.to_owned(), from, to, count: None })
}

fn with_motion(attractors: &[Attractor], motion: Motion) -> Vec<usize> {
    let same = |attractor: &&Attractor| attractor.cell.motion.same_class(&motion);
    attractors.iter().filter(same).map(|attractor| attractor.number).collect()
}

#[test]
fn figure_4_has_a_torus_a_stable_forced_motion_and_escape() -> TestResult {
    let omega = OMEGA_1 + OMEGA_2;
    let (system, _) = scenario(omega, None).validate()?;
    let forced = Orbit::find(&system, None, 1)?;
    let gap = system.equilibrium.gap;
    // Through the forced motion's own start, which is the cell in the middle.
    let (q, rate) = (forced.state[0], forced.state[2]);
    let question = Basin {
        x: side("q1", q - gap, q + gap),
        y: side("dq1/dt", rate - gap * OMEGA_1, rate + gap * OMEGA_1),
        count: Some(13),
    };
    let (basin, attractors) = basins(scenario(omega, Some(forced.state.clone())), question)?;
    let (torus, escape) = (Motion::Quasiperiodic, Motion::Escape { time: 0.0 });
    let periodic = Motion::Periodic { periods: 1 };
    for motion in [torus, escape, periodic] {
        assert_eq!(with_motion(&attractors, motion).len(), 1, "{attractors:?}");
    }
    let middle = basin.shown(6, 6).flatten().ok_or("a motion")?;
    let attractor = &attractors[middle];
    assert_eq!(attractor.cell.motion, periodic);
    assert!((attractor.cell.measures.v_rms / forced.measures.v_rms - 1.0).abs() < 1e-9, "{attractor:?}");
    for (a, b) in attractor.start.iter().zip(&forced.state) {
        assert!((a - b).abs() < 1e-7, "{attractor:?}");
    }
    // A plane through rest: the figure's own start leads to the torus, and to the same one.
    let (basin, from_rest) = basins(scenario(omega, None), first_mode(5))?;
    let middle = basin.shown(2, 2).flatten().ok_or("a motion")?;
    assert_eq!(from_rest[middle].cell.motion, torus);
    let there = attractors.iter().find(|attractor| attractor.cell.motion == torus).ok_or("a torus")?;
    assert!((from_rest[middle].cell.measures.v_rms / there.cell.measures.v_rms - 1.0).abs() < 0.01);
    Ok(())
}

#[test]
fn figure_9_has_one_motion_of_period_2_although_both_its_phases_are_reached() -> TestResult {
    let scenario = scenario(2.0 * OMEGA_1, None);
    let (system, _) = scenario.validate()?;
    let (basin, attractors) = basins(scenario.clone(), first_mode(11))?;
    let double = with_motion(&attractors, Motion::Periodic { periods: 2 });
    assert_eq!((double.len(), attractors.len()), (1, 2), "{attractors:?}");
    assert_eq!(with_motion(&attractors, Motion::Escape { time: 0.0 }).len(), 1);
    // Another program's voltage.
    let found = attractors.iter().find(|attractor| attractor.number == double[0]).ok_or("period 2")?;
    assert!((found.cell.measures.v_rms - 14.1783).abs() < 1e-4, "{found:?}");
    // After an even number of periods, starts of this basin are on one of its two stroboscopic states or the other.
    let mut phases = BTreeSet::new();
    for (column, row) in (0..11).flat_map(|row| (0..11).map(move |column| (column, row))) {
        let leads_there = basin.shown(column, row).flatten().is_some_and(|i| attractors[i] == *found);
        if leads_there {
            let [q, rate] = basin.chart().asked().place((column, row));
            let reached = reach(&system, &[q, 0.0, rate, 0.0, 0.0], Effort::full())?;
            let periods = (reached.time / system.parameters.period()).round() as u64;
            let near = (reached.state[0] - found.start[0]).abs() < 1e-3;
            phases.insert(near == periods.is_multiple_of(2));
        }
    }
    assert_eq!(phases.len(), 2, "both phases should be reached");
    let none = Basin { x: side("q4", -0.1, 0.1), ..first_mode(11) };
    assert!(BasinStudy::new(scenario, none).is_err());
    Ok(())
}
