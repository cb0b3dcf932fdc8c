//! Requests from outside, one piece each, answered in any order.

use std::collections::VecDeque;

use nanoserde::{DeBin, SerBin};

use super::solve;
use crate::scheduler::{Failure, Order, Piece, Study};

/// A request of the native command.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Solve {
    /// The request as JSON.
    pub request: String,
}

impl Piece for Solve {
    const NAME: &'static str = "answer";
    const LONG: bool = true;
    /// The answer as JSON.
    type Found = String;

    fn carry_out(&self) -> Result<String, Failure> {
        solve(&self.request).map_err(Failure::Verbatim)
    }
}

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
    fn next(&mut self) -> Option<Order<Self>> {
        let (number, request) = self.waiting.pop_front()?;
        self.under_way += 1;
        Some(Order::new(Solve { request }, move |answers: &mut Self, found| {
            answers.under_way = answers.under_way.saturating_sub(1);
            answers.answered.push((number, found.map_err(|failure| failure.to_string())));
        }))
    }

    fn progress(&self) -> f64 {
        if self.finished() { 1.0 } else { 0.0 }
    }

    fn finished(&self) -> bool {
        self.waiting.is_empty() && self.under_way == 0
    }
}
