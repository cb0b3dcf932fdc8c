//! Whatever is asked within (and outside) the allowed ranges ends in finite numbers or in one clear line.

use harvester_lab::dynamics::{Measures, Outcome, RunError};
use harvester_lab::model::{ForceLaw, MAX_MODES, Parameter, ParameterSet, state_dimension};
use harvester_lab::questions::{Run, solve};
use harvester_lab::scenario::{ModelChoice, Scenario};
use serde_json::{Value, json};

/// Points of which every run of the tests tries the same.
struct Random(fastrand::Rng);

impl Random {
    fn seeded(seed: u64) -> Self {
        Self(fastrand::Rng::with_seed(seed))
    }

    fn below(&mut self, count: usize) -> usize {
        self.0.usize(..count)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.f64()
    }

    fn log_between(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp().clamp(low, high)
    }

    fn sign(&mut self) -> f64 {
        if self.0.bool() { 1.0 } else { -1.0 }
    }

    /// A value of `parameter`: an end of its range, the paper's value, or anything between.
    fn value(&mut self, parameter: Parameter) -> f64 {
        let (low, high) = parameter.range();
        match self.below(12) {
            0 => low,
            1 => high,
            2 | 3 => ParameterSet::default().get(parameter),
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
            *parameters.get_mut(parameter) = self.value(parameter);
        }
        let modes = 1 + self.below(MAX_MODES);
        let initial = (self.below(3) > 0).then(|| {
            let size = self.log_between(1e-6, 1e6);
            (0..state_dimension(modes)).map(|_| size * self.between(-1.0, 1.0)).collect()
        });
        let t_end = (3.0 * std::f64::consts::TAU / parameters.omega).clamp(1.0, 5.0);
        let model = ModelChoice { modes, force: self.force(), ..Default::default() };
        Scenario { parameters, model, initial, t_end, ..Default::default() }
    }
}

fn assert_finite(run: &Run, t_end: f64) {
    let trajectory = &run.trajectory;
    assert!(trajectory.end_time().is_finite() && trajectory.end_time() <= t_end * (1.0 + 1e-9));
    if let Some(time) = run.outcome().early_end() {
        assert!((0.0..=t_end * (1.0 + 1e-9)).contains(&time), "{time}");
    } else {
        assert!((trajectory.end_time() - t_end).abs() <= 1e-9 * t_end);
    }
    trajectory.sample(0.0, trajectory.end_time(), 7, |t, state| {
        assert!(state.iter().all(|value| value.is_finite()), "t = {t}: {state:?}");
    });
    assert!(run.strobe.iter().all(|point| point.v.is_finite() && point.dv_dt.is_finite()));
    if let Some(s) = run.summary {
        let Measures { v_rms, v_peak, tip: (low, high), .. } = s.measures;
        let numbers = [s.from, s.to, v_rms, v_peak, s.dv_dt_peak, low, high, s.v_peak_whole];
        assert!(numbers.iter().all(|value| value.is_finite()), "{s:?}");
        assert!(low <= high && v_rms <= v_peak * (1.0 + 1e-9) && s.from <= s.to, "{s:?}");
    }
}

/// Half of the ten thousand; in two tests, so that two cores share them.
fn assert_five_thousand_random_devices_end_well(seed: u64) {
    let mut random = Random::seeded(seed);
    let (mut completed, mut escaped, mut touched, mut refused, mut unresolved) = (0, 0, 0, 0, 0);
    for _ in 0..5_000 {
        let scenario = random.scenario();
        let Ok(result) = std::panic::catch_unwind(|| Run::compute(&scenario)) else { panic!("{scenario:?}") };
        match result {
            Ok(run) => {
                assert_finite(&run, scenario.t_end);
                match run.outcome() {
                    Outcome::Completed => completed += 1,
                    Outcome::Escaped { .. } => escaped += 1,
                    Outcome::Contact { .. } => touched += 1,
                }
            }
            Err(error) => {
                assert_one_line(&error.to_string());
                match error {
                    RunError::Model(_) => refused += 1,
                    RunError::Integration(_) => unresolved += 1,
                }
            }
        }
    }
    // The questions reach every kind of end; devices that exist have an answer, but for a few whose motion is too
    // fast to follow.
    let counts = [completed, escaped, touched, refused];
    assert!(counts.iter().all(|count| *count > 100), "{counts:?}");
    assert!(unresolved <= 5, "{unresolved} of 5,000");
}

#[test]
fn ten_thousand_random_devices_end_in_finite_numbers_or_in_one_line_first_half() {
    assert_five_thousand_random_devices_end_well(20_200_731);
}

#[test]
fn ten_thousand_random_devices_end_in_finite_numbers_or_in_one_line_second_half() {
    assert_five_thousand_random_devices_end_well(3_389);
}

