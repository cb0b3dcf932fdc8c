//! Lanes: the newest question of each topic.

use std::any::Any;
use std::sync::Arc;

use super::piece::{Failure, Finding, Work};
use super::study::{Asked, Study, Take};
use crate::sentence::said;

/// How many workers may die over a piece before it counts as impossible.
const MOST_DEATHS: u32 = 2;

/// The newest question of a topic, with what may be shown until it is answered.
pub struct Lane<S> {
    study: Option<S>,
    /// Asked next, when the present study is finished or has a first picture.
    waiting: Option<S>,
    /// The last finished study before the present one.
    before: Option<S>,
    /// What the study does with its pieces under way, by ticket.
    under_way: Vec<(usize, Take<S>)>,
    book: Book,
}

/// What a lane keeps whatever its study, so that it is compiled once.
#[derive(Default)]
struct Book {
    generation: u64,
    handed: usize,
    redo: Vec<Ticket>,
    /// How far, 0 to 1, pieces under way are that tell it, by ticket.
    parts: Vec<(usize, f64)>,
}

impl Book {
    /// Nobody waits any more for what is under way.
    fn turn_over(&mut self) {
        self.generation += 1;
        self.redo.clear();
        self.parts.clear();
    }

    /// A ticket for a piece not handed out before.
    fn ticket(&mut self, work: Arc<dyn Work>) -> Ticket {
        self.handed += 1;
        Ticket { number: self.handed, work, deaths: 0 }
    }

    fn hear(&mut self, generation: u64, ticket: usize, part: f64) {
        if self.ends(generation, ticket) {
            self.parts.push((ticket, part));
        }
    }

    /// Forgets how far a piece is. Whether it belongs to the newest question.
    fn ends(&mut self, generation: u64, ticket: usize) -> bool {
        self.parts.retain(|(of, _)| *of != ticket);
        generation == self.generation
    }

    /// Has a piece done again whose worker died; its number when it is to be given up.
    fn again(&mut self, generation: u64, ticket: Ticket) -> Option<usize> {
        let deaths = ticket.deaths + 1;
        if !self.ends(generation, ticket.number) {
            None
        } else if deaths < MOST_DEATHS {
            self.redo.push(Ticket { deaths, ..ticket });
            None
        } else {
            Some(ticket.number)
        }
    }

    /// What pieces under way are together, in pieces.
    fn parts(&self) -> f64 {
        self.parts.iter().map(|(_, part)| part).sum()
    }
}

impl<S> Default for Lane<S> {
    fn default() -> Self {
        Self { study: None, waiting: None, before: None, under_way: Vec::new(), book: Book::default() }
    }
}

impl<S: Study> Lane<S> {
    /// Replaces the question at once: what is under way for the old one will be dropped.
    pub fn ask(&mut self, study: S) {
        self.drop_work();
        if let Some(old) = self.study.replace(study).filter(Study::finished) {
            self.before = Some(old);
        }
    }

    /// Changes what the study goes on with, as when it is stopped or taken up again: what is under way for it will be dropped,
    /// and nothing waits any more.
    pub fn redirect(&mut self, change: impl FnOnce(&mut S)) {
        self.drop_work();
        if let Some(study) = &mut self.study {
            change(study);
        }
    }

    fn drop_work(&mut self) {
        self.book.turn_over();
        self.under_way.clear();
        self.waiting = None;
    }

    /// Asks as soon as the present question is answered, or has a first picture, instead of any question that waits: for
    /// questions that change faster than they are answered.
    pub fn offer(&mut self, study: S) {
        if self.study.as_ref().is_none_or(Study::is_replaceable) {
            self.ask(study);
        } else {
            self.waiting = Some(study);
        }
    }

    /// Number of the newest question, or of the newest way to go on with it.
    pub fn generation(&self) -> u64 {
        self.book.generation
    }

    /// The newest study, finished or not.
    pub fn study(&self) -> Option<&S> {
        self.study.as_ref()
    }

    /// The newest study, to add to what it is asked.
    pub fn study_mut(&mut self) -> Option<&mut S> {
        self.study.as_mut()
    }

    /// The study asked for last: one that waits, or else the newest.
    pub fn wanted(&self) -> Option<&S> {
        self.waiting.as_ref().or(self.study.as_ref())
    }

    /// The newest finished study.
    pub fn finished(&self) -> Option<&S> {
        self.study.as_ref().filter(|study| study.finished()).or(self.before.as_ref())
    }
}

/// A lane whatever its study.
pub trait Traffic: Any {
    /// Number of the newest question.
    fn generation(&self) -> u64;
    /// The next piece.
    fn next(&mut self) -> Option<Ticket>;
    /// Takes a finding, unless it belongs to an older question.
    fn take(&mut self, generation: u64, ticket: usize, finding: Result<Finding, Failure>);
    /// Hears how far, 0 to 1, a piece under way is, unless it belongs to an older question.
    fn hear(&mut self, generation: u64, ticket: usize, part: f64);
    /// Takes back a piece whose worker died, unless it belongs to an older question.
    fn take_back(&mut self, generation: u64, ticket: Ticket);
    /// Done part, 0 to 1; `None` when nothing is being computed.
    fn progress(&self) -> Option<f64>;
    /// Whether the next piece is of a first, coarse picture that takes milliseconds.
    fn is_sketched(&self) -> bool;
}

