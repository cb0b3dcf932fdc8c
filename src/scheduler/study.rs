//! Studies: questions too large for a frame, cut into pieces that may be done anywhere and in any order.

use std::any::Any;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use super::budget::Budget;
use super::parallel;
use super::piece::{Failure, Finding, Piece, Work};

/// What a study does with what was found for a piece.
pub(super) type Take<S> = Box<dyn FnOnce(&mut S, Result<Finding, Failure>) + Send>;

/// A piece of work handed out, with what its study does when it comes back.
pub struct Order<S: ?Sized> {
    pub(super) work: Arc<dyn Work>,
    pub(super) take: Take<S>,
}

impl<S: 'static> Order<S> {
    /// Hands out `piece`; `take` gets what it finds.
    pub fn new<P: Piece>(
        piece: P,
        take: impl FnOnce(&mut S, Result<P::Found, Failure>) + Send + 'static,
    ) -> Self {
        let take: Take<S> = Box::new(move |study, found| take(study, found.and_then(Finding::open)));
        Self { work: Arc::new(piece), take }
    }

    /// The same as an order of a study that has this one as its part, and does something `after`.
    pub fn within<T: 'static>(self, part: fn(&mut T) -> &mut S, after: fn(&mut T)) -> Order<T> {
        let take = self.take;
        let take: Take<T> = Box::new(move |study, found| {
            take(part(study), found);
            after(study);
        });
        Order { work: self.work, take }
    }

    /// The piece, when it is a `P`.
    pub fn piece<P: Piece>(&self) -> Option<&P> {
        let work: &dyn Any = &*self.work;
        work.downcast_ref()
    }

    /// Does the work on this side.
    ///
    /// # Errors
    /// As [`Piece::carry_out`].
    pub fn carry_out(&self) -> Result<Finding, Failure> {
        self.work.carry_out()
    }

    /// Gives the study what was found for the piece.
    pub fn found(self, study: &mut S, finding: Result<Finding, Failure>) {
        (self.take)(study, finding);
    }
}

/// A question that hands out pieces and puts what they find together.
///
/// A study never waits: [`Self::next`] gives the most useful piece that can begin now. A piece whose worker died is
/// handed out again by whoever keeps the workers, so that each order comes back at most once.
pub trait Study: Sized + 'static {
    /// The next piece; `None` when there is none, or none before some finding has come back.
    fn next(&mut self) -> Option<Order<Self>>;

    /// Done part, 0 to 1.
    fn progress(&self) -> f64;

    /// Whether everything asked for is there, or failed.
    fn finished(&self) -> bool;

    /// Part, 0 to 1, that each piece is of it, where pieces take long and tell how far they are.
    fn share(&self) -> f64 {
        0.0
    }

    /// Whether the next piece is of a first, coarse picture that takes milliseconds: it goes before everything else.
    fn sketches(&self) -> bool {
        false
    }

    /// Whether a newer question may take its place: when it is finished, or has drawn its first picture.
    fn is_replaceable(&self) -> bool {
        self.finished()
    }
}

/// A study that knows what it was asked, so that the same is not asked again.
pub trait Asked: Study {
    /// Everything that its answer depends on.
    type Question: PartialEq;

    /// What it was asked.
    fn asked(&self) -> &Self::Question;
}

/// Carries out a whole study: natively on all cores, in the browser one piece after the other.
pub fn complete(study: &mut (impl Study + Send)) {
    complete_within(study, &Budget::default());
}

/// The same as far as `budget` goes. Findings are taken in the order in which the pieces were handed out, so that the
/// same study always ends the same, and each as soon as it can be.
pub fn complete_within(study: &mut (impl Study + Send), budget: &Budget<'_>) {
    run(&mut Desk { study, due: Vec::new(), taken: 0 }, budget);
}

/// A study with the pieces handed out last, in their order.
struct Desk<'a, S> {
    study: &'a mut S,
    due: Vec<Option<Take<S>>>,
    taken: usize,
}

/// A study at its desk, whatever it is.
trait Open: Send {
    /// The next pieces, at most `most`, numbered from 0.
    fn hand_out(&mut self, most: usize) -> Vec<(usize, Arc<dyn Work>)>;
    /// Takes what was found for a piece whose turn it is.
    fn take(&mut self, place: usize, finding: Result<Finding, Failure>);
    /// Done part, 0 to 1.
    fn progress(&self) -> f64;
    fn finished(&self) -> bool;
    /// The place whose turn it is.
    fn turn(&self) -> usize;
}

impl<S: Study + Send> Open for Desk<'_, S> {
    fn hand_out(&mut self, most: usize) -> Vec<(usize, Arc<dyn Work>)> {
        self.due.clear();
        self.taken = 0;
        let mut pieces = Vec::new();
        while pieces.len() < most
            && let Some(order) = self.study.next()
        {
            pieces.push((self.due.len(), order.work));
            self.due.push(Some(order.take));
        }
        pieces
    }

    fn take(&mut self, place: usize, finding: Result<Finding, Failure>) {
        self.taken = self.taken.max(place + 1);
        if let Some(take) = self.due.get_mut(place).and_then(Option::take) {
            take(self.study, finding);
        }
    }

    fn progress(&self) -> f64 {
        self.study.progress()
    }

    fn finished(&self) -> bool {
        self.study.finished()
    }

    fn turn(&self) -> usize {
        self.taken
    }
}

/// Pieces handed out before any finding is taken, many for each core.
const BATCH: usize = 256;

fn run(desk: &mut dyn Open, budget: &Budget<'_>) {
    while !desk.finished() && !budget.is_spent() {
        let pieces = desk.hand_out(BATCH);
        if pieces.is_empty() {
            return;
        }
        let arrivals = Mutex::new((&mut *desk, BTreeMap::new()));
        parallel::map(&pieces, |(place, work)| {
            let Some(finding) = budget.piece(|| work.carry_out()) else { return };
            if let Ok(mut arrivals) = arrivals.lock() {
                // Those whose turn has not come wait.
                let (desk, early) = &mut *arrivals;
                early.insert(*place, finding);
                while let Some(finding) = early.remove(&desk.turn()) {
                    desk.take(desk.turn(), finding);
                }
                budget.report(desk.progress());
            }
        });
        // Those behind a piece that was not begun.
        if let Ok((desk, early)) = arrivals.into_inner() {
            for (place, finding) in early {
                desk.take(place, finding);
            }
        }
    }
}
