//! Many requests, one a line, and their answers, one a line in the same order.

use std::io::{self, BufRead, Read, Write};

use thiserror::Error;

use super::{input, parallel, solve};

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

/// Answers every line of `requests` with one line of `answers`, in order: with the JSON answer, or with an object whose
/// only field `error` says what is wrong, also for an empty line. It holds as many lines as keep all cores busy, and
/// writes their answers when the last of them is there.
///
/// # Errors
/// [`BatchError`] when reading or writing fails.
pub fn answer_lines(mut requests: impl BufRead, mut answers: impl Write) -> Result<(), BatchError> {
    loop {
        let (lines, failure) = read_lines(&mut requests, PER_CORE * parallel::width());
        for answer in parallel::map(&lines, answer_line) {
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
    let answer = match line {
        Ok(request) => solve(request),
        Err(problem) => Err(problem.clone()),
    };
    answer.unwrap_or_else(|message| serde_json::json!({ "error": message }).to_string())
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
        answer_lines(requests, &mut written).expect("memory can be read and written");
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
    fn failures_of_reading_and_writing_end_it() {
        struct Broken;
        impl Read for Broken {
            fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
                Err(io::Error::other("gone"))
            }
        }
        let mut written = Vec::new();
        let input = io::BufReader::new(b"{\"task\":\"modes\"}\n".chain(Broken));
        assert!(matches!(answer_lines(input, &mut written), Err(BatchError::Read(_))));
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
        assert!(matches!(answer_lines(&b"x\n"[..], Full), Err(BatchError::Write(_))));
    }
}
