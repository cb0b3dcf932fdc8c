//! Requests as people and their tools write them, good and bad, to every task.

use harvester_lab::jobs::solve;
use harvester_lab::model::STANDARD_GRAVITY;
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
        "simulate" => json!({"t_end": 1}),
        "basin" => json!({"count": 2}),
        "load" => json!({"from": 1e6, "to": 1e7, "per_decade": 1}),
        "find" => json!({"variables": [{"name": "resistance", "from": 1e6, "to": 1e7}], "generations": 1}),
        "map" => json!({
            "x": {"name": "frequency", "from": 8, "to": 9, "count": 2},
            "y": {"name": "resistance", "from": 1e6, "to": 1e7, "count": 2},
        }),
        _ => json!({}),
    };
    let Value::Object(mut fields) = further else { panic!("an object") };
    fields.insert("task".to_owned(), Value::from(task));
    fields
}

const TASKS: [&str; 15] = [
    "modes",
    "boundary",
    "simulate",
    "orbit",
    "chart",
    "sweep",
    "verdict",
    "basin",
    "harvest",
    "load",
    "materials",
    "limits",
    "trust",
    "find",
    "map",
];

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
    for task in TASKS {
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
    for task in TASKS {
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
    for task in ["modes", "boundary", "simulate", "orbit", "chart", "sweep", "basin"] {
        let by_device = numbers(task, fields.clone()).expect(task);
        let by_numbers = numbers(task, json!({"parameters": same})).expect(task);
        // A device is turned into numbers with rounding in the last digit.
        assert!(agree(&read(&by_device), &read(&by_numbers)), "{task}: {by_device} {by_numbers}");
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
