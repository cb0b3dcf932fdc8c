//! Questions and answers: one request type for the native command, JavaScript and the page, and the sliced run
//! behind the page's plots.

pub mod batch;
pub mod budget;
pub mod design;
pub mod foreman;
pub mod input;
pub mod inspection;
pub mod motions;
pub mod request;
pub mod response;
pub mod run;
pub mod study;
pub mod tasks;
pub mod work;

mod parallel;

use budget::Budget;

pub use request::{Asked, Request, RequestError};
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
    let answer = Request::parse(json).and_then(|asked| asked.answer(budget));
    // Names in the message may hold what is in the request.
    let answer = answer.map_err(|error| error.to_string().replace(char::is_control, " "))?;
    serde_json::to_string(&answer).map_err(|error| error.to_string())
}
