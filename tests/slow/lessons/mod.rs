//! Every step of every lesson does what it says: views load, goals are open at first and reached by what is shown, and
//! every number in the texts is what the solver answers.

mod claims;
mod numbers;

use std::collections::{BTreeMap, BTreeSet};

use harvester_lab::app::lessons::data::{Goal, Lesson, Step};
use harvester_lab::app::lessons::{LessonId, STEPS, course, facts};
use harvester_lab::app::view::{Tab, View};
use harvester_lab::app::{fonts, link};
use rayon::prelude::*;

/// The lessons with their names.
fn lessons() -> Vec<(LessonId, &'static Lesson)> {
    LessonId::all().map(|id| (id, id.lesson().unwrap_or_else(|| panic!("{id} is no lesson")))).collect()
}

/// The view that a step's fragment sets, which must be usable without a complaint.
fn load(place: &str, fragment: &str, present: &View) -> View {
    let (_, problems) = link::read(fragment, present);
    assert!(problems.is_empty(), "{place}: {fragment}: {problems:?}");
    course::view_of(fragment, present)
}

/// Each step with its place, the view in which it begins when the user goes straight on, and its number.
fn steps() -> Vec<(String, LessonId, &'static Step, View, usize)> {
    let mut steps = Vec::new();
    for (id, lesson) in lessons() {
        let mut view = View { lesson: Some(id), ..View::default() };
        for (index, step) in lesson.steps.iter().enumerate() {
            let place = format!("{id}, step {}", index + 1);
            view.step = index + 1;
            if let Some(fragment) = &step.view {
                view = load(&place, fragment, &view);
            }
            steps.push((place.clone(), id, step, view.clone(), index + 1));
            if let Some(Goal { show, .. }) = &step.goal {
                view = load(&place, show, &view);
            }
        }
    }
    steps
}

#[test]
fn there_are_at_least_eight_lessons_of_a_few_steps_that_begin_with_a_view() {
    assert!(lessons().len() >= 8);
    for (id, lesson) in lessons() {
        assert!((3..=6).contains(&lesson.steps.len()) && lesson.steps.len() <= STEPS, "{id}");
        assert!((1..=15).contains(&lesson.minutes), "{id}: {} minutes", lesson.minutes);
        assert!(lesson.steps[0].view.is_some(), "{id} begins with whatever was in view");
        let tasks = lesson.steps.iter().filter(|step| step.goal.is_some()).count();
        assert!(tasks >= 2, "{id} gives too little to do");
    }
}

#[test]
fn every_goal_is_open_when_its_step_begins_and_reached_by_what_is_shown() {
    let failures: Vec<String> = steps()
        .into_par_iter()
        .filter_map(|(place, _, step, view, _)| {
            assert_ne!(view.tab, Tab::Lessons, "{place}");
            let goal = step.goal.as_ref()?;
            let reached = |view: &View| {
                let facts = facts::facts_at_once(view).unwrap_or_else(|why| panic!("{place}: {why}"));
                let missed: Vec<_> =
                    goal.conditions.iter().filter(|one| !one.holds(&facts)).cloned().collect();
                (missed.is_empty(), format!("{missed:?} of {}", facts["verdict"]["motion"]))
            };
            if reached(&view).0 {
                return Some(format!("{place}: nothing is left to do"));
            }
            let (done, missed) = reached(&load(&place, &goal.show, &view));
            (!done).then(|| format!("{place}: what is shown does not do it: {missed}"))
        })
        .collect();
    assert!(failures.is_empty(), "{failures:#?}");
}

/// All texts of a step, with what they are.
fn texts(step: &Step) -> Vec<(&'static str, &BTreeMap<String, String>)> {
    let mut texts = vec![("text", &step.text.0)];
    if let Some(goal) = &step.goal {
        texts.extend([("task", &goal.task.0), ("reaction", &goal.reaction.0)]);
    }
    if let Some(question) = &step.question {
        texts.push(("question", &question.text.0));
        for answer in &question.answers {
            texts.extend([("answer", &answer.text.0), ("reply", &answer.reply.0)]);
        }
    }
    texts
}

#[test]
fn every_question_has_one_right_answer_and_a_reply_to_each() {
    for (place, _, step, _, _) in steps() {
        for (what, text) in texts(step) {
            let english = text.get("en").unwrap_or_else(|| panic!("{place}: no English {what}"));
            assert!(
                !english.trim().is_empty() && english.matches("**").count() % 2 == 0,
                "{place}: {english}"
            );
            let known = |glyph: char| glyph.is_ascii() || ('¡'..='ÿ').contains(&glyph) || glyph == '\n';
            let strange =
                english.chars().find(|glyph| !known(*glyph) && !fonts::SPECIAL_GLYPHS.contains(*glyph));
            assert_eq!(strange, None, "{place}: no glyph, in: {english}");
        }
        let Some(question) = &step.question else { continue };
        assert!(question.answers.len() >= 2, "{place}");
        assert_eq!(question.answers.iter().filter(|answer| answer.right).count(), 1, "{place}");
        let different: BTreeSet<_> = question.answers.iter().map(|answer| answer.text.get()).collect();
        assert_eq!(different.len(), question.answers.len(), "{place}");
    }
}
