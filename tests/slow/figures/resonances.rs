//! Figures 4, 9 and 12: the closed curve, the doubled period and the growth at the three resonances.

use harvester_lab::dynamics::{ESCAPE_DISPLACEMENT, Outcome};
use harvester_lab::scenario::ModelChoice;

use super::shape::Shape;
use super::support::{Numbers, assert_close, assert_numbers, exact, paper, range, run, strobe_states};
use crate::{OMEGA_1, OMEGA_2};

#[test]
fn figure_4_is_a_closed_curve_in_the_poincare_map() {
    // At the paper's end, and when what is left of the transient has died out: the motion by the reference, and the
    // extent of its last thousand points in the planes of the figure.
    let paper_end: Numbers =
        [2.35028581911e1, 5.57434133451e1, 9.87165442197e2, 8.19075841202e-2, -8.53829402802e-2];
    let late: Numbers =
        [2.35093535100e1, 5.57491668595e1, 9.87175835828e2, 8.19114799364e-2, -8.53914466465e-2];
    let extents = [
        [-1.26943873873e1, 1.60526635727e1, 2.14312788730e2, 9.87821014531e2],
        [-1.26154956321e1, 1.59751129094e1, 2.14566506328e2, 9.87038219279e2],
    ];
    let count = 1000;
    for ((end, numbers), extent) in [(605.0, paper_end), (4000.0, late)].into_iter().zip(extents) {
        let run = paper(1e-4, 1e-2, OMEGA_1 + OMEGA_2, end);
        assert_numbers(&run, numbers);
        let states = strobe_states(&run, count);
        let rates = states.iter().map(|state| run.system.voltage_rate(state.as_slice()));
        let rates = rates.fold((f64::MAX, f64::MIN), |(low, high), rate| (low.min(rate), high.max(rate)));
        let volts = range(&states, 4);
        for (value, reference) in [volts.0, volts.1, rates.0, rates.1].into_iter().zip(extent) {
            assert_close(value, reference, reference.abs());
        }
        let shape = Shape::of(&states, 10);
        assert!(shape.is_closed_curve(count), "t = {end}: {shape:?}");
        assert_eq!(run.recurrence.and_then(|found| found.period), None);
        // The plotted points are (v, dv/dt) of the same states.
        let expected = strobe_states(&run, 3);
        let last = run.strobe.len() - 1;
        for (state, point) in expected.iter().zip(&run.strobe[last - 3..last]) {
            assert!((state[4] - point.v).abs() < 1e-8, "{} {}", state[4], point.v);
        }
    }
}

#[test]
fn figure_9_has_period_two() {
    let run = paper(1e-4, 1e-2, 2.0 * OMEGA_1, 608.0);
    assert_eq!(run.recurrence.and_then(|found| found.period), Some(2));
    // The rest is about the motion once its transient is gone.
    let end = 5000.0;
    let run = paper(1e-4, 1e-2, 2.0 * OMEGA_1, end);
    let states = strobe_states(&run, 100);
    let [even, odd] = [0, 1].map(|first| states.iter().skip(first).step_by(2).cloned().collect::<Vec<_>>());
    for k in 0..5 {
        let ((low, high), (other_low, other_high)) = (range(&even, k), range(&odd, k));
        let apart = (low - other_high).max(other_low - high);
        assert!((high - low).max(other_high - other_low) < 1e-9 * apart, "component {k}");
    }
    // The orbit of the reference, found by shooting. The run starts at rest and may be half a period behind it.
    let points = [
        [-3.86451008955e-2, 1.90434006184e-4, -4.00172877025e-1, -4.30037303762e-3, -1.73217103067e1],
        [6.53652381472e-2, 5.30205004933e-4, 2.37711353582e-2, -1.06398152371e-2, 1.53718648532e1],
    ];
    let [first, second] = if even[0][4] < 0.0 { [&even[0], &odd[0]] } else { [&odd[0], &even[0]] };
    for (state, reference) in [first, second].into_iter().zip(points) {
        for (k, reference) in reference.into_iter().enumerate() {
            let scale = range(&states, k).1.max(-range(&states, k).0);
            assert_close(state[k], reference, scale);
        }
    }
    assert_numbers(
        &run,
        [1.41783276644e1, 2.54146921132e1, 1.24074945463e2, 6.60116949105e-2, -8.35375647264e-2],
    );
}

#[test]
fn figure_12_escapes_under_the_quadratic_law_only() {
    let omega = 2.0 * OMEGA_2;
    let quadratic = run(1e-4, 1e-2, omega, 600.0, ModelChoice::default());
    let Outcome::Escaped { time } = quadratic.outcome() else { panic!("{:?}", quadratic.outcome()) };
    // When the tip passes one beam length, and ten, where it counts as escaped: by the reference, and here on the
    // record of the run.
    for (level, reference) in [(1.0, 9.57695666336e-1), (10.0, 1.13875094679)] {
        let passed =
            |t: f64| quadratic.system.tip_displacement(&quadratic.trajectory.state_at(t)).abs() > level;
        let (mut before, mut after) = (reference - 0.01, reference + 0.01);
        for _ in 0..50 {
            let middle = 0.5 * (before + after);
            if passed(middle) { after = middle } else { before = middle }
        }
        assert_close(after, reference, reference);
    }
    // The run notices at the end of the step in which it passes.
    let last = quadratic.trajectory.end_time();
    let tip = quadratic.system.tip_displacement(quadratic.trajectory.final_state());
    assert!(time == last && tip >= ESCAPE_DISPLACEMENT, "{time} {last} {tip}");
    for modes in [2, 4] {
        assert_eq!(run(1e-4, 1e-2, omega, 600.0, exact(modes)).outcome(), Outcome::Completed);
    }
}
