//! Every step of every lesson does what it says: views load, goals are open at first and reached by what is shown, and
//! every number in the texts is what the solver answers.
#![cfg(feature = "app")]

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Mutex;

use harvester_lab::app::lessons::data::{Goal, Lesson, Step};
use harvester_lab::app::lessons::{LessonId, STEPS, course, facts};
use harvester_lab::app::view::{Tab, View};
use harvester_lab::app::{fonts, link};
use harvester_lab::jobs;
use rayon::prelude::*;
use serde::Deserialize;
use serde_json::Value;

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
        assert!((2..=15).contains(&lesson.minutes), "{id}: {} minutes", lesson.minutes);
        assert!(lesson.steps[0].view.is_some(), "{id} begins with whatever was in view");
        let tasks = lesson.steps.iter().filter(|step| step.goal.is_some()).count();
        assert!(tasks >= 2, "{id} gives too little to do");
    }
}

/// Entries that the page knows, by what they stand in.
const ENTRIES: [(&str, &[&str]); 5] = [
    ("lesson", &["title", "summary", "minutes", "steps"]),
    ("steps", &["text", "view", "goal", "question", "claims"]),
    ("goal", &["task", "conditions", "show", "reaction"]),
    ("question", &["text", "answers"]),
    ("answers", &["text", "reply", "right"]),
];

fn misspelt(place: &str, value: &Value, found: &mut Vec<String>) {
    let Some((_, known)) = ENTRIES.iter().find(|(name, _)| *name == place) else { return };
    for (name, entry) in value.as_object().into_iter().flatten() {
        if !known.contains(&name.as_str()) {
            found.push(format!("{name} in {place}"));
        }
        match entry {
            Value::Array(parts) => parts.iter().for_each(|part| misspelt(name, part, found)),
            part => misspelt(name, part, found),
        }
    }
}

