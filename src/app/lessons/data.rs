//! What a lesson's file holds. `tests/slow/lessons/` runs every step; what it checks beside (`claims`) the page ignores.
//!
//! Read by hand: derived readers of these types would weigh as much in the page as all the lessons.

use std::collections::BTreeMap;

use serde_json::Value;

use super::condition::Condition;
use crate::app::text::language;

/// A text by language; `**` begins and ends what is set in bold.
#[derive(Debug, Clone, PartialEq)]
pub struct Text(pub BTreeMap<String, String>);

impl Text {
    /// In the page's language, else in English.
    pub fn get(&self) -> &str {
        self.0.get(language().code()).or_else(|| self.0.get("en")).map_or("", String::as_str)
    }
}

/// A lesson.
#[derive(Debug, Clone, PartialEq)]
pub struct Lesson {
    /// Its title.
    pub title: Text,
    /// What it is about, in one line.
    pub summary: Text,
    /// How long it takes.
    pub minutes: u32,
    /// Its steps, in order.
    pub steps: Vec<Step>,
}

impl Text {
    fn read(value: &Value) -> Option<Self> {
        let texts = value.as_object()?.iter();
        texts
            .map(|(language, text)| Some((language.clone(), text.as_str()?.to_owned())))
            .collect::<Option<_>>()
            .map(Self)
    }
}

impl Lesson {
    /// Reads a file; `None` when something is missing or of another kind.
    pub(super) fn read(json: &str) -> Option<Self> {
        let value: Value = serde_json::from_str(json).ok()?;
        Some(Self {
            title: Text::read(&value["title"])?,
            summary: Text::read(&value["summary"])?,
            minutes: u32::try_from(value["minutes"].as_u64()?).ok()?,
            steps: list(&value["steps"], Step::read)?,
        })
    }

    /// A step by its number from 1; the last one for numbers beyond.
    pub fn step(&self, number: usize) -> Option<&Step> {
        self.steps.get(number.clamp(1, self.steps.len()) - 1)
    }
}

/// A step of a lesson: what is said, shown, asked and to be done.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// What is said.
    pub text: Text,
    /// The view that the page is set to, as a link's fragment; it stays as it is without.
    pub view: Option<String>,
    /// What is to be done, and checked.
    pub goal: Option<Goal>,
    /// What is asked.
    pub question: Option<Question>,
}

/// Something to be done on the page.
#[derive(Debug, Clone, PartialEq)]
pub struct Goal {
    /// What is to be done.
    pub task: Text,
    /// When it is reached: all of them hold at the same time.
    pub conditions: Vec<Condition>,
    /// A view in which it is reached, as a link's fragment.
    pub show: String,
    /// What is said then.
    pub reaction: Text,
}

/// A question with answers to choose from.
#[derive(Debug, Clone, PartialEq)]
pub struct Question {
    /// What is asked.
    pub text: Text,
    /// What can be answered.
    pub answers: Vec<Answer>,
}

/// An answer that can be chosen.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// The answer.
    pub text: Text,
    /// What is said to it.
    pub reply: Text,
    /// Whether it is right.
    pub right: bool,
}

/// A list with at least one entry.
fn list<T>(value: &Value, read: fn(&Value) -> Option<T>) -> Option<Vec<T>> {
    value.as_array().filter(|entries| !entries.is_empty())?.iter().map(read).collect()
}

fn word(value: &Value) -> Option<String> {
    value.as_str().map(str::to_owned)
}

impl Step {
    fn read(value: &Value) -> Option<Self> {
        // What is there must be right; what is not there need not be.
        let goal = value.get("goal").map(Goal::read);
        let question = value.get("question").map(Question::read);
        Some(Self {
            text: Text::read(&value["text"])?,
            view: value.get("view").and_then(word),
            goal: if let Some(goal) = goal { Some(goal?) } else { None },
            question: if let Some(question) = question { Some(question?) } else { None },
        })
    }
}

impl Goal {
    fn read(value: &Value) -> Option<Self> {
        Some(Self {
            task: Text::read(&value["task"])?,
            conditions: list(&value["conditions"], Condition::read)?,
            show: word(&value["show"])?,
            reaction: Text::read(&value["reaction"])?,
        })
    }
}

impl Question {
    fn read(value: &Value) -> Option<Self> {
        Some(Self { text: Text::read(&value["text"])?, answers: list(&value["answers"], Answer::read)? })
    }
}

impl Answer {
    fn read(value: &Value) -> Option<Self> {
        Some(Self {
            text: Text::read(&value["text"])?,
            reply: Text::read(&value["reply"])?,
            right: value["right"].as_bool().unwrap_or_default(),
        })
    }
}
