//! Questions: one type each for the native command, JavaScript and the page, with its fields, its pieces of work, how they
//! are put together, and its answer; and the sliced run behind the page's plots.
//!
//! [`list`] names them all.
//!
//! A question is one type (`questions::Question`): its fields with their defaults, as they stand in a request; the
//! device, the model and the start are a `Scenario` beside it, read by `questions::subject` in the same way for all.
//! `list` names the tasks, once, by a macro that hands the list to others: here it becomes their modules (`cargo fmt` does
//! not see those: the Makefile names the files), there `list::TASKS`, which drives the reading of requests, the command's
//! help, the README's table (held by a test) and `harvester.solve`. The page asks the same types: a study is begun from a
//! scenario and a question, and "copy as program" serialises both (`questions::written`).
//!
//! JSON is read in two steps: `input::json` makes values of it, `input::fields` makes fields of those, by one
//! deserialiser that knows the path and speaks plainly: a wrapper around the library's would be compiled once more for
//! every type.

use crate::scheduler::Budget;
use list::{TASKS, tasks};

pub mod answers;
pub mod batch;
pub mod batch_means;
pub mod design;
pub mod error;
pub mod input;
pub mod inspection;
pub mod list;
pub mod motion_chart;
pub mod motions;
pub mod multiplier_chart;
pub mod rectifier;
pub mod request;
pub mod response;
pub mod run;
pub mod shaken_run;
pub mod spectrogram;
pub mod tongues;

pub mod checks;
pub mod question;
mod subject;

macro_rules! files {
    ($($name:ident $file:ident)*) => {
        $(pub mod $file;)*
    };
}
tasks!(files);

pub use error::RequestError;
pub use question::Question;
pub use request::written;
pub use run::{Run, RunJob};

/// Answers one JSON request with one JSON object; the format is described in the README.
///
/// # Errors
/// One line that names the field, the value and the allowed range.
pub fn solve(json: &str) -> Result<String, String> {
    solve_within(json, Budget::default())
}

/// The same within what `budget` leaves of the request's own, and telling how far it is.
///
/// # Errors
/// As [`solve`].
pub fn solve_within(json: &str, budget: Budget<'_>) -> Result<String, String> {
    // Names in the message may hold what is in the request.
    request::answer(TASKS, json, budget).map_err(|error| error.to_string().replace(char::is_control, " "))
}
