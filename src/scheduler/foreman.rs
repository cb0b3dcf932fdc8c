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
    ) -> Option<(u64, Arc<dyn Work>)> {
        let slot = self.busy.get_mut(worker).filter(|slot| slot.is_none())?;
        let mut order: Vec<usize> = (0..lanes.len()).collect();
        let pictured = |lane: &usize| lanes[*lane].progress().is_none_or(|done| done >= FIRST_PICTURE);
        order[urgent.min(lanes.len())..].sort_by_key(pictured);
        order.sort_by_key(|lane| !lanes[*lane].is_sketched());
        for lane in order {
            let traffic = &mut lanes[lane];
            if let Some(ticket) = traffic.next() {
                self.handed += 1;
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
