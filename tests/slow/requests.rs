//! Requests as people and their tools write them, good and bad, to every task.

use harvester_lab::model::STANDARD_GRAVITY;
use harvester_lab::questions::list::TASKS;
use harvester_lab::questions::solve;
use serde_json::{Map, Value, json};

/// A request that every task answers, or refuses for what is in it.
fn smallest(task: &str) -> Map<String, Value> {
    let further = match task {
        "boundary" => json!({"resonance": "sum", "theory": "coupled", "omega": [25.4]}),
        "chart" => json!({
            "omega": {"from": 8, "to": 9, "count": 2}, "beta": {"from": 0, "to": 0.001, "count": 2},
            "quantity": "multiplier",
        }),
        "sweep" => json!({"parameter": "omega", "from": 24, "to": 25, "count": 2, "transient": 5, "kept": 1}),
        "continue" => json!({"parameter": "omega", "from": 24, "to": 24.1}),
        "curves" => json!({
            "x": {"parameter": "omega", "from": 24, "to": 24.1}, "y": {"parameter": "beta", "from": 0, "to": 0.001},
            "lines": 1,
        }),
        "simulate" => json!({"t_end": 1}),
        "basin" => json!({"count": 2}),
        "load" => json!({"from": 1e6, "to": 1e7, "per_decade": 1}),
        "fit" => json!({"data": [[2.7, 1.0], [2.8, 2.0], [2.9, 1.5]]}),
        "find" => json!({"variables": [{"name": "resistance", "from": 1e6, "to": 1e7}], "generations": 1}),
        "map" => json!({
            "x": {"name": "frequency", "from": 8, "to": 9, "count": 2},
            "y": {"name": "resistance", "from": 1e6, "to": 1e7, "count": 2},
        }),
        "shake" => json!({
            "excitation": {"kind": "chirp", "from": 1, "to": 2, "duration": 2, "acceleration": 0.001},
        }),
        _ => json!({}),
    };
    let Value::Object(mut fields) = further else { panic!("an object") };
    fields.insert("task".to_owned(), Value::from(task));
    fields
}

fn refused(request: &str) -> String {
    let message = solve(request).expect_err("a bad request");
    assert_eq!(message.lines().count(), 1, "{message}");
    for word in
        ["f64", "usize", "u32", "u64", "struct", "enum", "variant", "tuple", "invalid type", "at line"]
    {
        assert!(!message.contains(word), "{message}");
    }
    message
}

