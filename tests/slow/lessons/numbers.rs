//! No number in a text stands without a reason, and translations say the same numbers.

use std::collections::BTreeSet;

use harvester_lab::app::lessons::LessonId;
use serde_json::Value;

use super::claims::{claims, printed};
use super::{steps, texts};

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
        fragments.extend(step.question.as_ref().and_then(|question| question.reveal.clone()));
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
