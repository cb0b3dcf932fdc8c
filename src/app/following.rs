//! The lessons as the page follows them: what their buttons do.

use super::App;
use super::history::Hand;
use super::lessons::LessonId;
use super::lessons::course::{self, Action};
use super::view::Tab;

impl App {
    /// Does what a button of the lessons asks for.
    pub(super) fn follow_lesson(&mut self, action: Action) {
        match action {
            Action::Begin(id) => {
                self.course.begin(id);
                (self.view.lesson, self.view.step) = (Some(id), 1);
                self.set_step();
            }
            Action::GoTo(number) => {
                let last = course::running(&self.view).map_or(1, |(_, lesson)| lesson.steps.len());
                self.view.step = number.clamp(1, last);
                self.set_step();
            }
            Action::Restart => self.set_step(),
            Action::Show => {
                if let Some(goal) = course::step(&self.view).and_then(|step| step.goal.as_ref()) {
                    self.set_view(&goal.show);
                }
            }
            Action::Answer(answer) => self.course.note(&self.view).answer = Some(answer),
            Action::Reveal => {
                self.course.note(&self.view).revealed = true;
                let question = course::step(&self.view).and_then(|step| step.question.as_ref());
                if let Some(reveal) = question.and_then(|question| question.reveal.as_ref()) {
                    self.set_view(reveal);
                }
            }
            Action::Leave => self.leave_lesson(),
            Action::Finish => {
                if let Some(id) = self.view.lesson {
                    self.course.finish(id);
                }
                self.leave_lesson();
                (self.view.tab, self.view.enlarged) = (Tab::Lessons, None);
            }
        }
    }

    /// Begins a lesson at one of its steps, as one step of the history.
    pub(super) fn begin_step(&mut self, id: LessonId, step: usize) {
        self.history.begin_frame(Hand::default());
        let before = self.moment();
        self.follow_lesson(Action::Begin(id));
        if step > 1 {
            self.follow_lesson(Action::GoTo(step));
        }
        if before != self.moment() {
            self.history.note(before, Hand::default());
        }
        self.follow();
    }

    fn leave_lesson(&mut self) {
        (self.view.lesson, self.view.step) = (None, 1);
    }

    /// Sets the page as the step in view begins.
    pub(super) fn set_step(&mut self) {
        if let Some(fragment) = course::step(&self.view).and_then(|step| step.view.as_ref()) {
            self.set_view(fragment);
        }
    }

    fn set_view(&mut self, fragment: &str) {
        let view = course::view_of(fragment, &self.view);
        self.place(view, !fragment.contains("map="));
    }
}
