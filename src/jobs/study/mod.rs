//! Studies: questions too large for a frame, cut into pieces of [`Work`] that may be done anywhere and in any order.

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
pub fn complete(study: &mut impl Study) {
    while !study.finished() {
        let mut pieces = Vec::new();
        while pieces.len() < BATCH
            && let Some(piece) = study.next()
        {
            pieces.push(piece);
        }
        if pieces.is_empty() {
            return;
        }
        let found = parallel::map(&pieces, |(ticket, work)| (*ticket, work.carry_out()));
        for (ticket, finding) in found {
            study.take(ticket, finding);
        }
    }
}

/// Pieces handed out before any finding is taken, many for each core.
const BATCH: usize = 256;
