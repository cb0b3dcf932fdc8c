//! The native command over many requests: as a user runs it on one machine or on a cluster.

use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use harvester_lab::questions::solve;
use serde_json::Value;

fn batch(requests: &[u8]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_harvester"))
        .arg("--batch")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut input = child.stdin.take().expect("piped");
    let requests = requests.to_vec();
    let writer = std::thread::spawn(move || input.write_all(&requests));
    let output = child.wait_with_output().expect("the command ends");
    writer.join().expect("the writer ends").expect("everything is read");
    output
}

#[test]
fn lines_are_answered_in_order_and_bad_ones_too() {
    // Long and short work by turns, so that order is not kept by chance.
    let request = |i: usize| match i % 5 {
        0 => r#"{"task":"verdict","parameters":{"alpha":1e-4,"beta":0.01,"omega":8.0969}}"#.to_owned(),
        1 => format!(r#"{{"task":"orbit","parameters":{{"omega":{}}}}}"#, 25.0 + 1e-3 * i as f64),
        2 => r#"{"task":"modes","parameters":{"beta":3}}"#.to_owned(),
        3 => "{".to_owned(),
        _ => format!(r#"{{"task":"modes","parameters":{{"eta":{}}}}}"#, 1e-3 * i as f64),
    };
    let lines: Vec<String> = (0..60).map(request).collect();
    let output = batch(lines.join("\n").as_bytes());
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    let answers = String::from_utf8(output.stdout).expect("answers are text");
    assert_eq!(answers.lines().count(), lines.len());
    for (line, answer) in lines.iter().zip(answers.lines()) {
        match solve(line) {
            Ok(alone) => assert_eq!(answer, alone, "{line}"),
            Err(message) => {
                let answer: Value = serde_json::from_str(answer).expect("a bad line has a JSON answer");
                assert_eq!(answer, serde_json::json!({ "error": message }), "{line}");
            }
        }
    }
}

#[test]
fn an_empty_batch_is_answered_and_a_closed_pipe_ends_it_quietly() {
    let output = batch(b"");
    assert_eq!((output.status.code(), output.stdout.len()), (Some(0), 0));
    // `head` takes one line and leaves.
    let command = format!(
        r#"yes '{{"task":"modes"}}' | head -n 5000 | {} --batch | head -n 1"#,
        env!("CARGO_BIN_EXE_harvester")
    );
    let output = Command::new("sh").args(["-c", &command]).output().expect("a shell");
    assert!(output.stdout.starts_with(b"{\"A_e\"") && output.stderr.is_empty());
    let output = Command::new(env!("CARGO_BIN_EXE_harvester"))
        .arg("--batch")
        .stdin(std::fs::File::open(env!("CARGO_MANIFEST_DIR")).expect("the folder opens"))
        .output()
        .expect("the command ends");
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("cannot be read"));
}

/// The README's example, as it is printed, on this machine.
#[test]
fn the_example_of_the_readme_splits_runs_and_joins() {
    let readme = include_str!("../../README.md");
    let blocks = readme.split("```sh\n").skip(1).filter_map(|rest| rest.split("```").next());
    let script: String =
        blocks.filter(|block| block.contains("--batch") && block.contains("split")).collect();
    assert!(script.contains("target/release/harvester"), "{script}");
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("batch-example");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    let script = script.replace("target/release/harvester", env!("CARGO_BIN_EXE_harvester"));
    let output = Command::new("sh").args(["-euc", &script]).current_dir(&folder).output().expect("a shell");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).expect("the example writes it");
    let (requests, answers) = (read("requests.jsonl"), read("answers.jsonl"));
    let asked: Vec<&str> = requests.lines().collect();
    assert!(asked.len() >= 40);
    assert_eq!(answers.lines().count(), asked.len());
    let mut doubled = 0;
    for (i, (request, answer)) in asked.iter().zip(answers.lines()).enumerate() {
        let given: Value = serde_json::from_str(answer).expect("JSON");
        assert!(given["sentence"].is_string(), "{request}: {answer}");
        doubled += usize::from(given["motion"]["periods"] == 2);
        if i % 7 == 0 {
            assert_eq!(solve(request).as_deref(), Ok(answer), "{request}");
        }
    }
    // The tongue at twice the first natural frequency.
    assert!((10..asked.len()).contains(&doubled), "{doubled}");
}
