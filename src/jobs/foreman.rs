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
mod tests {
    use super::*;

    /// Three pieces, each answered by its own request.
    #[derive(Debug, Default)]
    struct Three {
        handed: usize,
        found: Vec<(usize, Result<Finding, String>)>,
    }

    impl Study for Three {
        fn next(&mut self) -> Option<(usize, Work)> {
            (self.handed < 3).then(|| {
                self.handed += 1;
                (self.handed, Work::Answer { request: self.handed.to_string() })
            })
        }

        fn take(&mut self, ticket: usize, finding: Result<Finding, String>) {
            self.found.push((ticket, finding));
        }

        fn progress(&self) -> f64 {
            self.found.len() as f64 / 3.0
        }

        fn finished(&self) -> bool {
            self.found.len() == 3
        }
    }

    fn answer(text: &str) -> Result<Finding, String> {
        Ok(Finding::Answer(text.to_owned()))
    }

    #[test]
    fn every_piece_comes_back_once_although_a_worker_dies() {
        let mut lane = Lane::default();
        lane.ask(Three::default());
        let mut foreman = Foreman::new(2);
        let mut deaths = 0;
        while lane.progress().is_some() {
            let given: Vec<_> = (0..2).map(|worker| foreman.assign(worker, &mut [&mut lane], 1)).collect();
            for (worker, given) in given.into_iter().enumerate() {
                match given {
                    Some(_) if worker == 1 && deaths == 0 => {
                        deaths += 1;
                        foreman.died(worker, &mut [&mut lane]);
                    }
                    Some((number, Work::Answer { request })) => {
                        foreman.returned(worker, number, answer(&request), &mut [&mut lane]);
                    }
                    _ => {}
                }
            }
        }
        let mut found: Vec<_> = lane.study().expect("asked").found.clone();
        found.sort_by_key(|(ticket, _)| *ticket);
        assert_eq!(found, vec![(1, answer("1")), (2, answer("2")), (3, answer("3"))]);
    }

    #[test]
    fn findings_of_an_old_question_are_dropped() {
        let mut lane = Lane::default();
        lane.ask(Three::default());
        let mut foreman = Foreman::new(1);
        let (old, _) = foreman.assign(0, &mut [&mut lane], 1).expect("work");
        lane.ask(Three::default());
        assert_eq!(foreman.obsolete(&[&mut lane]).collect::<Vec<_>>(), vec![0]);
        foreman.returned(0, old, answer("old"), &mut [&mut lane]);
        assert!(lane.study().is_some_and(|study| study.found.is_empty()) && !foreman.is_busy(0));
        // A late second return of the same number changes nothing either.
        let (new, _) = foreman.assign(0, &mut [&mut lane], 1).expect("work");
        foreman.returned(0, old, answer("old"), &mut [&mut lane]);
        assert!(foreman.is_busy(0));
        foreman.returned(0, new, answer("new"), &mut [&mut lane]);
        assert_eq!(lane.study().map(|study| study.found.len()), Some(1));
    }

    #[test]
    fn a_question_that_waits_begins_when_the_present_one_is_answered() {
        let mut lane = Lane::default();
        let mut foreman = Foreman::new(1);
        lane.offer(Three::default());
        for _ in 0..2 {
            lane.offer(Three::default());
        }
        assert_eq!(lane.generation(), 1);
        for _ in 0..3 {
            let (number, _) = foreman.assign(0, &mut [&mut lane], 1).expect("work");
            foreman.returned(0, number, answer(""), &mut [&mut lane]);
        }
        // The second of three was never begun.
        assert_eq!((lane.generation(), lane.study().map(Study::progress)), (2, Some(0.0)));
        assert_eq!(lane.finished().map(Study::progress), Some(1.0));
    }

    #[test]
    fn a_piece_that_kills_every_worker_is_given_up() {
        let mut lane = Lane::default();
        lane.ask(Three::default());
        let mut foreman = Foreman::new(1);
        for _ in 0..6 {
            assert!(foreman.assign(0, &mut [&mut lane], 1).is_some());
            foreman.died(0, &mut [&mut lane]);
        }
        assert!(foreman.assign(0, &mut [&mut lane], 1).is_none());
        let study = lane.study().expect("asked");
        assert!(study.finished() && study.found.iter().all(|(_, finding)| finding.is_err()));
    }

    #[test]
    fn the_first_lane_goes_first() {
        let (mut urgent, mut other) = (Lane::default(), Lane::default());
        other.ask(Three::default());
        urgent.ask(Three::default());
        let mut foreman = Foreman::new(4);
        for worker in 0..4 {
            assert!(foreman.assign(worker, &mut [&mut urgent, &mut other], 1).is_some());
        }
        let left = |lane: &Lane<Three>| lane.study().map(|study| 3 - study.handed);
        assert_eq!((left(&urgent), left(&other)), (Some(0), Some(2)));
        assert_eq!(foreman.busy_count(), 4);
    }

    #[test]
    fn of_the_others_one_without_a_picture_goes_first() {
        let (mut a, mut b) = (Lane::default(), Lane::default());
        a.ask(Three { handed: 1, found: vec![(1, answer(""))] });
        b.ask(Three::default());
        let mut foreman = Foreman::new(1);
        let (number, _) = foreman.assign(0, &mut [&mut a, &mut b], 0).expect("work");
        assert_eq!(b.study().map(|study| study.handed), Some(1));
        foreman.returned(0, number, answer(""), &mut [&mut a, &mut b]);
    }
}
