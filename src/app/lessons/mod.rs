//! The guided lessons: authored as data in `assets/lessons`, followed step by step, their goals checked against what
//! the page shows and the solver finds.
//!
//! A lesson's name stands in links and in what browsers remember: it never changes.
//!
//! A lesson is data (`assets/lessons`, embedded): views are link fragments, read by `app::link` like any link; goals
//! are conditions on facts, and a fact is a place in the JSON of the view, of the verdict, or of how far beyond either
//! theory's boundary the point is (`lessons::facts`). So a lesson can ask for whatever the page can show without code
//! of its own. The running lesson and its step are fields of `View`: stored, linked, undone. What was answered and
//! reached is kept by `lessons::Course` while the lesson runs, the names of finished lessons beside the stored view. A
//! goal, once reached, stays so. Goals are looked at when view or verdict change; while a lesson runs the verdict is
//! computed on the Design tab, too.
//!
//! A lesson of one's own is a file dropped on the page or named in its address; `lessons::check` says what is wrong with
//! it. It runs under the name `own`.
//!
//! `tests/slow/lessons/` holds lessons to the truth: a step's own view must leave its goal open, what is shown must
//! reach it by the real solver, and every number in the texts needs a claim, which is a request whose answer it is.

pub mod check;
pub mod condition;
pub mod course;
pub mod data;
pub mod facts;
mod id;
mod part;

pub use course::Course;
pub use data::Lesson;
pub use id::{LessonId, STEPS};