#[test]
fn errors_of_all_tasks_speak_plainly_and_repeat_little() {
    let megabyte = "y".repeat(1 << 20);
    for task in TASKS.iter().map(|task| task.name) {
        let with = |name: &str, value: Value| {
            let mut fields = smallest(task);
            fields.insert(name.to_owned(), value);
            Value::Object(fields).to_string()
        };
        let mut requests = vec![
            (
                with("parameters", json!({"omega": "fast"})),
                vec!["parameters.omega", "\"fast\"", "a number", "0.1 to 500"],
            ),
            (with("parameters", json!({"omega": null})), vec!["parameters.omega", "null", "a number"]),
            (with("parameters", json!({"omega": [1]})), vec!["parameters.omega", "a list", "a number"]),
            (with("parameters", json!(3)), vec!["parameters", "an object in braces"]),
            (
                with("parameters", json!({"gamma": 3})),
                vec!["parameters.gamma", "unknown field `gamma`", "`alpha`"],
            ),
            (with("model", json!({"modes": -1})), vec!["model.modes", "-1", "a whole number"]),
            (with("model", json!({"modes": 2.5})), vec!["model.modes", "2.5", "a whole number"]),
            (with("model", json!({"modes": 1e300})), vec!["model.modes", "e+300", "a whole number"]),
            (with("model", json!({"force": "cubic"})), vec!["model.force", "`cubic`", "`exact`"]),
            (
                with("model", json!({"force": {"taylor": "x"}})),
                vec!["model.force", "\"x\"", "a whole number"],
            ),
            (with("device", json!({"beam_length": true})), vec!["device.beam_length", "true", "a number"]),
            (with("scaling", json!("mine")), vec!["scaling", "`mine`", "`consistent`"]),
            (with("acceleration", json!("1 g")), vec!["acceleration", "\"1 g\"", "a number"]),
            (with("colour", json!(1)), vec!["colour", "unknown field `colour`"]),
            (with(&megabyte, json!(1)), vec!["yyy", "…", "1048576 characters"]),
            (with("parameters", json!({megabyte.clone(): 1})), vec!["parameters.yyy", "…"]),
            (with("parameters", json!({"omega": megabyte})), vec!["parameters.omega", "1048576 characters"]),
            (with("device", json!({"ceramic": megabyte})), vec!["device.ceramic", "1048576 characters"]),
            (with("colour", json!(megabyte)), vec!["colour", "1048576 characters"]),
        ];
        for (field, value) in [
            ("t_end", json!("long")),
            ("initial", json!({})),
            ("count", json!("x")),
            ("omega", json!({"from": []})),
        ] {
            requests.push((with(field, value), vec![]));
        }
        for (request, parts) in requests {
            let message = refused(&request);
            assert!(message.chars().count() < 1000, "{message}");
            assert!(!message.contains(&megabyte[..80]), "{message}");
            for part in parts {
                assert!(
                    message.contains(part),
                    "{}: {message} lacks {part}",
                    &request[..request.len().min(200)]
                );
            }
        }
    }
    for request in [format!("{{\"task\":\"{megabyte}\"}}"), megabyte.clone(), format!("[\"{megabyte}\"]")] {
        let message = refused(&request);
        assert!(message.chars().count() < 500, "{message}");
    }
    assert!(refused("{\"task\":\"a\\nb\"}").contains("is not available"));
    let message = refused(r#"{"task":"find","variables":[{"name":"a\nb","from":1,"to":2}]}"#);
    assert!(message.contains("variables"), "{message}");
}

#[test]
fn a_name_given_twice_is_refused_with_its_path() {
    for task in TASKS.iter().map(|task| task.name) {
        let fields = Value::Object(smallest(task)).to_string();
        let twice = |more: &str| refused(&format!("{},{more}}}", fields.trim_end_matches('}')));
        // What ends in more than one brace is closed again by what is added.
        let open = fields.len() - fields.trim_end_matches('}').len();
        if open == 1 {
            assert!(
                twice(r#""parameters":{"beta":0.001,"beta":0.002}"#)
                    .contains("parameters.beta is given twice")
            );
            assert!(twice(r#""model":{},"model":{}"#).contains("model is given twice"));
        }
        assert!(
            refused(&fields.replacen('{', &format!(r#"{{"task":"{task}","#), 1))
                .contains("task is given twice")
        );
    }
}

#[test]
fn a_mark_of_the_byte_order_is_no_part_of_a_request() {
    let request = r#"{"task":"modes"}"#;
    assert_eq!(solve(&format!("\u{feff}{request}\r\n")), solve(request));
}

#[test]
fn every_task_takes_a_device_in_si_units() {
    let device = json!({"beam_length": 0.3, "resistance": 1e6, "frequency": 3.0});
    let numbers = |task: &str, fields: Value| {
        let mut request = smallest(task);
        request.extend(fields.as_object().expect("fields").clone());
        solve(&Value::Object(request).to_string())
    };
    // Its ten numbers, from a task that answers them.
    let fields = json!({"device": device, "scaling": "consistent", "acceleration": 0.02});
    let found = numbers("find", fields.clone()).expect("an answer");
    let found: Value = serde_json::from_str(&found).expect("JSON");
    let mut same = found["parameters"].clone();
    // The search changes the load only.
    let bench = numbers("harvest", fields.clone()).expect("an answer");
    let bench: Value = serde_json::from_str(&bench).expect("JSON");
    same["kappa"] = Value::Null;
    let units = {
        let device: harvester_lab::model::Device = serde_json::from_value(device).expect("a device");
        device.dimensionless(harvester_lab::model::ElectricalScaling::Consistent).expect("a device")
    };
    same["kappa"] = Value::from(units.kappa);
    assert!((bench["acceleration"].as_f64().unwrap_or_default() / 0.02 - 1.0).abs() < 1e-12, "{bench}");
    for task in ["modes", "boundary", "simulate", "orbit", "chart", "sweep", "continue", "curves", "basin"] {
        let by_device = numbers(task, fields.clone()).expect(task);
        let by_numbers = numbers(task, json!({"parameters": same})).expect(task);
        // A device is turned into numbers with rounding in the last digit; what it is in SI units is said of it alone.
        let mut of_device = read(&by_device);
        if let Some(answer) = of_device.as_object_mut() {
            answer.remove("device");
        }
        assert!(agree(&of_device, &read(&by_numbers)), "{task}: {by_device} {by_numbers}");
    }
    assert!(
        numbers("modes", json!({"device": {"beam_length": -1}}))
            .is_err_and(|why| why.contains("beam_length"))
    );
    assert!(numbers("modes", json!({"acceleration": -1})).is_err_and(|why| why.contains("acceleration")));
    assert!(numbers("modes", json!({"scaling": "other"})).is_err_and(|why| why.contains("consistent")));
}

fn read(json: &str) -> Value {
    serde_json::from_str(json).expect("JSON")
}

fn agree(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().unwrap_or(f64::NAN), b.as_f64().unwrap_or(f64::NAN));
            (a - b).abs() <= 1e-9 + 1e-7 * b.abs()
        }
        (Value::Array(a), Value::Array(b)) => a.len() == b.len() && a.iter().zip(b).all(|(a, b)| agree(a, b)),
        (Value::Object(a), Value::Object(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|((k, a), (l, b))| k == l && agree(a, b))
        }
        (a, b) => a == b,
    }
}

#[test]
fn acceleration_is_a_peak_in_units_of_one_standard_gravity() {
    // The paper prints g rounded.
    let paper = harvester_lab::model::Device::default();
    assert!((paper.gravity - STANDARD_GRAVITY).abs() <= 0.5e-4 + 1e-12);
    let answer =
        solve(r#"{"task":"harvest","device":{"frequency":3.0,"base_amplitude":1e-4}}"#).expect("an answer");
    let answer: Value = serde_json::from_str(&answer).expect("JSON");
    let peak = 1e-4 * (std::f64::consts::TAU * 3.0).powi(2) / 9.80665;
    let given = answer["acceleration"].as_f64().unwrap_or_default();
    assert!((given / peak - 1.0).abs() < 1e-9, "{given} {peak}");
    assert_eq!(answer["acceleration_unit"], "peak g of 9.80665 m/s^2");
}

fn answer(request: &str) -> Value {
    read(&solve(request).unwrap_or_else(|message| panic!("{request}: {message}")))
}

#[test]
fn a_spent_budget_leaves_out_what_was_not_begun_and_says_so() {
    let request = r#"{"task":"chart","quantity":"motion","omega":{"from":8,"to":9,"count":40},"beta":{"from":0,"to":0.01,"count":40},"budget":0.05}"#;
    let chart = answer(request);
    let cells: Vec<&Value> =
        chart["values"].as_array().into_iter().flatten().flat_map(|row| row.as_array()).flatten().collect();
    assert_eq!(cells.len(), 1600);
    assert!(cells.iter().any(|cell| cell.is_null()), "all was computed");
    assert!(chart["missing"].as_str().is_some_and(|why| why.contains("0.05 s")), "{}", chart["missing"]);
    let run = answer(r#"{"task":"simulate","method":"rk4","t_end":20000,"samples":5,"budget":0.05}"#);
    assert_eq!((&run["outcome"], run["missing"].is_string()), (&json!("unfinished"), true));
    assert!(run["t_outcome"].as_f64().is_some_and(|t| t > 0.0 && t < 20_000.0), "{run}");
    assert_eq!(run["t"].as_array().and_then(|times| times.last()), Some(&run["t_outcome"]));
    // Each task says something within the least budget, and all of it within the usual one.
    for task in TASKS.iter().map(|task| task.name) {
        let mut fields = smallest(task);
        fields.insert("budget".to_owned(), json!(0.001));
        let short = solve(&Value::Object(fields.clone()).to_string());
        assert!(
            short.is_ok() || short.as_ref().is_err_and(|why| why.contains("no candidate")),
            "{task}: {short:?}"
        );
    }
    assert!(refused(r#"{"task":"modes","budget":0}"#).contains("budget = 0 is out of range"));
    assert!(refused(r#"{"task":"modes","budget":"long"}"#).contains("budget: \"long\""));
    assert!(answer(r#"{"task":"modes","budget":5}"#).get("missing").is_none());
}

#[test]
fn numbers_too_small_to_matter_count_as_zero_and_take_no_time() {
    let begin = std::time::Instant::now();
    let ask = |beta: &str| {
        answer(&format!(
            r#"{{"task":"verdict","parameters":{{"kappa":0.01,"beta":{beta},"alpha":1.4e-4,"omega":8.0969}},"t_end":1}}"#
        ))
    };
    assert_eq!(ask("5e-324"), ask("0"));
    assert!(begin.elapsed().as_secs() < 10, "{:?}", begin.elapsed());
}

#[test]
fn branches_that_would_take_minutes_are_left_and_said_to_be() {
    let load = answer(
        r#"{"task":"load","parameters":{"c":0.01,"kappa":0.01,"beta":0.2,"alpha":0.00162,"omega":25.4047},"from":1e6,"to":1e7,"per_decade":1,"t_end":20,"window":{"from":0.0438,"to":64.99},"hold":"amplitude","model":{"modes":1,"force":"exact"},"acceleration":5.33,"scaling":"consistent"}"#,
    );
    let best = load["best_frequency"].as_array().expect("two loads");
    assert!(best.len() == 2 && best.iter().all(|best| best["cut"] == true), "{load}");
    assert!(load["missing"].as_str().is_some_and(|why| why.starts_with("under 2 of 2 loads")), "{load}");
    // Usual ones are followed to their ends.
    let load = answer(r#"{"task":"load","from":1e6,"to":1e7,"per_decade":1,"window":{"from":2.5,"to":3.1}}"#);
    assert!(load.get("missing").is_none() && load["best_frequency"][0]["cut"] == false, "{load}");
}

#[test]
fn steps_too_long_for_their_method_are_an_outcome_of_their_own() {
    // Ten steps a period at omega = 25: the eighth mode turns by 14 radians in each, far beyond the 2 sqrt(2) that the
    // method bears.
    let request = r#"{"task":"simulate","method":"rk4","steps_per_period":10,"model":{"modes":8},"t_end":50,"samples":500}"#;
    let run = answer(request);
    assert_eq!(run["outcome"], "unstable_steps");
    assert!(run["t_outcome"].as_f64().is_some_and(|t| t > 0.0 && t < 1.0), "{run}");
    assert!(!run.to_string().contains("null"), "{run}");
    let states = run["state"].as_array().expect("a list");
    assert!(!states.is_empty() && states.len() == run["t"].as_array().map_or(0, Vec::len), "{run}");
    // With steps short enough there is no such thing, and a true escape stays one.
    let run = answer(&request.replace(r#""steps_per_period":10"#, r#""steps_per_period":1000"#));
    assert_eq!(run["outcome"], "completed");
    let escape = r#"{"task":"simulate","method":"rk4","parameters":{"alpha":1e-4,"beta":0.01,"omega":42.71248685},"t_end":5}"#;
    assert_eq!(answer(escape)["outcome"], "escaped");
}
