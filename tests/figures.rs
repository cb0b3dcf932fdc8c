//! The figures of the paper on the data this program computes for them: which motion each shows, and how close the
//! paper's first-order theory comes to it.

use harvester_lab::dynamics::Outcome;
use harvester_lab::jobs::Run;
use harvester_lab::model::{ForceLaw, ParameterSet};
use harvester_lab::scenario::{ModelChoice, Scenario};
use harvester_lab::theory::{LinearResponse, SteadyState};
use nalgebra::{DMatrix, DVector};

/// omega_1, omega_2 and the gap s0 of the paper's device, in 40-digit arithmetic.
const OMEGA_1: f64 = 4.04845139686289;
const OMEGA_2: f64 = 21.3562434253049;
const GAP: f64 = 0.169450341372524;

/// A run of the paper's device from rest.
fn run(alpha: f64, beta: f64, omega: f64, t_end: f64, model: ModelChoice) -> Run {
    let parameters = ParameterSet { alpha, beta, omega, ..Default::default() };
    let scenario = Scenario { parameters, model, t_end, ..Default::default() };
    Run::compute(&scenario).expect("a run of the paper")
}

fn paper(alpha: f64, beta: f64, omega: f64, t_end: f64) -> Run {
    let run = run(alpha, beta, omega, t_end, ModelChoice::default());
    assert_eq!(run.outcome(), Outcome::Completed);
    run
}

fn exact(modes: usize) -> ModelChoice {
    ModelChoice { modes, force: ForceLaw::Exact }
}

/// States at the last `count` stroboscopic times before the end of the run, from its dense output.
fn strobe_states(run: &Run, count: usize) -> Vec<DVector<f64>> {
    let period = run.system.parameters.period();
    let last = (run.trajectory.end_time() / period + 1e-9).floor() as usize;
    let times: Vec<f64> = (last - count..last).map(|k| k as f64 * period).collect();
    let mut states = Vec::new();
    run.trajectory.read_at(&times, |_, state| states.push(DVector::from_column_slice(state)));
    states
}

/// Largest and smallest entry `k` of the states.
fn range(states: &[DVector<f64>], k: usize) -> (f64, f64) {
    states.iter().fold((f64::MAX, f64::MIN), |(low, high), state| (low.min(state[k]), high.max(state[k])))
}

/// A stable figure: alpha, beta, omega, end, and the range in which the largest distance between the paper's dots
/// and its curve lies, relative to the amplitude. The dots leave out damping and the circuit's back-action, which
/// move the linear response by up to 8 %: they must be near the curve, but not on it.
fn assert_period_one(alpha: f64, beta: f64, omega: f64, end: f64, distance: (f64, f64)) {
    let run = paper(alpha, beta, omega, end);
    let period = run.system.parameters.period();
    let states = strobe_states(&run, 50);
    let (mut peak, mut from_dots, mut from_linear): (f64, f64, f64) = (0.0, 0.0, 0.0);
    let dots = SteadyState::new(&run.system).expect("off resonance").voltage;
    let linear = LinearResponse::new(&run.system).expect("damped");
    run.trajectory.sample(end - period, end, 500, |t, state| {
        let (v, rate) = (state[4], run.system.voltage_rate(state) / omega);
        peak = peak.max(v.abs());
        from_dots = from_dots.max((v - dots.value(t)).hypot(rate - dots.rate(t) / omega));
        from_linear = from_linear.max((v - linear.state(t)[4]).abs());
    });
    // One point in the Poincare map: what the transient has left is below half a per cent.
    let (low, high) = range(&states, 4);
    assert!(high - low < 6e-3 * peak, "omega = {omega}: {low} to {high}");
    let recurrence = run.recurrence.expect("enough points");
    assert_eq!(recurrence.period, Some(1), "omega = {omega}: {recurrence:?}");
    let from_dots = from_dots / peak;
    assert!((distance.0..distance.1).contains(&from_dots), "omega = {omega}: {from_dots}");
    // Where the amplitude is small the linear response that keeps damping and circuit is the curve itself.
    if beta < 2e-3 {
        assert!(from_linear < 2e-3 * peak, "omega = {omega}: {}", from_linear / peak);
    }
}

#[test]
fn figure_3_has_period_one_and_the_theory_near_it() {
    assert_period_one(1e-3, 1e-3, 25.0, 602.0, (0.04, 0.09));
}

#[test]
fn figure_5_has_period_one_and_the_theory_near_it() {
    assert_period_one(1e-3, 1e-3, OMEGA_2 - OMEGA_1, 603.0, (0.02, 0.05));
}

