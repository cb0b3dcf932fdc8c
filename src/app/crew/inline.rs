//! Workers that are the caller's own thread: for tests, and where a browser has no workers.

use std::sync::Arc;

use super::Workers;
use crate::app::clock::milliseconds;
use crate::scheduler::{Failure, Finding, Work};

/// Time a frame may spend on pieces.
const BUDGET_MS: f64 = 6.0;

/// One worker that works when it is attended to.
#[derive(Default)]
pub struct Inline {
    due: Option<(u64, Arc<dyn Work>)>,
    /// When the present frame's share began.
    since: Option<f64>,
}

impl Workers for Inline {
    fn count(&self) -> usize {
        1
    }

    fn give(&mut self, _worker: usize, number: u64, work: Arc<dyn Work>) {
        self.due = Some((number, work));
    }

    fn replace(&mut self, _worker: usize) {
        self.due = None;
    }

    fn on_this_thread(&self) -> bool {
        true
    }

    fn attend(&mut self) -> Option<(usize, u64, Result<Finding, Failure>)> {
        let since = *self.since.get_or_insert_with(milliseconds);
        if milliseconds() - since > BUDGET_MS {
            self.since = None;
            return None;
        }
        let Some((number, work)) = self.due.take() else {
            self.since = None;
            return None;
        };
        Some((0, number, work.carry_out()))
    }
}
