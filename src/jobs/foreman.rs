//! Who does what: hands pieces of the studies to workers, newest questions only, and gives a dead worker's piece to
//! another. It knows nothing of how workers are made or reached.

use super::study::Study;
use super::work::{Finding, Work};

/// Done part of a study that counts as a first picture of it.
const FIRST_PICTURE: f64 = 0.02;
/// How many workers may die over a piece before it counts as impossible.
const MOST_DEATHS: u32 = 2;

/// The newest question of a topic, with what may be shown until it is answered.
#[derive(Debug)]
pub struct Lane<S> {
    generation: u64,
    study: Option<S>,
    /// Asked next, when the present study is finished.
    waiting: Option<S>,
    /// The last finished study before the present one.
    before: Option<S>,
    redo: Vec<Piece>,
}

impl<S> Default for Lane<S> {
    fn default() -> Self {
        Self { generation: 0, study: None, waiting: None, before: None, redo: Vec::new() }
    }
}

impl<S: Study> Lane<S> {
    /// Replaces the question at once: what is under way for the old one will be dropped.
    pub fn ask(&mut self, study: S) {
        self.generation += 1;
        self.redo.clear();
        self.waiting = None;
        if let Some(old) = self.study.replace(study).filter(Study::finished) {
            self.before = Some(old);
        }
    }

    /// Asks as soon as the present question is answered, instead of any question that waits: for questions that change
    /// faster than they are answered.
    pub fn offer(&mut self, study: S) {
        if self.study.as_ref().is_none_or(Study::finished) {
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

    /// Begins with the question that waits, once the present one is answered.
    fn go_on(&mut self) {
        if self.study.as_ref().is_none_or(Study::finished)
            && let Some(next) = self.waiting.take()
        {
            self.ask(next);
        }
    }
}

/// A lane whatever its study.
pub trait Traffic {
    /// Number of the newest question.
    fn generation(&self) -> u64;
    /// The next piece.
    fn next(&mut self) -> Option<Piece>;
    /// Takes a finding, unless it belongs to an older question.
    fn take(&mut self, generation: u64, ticket: usize, finding: Result<Finding, String>);
    /// Takes back a piece whose worker died, unless it belongs to an older question.
    fn take_back(&mut self, generation: u64, piece: Piece);
    /// Done part, 0 to 1; `None` when nothing is being computed.
    fn progress(&self) -> Option<f64>;
    /// Whether the next piece is of a first, coarse picture that takes milliseconds.
    fn is_sketched(&self) -> bool;
}

/// A piece of work with its ticket and how often it has killed its worker.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// The study's number for it.
    pub ticket: usize,
    /// What to do.
    pub work: Work,
    deaths: u32,
}

impl<S: Study> Traffic for Lane<S> {
    fn generation(&self) -> u64 {
        self.generation
    }

    fn next(&mut self) -> Option<Piece> {
        self.redo.pop().or_else(|| {
            let (ticket, work) = self.study.as_mut()?.next()?;
            Some(Piece { ticket, work, deaths: 0 })
        })
    }

    fn take(&mut self, generation: u64, ticket: usize, finding: Result<Finding, String>) {
        if generation == self.generation
            && let Some(study) = &mut self.study
        {
            study.take(ticket, finding);
            self.go_on();
        }
    }

    fn take_back(&mut self, generation: u64, piece: Piece) {
        if generation != self.generation {
            return;
        }
        let deaths = piece.deaths + 1;
        if deaths < MOST_DEATHS {
            self.redo.push(Piece { deaths, ..piece });
        } else {
            let message = "the computation stopped its worker twice and was given up";
            self.take(generation, piece.ticket, Err(message.to_owned()));
        }
    }

    fn progress(&self) -> Option<f64> {
        self.study.as_ref().filter(|study| !study.finished()).map(Study::progress)
    }

    fn is_sketched(&self) -> bool {
        self.redo.is_empty() && self.study.as_ref().is_some_and(|study| !study.finished() && study.sketches())
    }
}

/// What a worker is doing.
#[derive(Debug, Clone)]
struct Assignment {
    number: u64,
    lane: usize,
    generation: u64,
    piece: Piece,
}

/// The book of who does what.
#[derive(Debug, Default)]
pub struct Foreman {
    busy: Vec<Option<Assignment>>,
    handed: u64,
}

impl Foreman {
    /// A foreman of this many workers, numbered from 0.
    pub fn new(workers: usize) -> Self {
        Self { busy: vec![None; workers], handed: 0 }
    }

    /// The next piece for an idle worker and the number under which it is to be returned: from a lane that is being
    /// sketched, else from the first of the `urgent` lanes that has one, else from the first of the others that has no
    /// first picture yet, else from the first of the others.
    pub fn assign(
        &mut self,
        worker: usize,
        lanes: &mut [&mut dyn Traffic],
        urgent: usize,
    ) -> Option<(u64, Work)> {
        let slot = self.busy.get_mut(worker).filter(|slot| slot.is_none())?;
        let mut order: Vec<usize> = (0..lanes.len()).collect();
        let pictured = |lane: &usize| lanes[*lane].progress().is_none_or(|done| done >= FIRST_PICTURE);
        order[urgent.min(lanes.len())..].sort_by_key(pictured);
        order.sort_by_key(|lane| !lanes[*lane].is_sketched());
        for lane in order {
            let traffic = &mut lanes[lane];
            if let Some(piece) = traffic.next() {
                self.handed += 1;
                let work = piece.work.clone();
                *slot =
                    Some(Assignment { number: self.handed, lane, generation: traffic.generation(), piece });
                return Some((self.handed, work));
            }
        }
        None
    }

    /// A worker returned what it found under a number; anything but its present piece is ignored.
    pub fn returned(
        &mut self,
        worker: usize,
        number: u64,
        finding: Result<Finding, String>,
        lanes: &mut [&mut dyn Traffic],
    ) {
        let Some(slot) = self.busy.get_mut(worker) else { return };
        if let Some(done) = slot.take_if(|assignment| assignment.number == number)
            && let Some(lane) = lanes.get_mut(done.lane)
        {
            lane.take(done.generation, done.piece.ticket, finding);
        }
    }

    /// A worker died: its piece goes back.
    pub fn died(&mut self, worker: usize, lanes: &mut [&mut dyn Traffic]) {
        if let Some(lost) = self.busy.get_mut(worker).and_then(Option::take)
            && let Some(lane) = lanes.get_mut(lost.lane)
        {
            lane.take_back(lost.generation, lost.piece);
        }
    }

    /// Workers whose piece nobody waits for any more.
    pub fn obsolete<'a>(&'a self, lanes: &'a [&mut dyn Traffic]) -> impl Iterator<Item = usize> + 'a {
        self.busy.iter().enumerate().filter_map(|(worker, slot)| {
            let assignment = slot.as_ref()?;
            let lane = lanes.get(assignment.lane)?;
            (lane.generation() != assignment.generation).then_some(worker)
        })
    }

    /// Whether a worker is at work.
    pub fn is_busy(&self, worker: usize) -> bool {
        self.busy.get(worker).is_some_and(Option::is_some)
    }

    /// Number of workers at work.
    pub fn busy_count(&self) -> usize {
        self.busy.iter().flatten().count()
    }
}

#[cfg(test)]
mod tests;