#[test]
fn figure_6_has_period_one_and_the_theory_near_it() {
    assert_period_one(1e-4, 1e-2, OMEGA_2 - OMEGA_1, 603.0, (0.01, 0.03));
}

#[test]
fn figure_8_has_period_one_and_the_theory_near_it() {
    assert_period_one(1e-3, 1e-3, 8.0, 604.0, (0.002, 0.007));
}

#[test]
fn figure_11_has_period_one_and_the_theory_near_it() {
    assert_period_one(1e-3, 1e-3, 43.0, 601.0, (0.01, 0.03));
}

/// What a cloud of points looks like near each of its points.
#[derive(Debug)]
struct Shape {
    /// Largest ratio of the second to the first principal extent of a neighbourhood: 0 on a line, 1 in an area.
    width: f64,
    /// Smallest share of a neighbourhood on its poorer side along the line: 0 at the end of an arc.
    balance: f64,
    /// Largest distance to the nearest neighbour, relative to the size of the cloud.
    largest_gap: f64,
    /// Number of points that are apart from each other by more than a millionth of the cloud's size.
    distinct: usize,
    /// Parts that remain when points nearer than twice the largest gap are joined.
    parts: usize,
}

impl Shape {
    fn of(points: &[DVector<f64>], neighbours: usize) -> Self {
        let dimension = points[0].len();
        let scale: Vec<f64> = (0..dimension)
            .map(|k| {
                let (low, high) = range(points, k);
                (high - low).max(1e-300)
            })
            .collect();
        let scaled: Vec<DVector<f64>> =
            points.iter().map(|point| DVector::from_fn(dimension, |k, _| point[k] / scale[k])).collect();
        let mut shape = Self { width: 0.0, balance: 1.0, largest_gap: 0.0, distinct: 0, parts: 0 };
        for (i, point) in scaled.iter().enumerate() {
            let mut others: Vec<(f64, usize)> =
                scaled.iter().enumerate().map(|(j, other)| ((other - point).norm(), j)).collect();
            others.sort_by(|a, b| a.0.total_cmp(&b.0));
            shape.distinct += usize::from(!others.iter().any(|(r, j)| *j < i && *r < 1e-6));
            shape.largest_gap = shape.largest_gap.max(others[1].0);
            let near = DMatrix::from_fn(dimension, neighbours, |k, j| scaled[others[j + 1].1][k] - point[k]);
            let svd = near.clone().svd(true, false);
            let extents = svd.singular_values;
            shape.width = shape.width.max(extents[1] / extents[0]);
            let direction = svd.u.expect("asked for").column(0).into_owned();
            let ahead = near.column_iter().filter(|offset| offset.dot(&direction) > 0.0).count();
            shape.balance = shape.balance.min(ahead.min(neighbours - ahead) as f64 / neighbours as f64);
        }
        let mut part: Vec<Option<usize>> = vec![None; scaled.len()];
        for seed in 0..scaled.len() {
            let mut open = if part[seed].is_none() { vec![seed] } else { vec![] };
            shape.parts += open.len();
            while let Some(i) = open.pop() {
                part[i] = Some(seed);
                for j in 0..scaled.len() {
                    if part[j].is_none() && (&scaled[i] - &scaled[j]).norm() < 2.0 * shape.largest_gap {
                        part[j] = Some(seed);
                        open.push(j);
                    }
                }
            }
        }
        shape
    }

    fn is_closed_curve(&self, points: usize) -> bool {
        self.width < 0.4
            && self.balance > 0.1
            && self.parts == 1
            && self.distinct > points * 9 / 10
            && self.largest_gap < 0.1
    }
}

#[test]
fn the_shape_test_tells_closed_curves_from_other_sets() {
    let cloud = |f: &dyn Fn(f64) -> (f64, f64)| -> Vec<DVector<f64>> {
        let point = |i: usize| f(i as f64);
        (0..1000).map(|i| DVector::from_column_slice(&[point(i).0, 3.0 * point(i).1])).collect()
    };
    let golden = 3.883222077450933;
    let loops = cloud(&|i| ((golden * i).sin(), (golden * i + 0.7).cos() + 0.3 * (2.0 * golden * i).sin()));
    let arc = cloud(&|i| ((0.0017 * i).sin(), (0.0017 * i).cos()));
    let disk =
        cloud(&|i| ((i / 1000.0).sqrt() * (golden * i).sin(), (i / 1000.0).sqrt() * (golden * i).cos()));
    let finite = cloud(&|i| ((i % 7.0).sin(), (i % 7.0).cos()));
    let two = cloud(&|i| ((golden * i).sin() + 5.0 * (i % 2.0), (golden * i).cos()));
    assert!(Shape::of(&loops, 10).is_closed_curve(1000), "{:?}", Shape::of(&loops, 10));
    for other in [arc, disk, finite, two] {
        assert!(!Shape::of(&other, 10).is_closed_curve(1000), "{:?}", Shape::of(&other, 10));
    }
}