/// A piece under way, and how often it has killed its worker.
#[derive(Clone)]
pub struct Ticket {
    /// The lane's number for it.
    pub number: usize,
    /// What to do.
    pub work: Arc<dyn Work>,
    deaths: u32,
}

impl<S: Study> Traffic for Lane<S> {
    fn generation(&self) -> u64 {
        self.book.generation
    }

    fn next(&mut self) -> Option<Ticket> {
        self.book.redo.pop().or_else(|| {
            let order = self.study.as_mut()?.next()?;
            let ticket = self.book.ticket(order.work);
            self.under_way.push((ticket.number, order.take));
            Some(ticket)
        })
    }

    fn take(&mut self, generation: u64, ticket: usize, finding: Result<Finding, Failure>) {
        if !self.book.ends(generation, ticket) {
            return;
        }
        if let Some(study) = &mut self.study
            && let Some(place) = self.under_way.iter().position(|(of, _)| *of == ticket)
        {
            self.under_way.swap_remove(place).1(study, finding);
        }
        if self.study.as_ref().is_none_or(Study::is_replaceable)
            && let Some(next) = self.waiting.take()
        {
            self.ask(next);
        }
    }

    fn hear(&mut self, generation: u64, ticket: usize, part: f64) {
        self.book.hear(generation, ticket, part);
    }

    fn take_back(&mut self, generation: u64, ticket: Ticket) {
        if let Some(number) = self.book.again(generation, ticket) {
            let failure = said("the computation stopped its worker twice and was given up", &[]);
            self.take(generation, number, Err(failure));
        }
    }

    fn progress(&self) -> Option<f64> {
        let study = self.study.as_ref().filter(|study| !study.finished())?;
        Some(study.progress() + study.share() * self.book.parts())
    }

    fn is_sketched(&self) -> bool {
        self.book.redo.is_empty()
            && self.study.as_ref().is_some_and(|study| !study.finished() && study.sketches())
    }
}

/// Lanes by the kinds of their studies, most urgent first.
pub struct Lanes {
    lanes: Vec<(&'static str, Box<dyn Traffic>)>,
    urgent: usize,
}

impl Lanes {
    /// The first `urgent` of these are served also while the user's hand moves.
    pub fn new(lanes: Vec<(&'static str, Box<dyn Traffic>)>, urgent: usize) -> Self {
        Self { lanes, urgent }
    }

    /// How many are urgent.
    pub fn urgent(&self) -> usize {
        self.urgent
    }

    /// The lane of a kind of study.
    pub fn lane<S: Study>(&self) -> Option<&Lane<S>> {
        self.lanes.iter().find_map(|(_, lane)| {
            let lane: &dyn Any = &**lane;
            lane.downcast_ref()
        })
    }

    /// The same, to ask something.
    pub fn lane_mut<S: Study>(&mut self) -> Option<&mut Lane<S>> {
        self.lanes.iter_mut().find_map(|(_, lane)| {
            let lane: &mut dyn Any = &mut **lane;
            lane.downcast_mut()
        })
    }

    /// The newest study of a kind, finished or not.
    pub fn study<S: Study>(&self) -> Option<&S> {
        self.lane()?.study()
    }

    /// The newest finished study of a kind.
    pub fn finished<S: Study>(&self) -> Option<&S> {
        self.lane()?.finished()
    }

    /// The study of a kind that was asked for last.
    pub fn wanted<S: Study>(&self) -> Option<&S> {
        self.lane()?.wanted()
    }

    /// Number of the newest question to a kind of study.
    pub fn generation<S: Study>(&self) -> u64 {
        self.lane::<S>().map_or(0, Lane::generation)
    }

    /// Asks a question at once, unless it was the last of its kind; nothing when no study of it can begin.
    pub fn ask<S: Asked>(&mut self, question: S::Question, begin: impl FnOnce(S::Question) -> Option<S>) {
        self.put(question, begin, Lane::ask);
    }

    /// The same when the present one of its kind is answered or has a first picture: for questions that change faster than
    /// they are answered.
    pub fn offer<S: Asked>(&mut self, question: S::Question, begin: impl FnOnce(S::Question) -> Option<S>) {
        self.put(question, begin, Lane::offer);
    }

    fn put<S: Asked>(
        &mut self,
        question: S::Question,
        begin: impl FnOnce(S::Question) -> Option<S>,
        put: fn(&mut Lane<S>, S),
    ) {
        if self.wanted().is_none_or(|wanted: &S| *wanted.asked() != question)
            && let Some(study) = begin(question)
            && let Some(lane) = self.lane_mut()
        {
            put(lane, study);
        }
    }

    /// All of them, whatever their studies.
    pub fn traffic(&mut self) -> Vec<&mut dyn Traffic> {
        self.lanes.iter_mut().map(|(_, lane)| &mut **lane).collect()
    }

    /// Names and done parts, 0 to 1, of what is under way.
    pub fn progress(&self) -> impl Iterator<Item = (&'static str, f64)> {
        self.lanes.iter().filter_map(|(name, lane)| Some((*name, lane.progress()?)))
    }
}
