//! Pieces of work that do not depend on one another: the rows of a table.

use super::piece::{Failure, Piece};
use super::study::{Asked, Order, Study};

/// Pieces and what they found, in their order.
#[derive(Debug, Clone)]
pub struct Table<P: Piece> {
    pieces: Vec<P>,
    handed: usize,
    found: Vec<Option<Result<P::Found, Failure>>>,
    stopped: bool,
}

impl<P: Piece> Table<P> {
    /// A study of these pieces, not yet begun.
    pub fn new(pieces: Vec<P>) -> Self {
        Self { handed: 0, found: pieces.iter().map(|_| None).collect(), stopped: false, pieces }
    }

    /// What each found, or why it did not; `None` until it is known, and where the table was stopped before.
    pub fn found(&self) -> impl Iterator<Item = Option<Result<&P::Found, &Failure>>> {
        self.found.iter().map(|found| found.as_ref().map(Result::as_ref))
    }

    /// Ends it with what was found so far, unless that is everything. What is under way is to be dropped.
    pub fn stop(&mut self) {
        self.stopped = !self.is_whole();
    }

    /// Goes on with what was not found before it was stopped, each piece from its beginning.
    pub fn resume(&mut self) {
        (self.stopped, self.handed) = (false, 0);
    }

    /// Whether it was stopped before its end.
    pub fn is_stopped(&self) -> bool {
        self.stopped
    }

    /// Whether it is known of each what it found, or why it did not.
    pub fn is_whole(&self) -> bool {
        self.found.iter().all(Option::is_some)
    }
}

impl<P: Piece + Clone> Study for Table<P> {
    fn next(&mut self) -> Option<Order<Self>> {
        if self.stopped {
            return None;
        }
        let row = (self.handed..self.found.len()).find(|row| self.found[*row].is_none())?;
        self.handed = row + 1;
        Some(Order::new(self.pieces[row].clone(), move |table: &mut Self, found| {
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
        self.stopped || self.is_whole()
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
    use crate::scheduler::foreman::Foreman;
    use crate::scheduler::lane::Lanes;
    use crate::scheduler::{Lane, complete};

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

    /// The table, with what it found.
    fn table(lanes: &Lanes) -> (&Table<Row>, Vec<Option<u32>>) {
        let table: &Table<Row> = lanes.study().expect("asked");
        (table, table.found().map(|found| found.and_then(Result::ok).copied()).collect())
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

    #[test]
    fn once_stopped_it_stays_so_until_it_is_taken_up_again() {
        let (mut lanes, mut foreman) = (lanes(), Foreman::new(2));
        ask(&mut lanes);
        let assign = |foreman: &mut Foreman, lanes: &mut Lanes, worker| {
            foreman.assign(worker, &mut lanes.traffic(), (0, true))
        };
        let (number, work) = assign(&mut foreman, &mut lanes, 0).expect("work");
        foreman.returned(0, number, work.carry_out(), &mut lanes.traffic());
        let (number, work) = assign(&mut foreman, &mut lanes, 0).expect("work");
        assert!(foreman.told(0, number, 0.5, &mut lanes.traffic()));
        lanes.lane_mut::<Table<Row>>().expect("a lane").redirect(Table::stop);
        assert_eq!(foreman.obsolete(&lanes.traffic()).collect::<Vec<_>>(), [0]);
        // The same question is not asked again by being asked in every frame.
        for _ in 0..3 {
            ask(&mut lanes);
            assert!(assign(&mut foreman, &mut lanes, 1).is_none());
        }
        // What comes late is ignored.
        foreman.told(0, number, 0.9, &mut lanes.traffic());
        foreman.returned(0, number, work.carry_out(), &mut lanes.traffic());
        let (stopped, found) = table(&lanes);
        assert_eq!(found, [Some(3), None, None]);
        assert!(stopped.is_stopped() && stopped.finished() && lanes.progress().next().is_none());
        // Taken up again it does what is missing, from its beginning.
        lanes.lane_mut::<Table<Row>>().expect("a lane").redirect(Table::resume);
        assert!(lanes.progress().next().is_some_and(|(_, part)| (part - 1.0 / 3.0).abs() < 1e-9));
        while let Some((number, work)) = assign(&mut foreman, &mut lanes, 0) {
            foreman.returned(0, number, work.carry_out(), &mut lanes.traffic());
        }
        let (whole, found) = table(&lanes);
        assert_eq!(found, [Some(3), Some(4), Some(5)]);
        assert!(whole.finished() && !whole.is_stopped());
        // A whole one cannot be stopped before its end.
        lanes.lane_mut::<Table<Row>>().expect("a lane").redirect(Table::stop);
        assert!(!table(&lanes).0.is_stopped());
    }

    #[test]
    fn another_question_after_a_stopped_one_is_computed() {
        let mut lanes = lanes();
        ask(&mut lanes);
        lanes.lane_mut::<Table<Row>>().expect("a lane").redirect(Table::stop);
        lanes.ask(vec![Row(8)], |rows| Some(Table::new(rows)));
        complete(lanes.lane_mut::<Table<Row>>().and_then(Lane::study_mut).expect("a study"));
        assert_eq!(table(&lanes).1, [Some(8)]);
        // And back: what was stopped is another question now.
        ask(&mut lanes);
        assert!(!table(&lanes).0.is_stopped() && lanes.progress().next().is_some());
    }
}
