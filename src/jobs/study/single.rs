//! A question that is one piece of work.

use super::Study;
use crate::jobs::work::{Finding, Work};

/// One piece of work and what it found.
#[derive(Debug, Clone)]
pub struct Single {
    work: Work,
    handed: bool,
    found: Option<Result<Finding, String>>,
}

impl Single {
    /// Nothing found yet.
    pub fn new(work: Work) -> Self {
        Self { work, handed: false, found: None }
    }

    /// The question.
    pub fn work(&self) -> &Work {
        &self.work
    }

    /// The finding, or why there is none, once it is known.
    pub fn found(&self) -> Option<&Result<Finding, String>> {
        self.found.as_ref()
    }
}

impl Study for Single {
    fn next(&mut self) -> Option<(usize, Work)> {
        if std::mem::replace(&mut self.handed, true) {
            return None;
        }
        Some((0, self.work.clone()))
    }

    fn take(&mut self, _ticket: usize, finding: Result<Finding, String>) {
        self.found = Some(finding);
    }

    fn progress(&self) -> f64 {
        if self.finished() { 1.0 } else { 0.0 }
    }

    fn finished(&self) -> bool {
        self.found.is_some()
    }
}
