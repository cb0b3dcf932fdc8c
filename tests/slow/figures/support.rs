//! Runs of the paper's device, what is read off them, and how they are compared with tests/reference/figures.py.

use harvester_lab::dynamics::Outcome;
use harvester_lab::model::{ForceLaw, ParameterSet};
use harvester_lab::questions::Run;
use harvester_lab::scenario::{ModelChoice, Scenario};
use nalgebra::DVector;

/// A run of the paper's device from rest.
pub(crate) fn run(alpha: f64, beta: f64, omega: f64, t_end: f64, model: ModelChoice) -> Run {
    let parameters = ParameterSet { alpha, beta, omega, ..Default::default() };
    let scenario = Scenario { parameters, model, t_end, ..Default::default() };
    Run::compute(&scenario).expect("a run of the paper")
}

pub(crate) fn paper(alpha: f64, beta: f64, omega: f64, t_end: f64) -> Run {
    let run = run(alpha, beta, omega, t_end, ModelChoice::default());
    assert_eq!(run.outcome(), Outcome::Completed);
    run
}

pub(crate) fn exact(modes: usize) -> ModelChoice {
    ModelChoice { modes, force: ForceLaw::Exact, ..Default::default() }
}

/// States at the last `count` stroboscopic times before the end of the run, from its dense output.
pub(crate) fn strobe_states(run: &Run, count: usize) -> Vec<DVector<f64>> {
    let period = run.system.parameters.period();
    let last = (run.trajectory.end_time() / period + 1e-9).floor() as usize;
    let times: Vec<f64> = (last - count..last).map(|k| k as f64 * period).collect();
    let mut states = Vec::new();
    run.trajectory.read_at(&times, |_, state| states.push(DVector::from_column_slice(state)));
    states
}

/// Largest and smallest entry `k` of the states.
pub(crate) fn range(states: &[DVector<f64>], k: usize) -> (f64, f64) {
    states.iter().fold((f64::MAX, f64::MIN), |(low, high), state| (low.min(state[k]), high.max(state[k])))
}

/// Largest difference to a number of the reference, in its own units or those given. A run keeps the tip within 1e-10
/// of the gap; the smallest motion, that of Figure 11, moves it by 0.003 of the gap.
const AGREEMENT: f64 = 3e-8;

pub(crate) fn assert_close(value: f64, reference: f64, unit: f64) {
    let error = (value - reference).abs() / unit;
    assert!(error < AGREEMENT, "{value} instead of {reference}: {error:e}");
}

/// A motion by tests/reference/figures.py: over the summary's window v_rms, |v| and |dv/dt| at most, the tip's highest
/// and lowest place.
pub(crate) type Numbers = [f64; 5];

pub(crate) fn assert_numbers(run: &Run, reference: Numbers) {
    let s = run.summary.expect("a completed run has a summary");
    let m = s.measures;
    for (value, reference) in [m.v_rms, m.v_peak, s.dv_dt_peak, m.tip.1, m.tip.0].into_iter().zip(reference) {
        assert_close(value, reference, reference.abs());
    }
}
