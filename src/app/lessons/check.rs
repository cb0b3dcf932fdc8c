//! Whether a lesson of one's own can be followed: its links work, and its conditions name facts.

use serde_json::Value;

use super::data::Lesson;
use super::id::STEPS;
use super::part::Read;
use crate::app::link;
use crate::app::view::View;
use crate::scenario::counted;
use crate::sentence::{Say as _, Sentence, said};

/// What a lesson's file holds.
///
/// # Errors
/// What is wrong with it, and where.
pub fn checked(json: &str) -> Read<Lesson> {
    let lesson = Lesson::read(json)?;
    counted("steps", lesson.steps.len(), (1, STEPS)).map_err(|error| error.say())?;
    let view = View::complete().to_value();
    for (step, number) in lesson.steps.iter().zip(1..) {
        let goal = step.goal.as_ref();
        let reveal = step.question.as_ref().and_then(|question| question.reveal.as_ref());
        let links = [
            ("view", step.view.as_ref()),
            ("goal, show", goal.map(|goal| &goal.show)),
            ("question, reveal", reveal),
        ];
        for (place, link) in links {
            if let Some(problem) = link.and_then(|link| problem(link)) {
                let at = format!("steps {number}, {place}");
                return Err(said("{at}: {problem}", &[("at", &at), ("problem", &problem)]));
            }
        }
        for condition in goal.into_iter().flat_map(|goal| &goal.conditions) {
            if !is_fact(&condition.at, &view) {
                let at = format!("steps {number}, goal, conditions: {}", condition.at);
                return Err(said(
                    "{at} names no fact: they begin with /view/, /verdict/ or /theory/, such as /verdict/motion/periods",
                    &[("at", &at)],
                ));
            }
        }
    }
    Ok(lesson)
}

/// What of a link could not be used.
fn problem(link: &str) -> Option<Sentence> {
    let (_, problems) = link::read(link, &View::default());
    if !link.split('&').any(|part| part.starts_with("v=")) {
        return Some(said("a link begins with v=1, as in v=1&omega=8.2", &[]));
    }
    problems.first().map(|problem| Sentence::Verbatim(problem.to_string()))
}

/// Whether there can be a fact at this place. What the verdict holds is known only once there is one.
fn is_fact(at: &str, view: &Value) -> bool {
    let theory = ["over_published", "over_coupled"];
    at.starts_with("/verdict/")
        || at.strip_prefix("/theory/").is_some_and(|name| theory.contains(&name))
        || at
            .strip_prefix("/view")
            .is_some_and(|place| place.starts_with('/') && view.pointer(place).is_some())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::lessons::LessonId;

    const GOOD: &str = r#"{"title":"Mine","summary":{"en":"a","de":"b"},"minutes":2,"steps":[
        {"text":"one","view":"v=1&omega=8.2","goal":{"task":"do","conditions":[{"at":"/verdict/motion/periods","is":2}],
         "show":"v=1&omega=8.2&beta=0.01","reaction":"done"}},
        {"text":"**two**","question":{"text":"what?","reveal":"v=1&omega=8.3","answers":[
          {"text":"this","reply":"no"},{"text":"that","reply":"yes","right":true}]}}]}"#;

    #[test]
    fn ours_and_a_good_one_pass() {
        for id in LessonId::all() {
            assert!(checked(id.source()).is_ok(), "{id}: {:?}", checked(id.source()).err());
        }
        let lesson = checked(GOOD).expect("a lesson");
        assert_eq!((lesson.steps.len(), lesson.title.get()), (2, "Mine"));
        assert!(lesson.steps[1].question.as_ref().is_some_and(|question| question.reveal.is_some()));
    }

    #[test]
    fn the_example_of_the_readme_is_a_lesson() {
        let readme = include_str!("../../../README.md");
        let (_, example) = readme.split_once("```json\n").expect("an example");
        let (example, _) = example.split_once("```").expect("its end");
        assert!(checked(example).is_ok(), "{:?}", checked(example).err());
    }

    #[test]
    fn what_is_wrong_is_named_with_its_place() {
        for (part, instead, said) in [
            (r#""minutes":2"#, r#""minutes":"long""#, "minutes must be a whole number"),
            (r#""title":"Mine","#, "", "title is missing"),
            (r#""minutes":2,"#, r#""minutes":2,"stesp":1,"#, "stesp is not known; there are title, summary"),
            (
                "\"view\":\"v=1&omega=8.2\"",
                "\"view\":\"v=1&omeag=8.2\"",
                "steps 1, view: omeag = 8.2 (not a name",
            ),
            ("v=1&omega=8.2&beta=0.01", "v=1&beta=9", "steps 1, goal, show: beta = 9 (allowed are 0 to 0.2)"),
            ("v=1&omega=8.3", "omega=8.3", "steps 2, question, reveal: a link begins with v=1"),
            ("/verdict/motion/periods", "/verdikt/periods", "/verdikt/periods names no fact"),
            (r#""en":"a""#, r#""fr":"a""#, "summary must be a text, or texts by language of which one is en"),
            ("**two**", "**two", "steps 2, text has **"),
            (r#","right":true"#, "", "of steps 2, question, answers exactly one must be right"),
            (r#""reply":"no""#, r#""replay":"no""#, "steps 2, question, answers 1, replay is not known"),
            (r#""is":2"#, r#""iss":2"#, "steps 1, goal, conditions 1 must have an entry at"),
        ] {
            let wrong = GOOD.replacen(part, instead, 1);
            assert_ne!(wrong, GOOD, "{part}");
            let why = checked(&wrong).expect_err(part).to_string();
            assert!(why.contains(said), "{part}: {why}");
        }
        assert!(checked("{").is_err() && checked("[]").is_err() && checked(r#"{"steps":[]}"#).is_err());
    }
}
