//! What is asked of lanes of all kinds.

use crate::jobs::foreman::Lane;
use crate::jobs::study::Study;
use crate::jobs::study::single::Single;
use crate::jobs::work::Work;

/// Whether a lane's study goes on.
pub(super) fn open<S: Study>(lane: &Lane<S>) -> bool {
    lane.study().is_some_and(|study| !study.finished())
}

/// Asks for a piece of work, unless it was asked for last.
pub(super) fn offer(lane: &mut Lane<Single>, work: Work) {
    if lane.wanted().is_none_or(|wanted| *wanted.work() != work) {
        lane.offer(Single::new(work));
    }
}
