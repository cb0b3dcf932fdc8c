//! What a lesson's file holds. `tests/slow/lessons/` runs every step of ours; what it checks beside (`claims`) the page
//! ignores.
//!
//! Read by hand: derived readers of these types would weigh as much in the page as all the lessons, and would not say so
//! well what is wrong with a lesson of one's own.

use std::collections::BTreeMap;

use serde_json::Value;

use super::condition::Condition;
use super::part::{Part, Read};
use crate::app::text::language;
use crate::sentence::said;

/// A text by language; `**` begins and ends what is set in bold.
#[derive(Debug, Clone, PartialEq)]
pub struct Text(pub BTreeMap<String, String>);

impl Text {
    /// In the page's language, else in English.
    pub fn get(&self) -> &str {
        self.0.get(language().code()).or_else(|| self.0.get("en")).map_or("", String::as_str)
    }

    /// Texts by language, or one in English.
    fn read(part: &Part<'_>) -> Read<Self> {
        let texts: BTreeMap<String, String> = match part.value {
            Value::String(text) => BTreeMap::from([("en".to_owned(), text.clone())]),
            Value::Object(texts) => texts
                .iter()
                .map(|(language, text)| Some((language.clone(), text.as_str()?.to_owned())))
                .collect::<Option<_>>()
                .unwrap_or_default(),
            _ => BTreeMap::new(),
        };
        if !texts.contains_key("en") {
            return part.wants(|at| said("{at} must be a text, or texts by language of which one is en", at));
        }
        if texts.values().any(|text| text.matches("**").count() % 2 == 1) {
            return part.wants(|at| said("{at} has ** that begin bold words and do not end them", at));
        }
        Ok(Self(texts))
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
    /// Lines drawn beside its title, from 0 to 99 across and up.
    pub picture: Vec<Vec<[u8; 2]>>,
    /// Its steps, in order.
    pub steps: Vec<Step>,
}

impl Lesson {
    /// Reads a file.
    ///
    /// # Errors
    /// What is wrong, and where.
    pub fn read(json: &str) -> Read<Self> {
        let value: Value = serde_json::from_str(json).map_err(|error| {
            let place: [(&str, &dyn crate::sentence::Say); 2] =
                [("line", &error.line()), ("column", &error.column())];
            said("it is not JSON from line {line}, column {column} on", &place)
        })?;
        let part = Part { value: &value, at: String::new() };
        part.knows(&["title", "summary", "minutes", "picture", "steps"])?;
        let minutes = part.entry("minutes");
        let count = minutes.value.as_u64().and_then(|minutes| u32::try_from(minutes).ok());
        Ok(Self {
            title: Text::read(&part.entry("title"))?,
            summary: Text::read(&part.entry("summary"))?,
            minutes: count.map_or_else(|| minutes.wants(|at| said("{at} must be a whole number", at)), Ok)?,
            picture: part.optional("picture", lines)?.unwrap_or_default(),
            steps: part.entry("steps").each(Step::read)?,
        })
    }

    /// A step by its number from 1; the last one for numbers beyond.
    pub fn step(&self, number: usize) -> Option<&Step> {
        self.steps.get(number.clamp(1, self.steps.len()) - 1)
    }
}

/// Lines written as `0,0 50,99 99,0;..`.
fn lines(part: &Part<'_>) -> Read<Vec<Vec<[u8; 2]>>> {
    let number = |text: &str| text.parse().ok().filter(|number| *number <= 99_u8);
    let place = |text: &str| text.split_once(',').and_then(|(x, y)| Some([number(x)?, number(y)?]));
    let line = |text: &str| text.split_whitespace().map(place).collect::<Option<Vec<_>>>();
    let read = part.value.as_str().and_then(|text| text.split(';').map(line).collect());
    let wrong = |at: &[(&str, &dyn crate::sentence::Say)]| {
        said(
            "{at} must be lines such as 0,0 50,99 99,0 with numbers from 0 to 99 and ; between two lines",
            at,
        )
    };
    read.map_or_else(|| part.wants(wrong), Ok)
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
    /// The view that shows what comes of it, as a link's fragment: the answers are predictions then, about which nothing
    /// is said until it is shown.
    pub reveal: Option<String>,
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

impl Step {
    /// Whether it asks for another tab.
    pub fn asks_for_a_tab(&self) -> bool {
        self.goal.iter().flat_map(|goal| &goal.conditions).any(|condition| condition.at == "/view/tab")
    }

    fn read(part: &Part<'_>) -> Read<Self> {
        part.knows(&["text", "view", "goal", "question", "claims"])?;
        // What is there must be right; what is not there need not be.
        Ok(Self {
            text: Text::read(&part.entry("text"))?,
            view: part.optional("view", |part| part.word())?,
            goal: part.optional("goal", Goal::read)?,
            question: part.optional("question", Question::read)?,
        })
    }
}

impl Goal {
    fn read(part: &Part<'_>) -> Read<Self> {
        part.knows(&["task", "conditions", "show", "reaction"])?;
        Ok(Self {
            task: Text::read(&part.entry("task"))?,
            conditions: part.entry("conditions").each(|part| {
                let wrong = |at: &[(&str, &dyn crate::sentence::Say)]| {
                    said("{at} must have an entry at that names a fact, and may have from, to and is", at)
                };
                Condition::read(part.value).map_or_else(|| part.wants(wrong), Ok)
            })?,
            show: part.entry("show").word()?,
            reaction: Text::read(&part.entry("reaction"))?,
        })
    }
}

impl Question {
    fn read(part: &Part<'_>) -> Read<Self> {
        part.knows(&["text", "answers", "reveal"])?;
        let answers = part.entry("answers");
        let read: Vec<Answer> = answers.each(Answer::read)?;
        if read.iter().filter(|answer| answer.right).count() != 1 {
            return answers.wants(|at| said("of {at} exactly one must be right", at));
        }
        let text = Text::read(&part.entry("text"))?;
        Ok(Self { text, answers: read, reveal: part.optional("reveal", |part| part.word())? })
    }
}

impl Answer {
    fn read(part: &Part<'_>) -> Read<Self> {
        part.knows(&["text", "reply", "right"])?;
        Ok(Self {
            text: Text::read(&part.entry("text"))?,
            reply: Text::read(&part.entry("reply"))?,
            right: part.value.get("right").and_then(Value::as_bool).unwrap_or_default(),
        })
    }
}
