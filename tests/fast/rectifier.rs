//! The device with a rectifier: against a closed form, against another integration, and its energy.

use std::f64::consts::{PI, SQRT_2, TAU};

use harvester_lab::dynamics::Measures;
use harvester_lab::dynamics::attractors::rectified::{RectifiedBalance, Steady, settle_rectified};
use harvester_lab::dynamics::integration::rectified::{RectifiedRun, RectifiedTotals};
use harvester_lab::model::{ForceLaw, ParameterSet, Parameters, ReducedSystem};
use harvester_lab::questions::solve;
use harvester_lab::theory::{LinearResponse, Source};
use serde_json::Value;

fn system(set: ParameterSet, modes: usize, law: ForceLaw) -> ReducedSystem {
    ReducedSystem::new(Parameters::new(set).expect("in range"), modes, law).expect("a device")
}

fn settled(system: &ReducedSystem, threshold: f64) -> (Steady, RectifiedBalance) {
    let rest = vec![0.0; system.dimension()];
    let (steady, balance, _) = settle_rectified(system, threshold, &rest).expect("a motion");
    (steady, balance.expect("a balance"))
}

/// A beam without magnets and with a weak coupling, excited off its resonances: the rectifier does not move it.
fn weak() -> ParameterSet {
    ParameterSet {
        c0: 0.0,
        theta: 2e-6,
        kappa: 0.0,
        alpha: 1e-3,
        beta: 0.01,
        omega: 3.0,
        ..Default::default()
    }
}

#[test]
fn with_a_weak_coupling_the_power_is_the_published_one() {
    let system = system(weak(), 2, ForceLaw::Quadratic);
    let source = Source::new(&system).expect("damped");
    let open = (source.current / source.admittance).norm();
    let p = &system.parameters;
    let mut best = (0.0, 0.0);
    for part in [0.05, 0.25, 0.4, 0.5, 0.6, 0.75, 0.95] {
        let voltage = part * open;
        let (steady, balance) = settled(&system, voltage);
        assert_eq!(steady, Steady::Repeats { periods: 1 });
        // Ottman et al., IEEE Trans. Power Electron. 17, 669 (2002): a sinusoidal displacement.
        let published = 2.0 * p.omega * system.capacitance / PI * voltage * (open - voltage);
        assert!((balance.rectifier / published - 1.0).abs() < 0.01, "{part}: {balance:?} {published}");
        assert!((balance.switchings - 4.0).abs() < 1e-9);
        best = if balance.rectifier > best.1 { (part, balance.rectifier) } else { best };
    }
    assert_eq!(best.0, 0.5);
    // Beyond the open-circuit voltage nothing flows.
    let (_, balance) = settled(&system, 1.01 * open);
    assert_eq!((balance.current, balance.rectifier, balance.switchings), (0.0, 0.0, 0.0));
}

#[test]
fn a_store_that_is_never_reached_leaves_the_motion_with_open_electrodes() {
    // Without a current and a leak any charge would stay; from rest there is none, and the linear device is a sine.
    let devices = [
        (0.005151232885184298, 15.398464587095692, 0.00019310849540929052, 3),
        (0.005839108650569759, 12.202521272704232, 0.0003111881270497688, 1),
        (1e-3, 4.0, 2e-4, 2),
        (2e-2, 21.0, 1e-3, 2),
    ];
    for (alpha, omega, theta, modes) in devices {
        let set =
            ParameterSet { c0: 0.0, kappa: 0.0, beta: 0.002, alpha, omega, theta, ..Default::default() };
        let system = system(set, modes, ForceLaw::Quadratic);
        let open = LinearResponse::new(&system).expect("damped");
        let (steady, balance) = settled(&system, 1000.0);
        assert_eq!(steady, Steady::Repeats { periods: 1 }, "{omega}");
        let Measures { v_rms, v_peak, tip, .. } = balance.measures;
        // Peaks are read at nodes.
        for (found, exact, close) in [
            (v_rms * SQRT_2, open.voltage.norm(), 1e-7),
            (v_peak, open.voltage.norm(), 1e-3),
            (tip.1, open.tip().norm(), 1e-3),
            (-tip.0, open.tip().norm(), 1e-3),
        ] {
            assert!((found / exact - 1.0).abs() < close, "{omega}: {found} {exact}");
        }
        assert!((balance.input / balance.viscous - 1.0).abs() < 1e-6, "{omega}: {balance:?}");
    }
}

/// The same device by Runge and Kutta's classical method with small steps, which end where the circuit switches, found by
/// halving: it shares nothing with the solver but the right-hand side of Eqs. (31), (32).
struct Small<'a> {
    system: &'a ReducedSystem,
    threshold: f64,
    charging: Option<f64>,
    time: f64,
    state: Vec<f64>,
    charge: f64,
}

