//! The crew: workers that compute beside the frame, and the studies they work on.
//!
//! [`Crew`] brings the studies' pieces to whatever [`Workers`] there are: web workers in the browser (`bridge`), or the
//! caller's own thread in tests. Findings are taken in as they come, also while the page is hidden.

mod bench;
mod inline;
mod studies;

pub use inline::Inline;
pub(super) use studies::{Followed, Studies};

use std::sync::Arc;

use super::clock::milliseconds;
use crate::questions::answers::Answers;
use crate::scheduler::foreman::Foreman;
use crate::scheduler::{Failure, Finding, Work};

/// A worker may go on with a piece that nobody waits for any more for this long; then it is replaced.
const OBSOLETE_MS: f64 = 2000.0;
/// Longest time for a piece, since it last told how far it is; a request asked from outside may take longer.
const LONGEST_MS: f64 = 60_000.0;
const LONGEST_ANSWER_MS: f64 = 3_600_000.0;

/// Places where pieces are carried out, numbered from 0.
pub trait Workers {
    /// How many there are.
    fn count(&self) -> usize;

    /// Begins a piece; what it finds is brought to [`Crew::returned`] under the same number.
    fn give(&mut self, worker: usize, number: u64, work: Arc<dyn Work>);

    /// Stops a worker whatever it does, and puts a new one in its place.
    fn replace(&mut self, worker: usize);

    /// Does what is due on this thread, if the workers share it.
    fn attend(&mut self) -> Option<(usize, u64, Result<Finding, Failure>)> {
        None
    }

    /// Whether they work on the caller's thread, when attended to.
    fn on_this_thread(&self) -> bool {
        false
    }
}

/// Workers, studies, and who does what.
pub struct Crew {
    workers: Box<dyn Workers>,
    foreman: Foreman,
    /// When each worker began its piece, and how long it may take.
    begun: Vec<(f64, f64)>,
    /// What is being studied.
    pub(super) studies: Studies,
    /// While the user's hand moves, studies in the background that have a first picture leave all but one worker idle, and
    /// the frame its core.
    restrained: bool,
}

impl Crew {
    /// A crew of these workers, with nothing to do.
    pub fn new(workers: Box<dyn Workers>) -> Self {
        let count = workers.count();
        let foreman = Foreman::new(count);
        let begun = vec![(0.0, 0.0); count];
        Self { workers, foreman, begun, studies: Studies::default(), restrained: false }
    }

    /// Gives every idle worker a piece, if there is one.
    pub fn hand_out(&mut self) {
        for worker in 0..self.workers.count() {
            let in_background = !self.restrained || self.foreman.busy_count() == 0;
            let urgent = self.studies.lanes.urgent();
            let mut lanes = self.studies.lanes.traffic();
            let given = self.foreman.assign(worker, &mut lanes, (urgent, in_background));
            let Some((number, work)) = given else { continue };
            let longest = if work.is_long() { LONGEST_ANSWER_MS } else { LONGEST_MS };
            self.begun[worker] = (milliseconds(), longest);
            self.workers.give(worker, number, work);
        }
    }

    /// Takes in what a worker found, and gives it something new.
    pub fn returned(&mut self, worker: usize, number: u64, finding: Result<Finding, Failure>) {
        self.foreman.returned(worker, number, finding, &mut self.studies.lanes.traffic());
        self.hand_out();
    }

    /// A worker tells how far, 0 to 1, it is with its piece: it may take its time.
    pub fn told(&mut self, worker: usize, number: u64, part: f64) {
        if self.foreman.told(worker, number, part, &mut self.studies.lanes.traffic()) {
            let (since, longest) = &mut self.begun[worker];
            *longest = longest.max(milliseconds() - *since + LONGEST_MS);
        }
    }

    /// A worker died: another takes its place and its piece is done again.
    pub fn died(&mut self, worker: usize) {
        self.foreman.died(worker, &mut self.studies.lanes.traffic());
        self.workers.replace(worker);
        self.hand_out();
    }

    /// Once a frame: says whether the hand moves, and ends what takes too long.
    pub fn tick(&mut self, hand_moves: bool) {
        self.restrained = hand_moves;
        let now = milliseconds();
        let overdue: Vec<usize> = {
            let lanes = self.studies.lanes.traffic();
            let obsolete = self.foreman.obsolete(&lanes);
            let obsolete = obsolete.filter(|worker| now - self.begun[*worker].0 > OBSOLETE_MS);
            let endless = (0..self.workers.count()).filter(|worker| {
                let (since, longest) = self.begun[*worker];
                self.foreman.is_busy(*worker) && now - since > longest
            });
            obsolete.chain(endless).collect()
        };
        for worker in overdue {
            self.died(worker);
        }
        self.hand_out();
        while let Some((worker, number, finding)) = self.workers.attend() {
            self.returned(worker, number, finding);
        }
    }

    /// Whether the frames have to go on for the work to go on.
    pub fn works_on_this_thread(&self) -> bool {
        self.workers.on_this_thread()
    }

    /// Queues a request in JSON; its number comes back with the answer.
    pub fn ask(&mut self, request: String) -> Option<usize> {
        let number = self.answers()?.ask(request);
        self.hand_out();
        Some(number)
    }

    /// The answers to requests that have come in since the last call.
    pub fn take_answers(&mut self) -> Vec<(usize, Result<String, String>)> {
        self.answers().map(Answers::take_answers).unwrap_or_default()
    }

    fn answers(&mut self) -> Option<&mut Answers> {
        self.studies.lanes.lane_mut()?.study_mut()
    }

    /// Whether anything is being computed or waits to be.
    pub fn is_busy(&self) -> bool {
        self.studies.lanes.progress().next().is_some()
    }
}
