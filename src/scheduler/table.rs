//! Pieces of work that do not depend on one another: the rows of a table.

use super::piece::{Failure, Piece};
use super::study::{Asked, Order, Study};

/// Pieces and what they found, in their order.
#[derive(Debug, Clone)]
pub struct Table<P: Piece> {
    pieces: Vec<P>,
    handed: usize,
    found: Vec<Option<Result<P::Found, Failure>>>,
}

impl<P: Piece> Table<P> {
    /// A study of these pieces, not yet begun.
    pub fn new(pieces: Vec<P>) -> Self {
        Self { handed: 0, found: pieces.iter().map(|_| None).collect(), pieces }
    }

    /// What each found, or why it did not; `None` until it is known.
    pub fn found(&self) -> impl Iterator<Item = Option<Result<&P::Found, &Failure>>> {
        self.found.iter().map(|found| found.as_ref().map(Result::as_ref))
    }
}

impl<P: Piece + Clone> Study for Table<P> {
    fn next(&mut self) -> Option<Order<Self>> {
        let (row, piece) = (self.handed, self.pieces.get(self.handed)?.clone());
        self.handed += 1;
        Some(Order::new(piece, move |table: &mut Self, found| {
            if let Some(place) = table.found.get_mut(row) {
                *place = Some(found);
            }
        }))
    }

    fn progress(&self) -> f64 {
        let done = self.found.iter().flatten().count();
        done as f64 / self.found.len().max(1) as f64
    }

    fn finished(&self) -> bool {
        self.found.iter().all(Option::is_some)
    }
}

impl<P: Piece + Clone + PartialEq> Asked for Table<P> {
    type Question = Vec<P>;

    fn asked(&self) -> &Vec<P> {
        &self.pieces
    }
}