impl Small<'_> {
    fn current(&self, state: &[f64]) -> f64 {
        self.system.voltage_rate(state) * self.system.capacitance
    }

    fn rate(&self, time: f64, state: &[f64]) -> Vec<f64> {
        let mut rate = vec![0.0; state.len()];
        let rest = self.system.rest_force().rest(self.system.tip_displacement(state));
        let sine = (self.system.parameters.omega * time).sin();
        self.system.derivative(state, rest, sine, &mut rate);
        if self.charging.is_some() {
            rate[state.len() - 1] = 0.0;
        }
        rate
    }

    fn after(&self, step: f64) -> Vec<f64> {
        let moved = |rate: &[f64], h: f64| -> Vec<f64> {
            self.state.iter().zip(rate).map(|(y, k)| y + h * k).collect()
        };
        let k1 = self.rate(self.time, &self.state);
        let k2 = self.rate(self.time + 0.5 * step, &moved(&k1, 0.5 * step));
        let k3 = self.rate(self.time + 0.5 * step, &moved(&k2, 0.5 * step));
        let k4 = self.rate(self.time + step, &moved(&k3, step));
        (0..self.state.len())
            .map(|i| self.state[i] + step / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]))
            .collect()
    }

    /// Whether the other circuit holds in `state`.
    fn beyond(&self, state: &[f64]) -> bool {
        match self.charging {
            None => state[state.len() - 1].abs() > self.threshold,
            Some(sign) => sign * self.current(state) < 0.0,
        }
    }

    fn go(&mut self, step: f64) {
        let end = self.after(step);
        if !self.beyond(&end) {
            return self.take(end, step);
        }
        let (mut low, mut high) = (0.0, step);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.beyond(&self.after(middle)) { high = middle } else { low = middle }
        }
        self.take(self.after(low), low);
        let last = self.state.len() - 1;
        self.charging = match self.charging {
            None => {
                let sign = self.state[last].signum();
                self.state[last] = sign * self.threshold;
                Some(sign)
            }
            Some(_) => None,
        };
        // A whisker on, so that rounding does not switch it back.
        let rest = step - low;
        self.take(self.after(rest.min(1e-9)), rest.min(1e-9));
        if rest > 1e-9 {
            self.go(rest - 1e-9);
        }
    }

    fn take(&mut self, end: Vec<f64>, step: f64) {
        if let Some(sign) = self.charging {
            let n = self.system.modes.len();
            let moved: f64 = (0..n).map(|k| self.system.theta[k] * (end[k] - self.state[k])).sum();
            self.charge += sign * moved - self.system.parameters.kappa * self.threshold * step;
        }
        (self.state, self.time) = (end, self.time + step);
    }
}

#[test]
fn it_is_the_motion_of_another_integration() {
    let set = ParameterSet { alpha: 1e-3, beta: 5e-3, omega: 4.0, kappa: 2e-8, ..Default::default() };
    for (law, modes, threshold) in
        [(ForceLaw::Quadratic, 2, 4.0), (ForceLaw::Exact, 3, 1.0), (ForceLaw::Exact, 2, 12.0)]
    {
        let system = system(set, modes, law);
        let rest = vec![0.0; system.dimension()];
        let mut run = RectifiedRun::new(&system, threshold, &rest).expect("a start");
        let mut totals = RectifiedTotals::default();
        let (time, state, charge) = (0.0, rest.clone(), 0.0);
        let mut small = Small { system: &system, threshold, charging: None, time, state, charge };
        let (periods, steps) = (12, 6000);
        let step = TAU / set.omega / f64::from(steps);
        for _ in 0..periods {
            assert_eq!(run.period(Some(&mut totals)).expect("steps"), None);
            for _ in 0..steps {
                small.go(step);
            }
        }
        assert!(totals.switchings > 30, "{totals:?}");
        assert!((totals.charge / small.charge - 1.0).abs() < 1e-6, "{} {}", totals.charge, small.charge);
        let size = |i: usize| if i == 2 * modes { threshold } else { 0.01 };
        for (i, (a, b)) in run.state().iter().zip(&small.state).enumerate() {
            assert!((a - b).abs() < 1e-6 * size(i), "{law:?} component {i}: {a} {b}");
        }
    }
}

