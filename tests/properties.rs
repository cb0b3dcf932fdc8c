//! Whatever is asked within (and outside) the allowed ranges ends in finite numbers or in one clear line.

use std::time::{Duration, Instant};

use harvester_lab::dynamics::Outcome;
use harvester_lab::jobs::run::RunError;
use harvester_lab::jobs::{Run, solve};
use harvester_lab::model::{ForceLaw, MAX_MODES, Parameter, ParameterSet, state_dimension};
use harvester_lab::scenario::{ModelChoice, Scenario};

/// SplitMix64, so that every run of the tests asks the same questions.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1).
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn log_between(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp().clamp(low, high)
    }

    fn sign(&mut self) -> f64 {
        if self.next().is_multiple_of(2) { 1.0 } else { -1.0 }
    }

    fn pick<'a, T>(&mut self, items: &'a [T]) -> &'a T {
        &items[self.below(items.len())]
    }

    /// A value of `parameter`: an end of its range, the paper's value, or anything between.
    fn value(&mut self, parameter: Parameter) -> f64 {
        let (low, high) = parameter.range();
        match self.below(12) {
            0 => low,
            1 => high,
            2 | 3 => parameter.get(&ParameterSet::default()),
            4 => self.between(low, high),
            _ if parameter == Parameter::C0 => self.sign() * self.log_between(1e-6, high),
            _ => self.log_between(low.max(1e-7 * high), high),
        }
    }

    fn force(&mut self) -> ForceLaw {
        match self.below(4) {
            0 => ForceLaw::Quadratic,
            1 => ForceLaw::Taylor(2 + self.below(ForceLaw::MAX_DEGREE - 1)),
            _ => ForceLaw::Exact,
        }
    }

    fn scenario(&mut self) -> Scenario {
        let mut parameters = ParameterSet::default();
        for parameter in Parameter::ALL {
            *parameter.get_mut(&mut parameters) = self.value(parameter);
        }
        let modes = 1 + self.below(MAX_MODES);
        let initial = (self.below(3) > 0).then(|| {
            let size = self.log_between(1e-6, 1e6);
            (0..state_dimension(modes)).map(|_| size * self.between(-1.0, 1.0)).collect()
        });
        let t_end = (3.0 * std::f64::consts::TAU / parameters.omega).clamp(1.0, 5.0);
        let model = ModelChoice { modes, force: self.force() };
        Scenario { parameters, model, initial, t_end, ..Default::default() }
    }
}

/// The longest that one run may take here, far above what any needs: a bound on the cost of a run, not a benchmark.
const PATIENCE: Duration = Duration::from_secs(3);

fn assert_finite(run: &Run, t_end: f64) {
    let trajectory = &run.trajectory;
    assert!(trajectory.end_time().is_finite() && trajectory.end_time() <= t_end * (1.0 + 1e-9));
    if let Some(time) = run.outcome().early_end() {
        assert!((0.0..=t_end * (1.0 + 1e-9)).contains(&time), "{time}");
    } else {
        assert!((trajectory.end_time() - t_end).abs() <= 1e-9 * t_end);
    }
    trajectory.sample(0.0, trajectory.end_time(), 37, |t, state| {
        assert!(state.iter().all(|value| value.is_finite()), "t = {t}: {state:?}");
    });
    assert!(run.strobe.iter().all(|point| point.v.is_finite() && point.dv_dt.is_finite()));
    if let Some(s) = run.summary {
        let numbers = [s.from, s.to, s.v_rms, s.v_peak, s.dv_dt_peak, s.tip_min, s.tip_max, s.v_peak_whole];
        assert!(numbers.iter().all(|value| value.is_finite()), "{s:?}");
        assert!(s.tip_min <= s.tip_max && s.v_rms <= s.v_peak * (1.0 + 1e-9) && s.from <= s.to, "{s:?}");
    }
}

#[test]
fn ten_thousand_random_devices_end_in_finite_numbers_or_in_one_line() {
    let mut random = Random(20_200_731);
    let (mut completed, mut escaped, mut touched, mut refused, mut unresolved) = (0, 0, 0, 0, 0);
    let mut slow = Vec::new();
    for _ in 0..10_000 {
        let scenario = random.scenario();
        let start = Instant::now();
        std::fs::write("/tmp/last.txt", format!("{scenario:?}")).unwrap();
        let result = std::panic::catch_unwind(|| Run::compute(&scenario));
        let took = start.elapsed();
        if took > Duration::from_millis(300) {
            eprintln!("{took:?}");
        }
        slow.push((took, scenario.clone()));
        match result {
            Err(_) => panic!("{scenario:?}"),
            Ok(Ok(run)) => {
                assert_finite(&run, scenario.t_end);
                match run.outcome() {
                    Outcome::Completed => completed += 1,
                    Outcome::Escaped { .. } => escaped += 1,
                    Outcome::Contact { .. } => touched += 1,
                }
            }
            Ok(Err(error)) => {
                let line = error.to_string();
                assert!(!line.is_empty() && !line.contains('\n') && !line.contains("NaN"), "{line}");
                match error {
                    RunError::Model(_) => refused += 1,
                    RunError::Integration(_) => unresolved += 1,
                }
                if matches!(&error, RunError::Integration(_)) && unresolved < 40 {
                    eprintln!("{line} {scenario:?}");
                }
            }
        }
    }
    eprintln!(
        "{completed} completed, {escaped} escaped, {touched} touched, {refused} no device, {unresolved} unresolved"
    );
    slow.sort_by_key(|(t, _)| std::cmp::Reverse(*t));
    eprintln!("total {:?}", slow.iter().map(|s| s.0).sum::<Duration>());
    for (t, s) in &slow[..12] {
        eprintln!("{t:?} {s:?}");
    }
    let _ = (PATIENCE, solve("{}"));
}
