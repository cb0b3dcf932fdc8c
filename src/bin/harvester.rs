//! The native command: JSON requests on standard input, JSON answers on standard output, progress on standard error when
//! that is a terminal.
//!
//! Exit status 0 with an answer, or a line for each line of a batch; 2 with one line on standard error when the input
//! is not good.

use std::io::{self, BufWriter, ErrorKind, IsTerminal, Read, Write};
use std::process::ExitCode;
use std::sync::Mutex;
use std::time::Duration;

use harvester_lab::questions::batch::{BatchError, Manner, answer_lines};
use harvester_lab::questions::list::TASKS;
use harvester_lab::questions::{input, solve_within};
use harvester_lab::scheduler::budget::{Budget, now};

/// How the command is used.
fn usage() -> String {
    let tasks = TASKS.iter().map(|task| task.name).collect::<Vec<_>>().join(", ");
    format!(
        "usage: harvester < request.json > answer.json
       harvester --batch [--timeout SECONDS] < requests.jsonl > answers.jsonl

One JSON request on standard input, one JSON answer on standard output, for example
  echo '{{\"task\":\"modes\"}}' | harvester
Tasks: {tasks}.
The README describes their fields. How far a request is stands on standard error when that is a terminal.

  --batch            one request a line, one answer a line in the same order, on all cores;
                     a bad line is answered with {{\"error\": ...}}
  --timeout SECONDS  for a line of a batch: one that is not answered by then is answered with {{\"error\": ...}}
  --help             this text
  --version          the version"
    )
}

/// Longest time for a line (s).
const LONGEST: f64 = 1e7;

/// What the command is asked to do.
enum Mode {
    Single,
    Batch(Option<Duration>),
    Say(String),
}

fn main() -> ExitCode {
    match mode() {
        Ok(Mode::Single) => single(),
        Ok(Mode::Batch(timeout)) => batch(timeout),
        Ok(Mode::Say(text)) => say(&text),
        Err(error) => fail(&format!("{error}\n{}", usage())),
    }
}

/// Reads the arguments.
fn mode() -> Result<Mode, lexopt::Error> {
    use lexopt::prelude::{Long, Short, ValueExt as _};
    let mut parser = lexopt::Parser::from_env();
    let (mut batch, mut timeout) = (false, None);
    while let Some(argument) = parser.next()? {
        match argument {
            Long("batch") => batch = true,
            Long("timeout") => timeout = Some(parser.value()?.parse_with(seconds)?),
            Long("help") | Short('h') => return Ok(Mode::Say(usage())),
            Long("version") | Short('V') => {
                return Ok(Mode::Say(format!("harvester {}", env!("CARGO_PKG_VERSION"))));
            }
            other => return Err(other.unexpected()),
        }
    }
    match (batch, timeout) {
        (true, timeout) => Ok(Mode::Batch(timeout)),
        (false, None) => Ok(Mode::Single),
        (false, Some(_)) => Err("--timeout is for the lines of a --batch".into()),
    }
}

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds: Option<f64> = text.parse().ok().filter(|seconds| (1e-3..=LONGEST).contains(seconds));
    seconds.map(Duration::from_secs_f64).ok_or_else(|| format!("allowed are 0.001 to {LONGEST} seconds"))
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
    let line = Line::new();
    let report = |part: f64| line.show(|| format!("{:.0} % computed", 100.0 * part));
    let answer = solve_within(request, Budget::default().reporting(Some(&report)));
    line.clear();
    match answer {
        Ok(answer) => say(&answer),
        Err(message) => fail(&message),
    }
}

fn batch(timeout: Option<Duration>) -> ExitCode {
    let line = Line::new();
    let report = |count| line.show(|| format!("{count} lines answered"));
    let manner = Manner { timeout, report: Some(&report) };
    let done = answer_lines(io::stdin().lock(), BufWriter::new(io::stdout().lock()), manner);
    line.clear();
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(BatchError::Write(error)) => unwritten(&error),
        Err(error) => fail(&error.to_string()),
    }
}

/// The line on a terminal that says how far the command is; nothing elsewhere.
struct Line {
    terminal: bool,
    /// When it was written last (s of the clock), and whether ever.
    written: Mutex<(f64, bool)>,
}

impl Line {
    /// Seconds between two writings, and before the first: what is quick needs none.
    const PAUSE: f64 = 0.25;

    fn new() -> Self {
        Self { terminal: io::stderr().is_terminal(), written: Mutex::new((now(), false)) }
    }

    fn show(&self, text: impl FnOnce() -> String) {
        if !self.terminal {
            return;
        }
        if let Ok(mut written) = self.written.lock()
            && now() - written.0 >= Self::PAUSE
        {
            *written = (now(), true);
            // A terminal that has gone is no reason to stop.
            let _ = write!(io::stderr(), "\r\x1b[K{}", text());
        }
    }

    fn clear(&self) {
        if self.written.lock().is_ok_and(|written| written.1) {
            let _ = write!(io::stderr(), "\r\x1b[K");
        }
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