#[test]
fn its_energy_balance_closes() {
    let set = ParameterSet { alpha: 1e-3, beta: 4e-3, omega: 4.0, kappa: 3e-8, ..Default::default() };
    // In air, and with a tip that turns about a centre of its own.
    let real = ParameterSet { air: 0.05, j: 1e-3, e: 0.02, ..set };
    for (set, law, modes) in [
        (set, ForceLaw::Quadratic, 2),
        (set, ForceLaw::Exact, 2),
        (set, ForceLaw::Exact, 4),
        (real, ForceLaw::Exact, 3),
    ] {
        for threshold in [0.5, 5.0, 9.0] {
            let system = system(set, modes, law).with_residual_moment(modes == 4);
            let (steady, balance) = settled(&system, threshold);
            assert!(matches!(steady, Steady::Repeats { .. }), "{steady:?}");
            assert!(balance.rectifier > 0.0 && balance.dielectric > 0.0, "{balance:?}");
            assert!(balance.stored.abs() < 1e-8 * balance.input, "{law:?} {threshold}: {balance:?}");
            assert!(balance.defect() < 1e-8, "{law:?} {threshold}: {} {balance:?}", balance.defect());
        }
    }
}

#[test]
fn a_resonance_that_takes_long_is_settled_by_its_cycle() {
    // From rest the beam alone needs thousands of periods; the numbers must be those of a run that waited.
    let set = ParameterSet { c0: 0.0, alpha: 1e-4, beta: 1e-3, omega: 3.5, kappa: 0.0, ..Default::default() };
    let system = system(set, 2, ForceLaw::Quadratic);
    let threshold = 1.0;
    let (steady, balance) = settled(&system, threshold);
    assert_eq!(steady, Steady::Repeats { periods: 1 });
    let mut run = RectifiedRun::new(&system, threshold, &[0.0; 5]).expect("a start");
    for _ in 0..20_000 {
        run.period(None).expect("steps");
    }
    let mut totals = RectifiedTotals::default();
    run.period(Some(&mut totals)).expect("steps");
    let waited = threshold * totals.charge / totals.duration;
    assert!((balance.rectifier / waited - 1.0).abs() < 1e-6, "{} {waited}", balance.rectifier);
}

fn answer(request: &str) -> Value {
    serde_json::from_str(&solve(request).expect(request)).expect("JSON")
}

#[test]
fn requests_get_the_power_into_the_store_beside_that_in_a_load() {
    let device = r#""task":"harvest","device":{"frequency":2.835,"resistance":7631732},"acceleration":0.15"#;
    let begin = std::time::Instant::now();
    let found = answer(&format!("{{{device},\"rectifier\":{{\"voltage\":3,\"drop\":0.25}}}}"));
    println!("{:.3} s", begin.elapsed().as_secs_f64());
    let number = |value: &Value| value.as_f64().expect("a number");
    let rectified = &found["rectified"];
    let own = &rectified["at_voltage"];
    let of = |name: &str| number(&own["delivered"][name]);
    assert_eq!(number(&own["voltage"]), 3.0);
    assert!((of("power") - 3.0 * of("current")).abs() < 1e-12 * of("power"));
    assert!((of("diodes") - 0.5 * of("current")).abs() < 1e-12 * of("power"));
    assert!((of("v_peak") - 3.5).abs() < 1e-9);
    let out = of("power") + of("diodes") + of("viscous") + of("dielectric");
    assert!((out / of("input") - 1.0).abs() < 1e-8 && of("defect") < 1e-8, "{own}");
    let curve = rectified["curve"].as_array().expect("a curve");
    assert_eq!(curve.len(), 24);
    let open = number(&rectified["open_circuit"]);
    let best = &rectified["best"];
    let powers: Vec<f64> = curve.iter().map(|point| number(&point["delivered"]["power"])).collect();
    let highest = powers.iter().copied().fold(0.0, f64::max);
    assert!(number(&best["delivered"]["power"]) >= highest && number(&best["voltage"]) < open - 0.5);
    // In a linear device the best rectified power is below that of the best load, and not by much.
    let [_, watts] = [0, 1].map(|i| number(&rectified["resistive_linear"][i]));
    assert!(watts > 0.0);
    // Without a rectifier the answer is as before.
    assert!(answer(&format!("{{{device}}}")).get("rectified").is_none());
    let refused =
        |rectifier: &str| solve(&format!("{{{device},\"rectifier\":{rectifier}}}")).expect_err(rectifier);
    assert_eq!(
        refused(r#"{"voltage":0}"#),
        "rectifier.voltage = 0 is out of range: allowed are 1e-6 to 1000000 V"
    );
    assert!(refused(r#"{"drop":-1}"#).starts_with("rectifier.drop = -1 is out of range"));
    assert!(refused(r#"{"volts":1}"#).starts_with("rectifier.volts"));
}
