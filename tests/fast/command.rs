//! The native command as a user runs it: requests on standard input, answers, messages and exit status.

use std::io::Write;
use std::process::{Command, Output, Stdio};

use serde_json::Value;

fn harvester(arguments: &[&str], request: &[u8]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_harvester"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut input = child.stdin.take().expect("piped");
    // A command that fails on its arguments does not read; that is no error here.
    let _ = input.write_all(request);
    drop(input);
    child.wait_with_output().expect("the command ends")
}

fn answer(request: &str) -> Value {
    let output = harvester(&[], request.as_bytes());
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{request}: {message}");
    assert!(message.is_empty(), "{message}");
    serde_json::from_slice(&output.stdout).expect("an answer is one JSON object")
}

/// The line that a bad request is answered with.
fn message(request: &[u8]) -> String {
    let output = harvester(&[], request);
    let message = String::from_utf8(output.stderr).expect("messages are text");
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(output.stdout.is_empty());
    assert_eq!(message.lines().count(), 1, "{message}");
    message.trim_end().to_owned()
}

fn close(value: &Value, reference: f64, tolerance: f64) -> bool {
    value.as_f64().is_some_and(|value| (value / reference - 1.0).abs() < tolerance)
}

#[test]
fn a_modes_request_gives_the_papers_device() {
    let modes = answer(r#"{"task":"modes","parameters":{"alpha":0.0001},"model":{"modes":4}}"#);
    // 40-digit arithmetic.
    assert!(close(&modes["A_e"], 0.019450341372524, 1e-12) && close(&modes["gap"], 0.169450341372524, 1e-13));
    for (name, reference) in [
        ("c", &[1.3450051225722, -19.378543266711, 223.38294552191, -2253.3500136038, 20784.085809382][..]),
        ("omega", &[4.04845139686289, 21.3562434253049, 59.6583720416340, 117.076204254911]),
        ("eta1", &[0.417268652823084, -0.235757431026728, 0.150622489847240, -0.113977721138080]),
        ("eta2", &[0.275163559332428, 0.300562648266401, 0.342470056839830, 0.385935832029205]),
        ("theta", &[2.66720397414344e-4, 1.01697006538490e-3, 1.77731528223104e-3, 2.63014911900199e-3]),
    ] {
        for (i, reference) in reference.iter().enumerate() {
            assert!(close(&modes[name][i], *reference, 1e-11), "{name}: {}", modes[name]);
        }
    }
    let two = answer(r#"{"task":"modes","parameters":{"alpha":1e-4}}"#);
    let eigenvalues = two["eigenvalues"].as_array().expect("a list");
    for (re, im) in [(-0.0078, 4.0783), (-0.0263, 21.4365)] {
        let near = |pair: &Value| {
            pair[0].as_f64().is_some_and(|x| (x - re).abs() < 6e-5)
                && pair[1].as_f64().is_some_and(|y| (y.abs() - im).abs() < 6e-5)
        };
        assert!(eigenvalues.iter().any(near), "{re} {im}: {eigenvalues:?}");
    }
}

#[test]
fn a_boundary_request_gives_both_theories() {
    let ask = |theory: &str, resonance: &str, omega: f64| {
        answer(&format!(
            r#"{{"task":"boundary","parameters":{{"alpha":1e-4}},"resonance":"{resonance}","theory":"{theory}","omega":[{omega}]}}"#
        ))["beta"][0]
            .clone()
    };
    assert!(close(&ask("coupled", "first", 8.1569), 0.000421323711331, 1e-9));
    assert!(close(&ask("coupled", "sum", 25.4047), 0.01157806432, 1e-9));
    assert!(close(&ask("coupled", "second", 42.8725), 0.0359373781403, 1e-9));
    assert!(close(&ask("published", "sum", 25.3047), 0.0037681965547, 1e-9));
}

#[test]
fn a_simulate_request_ends_in_the_state_of_figure_3() {
    let t_end = 23_952_818.0 * std::f64::consts::TAU / 250_000.0;
    let request = format!(r#"{{"task":"simulate","t_end":{t_end:?},"samples":3}}"#);
    let run = answer(&request);
    let reference = [-1.521630082e-3, 2.841270618e-3, 7.724208224e-3, -1.957999388e-2, 2.449883949];
    assert_eq!(run["outcome"], "completed");
    for (i, reference) in reference.iter().enumerate() {
        let value = run["state"][2][i].as_f64().unwrap_or(f64::NAN);
        assert!((value - reference).abs() < 1e-9, "{i}: {value}");
    }
    assert_eq!(run["t"].as_array().map(Vec::len), Some(3));
}

#[test]
fn a_simulate_request_reports_escape_as_a_result() {
    let request =
        r#"{"task":"simulate","parameters":{"alpha":1e-4,"beta":0.01,"omega":42.71248685},"t_end":600}"#;
    let run = answer(request);
    assert_eq!(run["outcome"], "escaped");
    assert!(run["t_outcome"].as_f64().is_some_and(|t| (1.1..1.25).contains(&t)), "{}", run["t_outcome"]);
    let exact = answer(&request.replace("\"t_end\"", "\"model\":{\"force\":\"exact\"},\"t_end\""));
    assert_eq!(exact["outcome"], "completed");
}

#[test]
fn a_bad_request_gets_status_2_and_one_line_that_names_the_field() {
    for (request, parts) in [
        (r#"{"task":"modes","parameters":{"beta":3}}"#, &["beta", "3", "0 to 0.2"][..]),
        (r#"{"task":"modes","parameters":{"omega":0.01}}"#, &["omega", "0.01", "0.1 to 500"]),
        (r#"{"task":"modes","parameters":{"omega":"fast"}}"#, &["parameters.omega", "fast", "0.1 to 500"]),
        (r#"{"task":"modes","parameters":{"gamma":1}}"#, &["gamma"]),
        (r#"{"task":"modes","model":{"modes":9}}"#, &["modes", "9", "1 to 8"]),
        (r#"{"task":"modes","model":{"force":{"taylor":1}}}"#, &["taylor", "1", "2 to 15"]),
        (r#"{"task":"modes","model":{"force":"cubic"}}"#, &["model.force", "cubic", "quadratic", "exact"]),
        (r#"{"task":"dance"}"#, &["task", "dance", "modes", "boundary", "simulate"]),
        (r#"{}"#, &["task", "modes"]),
        (r#"[1,2]"#, &["must be an object"]),
        (r#"{"task":"modes""#, &["not valid JSON"]),
        ("", &["not valid JSON"]),
        (r#"{"task":"simulate","t_end":-1}"#, &["t_end", "-1"]),
        (r#"{"task":"simulate","samples":1}"#, &["samples", "1", "2 to 200000"]),
        (r#"{"task":"simulate","tolerance":1}"#, &["tolerance", "1", "0.01"]),
        (r#"{"task":"simulate","initial":[0,0]}"#, &["initial", "5", "2 numbers"]),
        (r#"{"task":"simulate","method":"euler"}"#, &["method", "euler", "rk4", "adaptive"]),
        (r#"{"task":"boundary","theory":"coupled","omega":[25]}"#, &["resonance"]),
        (
            r#"{"task":"boundary","resonance":"sum","theory":"coupled","omega":[25,600]}"#,
            &["omega", "600", "0.1 to 500"],
        ),
        (r#"{"task":"modes","parameters":{"c0":-10}}"#, &["pull-in", "c0 = -10", "gap"]),
        (r#"{"task":"orbit","guess":[0,0]}"#, &["guess", "5 numbers", "2"]),
        (r#"{"task":"orbit","periods":65}"#, &["periods", "65", "1 to 64"]),
        (
            r#"{"task":"boundary","resonance":"sum","theory":"floquet","omega":[25],"limit":1}"#,
            &["limit", "1", "1e-6 to 0.2"],
        ),
        (
            r#"{"task":"boundary","resonance":"sum","theory":"floquet","omega":[25],"model":{"modes":1}}"#,
            &["two modes", "1"],
        ),
        (r#"{"task":"chart","beta":{"from":0,"to":0.01},"quantity":"power"}"#, &["omega", "missing"]),
        (
            r#"{"task":"chart","omega":8,"beta":{"from":0,"to":0.01},"quantity":"power"}"#,
            &["omega", "8", "from", "to", "count"],
        ),
        (
            r#"{"task":"chart","omega":{"from":8,"to":"nine"},"beta":{"from":0,"to":0.01},"quantity":"power"}"#,
            &["omega.to", "nine", "0.1 to 500"],
        ),
        (
            r#"{"task":"chart","omega":{"from":8,"to":9},"beta":{"from":0,"to":1},"quantity":"power"}"#,
            &["beta.to", "1", "0 to 0.2"],
        ),
        (
            r#"{"task":"chart","omega":{"from":8,"to":9,"count":2000},"beta":{"from":0,"to":0.1},"quantity":"motion"}"#,
            &["omega.count", "2000", "2 to 512"],
        ),
        (
            r#"{"task":"chart","omega":{"from":8,"to":9},"beta":{"from":0,"to":0.1},"quantity":"colour"}"#,
            &["quantity", "colour", "multiplier", "v_rms"],
        ),
        (r#"{"task":"sweep","parameter":"omega","from":9,"to":8}"#, &["omega.to", "8", "9 to 500"]),
        (
            r#"{"task":"sweep","parameter":"omega","from":8,"to":9,"count":2000,"kept":1000}"#,
            &["count times kept", "2000000", "200000"],
        ),
        (r#"{"task":"sweep","parameter":"omega","from":8,"to":9,"transient":9999}"#, &["transient", "5000"]),
        (r#"{"task":"continue","parameter":"omega","from":9,"to":9}"#, &["omega.to", "9 must be above"]),
        (
            r#"{"task":"continue","parameter":"omega","from":9,"to":10,"doublings":7}"#,
            &["doublings", "0 to 6"],
        ),
        (
            r#"{"task":"continue","parameter":"omega","from":9,"to":10,"guess":[0,0,0,0,0]}"#,
            &["omega = 25", "9 to 10"],
        ),
        (
            r#"{"task":"continue","parameter":"omega","from":9,"to":30,"guess":[0],"initial":[0,0,0,0,0]}"#,
            &["guess", "initial"],
        ),
        (
            r#"{"task":"continue","parameter":"omega","from":9,"to":30,"guess":[0]}"#,
            &["guess", "5 numbers", "1"],
        ),
        (
            r#"{"task":"continue","parameter":"omega","from":8,"to":30,"parameters":{"alpha":1e-4,"beta":0.01,"omega":25.4047},"initial":[0,0,0,0,0]}"#,
            &["initial", "no periodic motion", "quasiperiodic"],
        ),
        (
            r#"{"task":"curves","x":{"parameter":"omega","from":9,"to":8},"y":{"parameter":"beta","from":0,"to":0.1}}"#,
            &["x.to", "8", "9 to 500"],
        ),
        (
            r#"{"task":"curves","x":{"parameter":"omega","from":8,"to":9},"y":{"parameter":"omega","from":8,"to":9}}"#,
            &["omega", "differ"],
        ),
        (
            r#"{"task":"curves","x":{"parameter":"gamma","from":8,"to":9}}"#,
            &["x.parameter", "`gamma`", "`omega`"],
        ),
        (r#"{"task":"verdict","t_end":1e6}"#, &["t_end", "1000000", "1 to 5000"]),
        (r#"{"task":"verdict","initial":[0]}"#, &["initial", "5 numbers", "1"]),
        (r#"{"task":"basin","count":1}"#, &["count", "1", "2 to 512"]),
        (
            r#"{"task":"basin","x":{"component":"q3","from":0,"to":1}}"#,
            &["x.component", "q3", "q1, q2, dq1/dt, dq2/dt, v"],
        ),
        (r#"{"task":"basin","x":{"component":"dq1/dt","from":0,"to":1}}"#, &["dq1/dt", "differ"]),
        (r#"{"task":"basin","y":{"component":"q2","from":0,"to":11}}"#, &["y.to", "11", "0 to 10"]),
    ] {
        let message = message(request.as_bytes());
        for part in parts {
            assert!(message.contains(part), "{request}: `{message}` lacks `{part}`");
        }
    }
}

#[test]
fn input_that_is_no_text_is_refused_and_arguments_are_explained() {
    assert!(message(b"\xfc\xfd").contains("not UTF-8"));
    assert!(message(b"\xff\xfe{\0}\0").contains("UTF-16"));
    let marked = harvester(&[], b"\xef\xbb\xbf{\"task\":\"modes\"}");
    assert_eq!(marked.status.code(), Some(0));
    for (argument, start) in [("--help", "usage: harvester"), ("--version", "harvester 0.")] {
        let output = harvester(&[argument], b"");
        assert_eq!(output.status.code(), Some(0));
        assert!(String::from_utf8_lossy(&output.stdout).starts_with(start));
    }
    let help = String::from_utf8_lossy(&harvester(&["--help"], b"").stdout).into_owned();
    let tasks = help.lines().find_map(|line| line.strip_prefix("Tasks: ")).expect("the tasks");
    let names =
        harvester_lab::questions::list::TASKS.iter().map(|task| task.name).collect::<Vec<_>>().join(", ");
    assert_eq!(tasks.trim_end_matches('.'), names);
    let output = harvester(&["--fast"], b"");
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(message.contains("--fast") && message.contains("usage: harvester"), "{message}");
}

#[test]
fn every_example_of_the_readme_has_an_answer() {
    let readme = include_str!("../../README.md");
    let after = |line: &'static str| line.strip_prefix("echo '")?.split_once("' | target/release/harvester");
    let requests: Vec<&str> = readme.lines().filter_map(after).map(|(request, _)| request).collect();
    for task in [
        "modes",
        "boundary",
        "simulate",
        "orbit",
        "chart",
        "sweep",
        "continue",
        "curves",
        "verdict",
        "basin",
        "harvest",
        "find",
        "shake",
        "tolerances",
        "fit",
    ] {
        let asks = |request: &&&str| request.contains(&format!("\"task\":\"{task}\""));
        assert!(requests.iter().any(|request| asks(&request)), "the README has no example of {task}");
    }
    for request in requests {
        let asked: Value = serde_json::from_str(request).expect("an example is JSON");
        let given = answer(request);
        match asked["task"].as_str() {
            Some("modes") => assert!(close(&given["gap"], 0.169450341372524, 1e-13)),
            Some("boundary") => {
                // One number for each frequency asked; the reference ones where the example uses them.
                let omegas = asked["omega"].as_array().expect("a list");
                assert_eq!(given["beta"].as_array().map(Vec::len), Some(omegas.len()));
                for (omega, beta) in [(25.3047, 0.0204995442183), (25.4047, 0.01157806432)] {
                    if let Some(i) = omegas.iter().position(|value| value.as_f64() == Some(omega)) {
                        assert!(close(&given["beta"][i], beta, 1e-9), "{given}");
                    }
                }
            }
            Some("simulate") => {
                let rows = given["state"].as_array().map(Vec::len);
                assert_eq!(given["outcome"], "completed");
                assert_eq!(rows.map(|rows| rows as u64), asked["samples"].as_u64());
            }
            Some("orbit") => assert_eq!(given["instability"], "period_doubling"),
            Some("chart") => {
                let size = |field: &str| asked[field]["count"].as_u64().unwrap_or_default() as usize;
                assert_eq!(given["values"].as_array().map(Vec::len), Some(size("beta")));
                assert_eq!(given["values"][0].as_array().map(Vec::len), Some(size("omega")));
                assert!(given["values"].to_string().contains("period 2"));
            }
            Some("sweep") => {
                assert_eq!(
                    given["points"].as_array().map(|points| points.len() as u64),
                    asked["count"].as_u64()
                );
            }
            Some("continue") => {
                // An independent program's boundary: 0.001628 at this frequency.
                let found = &given["branches"][0]["bifurcations"][0];
                assert!(close(&found["beta"], 0.001628, 3e-4), "{found}");
                assert_eq!(
                    (&found["kind"], &found["criticality"]),
                    (&"period_doubling".into(), &"subcritical".into())
                );
            }
            Some("curves") => {
                let special = &given["curves"][0]["special"][0];
                assert_eq!(special["kind"], "generalized_period_doubling");
                assert!(close(&special["at"][0], 8.156415, 1e-6), "{special}");
            }
            Some("verdict") => assert_eq!(given["motion"]["kind"], "quasiperiodic"),
            Some("basin") => {
                assert_eq!(given["cells"].as_array().map(|rows| rows.len() as u64), asked["count"].as_u64());
            }
            Some("harvest") => {
                let shaken = given["acceleration"].as_f64().zip(asked["acceleration"].as_f64());
                assert!(shaken.is_some_and(|(given, asked)| (given / asked - 1.0).abs() < 1e-12));
                assert!(given["reached"]["harvest"]["defect"].as_f64().is_some_and(|defect| defect < 1e-8));
            }
            Some("find") => {
                let generations = given["history"].as_array().map(|history| history.len() as u64);
                // The local search at the end takes 16 rounds.
                assert_eq!(generations, asked["generations"].as_u64().map(|count| count + 16));
                assert_eq!(given["evaluation"]["violation"], 0.0);
            }
            Some("shake") => {
                assert_eq!(
                    (&given["outcome"], &given["completed"]),
                    (&"completed".into(), &asked["realisations"])
                );
                let (times, volts) = (given["time"].as_array(), given["voltage"].as_array());
                assert_eq!(times.map(Vec::len), volts.map(Vec::len));
                assert!(given["gain"].as_f64().is_some_and(|gain| gain > 0.0), "{given}");
            }
            Some("tolerances") => {
                let shares = ["lasting", "safe"].map(|share| given["yield"][share].as_f64().unwrap_or(-1.0));
                assert!(shares.iter().all(|share| (0.0..=1.0).contains(share)), "{given}");
            }
            Some("fit") => {
                assert_eq!(given["fitted"].as_array().map(Vec::len), asked["free"].as_array().map(Vec::len));
                let left = [0, 1].map(|at| given["left"][at].as_f64().unwrap_or(f64::NAN));
                assert!(given["converged"] == true && left[1] < 0.1 * left[0], "{given}");
            }
            other => panic!("{other:?}"),
        }
    }
}
