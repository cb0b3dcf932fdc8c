//! How far the user is: what was answered and reached in the running lesson, which lessons are done, and what the
//! guide's buttons do.

use serde_json::Value;

use super::LessonId;
use super::data::{Lesson, Step};
use super::facts::facts;
use crate::app::link;
use crate::app::session::Session;
use crate::app::view::View;
use crate::dynamics::Verdict;

/// What the user wants of the lessons.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::app) enum Action {
    /// Begin a lesson, or begin it again.
    Begin(LessonId),
    /// Go to a step of the running lesson, from 1.
    GoTo(usize),
    /// Set the page as at the beginning of the step.
    Restart,
    /// Show how the goal is reached.
    Show,
    /// Choose an answer, from 0.
    Answer(usize),
    /// Show what comes of what was predicted.
    Reveal,
    /// Leave the lesson; the page stays as it is.
    Leave,
    /// Leave it by its end.
    Finish,
}

/// What happened in a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(in crate::app) struct Progress {
    /// Whether its goal was reached.
    pub reached: bool,
    /// The answer chosen last, from 0.
    pub answer: Option<usize>,
    /// Whether it was shown what comes of it.
    pub revealed: bool,
}

/// What is remembered of the lessons beside the view.
#[derive(Debug, Default)]
pub struct Course {
    finished: Vec<LessonId>,
    lesson: Option<LessonId>,
    /// One a step of that lesson, as far as there is something to say.
    progress: Vec<Progress>,
    /// The view that the goal was last checked on, and whether its verdict was known.
    checked: Option<(View, bool)>,
}

impl Course {
    /// Continues after what an earlier session stored.
    pub(in crate::app) fn restore(stored: Option<&str>) -> Self {
        let value: Value = stored.and_then(|text| serde_json::from_str(text).ok()).unwrap_or_default();
        let names = value.get(FINISHED).and_then(Value::as_array).into_iter().flatten();
        let finished = names.filter_map(|name| LessonId::named(name.as_str()?)).collect();
        Self { finished, ..Self::default() }
    }

    /// Adds what is to be stored to the stored view.
    pub(in crate::app) fn store(&self, view: &mut Value) {
        // Another file may be brought next time.
        let ours = self.finished.iter().filter(|id| **id != LessonId::own());
        let names: Vec<&str> = ours.map(|id| id.name()).collect();
        if let Some(entries) = view.as_object_mut().filter(|_| !names.is_empty()) {
            entries.insert(FINISHED.to_owned(), Value::from(names));
        }
    }

    /// Whether a lesson was gone through to its end.
    pub(in crate::app) fn is_finished(&self, id: LessonId) -> bool {
        self.finished.contains(&id)
    }

    /// What happened in the step in view.
    pub(in crate::app) fn progress(&self, view: &View) -> Progress {
        let same = self.lesson == view.lesson;
        same.then(|| self.progress.get(view.step)).flatten().copied().unwrap_or_default()
    }

    /// Whether what the page shows reaches the goal of the step in view, which it had not before. Once reached, it
    /// stays so.
    pub(in crate::app) fn look(&mut self, view: &View, session: &Session, verdict: Option<&Verdict>) -> bool {
        let Some(goal) = step(view).and_then(|step| step.goal.as_ref()) else { return false };
        let known = verdict.is_some();
        let checked = self.checked.as_ref().is_some_and(|(of, then)| *then == known && of == view);
        if checked || self.progress(view).reached {
            return false;
        }
        let facts = facts(view, session.boundaries.as_ref(), verdict);
        let reached = goal.conditions.iter().all(|condition| condition.holds(&facts));
        if reached {
            self.note(view).reached = true;
        }
        self.checked = Some((view.clone(), known));
        reached
    }

    /// Where to note what happens in the step in view.
    pub(in crate::app) fn note(&mut self, view: &View) -> &mut Progress {
        if self.lesson != view.lesson {
            self.lesson = view.lesson;
            self.progress.clear();
        }
        let length = self.progress.len().max(view.step + 1);
        self.progress.resize(length, Progress::default());
        &mut self.progress[view.step]
    }

    /// A lesson begins, or begins again.
    pub(in crate::app) fn begin(&mut self, id: LessonId) {
        self.lesson = Some(id);
        self.progress.clear();
        self.checked = None;
    }

    /// A lesson was gone through to its end.
    pub(in crate::app) fn finish(&mut self, id: LessonId) {
        if !self.is_finished(id) {
            self.finished.push(id);
        }
    }
}

/// The entry of the stored view that names the lessons done.
const FINISHED: &str = "finished_lessons";

/// The running lesson.
pub(in crate::app) fn running(view: &View) -> Option<(LessonId, &'static Lesson)> {
    let id = view.lesson?;
    Some((id, id.lesson()?))
}

/// The step in view.
pub(in crate::app) fn step(view: &View) -> Option<&'static Step> {
    running(view)?.1.step(view.step)
}

