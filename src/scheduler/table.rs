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
            table.found[row] = Some(found);
        }))
    }

    fn progress(&self) -> f64 {
        self.share() * self.found.iter().flatten().count() as f64
    }

    fn share(&self) -> f64 {
        1.0 / self.found.len().max(1) as f64
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scheduler::Lane;
    use crate::scheduler::foreman::Foreman;
    use crate::scheduler::lane::Lanes;

    /// A piece that finds its own number.
    #[derive(Debug, Clone, PartialEq, nanoserde::SerBin, nanoserde::DeBin)]
    struct Row(u32);

    impl Piece for Row {
        const NAME: &'static str = "row";
        type Found = u32;

        fn carry_out(&self) -> Result<u32, Failure> {
            Ok(self.0)
        }
    }

    fn rows() -> Vec<Row> {
        [3, 4, 5].map(Row).into()
    }

    fn lanes() -> Lanes {
        Lanes::new(vec![("rows", Box::new(Lane::<Table<Row>>::default()))], 0)
    }

    fn ask(lanes: &mut Lanes) {
        lanes.ask(rows(), |rows| Some(Table::new(rows)));
    }

    #[test]
    fn parts_of_what_is_under_way_count() {
        let (mut lanes, mut foreman) = (lanes(), Foreman::new(2));
        ask(&mut lanes);
        let given: Vec<_> = (0..2)
            .map(|worker| foreman.assign(worker, &mut lanes.traffic(), (0, true)).expect("work"))
            .collect();
        let progress = |lanes: &Lanes| lanes.progress().next().map(|(_, part)| (300.0 * part).round());
        assert!(foreman.told(0, given[0].0, 0.1, &mut lanes.traffic()));
        assert!(foreman.told(0, given[0].0, 0.3, &mut lanes.traffic()));
        assert!(foreman.told(1, given[1].0, 0.6, &mut lanes.traffic()));
        assert_eq!(progress(&lanes), Some(90.0));
        // Whatever a worker tells of something else is not heard.
        assert!(!foreman.told(0, given[1].0, 0.9, &mut lanes.traffic()));
        assert!(!foreman.told(7, given[1].0, 0.9, &mut lanes.traffic()));
        assert_eq!(progress(&lanes), Some(90.0));
        // What was found counts whole, whatever was told of it.
        foreman.returned(0, given[0].0, given[0].1.carry_out(), &mut lanes.traffic());
        assert_eq!(progress(&lanes), Some(160.0));
        assert!(!foreman.told(0, given[0].0, 0.5, &mut lanes.traffic()));
        assert_eq!(progress(&lanes), Some(160.0));
        // Whoever takes the place of a worker that died begins anew.
        foreman.died(1, &mut lanes.traffic());
        assert_eq!(progress(&lanes), Some(100.0));
    }
}
