//! Requests from outside, one piece each, answered in any order.

use std::collections::VecDeque;

use super::Study;
use crate::jobs::work::{Finding, Work};

/// A queue of requests and their answers.
#[derive(Debug, Clone, Default)]
pub struct Answers {
    asked: usize,
    waiting: VecDeque<(usize, String)>,
    under_way: usize,
    answered: Vec<(usize, Result<String, String>)>,
}

impl Answers {
    /// Queues a request, as JSON; the number returned comes back with its answer.
    pub fn ask(&mut self, request: String) -> usize {
        self.asked += 1;
        self.waiting.push_back((self.asked, request));
        self.asked
    }

    /// Takes the answers that have come in: JSON, or the sentence that says what is wrong.
    pub fn take_answers(&mut self) -> Vec<(usize, Result<String, String>)> {
        std::mem::take(&mut self.answered)
    }
}

impl Study for Answers {
    fn next(&mut self) -> Option<(usize, Work)> {
        let (number, request) = self.waiting.pop_front()?;
        self.under_way += 1;
        Some((number, Work::Answer { request }))
    }

    fn take(&mut self, ticket: usize, finding: Result<Finding, String>) {
        self.under_way = self.under_way.saturating_sub(1);
        let answer = match finding {
            Ok(Finding::Answer(json)) => Ok(json),
            Ok(_) => Err("the computation returned something else than an answer".to_owned()),
            Err(message) => Err(message),
        };
        self.answered.push((ticket, answer));
    }

    fn progress(&self) -> f64 {
        if self.finished() { 1.0 } else { 0.0 }
    }

    fn finished(&self) -> bool {
        self.waiting.is_empty() && self.under_way == 0
    }
}