/// The view that a step's `fragment` sets, in the same lesson. The Design tab stays as the user left it unless the
/// fragment is about it.
pub fn view_of(fragment: &str, present: &View) -> View {
    let (mut view, _) = link::read(fragment, present);
    if !fragment.contains("design.") {
        view.design = present.design.clone();
        // A step is about what it says, which is the sine.
        view.design.shake.everywhere = false;
    }
    View { lesson: present.lesson, step: present.step, ..view }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::App;
    use crate::app::command::Command;
    use crate::app::history::Hand;
    use crate::app::rehearsal;
    use crate::app::view::Tab;

    fn app(stored: Option<&str>) -> App {
        rehearsal::app(&egui::Context::default(), stored)
    }

    fn act(app: &mut App, action: Action) {
        app.history.begin_frame(Hand::default());
        app.step(Command::Lesson(action), Hand::default());
    }

    fn tongue() -> LessonId {
        LessonId::named("first-tongue").expect("a lesson")
    }

    #[test]
    fn steps_set_the_page_and_are_undone() {
        let mut app = app(None);
        app.view.design.mode = 3;
        app.view.design.shake.everywhere = true;
        let before = app.view.clone();
        act(&mut app, Action::Begin(tongue()));
        assert_eq!(app.view.shaken(), None);
        assert_eq!((app.view.lesson, app.view.step), (Some(tongue()), 1));
        assert_eq!((app.view.scenario.parameters.beta, app.view.design.mode), (5e-4, 3));
        act(&mut app, Action::GoTo(2));
        assert_eq!((app.view.step, app.view.scenario.parameters.beta), (2, 1e-3));
        act(&mut app, Action::Show);
        assert_eq!((app.view.step, app.view.scenario.parameters.omega), (2, 8.1569));
        act(&mut app, Action::Restart);
        assert_eq!(app.view.scenario.parameters.omega, 8.0969);
        act(&mut app, Action::GoTo(99));
        assert_eq!((app.view.step, app.view.tab), (4, Tab::Stability));
        act(&mut app, Action::Leave);
        assert_eq!((app.view.lesson, app.view.step, app.view.tab), (None, 1, Tab::Stability));
        for _ in 0..6 {
            app.undo();
        }
        assert_eq!(app.view, before);
    }

    #[test]
    fn a_goal_is_reached_by_whatever_way_and_stays_so() {
        let mut app = app(None);
        act(&mut app, Action::Begin(LessonId::named("resonance").expect("a lesson")));
        act(&mut app, Action::GoTo(4));
        let look = |app: &mut App| app.course.look(&app.view, &app.session, None);
        assert!(!look(&mut app));
        // By hand; the rest of the goal needs no verdict.
        app.view.scenario.parameters.beta = 4.1e-5;
        assert!(look(&mut app));
        app.view.scenario.parameters.beta = 2e-5;
        assert!(!look(&mut app) && app.course.progress(&app.view).reached);
        act(&mut app, Action::Answer(1));
        act(&mut app, Action::GoTo(1));
        assert_eq!(app.course.progress(&app.view), Progress::default());
        act(&mut app, Action::GoTo(4));
        assert_eq!(
            app.course.progress(&app.view),
            Progress { reached: true, answer: Some(1), revealed: false }
        );
        // What was done in one lesson is not done in another, nor when it begins again.
        act(&mut app, Action::Begin(tongue()));
        assert_eq!(app.course.progress(&app.view), Progress::default());
    }

    #[test]
    fn finished_lessons_are_remembered_and_are_no_part_of_links_and_files() {
        let mut first = app(None);
        act(&mut first, Action::Begin(tongue()));
        act(&mut first, Action::Finish);
        assert_eq!((first.view.lesson, first.view.tab), (None, Tab::Lessons));
        assert!(!first.fragment().contains("tongue"), "{}", first.fragment());
        let stored = first.stored();
        let next = app(Some(&stored));
        assert!(next.course.is_finished(tongue()) && next.notice.is_none());
        assert_eq!(next.stored(), stored);
        // Lessons of another version are forgotten.
        let other = stored.replace("first-tongue", "last-tongue");
        assert!(!app(Some(&other)).course.is_finished(tongue()));
    }

    #[test]
    fn a_link_with_a_lesson_alone_begins_its_step_and_one_with_more_shows_that() {
        let mut app = app(None);
        app.open_link("#v=1&lesson=first-tongue&step=2");
        assert_eq!((app.view.step, app.view.scenario.parameters.beta), (2, 1e-3));
        app.open_link("#v=1&lesson=first-tongue&step=2&beta=0.003&omega=8.1");
        assert_eq!((app.view.step, app.view.scenario.parameters.beta), (2, 3e-3));
        app.open_link("#v=1&lesson=juggling");
        let notice = app.notice.take().expect("a notice");
        assert!(notice.contains("lesson = juggling (allowed are tour, resonance,"), "{notice}");
    }
}
