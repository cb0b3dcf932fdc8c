//! The native command: one JSON request on standard input, one JSON answer on standard output.
//!
//! Exit status 0 with an answer; 2 with one line on standard error when the request is not good.

use std::io::{Read, Write};
use std::process::ExitCode;

use harvester_lab::jobs::solve;

const USAGE: &str = "usage: harvester < request.json > answer.json

One JSON request on standard input, one JSON answer on standard output, for example
  echo '{\"task\":\"modes\"}' | harvester
Tasks: modes, boundary, simulate. The README describes their fields.";

fn main() -> ExitCode {
    if std::env::args().len() > 1 {
        return say_and_fail(USAGE);
    }
    let mut request = String::new();
    if let Err(error) = std::io::stdin().read_to_string(&mut request) {
        return say_and_fail(&format!("the request cannot be read: {error}"));
    }
    match solve(&request) {
        Ok(answer) => match writeln!(std::io::stdout(), "{answer}") {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => say_and_fail(&format!("the answer cannot be written: {error}")),
        },
        Err(message) => say_and_fail(&message),
    }
}

fn say_and_fail(message: &str) -> ExitCode {
    eprintln!("{message}");
    ExitCode::from(2)
}
