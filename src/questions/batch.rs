//! Many requests, one a line, and their answers, one a line in the same order.

use std::io::{self, BufRead, Read, Write};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::time::Duration;

use thiserror::Error;

use super::{input, solve, solve_within};
use crate::scheduler::budget::{Budget, now};
use crate::scheduler::parallel;

/// Lines read before any is answered, for each core: enough to keep all busy, few enough to hold in memory.
const PER_CORE: usize = 8;
/// Longest line that is read (bytes).
const LONGEST: usize = 1 << 24;

/// Why a batch ended early.
#[derive(Debug, Error)]
pub enum BatchError {
    /// The requests cannot be read; all before have been answered.
    #[error("the requests cannot be read: {0}")]
    Read(io::Error),
    /// The answers cannot be written.
    #[error("the answers cannot be written: {0}")]
    Write(io::Error),
}

/// How a batch is answered.
#[derive(Clone, Copy, Default)]
pub struct Manner<'a> {
    /// Time for each line; without end when absent.
    pub timeout: Option<Duration>,
    /// Told how many lines have been answered, as that grows.
    pub report: Option<&'a (dyn Fn(usize) + Sync)>,
}

/// Answers every line of `requests` with one line of `answers`, in order: with the JSON answer, or with an object whose
/// only field `error` says what is wrong, also for an empty line. It holds as many lines as keep all cores busy, and
/// writes their answers when the last of them is there. A line that is not answered in time has an error for that.
///
/// # Errors
/// [`BatchError`] when reading or writing fails.
pub fn answer_lines(
    mut requests: impl BufRead,
    mut answers: impl Write,
    manner: Manner<'_>,
) -> Result<(), BatchError> {
    let answered = AtomicUsize::new(0);
    let tell = |answer| {
        let count = answered.fetch_add(1, Ordering::Relaxed) + 1;
        manner.report.inspect(|report| report(count));
        answer
    };
    loop {
        let (lines, failure) = read_lines(&mut requests, PER_CORE * parallel::width());
        let found = match manner.timeout {
            None => parallel::map(&lines, |line| tell(answer_line(line))),
            Some(timeout) => in_time(&lines, |line| tell(answer_line_within(line, timeout))),
        };
        for answer in found {
            writeln!(answers, "{answer}").map_err(BatchError::Write)?;
        }
        answers.flush().map_err(BatchError::Write)?;
        match failure {
            Some(error) => return Err(BatchError::Read(error)),
            None if lines.is_empty() => return Ok(()),
            None => {}
        }
    }
}

/// A request, or why the line is none.
type Line = Result<String, String>;

fn answer_line(line: &Line) -> String {
    told(match line {
        Ok(request) => solve(request),
        Err(problem) => Err(problem.clone()),
    })
}

fn told(answer: Result<String, String>) -> String {
    answer.unwrap_or_else(|message| serde_json::json!({ "error": message }).to_string())
}

/// Part of the time within which an answer is whole.
const IN_TIME: f64 = 0.98;

/// The same within a time. A computation that takes longer is left behind: it begins no further piece of work, and ends
/// with the program at the latest.
fn answer_line_within(line: &Line, timeout: Duration) -> String {
    let request = match line {
        Ok(request) => request.clone(),
        Err(problem) => return told(Err(problem.clone())),
    };
    let seconds = timeout.as_secs_f64();
    let (sender, receiver) = mpsc::channel();
    let computation = std::thread::Builder::new().spawn(move || {
        let answer = solve_within(&request, Budget::default().until(Some(seconds)));
        // Nobody may be waiting any more.
        let _ = sender.send(answer);
    });
    if let Err(error) = computation {
        return told(Err(format!("the line could not be computed: {error}")));
    }
    let begun = now();
    match receiver.recv_timeout(timeout) {
        // What came at the last moment came because its time was over.
        Ok(answer) if now() - begun < IN_TIME * seconds => told(answer),
        _ => told(Err(format!("not answered within {seconds} s, the time for a line"))),
    }
}

/// What `work` makes of each of `lines`, in their order, by threads that may wait: those of [`parallel`] must not, as the
/// work waited for is done by them.
fn in_time(lines: &[Line], work: impl Fn(&Line) -> String + Sync) -> Vec<String> {
    let next = AtomicUsize::new(0);
    let found = Mutex::new(vec![String::new(); lines.len()]);
    std::thread::scope(|scope| {
        for _ in 0..parallel::width().min(lines.len()) {
            scope.spawn(|| {
                while let Some((place, line)) = {
                    let place = next.fetch_add(1, Ordering::Relaxed);
                    lines.get(place).map(|line| (place, line))
                } {
                    let answer = work(line);
                    if let Ok(mut found) = found.lock() {
                        found[place] = answer;
                    }
                }
            });
        }
    });
    found.into_inner().unwrap_or_default()
}

/// Up to `most` lines; fewer at the end, or when reading fails.
fn read_lines(requests: &mut impl BufRead, most: usize) -> (Vec<Line>, Option<io::Error>) {
    let mut lines = Vec::new();
    while lines.len() < most {
        match read_line(requests) {
            Ok(Some(line)) => lines.push(line),
            Ok(None) => break,
            Err(error) => return (lines, Some(error)),
        }
    }
    (lines, None)
}

