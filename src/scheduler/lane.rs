//! Lanes: the newest question of each topic.

use std::any::Any;
use std::collections::BTreeMap;
use std::sync::Arc;

use super::piece::{Failure, Finding, Work};
use super::study::{Asked, Study, Take};
use crate::sentence::said;

/// How many workers may die over a piece before it counts as impossible.
const MOST_DEATHS: u32 = 2;

/// The newest question of a topic, with what may be shown until it is answered.
pub struct Lane<S> {
    generation: u64,
    study: Option<S>,
    /// Asked next, when the present study is finished or has a first picture.
    waiting: Option<S>,
    /// The last finished study before the present one.
    before: Option<S>,
    /// What the study does with its pieces under way, by ticket.
    under_way: BTreeMap<usize, Take<S>>,
    handed: usize,
    redo: Vec<Ticket>,
}

impl<S> Default for Lane<S> {
    fn default() -> Self {
        Self {
            generation: 0,
            study: None,
            waiting: None,
            before: None,
            under_way: BTreeMap::new(),
            handed: 0,
            redo: Vec::new(),
        }
    }
}

impl<S: Study> Lane<S> {
    /// Replaces the question at once: what is under way for the old one will be dropped.
    pub fn ask(&mut self, study: S) {
        self.generation += 1;
        self.redo.clear();
        self.under_way.clear();
        self.waiting = None;
        if let Some(old) = self.study.replace(study).filter(Study::finished) {
            self.before = Some(old);
        }
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

    /// Number of the newest question.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    /// The newest study, finished or not.
    pub fn study(&self) -> Option<&S> {
        self.study.as_ref()
    }

    /// The newest study, to change what it is asked.
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
        self.generation
    }

    fn next(&mut self) -> Option<Ticket> {
        self.redo.pop().or_else(|| {
            let order = self.study.as_mut()?.next()?;
            self.handed += 1;
            self.under_way.insert(self.handed, order.take);
            Some(Ticket { number: self.handed, work: order.work, deaths: 0 })
        })
    }

    fn take(&mut self, generation: u64, ticket: usize, finding: Result<Finding, Failure>) {
        if generation != self.generation {
            return;
        }
        if let (Some(study), Some(take)) = (&mut self.study, self.under_way.remove(&ticket)) {
            take(study, finding);
        }
        if self.study.as_ref().is_none_or(Study::is_replaceable)
            && let Some(next) = self.waiting.take()
        {
            self.ask(next);
        }
    }

    fn take_back(&mut self, generation: u64, ticket: Ticket) {
        if generation != self.generation {
            return;
        }
        let deaths = ticket.deaths + 1;
        if deaths < MOST_DEATHS {
            self.redo.push(Ticket { deaths, ..ticket });
        } else {
            let failure = said("the computation stopped its worker twice and was given up", &[]);
            self.take(generation, ticket.number, Err(failure));
        }
    }

    fn progress(&self) -> Option<f64> {
        self.study.as_ref().filter(|study| !study.finished()).map(Study::progress)
    }

    fn is_sketched(&self) -> bool {
        self.redo.is_empty() && self.study.as_ref().is_some_and(|study| !study.finished() && study.sketches())
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
