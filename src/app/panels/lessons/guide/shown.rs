//! The step in view, with what the user has done in it.

use crate::app::lessons::course::{self, Progress};
use crate::app::lessons::data::Step;
use crate::app::lessons::{Lesson, LessonId};
use crate::app::panels::Context;

/// A step that is shown.
#[derive(Clone, Copy)]
pub(super) struct Shown {
    pub(super) lesson: &'static Lesson,
    pub(super) step: &'static Step,
    /// From 1.
    pub(super) number: usize,
    pub(super) progress: Progress,
}

impl Shown {
    pub(super) fn of(context: &Context<'_>) -> Option<(LessonId, Self)> {
        let (id, lesson) = course::running(context.view)?;
        let step = course::step(context.view)?;
        let number = context.view.step.clamp(1, lesson.steps.len());
        Some((id, Self { lesson, step, number, progress: context.course.progress(context.view) }))
    }

    pub(super) fn is_last(&self) -> bool {
        self.number == self.lesson.steps.len()
    }

    /// Whether what the step asks for has been done.
    pub(super) fn is_done(&self) -> bool {
        (self.step.goal.is_none() || self.progress.reached)
            && self.step.question.as_ref().is_none_or(|question| {
                self.progress.answer.is_some() && (question.reveal.is_none() || self.progress.revealed)
            })
    }
}
