//! A question that is one piece of work.

use super::piece::{Failure, Piece};
use super::study::{Asked, Order, Study};

/// One piece of work and what it found.
#[derive(Debug, Clone)]
pub struct Single<P: Piece> {
    piece: P,
    handed: bool,
    found: Option<Result<P::Found, Failure>>,
}

impl<P: Piece> Single<P> {
    /// A study of this one piece, not yet begun.
    pub fn new(piece: P) -> Self {
        Self { piece, handed: false, found: None }
    }

    /// The finding, or why there is none, once it is known.
    pub fn found(&self) -> Option<Result<&P::Found, &Failure>> {
        self.found.as_ref().map(Result::as_ref)
    }
}

impl<P: Piece + Clone> Study for Single<P> {
    fn next(&mut self) -> Option<Order<Self>> {
        if std::mem::replace(&mut self.handed, true) {
            return None;
        }
        Some(Order::new(self.piece.clone(), |study: &mut Self, found| study.found = Some(found)))
    }

    fn progress(&self) -> f64 {
        if self.finished() { 1.0 } else { 0.0 }
    }

    fn finished(&self) -> bool {
        self.found.is_some()
    }
}

impl<P: Piece + Clone + PartialEq> Asked for Single<P> {
    type Question = P;

    fn asked(&self) -> &P {
        &self.piece
    }
}