#[test]
fn no_entry_of_a_file_is_misspelt() {
    for (id, _) in lessons() {
        let (lesson, mut found) = (serde_json::from_str(id.source()).expect("JSON"), Vec::new());
        misspelt("lesson", &lesson, &mut found);
        assert!(found.is_empty(), "{id}: {found:?}");
    }
    let mut found = Vec::new();
    let wrong = serde_json::json!({ "steps": [{ "text": {}, "goal": { "shows": "" } }] });
    misspelt("lesson", &wrong, &mut found);
    assert_eq!(found, ["shows in goal"]);
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

/// A number in a text, and the request whose answer it is.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct Claim {
    /// The number as it stands in the text, or a word for it.
    says: String,
    request: Value,
    /// Where the value stands in the answer.
    at: String,
    /// Multiplies it.
    times: Option<f64>,
    /// Is added: a number, or another term.
    plus: Option<Value>,
    /// Divides it.
    over: Option<Term>,
    /// What it is, when that is not what is said.
    value: Option<f64>,
    /// How far it may be off; half a unit of the last digit of what is said when absent.
    tolerance: Option<f64>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct Term {
    request: Value,
    at: String,
    times: Option<f64>,
}

/// Answers, each computed once.
#[derive(Default)]
struct Solver(Mutex<BTreeMap<String, Value>>);

impl Solver {
    fn number(&self, request: &Value, at: &str) -> Result<f64, String> {
        let text = request.to_string();
        let known = self.0.lock().map_err(|_| "a panic elsewhere")?.get(&text).cloned();
        let answer = match known {
            Some(answer) => answer,
            None => {
                let answer: Value =
                    serde_json::from_str(&jobs::solve(&text)?).map_err(|error| error.to_string())?;
                self.0.lock().map_err(|_| "a panic elsewhere")?.insert(text, answer.clone());
                answer
            }
        };
        answer.pointer(at).and_then(Value::as_f64).ok_or_else(|| format!("no number at {at} of {request}"))
    }

    fn value(&self, claim: &Claim) -> Result<f64, String> {
        let mut value = self.number(&claim.request, &claim.at)? * claim.times.unwrap_or(1.0);
        if let Some(over) = &claim.over {
            value /= self.number(&over.request, &over.at)? * over.times.unwrap_or(1.0);
        }
        if let Some(plus) = &claim.plus {
            value += match plus.as_f64() {
                Some(number) => number,
                None => {
                    let term = Term::deserialize(plus).map_err(|error| error.to_string())?;
                    self.number(&term.request, &term.at)? * term.times.unwrap_or(1.0)
                }
            };
        }
        Ok(value)
    }
}

/// A number as printed, and half a unit of its last digit.
fn printed(text: &str) -> Option<(f64, f64)> {
    let digits = text.split_once('.').map_or(0, |(_, digits)| digits.len());
    let value = text.replace('−', "-").parse().ok()?;
    Some((value, 0.5 * 10.0_f64.powi(-i32::try_from(digits).ok()?)))
}

fn claims(id: LessonId, step: usize) -> Vec<Claim> {
    let lesson: Value = serde_json::from_str(id.source()).expect("JSON");
    let claims = lesson["steps"][step - 1].get("claims").cloned().unwrap_or_else(|| Value::Array(Vec::new()));
    serde_path_to_error::deserialize(claims).unwrap_or_else(|error| panic!("{id}, step {step}: {error}"))
}

#[test]
fn every_claim_is_what_the_solver_answers() {
    let solver = Solver::default();
    let mut all = Vec::new();
    for (place, id, step, _, number) in steps() {
        let whole: Vec<&str> = texts(step).iter().map(|(_, text)| text["en"].as_str()).collect();
        for claim in claims(id, number) {
            assert!(whole.join("\n").contains(&claim.says), "{place} does not say {}", claim.says);
            all.push((place.clone(), claim));
        }
    }
    assert!(all.len() > 100, "{} claims", all.len());
    let failures: Vec<String> = all
        .into_par_iter()
        .filter_map(|(place, claim)| {
            let printed = printed(&claim.says);
            let wanted = claim.value.or(printed.map(|(value, _)| value));
            let tolerance = claim.tolerance.or(printed.map(|(_, half)| half));
            let (Some(wanted), Some(tolerance)) = (wanted, tolerance) else {
                return Some(format!("{place}: {} needs a value and a tolerance", claim.says));
            };
            match solver.value(&claim) {
                // Half a unit, less or more by rounding.
                Ok(value) if (value - wanted).abs() <= tolerance * (1.0 + 1e-9) => None,
                Ok(value) => Some(format!("{place} says {}, but it is {value}", claim.says)),
                Err(why) => Some(format!("{place}: {}: {why}", claim.says)),
            }
        })
        .collect();
    assert!(failures.is_empty(), "{failures:#?}");
}

/// The numbers in a text that need a reason: not the numbers of equations, figures, sections and lessons, and not
/// small whole numbers, with which modes, periods and steps are counted.
fn numbers(text: &str) -> Vec<String> {
    let mut numbers = Vec::new();
    let mut before = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(|glyph: char| glyph.is_ascii_digit()) {
        before.push_str(&rest[..start]);
        let tail = &rest[start..];
        let end = tail.find(|glyph: char| !glyph.is_ascii_digit() && glyph != '.').unwrap_or(tail.len());
        let number = tail[..end].trim_end_matches('.');
        let names = ["Eq. ", "Eqs. ", "Figure ", "section ", "lesson ", "Lesson "];
        let named = names.iter().any(|name| before.ends_with(name));
        let counts = number.parse::<u32>().is_ok_and(|count| count <= 4);
        if !named && !counts {
            numbers.push(number.to_owned());
        }
        before.push_str(&tail[..end]);
        rest = &tail[end..];
    }
    numbers
}

#[test]
fn every_number_in_the_texts_is_claimed_or_set() {
    let mut failures = Vec::new();
    for (place, id, step, view, number) in steps() {
        let mut set: Vec<f64> = Vec::new();
        let mut fragments: Vec<String> = Vec::from_iter(step.view.clone());
        if let Some(goal) = &step.goal {
            fragments.push(goal.show.clone());
            set.extend(goal.conditions.iter().flat_map(|one| [one.from, one.to]).flatten());
        }
        for fragment in fragments {
            set.extend(fragment.split(['&', '=', '+']).filter_map(|part| part.parse::<f64>().ok()));
        }
        let p = view.scenario.parameters;
        set.extend([p.alpha, p.beta, p.omega]);
        let claims = claims(id, number);
        for parameters in claims.iter().filter_map(|claim| claim.request["parameters"].as_object()) {
            set.extend(parameters.values().filter_map(Value::as_f64));
        }
        let said = claims.iter().filter_map(|claim| printed(claim.says.trim_start_matches('−')));
        set.extend(said.map(|(value, _)| value));
        for (what, text) in texts(step).into_iter().filter(|(what, _)| *what != "answer") {
            for number in numbers(&text["en"]) {
                let value: f64 = number.parse().expect("a number");
                if !set.contains(&value) {
                    failures.push(format!("{place}: {number} in {what} stands without a claim"));
                }
            }
        }
        // Of the answers the right one alone must hold.
        let right = step.question.iter().flat_map(|question| &question.answers).filter(|answer| answer.right);
        for number in right.flat_map(|answer| numbers(answer.text.get())) {
            let value: f64 = number.parse().expect("a number");
            if !set.contains(&value) {
                failures.push(format!("{place}: {number} in the right answer stands without a claim"));
            }
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

/// Translations say the same numbers as the English text, which is held to the solver, and have the same words in bold.
#[test]
fn translations_say_the_same_numbers() {
    for id in LessonId::all() {
        let lesson: Value = serde_json::from_str(id.source()).expect("JSON");
        compare(id, &lesson);
    }
}

fn compare(id: LessonId, value: &Value) {
    let all = |text: &str| -> BTreeSet<String> {
        let parts = text.split(|glyph: char| !glyph.is_ascii_digit() && glyph != '.');
        parts.map(|part| part.trim_matches('.').to_owned()).filter(|part| !part.is_empty()).collect()
    };
    match value {
        Value::Object(entries) if entries.contains_key("en") => {
            let english = entries["en"].as_str().expect("a text");
            for code in ["de", "zh"] {
                let text = entries.get(code).and_then(Value::as_str);
                let text = text.unwrap_or_else(|| panic!("{id}: no {code} of {english:?}"));
                assert!(!text.trim().is_empty(), "{id}: {code} of {english:?} is empty");
                assert_eq!(all(english), all(text), "{id}: {code} of {english:?}");
                assert_eq!(english.matches("**").count(), text.matches("**").count(), "{id}: {text:?}");
            }
        }
        Value::Object(entries) => entries.values().for_each(|entry| compare(id, entry)),
        Value::Array(entries) => entries.iter().for_each(|entry| compare(id, entry)),
        _ => {}
    }
}

#[test]
fn the_check_for_numbers_sees_them() {
    assert_eq!(
        numbers("At ω = 25.305 Eq. 57 allows 0.0038, 5 times, mode 1, 2ω₁, −1.148 and 97 %."),
        ["25.305", "0.0038", "5", "1.148", "97"]
    );
}
