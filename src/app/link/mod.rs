//! Links: a view as the readable, versioned fragment of an address, `#v=1&alpha=1e-4&omega=8.0969&tab=stability`.
//!
//! Names are spelled as in the JSON of a view. Only what differs from the paper's numbers is written, so a link says all
//! that is special about what it shows, and means the same in a later version that opens with something else. What is
//! not usable is reported and left at its usual value; everything else is loaded.
//!
//! `app::link` turns a view into a fragment and back by way of the view's JSON: an entry is a leaf of it, and what it may
//! be is what the view takes when it is read and checked (`link/field.rs`). So a new field of `View` is in links by itself,
//! with the range of its check; the test that sends 1,000 random views there and back names every field. A link leaves out
//! what is as in the paper, not as in the view that the page opens with, so that it means the same in a later version; a
//! test holds two old links to that.

mod entry;
mod field;

#[cfg(test)]
mod tests;

use std::fmt;

use serde_json::Value;

use super::view::View;
use crate::app::text::{fill, say};
use crate::scenario::Scenario;
use crate::sentence::{Say as _, Sentence, said};
pub use entry::{edit, entries};
use field::{Field, fields};

/// Version of the links written here; older ones are read.
const VERSION: u32 = 1;
/// A link with more entries than this is not one of ours.
const MOST_ENTRIES: usize = 200;
/// Characters of a wrong value that are repeated in a message, and wrong entries that are named.
const SHOWN_CHARACTERS: usize = 40;
const SHOWN_PROBLEMS: usize = 5;

/// An entry of a link that could not be used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// Its name as given, shortened.
    pub name: String,
    /// Its value as given, shortened.
    pub value: String,
    /// What is wrong, with what is allowed.
    pub reason: Sentence,
}

impl Problem {
    fn new(name: &str, value: &str, reason: Sentence) -> Self {
        let short = |text: &str| {
            let start: String = text.chars().take(SHOWN_CHARACTERS).collect();
            if start.len() < text.len() { start + "…" } else { start }
        };
        Self { name: short(name), value: short(value), reason }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} = {} ({})", self.name, self.value, say(&self.reason))
    }
}

/// What to tell the user about a link with problems.
pub fn complaint(problems: &[Problem]) -> Option<String> {
    if problems.is_empty() {
        return None;
    }
    let mut named: Vec<String> = problems.iter().take(SHOWN_PROBLEMS).map(Problem::to_string).collect();
    if problems.len() > SHOWN_PROBLEMS {
        named.push(fill("and {more} more", &[("more", &(problems.len() - SHOWN_PROBLEMS))]));
    }
    Some(fill("Not everything in this link could be used: {problems}.", &[("problems", &named.join("; "))]))
}

/// The view as a fragment, without the `#`.
pub fn write(view: &View) -> String {
    let (value, usual) = (view.to_value(), usual(view, &View::default()).to_value());
    let mut writer = form_urlencoded::Serializer::new(String::new());
    writer.append_pair("v", &VERSION.to_string());
    let mut device_written = false;
    for field in fields() {
        let given = field.of(&value);
        // The device's own entry says that there is one, when none of its dimensions does.
        let differs =
            if field.is_device() { !given.is_null() && !device_written } else { given != field.of(&usual) };
        if differs {
            device_written |= field.is_dimension();
            writer.append_pair(&field.name, &field.write(given));
        }
    }
    writer.finish()
}

/// Reads a fragment, with or without the `#`. How `present` looks (its theme, its size of type) stays unless the link
/// names it. A fragment that is no link at all changes nothing.
pub fn read(fragment: &str, present: &View) -> (View, Vec<Problem>) {
    let fields = fields();
    let usual = usual(&View::default(), present);
    let plain = usual.to_value();
    let (mut given, mut problems, mut recognised) = (Vec::<Given<'_>>::new(), Vec::new(), false);
    let fragment = fragment.trim().trim_start_matches('#').as_bytes();
    for (position, (name, text)) in form_urlencoded::parse(fragment).take(MOST_ENTRIES).enumerate() {
        let mut wrong = |reason| problems.push((position, Problem::new(&name, &text, reason)));
        if name == "v" {
            recognised = true;
            if !text.parse().is_ok_and(|version: u32| (1..=VERSION).contains(&version)) {
                wrong(said("this page knows version {version}", &[("version", &VERSION)]));
            }
            continue;
        }
        let Some((place, field)) = fields.iter().enumerate().find(|(_, field)| field.name == name) else {
            wrong(unknown());
            continue;
        };
        recognised = true;
        match field.read(&text, &plain) {
            Ok(value) => {
                given.retain(|other| other.place != place);
                given.push(Given { field, place, position, value, text: text.into_owned() });
            }
            Err(reason) => wrong(reason),
        }
    }
    let view = if recognised { agree(given, usual, &plain, &mut problems) } else { present.clone() };
    problems.sort_by_key(|(position, _)| *position);
    (view, problems.into_iter().map(|(_, problem)| problem).collect())
}

/// What is wrong with an entry of another name.
fn unknown() -> Sentence {
    said("not a name this page knows", &[])
}

/// An entry of the right kind.
#[derive(Clone)]
struct Given<'a> {
    field: &'a Field,
    /// Its place among all of them, and in the link.
    place: usize,
    position: usize,
    value: Value,
    text: String,
}

/// The view of entries each of which is of the right kind, less those that are out of their range or do not go together with
/// the others.
fn agree(
    mut given: Vec<Given<'_>>,
    usual: View,
    plain: &Value,
    problems: &mut Vec<(usize, Problem)>,
) -> View {
    let assemble = |given: &[Given<'_>]| {
        let mut value = plain.clone();
        for Given { field, value: new, .. } in given {
            field.set(&mut value, new);
        }
        View::from_value(value).unwrap_or_else(|_| usual.clone())
    };
    // Of several that could be blamed, the more special one is: a start state rather than the number of modes.
    given.sort_by_key(|given| given.place);
    loop {
        let view = assemble(&given);
        let Err(fault) = view.check() else { return view };
        let mut blame = |given: &mut Vec<Given<'_>>, i: usize, reason| {
            let Given { field, text, position, .. } = given.remove(i);
            problems.push((position, Problem::new(&field.name, &text, reason)));
        };
        let own = |i: usize| Some((i, given[i].field.allowed(&fault)?));
        if let Some((i, allowed)) = (0..given.len()).find_map(own) {
            blame(&mut given, i, allowed);
            continue;
        }
        let suspects: Vec<usize> =
            (0..given.len()).filter(|i| given[*i].field.is_part_of(fault.part)).collect();
        let mends = |i: &usize| {
            let others: Vec<_> = (0..given.len()).filter(|j| j != i).map(|j| given[j].clone()).collect();
            !matches!(assemble(&others).check(), Err(still) if still.part == fault.part)
        };
        let culprits = suspects.iter().rev().find(|i| mends(i)).map_or(suspects.clone(), |one| vec![*one]);
        if culprits.is_empty() {
            return usual;
        }
        for i in culprits.into_iter().rev() {
            blame(&mut given, i, fault.say());
        }
    }
}

/// What a link leaves out: the paper's numbers and a plain view, as long as links of version 1 are read, and the device's
/// dimensions when `of` has some; looks as in `present`.
fn usual(of: &View, present: &View) -> View {
    let device = of.scenario.device.map(|_| Default::default());
    let scenario = Scenario { device, ..Scenario::default() };
    View { scenario, ..View::default() }.with_looks_of(present)
}
