//! The figures of the paper on the data this program computes for them: which motion each shows, and how close the
//! paper's first-order theory comes to it.

use harvester_lab::dynamics::{ESCAPE_DISPLACEMENT, Outcome};
use harvester_lab::jobs::Run;
use harvester_lab::model::{ForceLaw, ParameterSet};
use harvester_lab::scenario::{ModelChoice, Scenario};
use harvester_lab::theory::{LinearResponse, SteadyState};
use nalgebra::{DMatrix, DVector};

/// omega_1 and omega_2 of the paper's device, in 40-digit arithmetic.
const OMEGA_1: f64 = 4.04845139686289;
const OMEGA_2: f64 = 21.3562434253049;

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

/// Largest difference to a number of the reference, in its own units or those given. A run keeps the tip within 1e-10
/// of the gap; the smallest motion, that of Figure 11, moves it by 0.003 of the gap.
const AGREEMENT: f64 = 3e-8;

fn assert_close(value: f64, reference: f64, unit: f64) {
    let error = (value - reference).abs() / unit;
    assert!(error < AGREEMENT, "{value} instead of {reference}: {error:e}");
}

/// A motion by tests/reference/figures.py: over the summary's window v_rms, |v| and |dv/dt| at most, the tip's highest
/// and lowest place.
type Numbers = [f64; 5];

fn assert_numbers(run: &Run, reference: Numbers) {
    let s = run.summary.expect("a completed run has a summary");
    for (value, reference) in
        [s.v_rms, s.v_peak, s.dv_dt_peak, s.tip_max, s.tip_min].into_iter().zip(reference)
    {
        assert_close(value, reference, reference.abs());
    }
}

/// What the figures with a motion of the excitation's own period show.
struct PeriodOne {
    alpha: f64,
    beta: f64,
    omega: f64,
    end: f64,
    numbers: Numbers,
    /// Spread of v over the last 50 stroboscopic points: what is left of the transient. This and the next two are
    /// in units of the largest |v| of the last period.
    spread: f64,
    /// Largest distance between the computed curve and the paper's dots in the plane (v, dv/dt / omega). The dots
    /// leave out damping and the circuit's back-action.
    from_dots: f64,
    /// The same in v from the linear response that keeps both.
    from_linear: f64,
}

impl PeriodOne {
    fn assert(&self) {
        let &Self { alpha, beta, omega, end, .. } = self;
        let run = paper(alpha, beta, omega, end);
        assert_numbers(&run, self.numbers);
        let period = run.system.parameters.period();
        let (mut peak, mut from_dots, mut from_linear): (f64, f64, f64) = (0.0, 0.0, 0.0);
        let dots = SteadyState::new(&run.system).expect("off resonance").voltage;
        let linear = LinearResponse::new(&run.system).expect("damped");
        // The 500 times of the reference.
        run.trajectory.sample(end - period, end, 500, |t, state| {
            let (v, rate) = (state[4], run.system.voltage_rate(state) / omega);
            peak = peak.max(v.abs());
            from_dots = from_dots.max((v - dots.value(t)).hypot(rate - dots.rate(t) / omega));
            from_linear = from_linear.max((v - linear.state(t)[4]).abs());
        });
        let (low, high) = range(&strobe_states(&run, 50), 4);
        for (value, reference) in
            [(high - low, self.spread), (from_dots, self.from_dots), (from_linear, self.from_linear)]
        {
            assert_close(value / peak, reference, 1.0);
        }
        let recurrence = run.recurrence.expect("enough points");
        assert_eq!(recurrence.period, Some(1), "omega = {omega}: {recurrence:?}");
    }
}

#[test]
fn figure_3_has_period_one_and_the_theory_near_it() {
    let figure = PeriodOne {
        alpha: 1e-3,
        beta: 1e-3,
        omega: 25.0,
        end: 602.0,
        numbers: [1.82572778232, 2.58409944845, 6.45577657051e1, 1.41400545441e-3, -1.40549226624e-3],
        spread: 8.6589748e-4,
        from_dots: 8.1773785e-2,
        from_linear: 4.0589031e-4,
    };
    figure.assert();
}

#[test]
fn figure_5_has_period_one_and_the_theory_near_it() {
    let figure = PeriodOne {
        alpha: 1e-3,
        beta: 1e-3,
        omega: OMEGA_2 - OMEGA_1,
        end: 603.0,
        numbers: [1.34976241319, 1.91042250599, 3.30437899540e1, 3.09211368031e-3, -3.05188443651e-3],
        spread: 6.8987531e-4,
        from_dots: 4.5421426e-2,
        from_linear: 4.9508863e-4,
    };
    figure.assert();
}