fn assert_one_line(message: &str) {
    assert!(!message.trim().is_empty() && !message.contains('\n') && !message.contains("NaN"), "{message:?}");
}

/// Requests that are quick to answer, to be spoilt.
const REQUESTS: [&str; 5] = [
    r#"{"task":"modes","parameters":{"alpha":0.001,"c0":0.4,"d":0.2,"h":0.01,"eta":0.1},"model":{"modes":3,"force":"exact"}}"#,
    r#"{"task":"boundary","resonance":"sum","theory":"coupled","omega":[25.2,25.5],"parameters":{"kappa":1e-6}}"#,
    r#"{"task":"boundary","resonance":"first","theory":"published","omega":[8.1],"model":{"modes":2,"force":"quadratic"}}"#,
    r#"{"task":"simulate","t_end":2,"samples":3,"method":"adaptive","tolerance":1e-4,"initial":[0.01,0,0,0,1]}"#,
    r#"{"task":"simulate","t_end":2,"samples":3,"method":"rk4","steps_per_period":99,"parameters":{"omega":9,"beta":0.01,"theta":2e-4,"c":1e-6}}"#,
];

/// Whether a null, as which JSON writes NaN, hides anywhere but among the boundaries, where it means none.
fn hides_a_null(value: &Value) -> bool {
    match value {
        Value::Null => true,
        Value::Array(items) => items.iter().any(hides_a_null),
        Value::Object(fields) => fields.iter().any(|(name, value)| name != "beta" && hides_a_null(value)),
        _ => false,
    }
}

fn assert_answer_or_line(request: &str) {
    let Ok(result) = std::panic::catch_unwind(|| solve(request)) else { panic!("{request}") };
    match result {
        Ok(answer) => {
            let answer: Value = serde_json::from_str(&answer).expect("an answer is JSON");
            assert!(answer.is_object() && !hides_a_null(&answer), "{request}: {answer}");
        }
        Err(message) => assert_one_line(&message),
    }
}

/// Every field of a request, as a path.
fn paths(value: &Value) -> Vec<Vec<String>> {
    let Value::Object(fields) = value else { return vec![vec![]] };
    let below = |(name, value): (&String, &Value)| {
        let mut all = vec![vec![name.clone()]];
        if value.is_object() {
            all.extend(paths(value).into_iter().map(|path| [vec![name.clone()], path].concat()));
        }
        all
    };
    fields.iter().flat_map(below).collect()
}

#[test]
fn a_field_of_wrong_type_or_out_of_range_is_named() {
    // Right for no field at all.
    let wrong = [json!(-12345.5), json!(1e300), json!("loud"), json!(true), json!({"x": 1}), json!([[1]])];
    let mut checked = 0;
    for request in REQUESTS {
        let good: Value = serde_json::from_str(request).expect("JSON");
        assert!(solve(request).is_ok(), "{request}");
        for path in paths(&good) {
            for value in &wrong {
                let mut bad = good.clone();
                let mut place = &mut bad;
                for name in &path {
                    place = &mut place[name];
                }
                *place = value.clone();
                let name = path.last().expect("a path is not empty");
                let message = solve(&bad.to_string()).expect_err(&bad.to_string());
                assert_one_line(&message);
                // A wrong value deep in a field is reported at its own path, such as omega[0].
                assert!(message.contains(name.as_str()), "{bad}: {message}");
                checked += 1;
            }
        }
        let mut unknown = good;
        unknown["surprise"] = json!(1);
        assert!(solve(&unknown.to_string()).is_err_and(|message| message.contains("surprise")));
    }
    assert!(checked > 150, "{checked}");
}

#[test]
fn spoilt_and_random_text_gets_an_answer_or_one_line() {
    let mut random = Random::seeded(7);
    let signs = b"{}[]\",:0123456789.-+eEnulltrfas \\";
    for i in 0..4000 {
        let mut text = REQUESTS[random.below(REQUESTS.len())].as_bytes().to_vec();
        for _ in 0..1 + i % 3 {
            let place = random.below(text.len().max(1));
            if text.is_empty() {
                break;
            }
            match random.below(4) {
                0 => text[place] = signs[random.below(signs.len())],
                1 => drop(text.remove(place)),
                2 => text.truncate(place.max(1)),
                _ => text[place] = 32 + random.below(95) as u8,
            }
        }
        assert_answer_or_line(&String::from_utf8_lossy(&text));
    }
    for _ in 0..2000 {
        let length = random.below(60);
        let text: String = (0..length).map(|_| char::from(random.below(256) as u8)).collect();
        assert_answer_or_line(&text);
    }
    for text in
        ["null", "1e999", "\"modes\"", "{\"task\":null}", "{\"task\":\"modes\"} x", &"[".repeat(100_000)]
    {
        assert!(solve(text).is_err_and(|message| !message.contains('\n')), "{}", &text[..text.len().min(30)]);
    }
}
