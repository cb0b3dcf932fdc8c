//! Who does what: hands pieces of the studies to workers, newest questions only, and gives a dead worker's piece to
//! another. It knows nothing of how workers are made or reached.

use std::sync::Arc;

use super::lane::{Ticket, Traffic};
use super::piece::{Failure, Finding, Work};

/// Done part of a study that counts as a first picture of it.
const FIRST_PICTURE: f64 = 0.02;
/// What a worker is doing.
#[derive(Clone)]
struct Assignment {
    number: u64,
    lane: usize,
    generation: u64,
    ticket: Ticket,
}

/// The book of who does what.
#[derive(Default)]
pub struct Foreman {
    busy: Vec<Option<Assignment>>,
    handed: u64,
    /// The lane and the question whose sketch has last let an urgent piece go first.
    gave_way: Option<(usize, u64)>,
}

impl Foreman {
    /// A foreman of this many workers, numbered from 0.
    pub fn new(workers: usize) -> Self {
        Self { busy: vec![None; workers], ..Self::default() }
    }

    /// The next piece for an idle worker and the number under which it is to be returned: from a lane that is being
    /// sketched, else from the first of the `urgent` lanes that has one, else, `in_background`, from the first of the others
    /// that has no first picture yet, else from the first of the others. Each new sketch lets one urgent piece go first, so
    /// that a question which changes as often as the hand moves does not keep these waiting.
    pub fn assign(
        &mut self,
        worker: usize,
        lanes: &mut [&mut dyn Traffic],
        (urgent, in_background): (usize, bool),
    ) -> Option<(u64, Arc<dyn Work>)> {
        let slot = self.busy.get_mut(worker).filter(|slot| slot.is_none())?;
        let urgent = urgent.min(lanes.len());
        let mut order: Vec<usize> = (0..lanes.len()).collect();
        let pictured = |lane: &usize| lanes[*lane].progress().is_none_or(|done| done >= FIRST_PICTURE);
        order[urgent..].sort_by_key(pictured);
        order.retain(|lane| *lane < urgent || in_background || lanes[*lane].is_sketched());
        let sketch = order.iter().copied().find(|lane| lanes[*lane].is_sketched());
        let sketch = sketch.map(|lane| (lane, lanes[lane].generation()));
        if sketch.is_none() || self.gave_way == sketch {
            order.sort_by_key(|lane| !lanes[*lane].is_sketched());
        }
        for lane in order {
            let traffic = &mut lanes[lane];
            if let Some(ticket) = traffic.next() {
                self.handed += 1;
                self.gave_way = sketch.or(self.gave_way);
                let work = Arc::clone(&ticket.work);
                *slot =
                    Some(Assignment { number: self.handed, lane, generation: traffic.generation(), ticket });
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
        finding: Result<Finding, Failure>,
        lanes: &mut [&mut dyn Traffic],
    ) {
        let Some(slot) = self.busy.get_mut(worker) else { return };
        if let Some(done) = slot.take_if(|assignment| assignment.number == number)
            && let Some(lane) = lanes.get_mut(done.lane)
        {
            lane.take(done.generation, done.ticket.number, finding);
        }
    }

    /// A worker tells how far, 0 to 1, it is with the piece of a number. Whether that is its present piece.
    pub fn told(&self, worker: usize, number: u64, part: f64, lanes: &mut [&mut dyn Traffic]) -> bool {
        let Some(Some(present)) = self.busy.get(worker) else { return false };
        if present.number != number {
            return false;
        }
        if let Some(lane) = lanes.get_mut(present.lane) {
            lane.hear(present.generation, present.ticket.number, part);
        }
        true
    }

    /// A worker died: its piece goes back.
    pub fn died(&mut self, worker: usize, lanes: &mut [&mut dyn Traffic]) {
        if let Some(lost) = self.busy.get_mut(worker).and_then(Option::take)
            && let Some(lane) = lanes.get_mut(lost.lane)
        {
            lane.take_back(lost.generation, lost.ticket);
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
