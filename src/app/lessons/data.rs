//! What a lesson's file holds. `tests/lessons.rs` runs every step; what it checks beside (`claims`) the page ignores.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::LANGUAGE;
use super::facts::Condition;

/// A text by language; `**` begins and ends what is set in bold.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(transparent)]
pub struct Text(pub BTreeMap<String, String>);

impl Text {
    /// In the page's language, else in English.
    pub fn get(&self) -> &str {
        self.0.get(LANGUAGE).or_else(|| self.0.get("en")).map_or("", String::as_str)
    }
}

/// A lesson.
#[derive(Debug, Clone, PartialEq, Deserialize)]
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

impl Lesson {
    /// A step by its number from 1; the last one for numbers beyond.
    pub fn step(&self, number: usize) -> Option<&Step> {
        self.steps.get(number.clamp(1, self.steps.len()) - 1)
    }
}

/// A step of a lesson: what is said, shown, asked and to be done.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Step {
    /// What is said.
    pub text: Text,
    /// The view that the page is set to, as a link's fragment; it stays as it is without.
    #[serde(default)]
    pub view: Option<String>,
    /// What is to be done, and checked.
    #[serde(default)]
    pub goal: Option<Goal>,
    /// What is asked.
    #[serde(default)]
    pub question: Option<Question>,
}

/// Something to be done on the page.
#[derive(Debug, Clone, PartialEq, Deserialize)]
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
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Question {
    /// What is asked.
    pub text: Text,
    /// What can be answered.
    pub answers: Vec<Answer>,
}

/// An answer that can be chosen.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Answer {
    /// The answer.
    pub text: Text,
    /// What is said to it.
    pub reply: Text,
    /// Whether it is right.
    #[serde(default)]
    pub right: bool,
}
