//! The native command: JSON requests on standard input, JSON answers on standard output.
//!
//! Exit status 0 with an answer, or a line for each line of a batch; 2 with one line on standard error when the input
//! is not good.

use std::io::{self, BufWriter, ErrorKind, Read, Write};
use std::process::ExitCode;

use harvester_lab::jobs::batch::{BatchError, answer_lines};
use harvester_lab::jobs::{input, solve};

const USAGE: &str = "usage: harvester < request.json > answer.json
       harvester --batch < requests.jsonl > answers.jsonl

One JSON request on standard input, one JSON answer on standard output, for example
  echo '{\"task\":\"modes\"}' | harvester
Tasks: modes, boundary, simulate, orbit, chart, sweep, verdict, basin, harvest, load, materials, limits, trust, find.
The README describes their fields.

  --batch    one request a line, one answer a line in the same order, on all cores;
             a bad line is answered with {\"error\": ...}
  --help     this text
  --version  the version";

/// What the command is asked to do.
enum Mode {
    Single,
    Batch,
    Say(String),
}

fn main() -> ExitCode {
    match mode() {
        Ok(Mode::Single) => single(),
        Ok(Mode::Batch) => batch(),
        Ok(Mode::Say(text)) => say(&text),
        Err(error) => fail(&format!("{error}\n{USAGE}")),
    }
}

/// Reads the arguments.
fn mode() -> Result<Mode, lexopt::Error> {
    use lexopt::prelude::{Long, Short};
    let mut parser = lexopt::Parser::from_env();
    let mut mode = Mode::Single;
    while let Some(argument) = parser.next()? {
        match argument {
            Long("batch") => mode = Mode::Batch,
            Long("help") | Short('h') => return Ok(Mode::Say(USAGE.to_owned())),
            Long("version") | Short('V') => {
                return Ok(Mode::Say(format!("harvester {}", env!("CARGO_PKG_VERSION"))));
            }
            other => return Err(other.unexpected()),
        }
    }
    Ok(mode)
}

fn single() -> ExitCode {
    let mut bytes = Vec::new();
    if let Err(error) = io::stdin().read_to_end(&mut bytes) {
        return fail(&format!("the request cannot be read: {error}"));
    }
    let request = match input::text(&bytes) {
        Ok(request) => request,
        Err(problem) => return fail(&format!("the request is {problem}")),
    };
    match solve(request) {
        Ok(answer) => say(&answer),
        Err(message) => fail(&message),
    }
}

fn batch() -> ExitCode {
    match answer_lines(io::stdin().lock(), BufWriter::new(io::stdout().lock())) {
        Ok(()) => ExitCode::SUCCESS,
        Err(BatchError::Write(error)) => unwritten(&error),
        Err(error) => fail(&error.to_string()),
    }
}

fn say(text: &str) -> ExitCode {
    match writeln!(io::stdout(), "{text}") {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => unwritten(&error),
    }
}

/// Whoever closed the pipe has read enough; a full disk must be told.
fn unwritten(error: &io::Error) -> ExitCode {
    if error.kind() == ErrorKind::BrokenPipe {
        return ExitCode::SUCCESS;
    }
    fail(&format!("the answer cannot be written: {error}"))
}

fn fail(message: &str) -> ExitCode {
    eprintln!("{message}");
    ExitCode::from(2)
}
