//! The guided lessons: authored as data in `assets/lessons`, followed step by step, their goals checked against what
//! the page shows and the solver finds.
//!
//! A lesson's name stands in links and in what browsers remember: it never changes.

pub mod condition;
pub mod course;
pub mod data;
pub mod facts;
mod id;

pub use course::Course;
pub use data::Lesson;
pub use id::{LessonId, STEPS};