#[test]
fn figure_6_has_period_one_and_the_theory_near_it() {
    let figure = PeriodOne {
        alpha: 1e-4,
        beta: 1e-2,
        omega: OMEGA_2 - OMEGA_1,
        end: 603.0,
        numbers: [1.35443918911e1, 1.92064540971e1, 3.31818836505e2, 3.28017892951e-2, -2.86976655111e-2],
        spread: 6.1433879e-4,
        from_dots: 2.4196151e-2,
        from_linear: 4.8730649e-3,
    };
    figure.assert();
}

#[test]
fn figure_8_has_period_one_and_the_theory_near_it() {
    let figure = PeriodOne {
        alpha: 1e-3,
        beta: 1e-3,
        omega: 8.0,
        end: 604.0,
        numbers: [4.71271292530e-1, 6.67800683228e-1, 5.33691337715, 2.18760909840e-3, -2.16657062094e-3],
        spread: 1.5782635e-3,
        from_dots: 5.1571594e-3,
        from_linear: 1.4076367e-3,
    };
    figure.assert();
}

#[test]
fn figure_11_has_period_one_and_the_theory_near_it() {
    let figure = PeriodOne {
        alpha: 1e-3,
        beta: 1e-3,
        omega: 43.0,
        end: 601.0,
        numbers: [4.61246995757e-1, 6.55891644297e-1, 2.80635815711e1, 5.01689700928e-4, -5.00768473232e-4],
        spread: 5.5161317e-3,
        from_dots: 2.4097688e-2,
        from_linear: 1.1332933e-3,
    };
    figure.assert();
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

#[test]
fn the_last_tenth_under_three_models() {
    // From rest to t = 600. None of these motions is chaotic: two computations agree to many digits.
    for ([alpha, beta, omega], model, reference) in [
        (
            [1e-4, 1e-2, OMEGA_1 + OMEGA_2],
            ModelChoice::default(),
            [2.34916161401e1, 5.57464052635e1, 9.87165442197e2, 8.19075841202e-2, -8.53829402802e-2],
        ),
        (
            [1e-4, 1e-2, OMEGA_1 + OMEGA_2],
            exact(2),
            [1.66098137469e1, 2.52017990241e1, 6.10778912261e2, 1.67001996862e-2, -1.49008925213e-2],
        ),
        (
            [1e-4, 1e-2, OMEGA_1 + OMEGA_2],
            exact(4),
            [1.75136453635e1, 2.69248879470e1, 6.47202288234e2, 1.87984828948e-2, -1.64776460804e-2],
        ),
        (
            [1e-4, 1e-2, 2.0 * OMEGA_1],
            ModelChoice::default(),
            [1.41793010613e1, 2.55704127723e1, 1.24700323008e2, 6.67803810561e-2, -8.39676401562e-2],
        ),
        (
            [1e-4, 1e-2, 2.0 * OMEGA_1],
            exact(2),
            [1.26032512976e1, 2.30397564007e1, 1.11473160767e2, 9.32878366381e-2, -3.93679117696e-2],
        ),
        (
            [1e-4, 1e-2, 2.0 * OMEGA_1],
            exact(4),
            [1.25636687337e1, 2.29748949081e1, 1.10876312847e2, 9.34254551531e-2, -3.93676369079e-2],
        ),
        (
            [1e-4, 1e-2, 2.0 * OMEGA_2],
            exact(2),
            [2.64794020159e1, 4.72516964535e1, 5.70114647714e2, 1.98073944181e-1, -9.78585120401e-2],
        ),
        (
            [1e-4, 1e-2, 2.0 * OMEGA_2],
            exact(4),
            [9.56871900266, 1.41726124929e1, 5.80183793293e2, 3.22605964618e-3, -3.19433366974e-3],
        ),
        (
            [1e-3, 1e-3, 25.0],
            ModelChoice::default(),
            [1.82572918235, 2.58413474696, 6.45583618140e1, 1.41467187657e-3, -1.40549226624e-3],
        ),
        (
            [1e-3, 1e-3, 25.0],
            exact(2),
            [1.82573649990, 2.58419470618, 6.45581562737e1, 1.41428458899e-3, -1.40583684713e-3],
        ),
        (
            [1e-3, 1e-3, 25.0],
            exact(4),
            [1.90971375206, 2.70295410961, 6.75279598486e1, 1.48987799154e-3, -1.48019997109e-3],
        ),
    ] {
        assert_numbers(&run(alpha, beta, omega, 600.0, model), reference);
    }
}
