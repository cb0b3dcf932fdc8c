//! Devices shaken by chirps, noise and records: against closed forms, the other tasks, and another integrator.

use std::sync::Arc;

use differential_equations::prelude::{ExplicitRungeKutta, IVP, ODE};
use harvester_lab::dynamics::integration::Shaken;
use harvester_lab::dynamics::{Outcome, Settings, Trajectory};
use harvester_lab::model::base_motion::{BaseMotion, Noise, Signal};
use harvester_lab::model::{ForceLaw, ParameterSet, Parameters, ReducedSystem, STANDARD_GRAVITY, Units};
use harvester_lab::questions::shaken_run::dimensionless;
use harvester_lab::questions::solve;
use harvester_lab::scenario::Scenario;
use nalgebra::DMatrix;
use serde_json::{Value, json};

use crate::{TestResult, answer, list, number};

/// Mean square of the voltage (V^2) of the linear `system` under white noise of the one-sided density `density` (dimensionless
/// acceleration squared per unit of frequency): the covariance P of the state solves A P + P A^T + density/2 b b^T = 0.
fn white(system: &ReducedSystem, density: f64) -> f64 {
    let (n, size) = (system.modes.len(), system.dimension());
    let a = system.jacobian(0.0);
    let mut b = DMatrix::zeros(size, 1);
    for (k, mode) in system.modes.iter().enumerate() {
        b[(n + k, 0)] = mode.eta1 / mode.eta2;
    }
    let unit = DMatrix::identity(size, size);
    let lyapunov = a.kronecker(&unit) + unit.kronecker(&a);
    let right = (&b * b.transpose() * (-0.5 * density))
        .reshape_generic(nalgebra::Dyn(size * size), nalgebra::Const::<1>);
    let covariance = lyapunov.lu().solve(&right).expect("a damped system");
    covariance[size * size - 1]
}

/// Dimensionless acceleration of 1 g.
fn scale(units: &Units) -> f64 {
    STANDARD_GRAVITY * units.time * units.time / units.length
}

#[test]
fn white_noise_gives_the_linear_device_the_power_of_the_closed_form() -> TestResult {
    let scenario = Scenario::default();
    let units = scenario.units();
    for kappa in [1e-9, 1e-8, 1e-7, 1e-6, 1e-5] {
        let set = ParameterSet { alpha: 5e-3, c0: 0.0, kappa, ..Default::default() };
        let system = ReducedSystem::new(Parameters::new(set)?, 2, ForceLaw::Quadratic)?;
        // Five times past the second own frequency.
        let (to, rms) = (units.hertz(110.0), 0.2);
        let request = json!({"task": "shake", "parameters": set, "realisations": 4,
            "excitation": {"kind": "noise", "from": 0, "to": to, "rms": rms, "duration": 400.0 / units.hertz(1.0), "seed": 5}});
        let found = answer(&request);
        let density = (rms * scale(&units)).powi(2) / (to * units.time);
        let expected = units.watts(kappa * white(&system, density));
        let (power, error) = (number(&found["power"]), number(&found["power_error"]));
        assert!((power - expected).abs() < 3.0 * error, "{kappa}: {power} +- {error}, {expected}");
        assert!(error < 0.1 * power, "{kappa}: {power} +- {error}");
        // Without magnets both devices are the same, and what goes in is lost in the beam or delivered.
        assert!((number(&found["gain"]) - 1.0).abs() < 1e-12 && number(&found["gain_error"]) < 1e-12);
        assert!(number(&found["input"]) > power);
        assert_eq!((&found["outcome"], &found["completed"]), (&json!("completed"), &json!(4)));
    }
    Ok(())
}

/// The equations as the paper prints them, under any acceleration.
#[derive(Clone)]
struct Forced<'a> {
    system: &'a ReducedSystem,
    signal: &'a Signal,
}

impl ODE<f64, [f64; 5]> for Forced<'_> {
    fn diff(&self, t: f64, y: &[f64; 5], rates: &mut [f64; 5]) {
        let p = &self.system.parameters;
        let rest = self.system.rest_force().rest(self.system.tip_displacement(y));
        let sine = -self.signal.at(t) / (p.omega * p.omega * p.beta);
        self.system.derivative(y, rest, sine, rates);
    }
}

#[test]
fn a_motion_under_noise_is_that_of_another_integrator() -> TestResult {
    let units = Scenario::default().units();
    for law in [ForceLaw::Quadratic, ForceLaw::Exact] {
        let set = ParameterSet { alpha: 1e-3, ..Default::default() };
        let system = ReducedSystem::new(Parameters::new(set)?, 2, law)?;
        let (from, to, rms) = (Some(units.hertz(2.0)), Some(units.hertz(12.0)), Some(0.05 / scale(&units)));
        let noise = Noise { from, to, rms, duration: 60.0 * units.time, seed: 3, spectrum: None };
        let signal = dimensionless(&BaseMotion::Noise(noise).signal(0)?, &units);
        let mut run = Shaken::new(&system, Arc::new(signal.clone()), &[0.0; 5], (100, 1))?;
        assert_eq!(run.advance(usize::MAX)?, Some(Outcome::Completed));
        // From sample to sample, where the acceleration has its kinks.
        let (mut state, interval) = ([0.0; 5], signal.interval());
        let equations = Forced { system: &system, signal: &signal };
        for i in 0..signal.samples().len() - 1 {
            let (begin, end) = (interval * i as f64, interval * (i + 1) as f64);
            let method = ExplicitRungeKutta::dop853().rtol(1e-12).atol(1e-14);
            let solution =
                IVP::ode(&equations, begin, end, state).method(method).solve().map_err(|_| "no solution")?;
            state = *solution.y.last().ok_or("no end")?;
        }
        let size = [0.01, 0.01, 0.1, 0.1, 1.0];
        for ((ours, theirs), size) in run.state().iter().zip(state).zip(size) {
            assert!((ours - theirs).abs() < 1e-6 * theirs.abs().max(size), "{law:?}: {ours} {theirs}");
        }
        let lively = run.measures().ok_or("measured")?;
        assert!(lively.tip.1 > 0.1 * system.equilibrium.gap, "{lively:?}");
    }
    Ok(())
}