#[test]
fn figure_4_is_a_closed_curve_in_the_poincare_map() {
    // At the paper's end, and when what is left of the transient has died out.
    for (end, count) in [(605.0, 1000), (4000.0, 1000)] {
        let run = paper(1e-4, 1e-2, OMEGA_1 + OMEGA_2, end);
        let shape = Shape::of(&strobe_states(&run, count), 10);
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
    // The same orbit by SciPy's DOP853 at a relative tolerance of 1e-11: 14.1783 V, -0.49299 and 0.38956 of s0.
    let period = run.system.parameters.period();
    let (mut square, mut low, mut high) = (0.0, f64::MAX, f64::MIN);
    let samples = 4001;
    run.trajectory.sample(end - 2.0 * period, end, samples, |t, state| {
        square += if t < end - 1e-9 { state[4] * state[4] / (samples - 1) as f64 } else { 0.0 };
        (low, high) = (low.min(state[0] + state[1]), high.max(state[0] + state[1]));
    });
    let v_rms = square.sqrt();
    assert!((v_rms - 14.178_327_664).abs() < 1e-7, "{v_rms}");
    assert!((low / GAP + 0.492991).abs() < 2e-6 && (high / GAP - 0.389564).abs() < 2e-6, "{low} {high}");
    let summary = run.summary.expect("a completed run has a summary");
    // Its window of 646 periods begins at the border of a step, which may lose a fraction of a period.
    assert!((summary.v_rms - 14.17833).abs() < 5e-3, "{}", summary.v_rms);
    assert!((summary.tip_min / GAP + 0.49299).abs() < 5e-4, "{}", summary.tip_min / GAP);
    assert!((summary.tip_max / GAP - 0.38956).abs() < 5e-4, "{}", summary.tip_max / GAP);
}

#[test]
fn figure_12_escapes_under_the_quadratic_law_only() {
    let omega = 2.0 * OMEGA_2;
    let quadratic = run(1e-4, 1e-2, omega, 600.0, ModelChoice::default());
    let Outcome::Escaped { time } = quadratic.outcome() else { panic!("{:?}", quadratic.outcome()) };
    assert!((1.1..1.25).contains(&time), "{time}");
    // Once over the barrier it falls: without the force that the truncation leaves out the tip goes far away.
    assert!(quadratic.summary.is_some_and(|summary| summary.tip_max > 5.0 * GAP));
    for modes in [2, 4] {
        let exact = run(1e-4, 1e-2, omega, 600.0, exact(modes));
        assert_eq!(exact.outcome(), Outcome::Completed);
        let summary = exact.summary.expect("a completed run has a summary");
        assert!(summary.tip_min > -GAP && summary.tip_max < 2.0 * GAP, "{summary:?}");
    }
}

#[test]
fn peaks_of_the_last_tenth_under_three_models() {
    // Peak |v| from t = 540 to 600 by an independent program; the motions of Figures 4 and 12 do not repeat, so
    // two converged computations agree there to a few per cent only.
    let models = [ModelChoice::default(), exact(2), exact(4)];
    for (alpha, beta, omega, peaks, tolerance) in [
        (1e-4, 1e-2, OMEGA_1 + OMEGA_2, [Some(55.7), Some(25.2), Some(26.9)], 0.03),
        (1e-4, 1e-2, 2.0 * OMEGA_1, [Some(25.6), Some(23.0), Some(23.0)], 0.005),
        (1e-4, 1e-2, 2.0 * OMEGA_2, [None, Some(47.3), Some(14.2)], 0.03),
        (1e-3, 1e-3, 25.0, [Some(2.584), Some(2.584), Some(2.703)], 0.003),
    ] {
        for (model, reference) in models.into_iter().zip(peaks) {
            let Some(reference) = reference else { continue };
            let run = run(alpha, beta, omega, 600.0, model);
            let peak = run.summary.map_or(f64::NAN, |summary| summary.v_peak);
            assert!((peak / reference - 1.0).abs() < tolerance, "{omega} {model:?}: {peak} not {reference}");
        }
    }
}
