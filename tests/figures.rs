//! The figures of the paper on the data this program computes for them: which motion each shows, and how close the
//! paper's first-order theory comes to it.

use std::f64::consts::TAU;

use harvester_lab::dynamics::Outcome;
use harvester_lab::jobs::Run;
use harvester_lab::model::{ForceLaw, ParameterSet};
use harvester_lab::scenario::{ModelChoice, Scenario};
use harvester_lab::theory::SteadyState;

/// omega_1, omega_2 and the gap s0 of the paper's device, in 40-digit arithmetic.
const OMEGA_1: f64 = 4.04845139686289;
const OMEGA_2: f64 = 21.3562434253049;
const GAP: f64 = 0.169450341372524;

/// A run of the paper's device from rest, with two modes unless `modes` says otherwise.
fn run(alpha: f64, beta: f64, omega: f64, t_end: f64, model: ModelChoice) -> Run {
    let parameters = ParameterSet { alpha, beta, omega, ..Default::default() };
    let scenario = Scenario { parameters, model, t_end, ..Default::default() };
    Run::compute(&scenario).expect("a run of the paper")
}

fn exact(modes: usize) -> ModelChoice {
    ModelChoice { modes, force: ForceLaw::Exact }
}

fn paper(alpha: f64, beta: f64, omega: f64, t_end: f64) -> Run {
    let run = run(alpha, beta, omega, t_end, ModelChoice::default());
    assert_eq!(run.outcome(), Outcome::Completed);
    run
}

/// States at the last `count` stroboscopic times that the run reached, from its dense output.
fn strobe_states(run: &Run, count: usize) -> Vec<Vec<f64>> {
    let period = run.system.parameters.period();
    let last = (run.trajectory.end_time() / period + 1e-9).floor() as usize;
    let times: Vec<f64> = (last - count..last).map(|k| k as f64 * period).collect();
    let mut states = Vec::new();
    run.trajectory.read_at(&times, |_, state| states.push(state.to_vec()));
    states
}

#[test]
fn explore() {
    for (name, alpha, beta, omega, end) in [
        ("3", 1e-3, 1e-3, 25.0, 602.0),
        ("5", 1e-3, 1e-3, OMEGA_2 - OMEGA_1, 603.0),
        ("6", 1e-4, 1e-2, OMEGA_2 - OMEGA_1, 603.0),
        ("8", 1e-3, 1e-3, 8.0, 604.0),
        ("11", 1e-3, 1e-3, 43.0, 601.0),
    ] {
        let run = paper(alpha, beta, omega, end);
        let theory = SteadyState::new(&run.system).unwrap().voltage;
        let states = strobe_states(&run, 50);
        let spread = |f: &dyn Fn(&[f64]) -> f64| {
            let v: Vec<f64> = states.iter().map(|s| f(s)).collect();
            v.iter().cloned().fold(f64::MIN, f64::max) - v.iter().cloned().fold(f64::MAX, f64::min)
        };
        let period = run.system.parameters.period();
        let mut worst = [0.0_f64; 2];
        let mut peak: f64 = 0.0;
        let mut rms = 0.0;
        run.trajectory.sample(end - period, end, 1000, |t, s| {
            let (v, r) = (s[4], run.system.voltage_rate(s));
            peak = peak.max(v.abs());
            worst[0] = worst[0].max((v - theory.value(t)).abs());
            worst[1] = worst[1].max((r - theory.rate(t)).abs() / omega);
            rms += (v - theory.value(t)).powi(2) / 1000.0;
        });
        eprintln!(
            "fig {name}: theory amp {} peak {} worst {:?} rel {:?} rms/amp {} spread v {} rate {} rec {:?} sum {:?}",
            theory.amplitude,
            peak,
            worst,
            worst.map(|w| w / peak),
            rms.sqrt() / peak,
            spread(&|s| s[4]) / peak,
            spread(&|s| run.system.voltage_rate(s)) / peak / omega,
            run.recurrence,
            run.summary
        );
    }
    for end in [608.0, 5000.0] {
        let r = paper(1e-4, 1e-2, 2.0 * OMEGA_1, end);
        let st = strobe_states(&r, 12);
        for s in &st {
            eprintln!("{:?}", s)
        }
        let (mut lo, mut hi) = (f64::MAX, f64::MIN);
        r.trajectory.sample(end * 0.9, end, 200000, |_, s| {
            lo = lo.min(s[0] + s[1]);
            hi = hi.max(s[0] + s[1]);
        });
        eprintln!(
            "fig 9 {:?} {:?} dense {} {} ; sum {} {}",
            r.summary,
            r.recurrence,
            lo / GAP,
            hi / GAP,
            r.summary.unwrap().tip_min / GAP,
            r.summary.unwrap().tip_max / GAP
        );
    }
    for m in [ModelChoice::default(), exact(2), exact(4)] {
        for (n, alpha, beta, omega) in [
            ("3", 1e-3, 1e-3, 25.0),
            ("4", 1e-4, 1e-2, OMEGA_1 + OMEGA_2),
            ("9", 1e-4, 1e-2, 2.0 * OMEGA_1),
            ("12", 1e-4, 1e-2, 2.0 * OMEGA_2),
        ] {
            let r = run(alpha, beta, omega, 600.0, m);
            eprintln!(
                "{n} {m:?} {:?} {:?}",
                r.outcome(),
                r.summary.map(|s| (s.v_peak, s.tip_min / GAP, s.tip_max / GAP))
            );
        }
    }
    let _ = TAU;
}