#[test]
fn a_slow_chirp_follows_the_sweep() -> TestResult {
    // Up through the first resonance of a damped device, where both hang together by one curve.
    let units = Scenario::default().units();
    let (alpha, acceleration) = (5e-3, 0.006 / scale(&units));
    let (from, to) = (3.95, 4.25);
    let chirp = json!({"task": "shake", "parameters": {"alpha": alpha}, "points": 4000,
        "excitation": {"kind": "chirp", "from": units.hertz(from), "to": units.hertz(to),
                       "duration": 40_000.0 * units.time, "acceleration": acceleration}});
    let found = answer(&chirp);
    assert_eq!(found["outcome"], "completed");
    let (times, voltages) = (list(&found["time"]), list(&found["voltage"]));
    for omega in [4.0, 4.05, 4.1, 4.2] {
        let beta = units.beta_of(acceleration, omega);
        let sweep = json!({"task": "sweep", "parameters": {"alpha": alpha, "beta": beta}, "parameter": "omega",
            "from": omega, "to": omega + 1e-6, "count": 2, "transient": 600, "kept": 2});
        let steady = answer(&sweep);
        let v_peak = number(&steady["points"][0]["v_peak"]);
        let middle = (omega - from) / (to - from) * 40_000.0 * units.time;
        let near =
            times.iter().zip(voltages).filter(|(time, _)| (number(time) - middle).abs() < 40.0 * units.time);
        let envelope = near.map(|(_, voltage)| number(voltage).abs()).fold(0.0, f64::max);
        assert!((envelope / v_peak - 1.0).abs() < 0.01, "{omega}: {envelope} {v_peak}");
    }
    Ok(())
}

#[test]
fn a_recorded_sine_gives_what_the_sine_gives() -> TestResult {
    let scenario = Scenario::default();
    let units = scenario.units();
    let set = ParameterSet { alpha: 5e-3, beta: 5e-3, omega: 6.0, ..Default::default() };
    let system = ReducedSystem::new(Parameters::new(set)?, 2, ForceLaw::Quadratic)?;
    let (periods, per_period) = (200, 64);
    let interval = system.parameters.period() / per_period as f64;
    let peak = units.acceleration(set.beta, set.omega);
    let samples = 0..=periods * per_period;
    let time: Vec<f64> = samples.clone().map(|i| i as f64 * interval * units.time).collect();
    let acceleration: Vec<f64> = samples.map(|i| -peak * (set.omega * interval * i as f64).sin()).collect();
    let request = json!({"task": "shake", "parameters": set,
        "excitation": {"kind": "recorded", "time": time, "acceleration": acceleration}});
    let found = answer(&request);
    let end = interval * (periods * per_period) as f64;
    let own = Trajectory::compute(&system, &[0.0; 5], end, Settings { tolerance: 1e-8 })?;
    // Mean square by the trapezoidal rule, finely.
    let (mut square, mut count) = (0.0, 0.0);
    own.sample(0.0, end, 400_000, |_, state| {
        square += state[4] * state[4];
        count += 1.0;
    });
    let v_rms = number(&found["v_rms"]);
    assert!((v_rms / (square / count).sqrt() - 1.0).abs() < 1e-5, "{v_rms}");
    assert!((number(&found["acceleration_rms"]) / (peak * 0.5_f64.sqrt()) - 1.0).abs() < 1e-3);
    assert!(found["power_error"].is_null() && found["from"] == 0.0);
    Ok(())
}

#[test]
fn wrong_requests_are_told_what_is_wrong() {
    let refused = |excitation: Value| {
        solve(&json!({"task": "shake", "excitation": excitation}).to_string()).expect_err("a refusal")
    };
    let chirp = json!({"kind": "chirp", "from": 1, "to": 2, "duration": 10, "acceleration": -1});
    assert!(refused(chirp).starts_with("acceleration = -1 is out of range"));
    let text = refused(json!({"kind": "chirp", "from": 1, "to": 2, "acceleration": 1}));
    assert!(text.starts_with("excitation") && text.contains("duration"), "{text}");
    let text = refused(json!({"kind": "thunder"}));
    assert!(text.starts_with("excitation") && text.contains("chirp") && text.contains("recorded"), "{text}");
    let text = refused(json!({"kind": "noise", "from": 1, "to": 2, "rms": 1, "duration": 10, "loud": 1}));
    assert!(text.starts_with("excitation") && text.contains("loud"), "{text}");
    let text =
        refused(json!({"kind": "recorded", "time": [0, 1, 2, 3, 4, 3], "acceleration": [0, 0, 0, 0, 0, 0]}));
    assert!(text.starts_with("time[5] = 3"), "{text}");
    let many = json!({"task": "shake", "realisations": 3,
        "excitation": {"kind": "chirp", "from": 1, "to": 2, "duration": 10, "acceleration": 1}});
    assert!(solve(&many.to_string()).expect_err("one chirp is like another").starts_with("realisations = 3"));
}