/// The next line, if there is one.
fn read_line(requests: &mut impl BufRead) -> io::Result<Option<Line>> {
    let mut line = Vec::new();
    let length = requests.by_ref().take(LONGEST as u64).read_until(b'\n', &mut line)?;
    if length == 0 {
        return Ok(None);
    }
    if length == LONGEST && line.last() != Some(&b'\n') {
        requests.skip_until(b'\n')?;
        return Ok(Some(Err("the line is longer than 16 MiB".to_owned())));
    }
    Ok(Some(match input::text(&line) {
        Ok(text) if text.trim().is_empty() => Err("the line is empty".to_owned()),
        // Without its end, so that a message counts lines as for a single request.
        Ok(text) => Ok(text.trim_end().to_owned()),
        Err(problem) => Err(format!("the line is {problem}")),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answers(requests: &[u8]) -> Vec<String> {
        let mut written = Vec::new();
        answer_lines(requests, &mut written, Manner::default()).expect("memory can be read and written");
        String::from_utf8(written).expect("answers are text").lines().map(str::to_owned).collect()
    }

    #[test]
    fn every_line_has_its_answer_in_its_place() {
        let good =
            |alpha: usize| format!(r#"{{"task":"modes","parameters":{{"alpha":{}}}}}"#, alpha as f64 * 1e-5);
        let count = 3 * PER_CORE * parallel::width() + 1;
        let mut lines: Vec<String> = (0..count).map(good).collect();
        lines[1] = String::new();
        lines[4] = "no request".to_owned();
        let found = answers((lines.join("\n") + "\r\n").as_bytes());
        assert_eq!(found.len(), count);
        for (line, answer) in lines.iter().zip(found) {
            match solve(line) {
                Ok(alone) => assert_eq!(answer, alone),
                Err(_) => assert!(answer.starts_with(r#"{"error":""#), "{answer}"),
            }
        }
    }

    #[test]
    fn lines_that_are_no_text_or_endless_are_answered_too() {
        let mut requests = b"\xef\xbb\xbf{\"task\":\"modes\"}\n\xfc\n\xff\xfe{\0\n\0}\0\n".to_vec();
        requests.extend(std::iter::repeat_n(b' ', LONGEST + 5));
        requests.extend(b"\n\n{\"task\":\"modes\"}");
        let found = answers(&requests);
        let parts = ["A_e", "not UTF-8", "UTF-16", "UTF-16", "16 MiB", "empty", "A_e"];
        assert_eq!(found.len(), parts.len());
        assert!(found.iter().zip(parts).all(|(answer, part)| answer.contains(part)), "{found:?}");
        assert!(answers(b"").is_empty());
    }

    #[test]
    fn a_line_that_takes_too_long_is_answered_with_its_time_and_the_batch_goes_on() {
        let long = r#"{"task":"simulate","method":"rk4","t_end":20000,"steps_per_period":10000}"#;
        let requests = format!("{{\"task\":\"modes\"}}\n{long}\n{{\"task\":\"modes\"}}\n\n");
        let counts = Mutex::new(Vec::new());
        let report = |count| counts.lock().expect("whole").push(count);
        let manner = Manner { timeout: Some(Duration::from_millis(400)), report: Some(&report) };
        let mut written = Vec::new();
        let begin = std::time::Instant::now();
        answer_lines(requests.as_bytes(), &mut written, manner).expect("memory can be read and written");
        assert!(begin.elapsed() < Duration::from_secs(5), "{:?}", begin.elapsed());
        let written = String::from_utf8(written).expect("text");
        let lines: Vec<&str> = written.lines().collect();
        assert_eq!(lines.len(), 4);
        assert_eq!(lines[1], r#"{"error":"not answered within 0.4 s, the time for a line"}"#);
        assert!(lines[0] == lines[2] && lines[0].contains("A_e") && lines[3].contains("empty"), "{written}");
        let mut counts = counts.lock().expect("whole").clone();
        counts.sort_unstable();
        assert_eq!(counts, [1, 2, 3, 4]);
    }

    #[test]
    fn failures_of_reading_and_writing_end_it() {
        struct Broken;
        impl Read for Broken {
            fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
                Err(io::Error::other("gone"))
            }
        }
        let mut written = Vec::new();
        let input = io::BufReader::new(b"{\"task\":\"modes\"}\n".chain(Broken));
        assert!(matches!(answer_lines(input, &mut written, Manner::default()), Err(BatchError::Read(_))));
        // What was read before is answered.
        assert!(written.starts_with(b"{\"A_e\""));
        struct Full;
        impl Write for Full {
            fn write(&mut self, _: &[u8]) -> io::Result<usize> {
                Err(io::ErrorKind::StorageFull.into())
            }
            fn flush(&mut self) -> io::Result<()> {
                Ok(())
            }
        }
        assert!(matches!(answer_lines(&b"x\n"[..], Full, Manner::default()), Err(BatchError::Write(_))));
    }
}
