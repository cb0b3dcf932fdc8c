//! Studies: questions too large for a frame, cut into pieces of [`Work`] that may be done anywhere and in any order.

use std::collections::BTreeMap;
use std::sync::Mutex;

use super::budget::Budget;
use super::parallel;
use super::work::{Finding, Work};

pub mod answers;
pub mod basin;
pub mod curves;
pub mod find;
pub mod harvest;
pub mod load;
pub mod map;
pub mod mosaic;
pub mod motion_chart;
pub mod multiplier_chart;
pub mod single;
pub mod sweep;
pub mod table;
pub mod tongues;

/// A question that hands out work and puts the findings together.
///
/// A study never waits: [`Self::next`] gives the most useful piece that can begin now. A piece whose worker died is
/// handed out again by whoever keeps the workers, so that each ticket comes back exactly once.
pub trait Study {
    /// The next piece with its ticket; `None` when there is none, or none before some finding has come back.
    fn next(&mut self) -> Option<(usize, Work)>;

    /// Takes what was found for the piece with this ticket.
    fn take(&mut self, ticket: usize, finding: Result<Finding, String>);

    /// Done part, 0 to 1.
    fn progress(&self) -> f64;

    /// Whether everything asked for is there, or failed.
    fn finished(&self) -> bool;

    /// Whether the next piece is of a first, coarse picture that takes milliseconds: it goes before everything else.
    fn sketches(&self) -> bool {
        false
    }
}

/// Carries out a whole study: natively on all cores, in the browser one piece after the other.
pub fn complete(study: &mut (impl Study + Send)) {
    complete_within(study, &Budget::default());
}

/// The same as far as `budget` goes. Findings are taken in the order in which the pieces were handed out, so that the
/// same study always ends the same, and each as soon as it can be.
pub fn complete_within(study: &mut (impl Study + Send), budget: &Budget<'_>) {
    while !study.finished() && !budget.is_spent() {
        let mut pieces = Vec::new();
        while pieces.len() < BATCH
            && let Some(piece) = study.next()
        {
            pieces.push(piece);
        }
        if pieces.is_empty() {
            return;
        }
        let places: Vec<usize> = (0..pieces.len()).collect();
        let arrivals = Mutex::new(Arrivals { study: &mut *study, early: BTreeMap::new(), due: 0 });
        parallel::map(&places, |place| {
            let (ticket, work) = &pieces[*place];
            let Some(finding) = budget.piece(|| work.carry_out()) else { return };
            if let Ok(mut arrivals) = arrivals.lock() {
                budget.report(arrivals.add(*place, (*ticket, finding)));
            }
        });
        // Those behind a piece that was not begun.
        let early = arrivals.into_inner().map_or_else(|_| BTreeMap::new(), |arrivals| arrivals.early);
        for (ticket, finding) in early.into_values() {
            study.take(ticket, finding);
        }
    }
}

/// A ticket and what was found for it.
type Arrival = (usize, Result<Finding, String>);

/// Findings on their way to a study.
struct Arrivals<'a, S> {
    study: &'a mut S,
    /// Those whose turn has not come, by their places.
    early: BTreeMap<usize, Arrival>,
    /// The place whose turn it is.
    due: usize,
}

impl<S: Study> Arrivals<'_, S> {
    /// Lets the study take what can be taken now; its done part.
    fn add(&mut self, place: usize, arrival: Arrival) -> f64 {
        self.early.insert(place, arrival);
        while let Some((ticket, finding)) = self.early.remove(&self.due) {
            self.study.take(ticket, finding);
            self.due += 1;
        }
        self.study.progress()
    }
}

/// Pieces handed out before any finding is taken, many for each core.
const BATCH: usize = 256;
