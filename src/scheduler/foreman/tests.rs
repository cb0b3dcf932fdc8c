use super::*;
use crate::scheduler::lane::Lane;
use crate::scheduler::piece::{Failure, Piece};
use crate::scheduler::study::{Order, Study};

/// A piece that finds its own number, in words.
#[derive(nanoserde::SerBin, nanoserde::DeBin)]
struct Number(usize);

impl Piece for Number {
    const NAME: &'static str = "number";
    type Found = String;

    fn carry_out(&self) -> Result<String, Failure> {
        Ok(self.0.to_string())
    }
}

/// Three pieces, each answered by its own number; so many of them are a sketch.
#[derive(Debug, Default)]
struct Three {
    handed: usize,
    found: Vec<(usize, Result<String, Failure>)>,
    sketch: usize,
}

impl Study for Three {
    fn next(&mut self) -> Option<Order<Self>> {
        (self.handed < 3).then(|| {
            self.handed += 1;
            let number = self.handed;
            Order::new(Number(number), move |study: &mut Self, found| study.found.push((number, found)))
        })
    }

    fn progress(&self) -> f64 {
        self.found.len() as f64 / 3.0
    }

    fn finished(&self) -> bool {
        self.found.len() == 3
    }

    fn sketches(&self) -> bool {
        self.handed < self.sketch
    }

    fn is_replaceable(&self) -> bool {
        self.finished() || self.sketch > 0 && self.found.len() >= self.sketch
    }
}

fn answer(text: &str) -> Result<Finding, Failure> {
    Ok(Finding::Here(Box::new(text.to_owned())))
}

#[test]
fn every_piece_comes_back_once_although_a_worker_dies() {
    let mut lane = Lane::default();
    lane.ask(Three::default());
    let mut foreman = Foreman::new(2);
    let mut deaths = 0;
    while lane.progress().is_some() {
        let given: Vec<_> =
            (0..2).map(|worker| foreman.assign(worker, &mut [&mut lane], (1, true))).collect();
        for (worker, given) in given.into_iter().enumerate() {
            match given {
                Some(_) if worker == 1 && deaths == 0 => {
                    deaths += 1;
                    foreman.died(worker, &mut [&mut lane]);
                }
                Some((number, work)) => {
                    foreman.returned(worker, number, work.carry_out(), &mut [&mut lane]);
                }
                None => {}
            }
        }
    }
    let mut found: Vec<_> = lane.study().expect("asked").found.clone();
    found.sort_by_key(|(ticket, _)| *ticket);
    assert_eq!(found, [1, 2, 3].map(|number: usize| (number, Ok(number.to_string()))));
}

#[test]
fn findings_of_an_old_question_are_dropped() {
    let mut lane = Lane::default();
    lane.ask(Three::default());
    let mut foreman = Foreman::new(1);
    let (old, _) = foreman.assign(0, &mut [&mut lane], (1, true)).expect("work");
    lane.ask(Three::default());
    assert_eq!(foreman.obsolete(&[&mut lane]).collect::<Vec<_>>(), vec![0]);
    foreman.returned(0, old, answer("old"), &mut [&mut lane]);
    assert!(lane.study().is_some_and(|study| study.found.is_empty()) && !foreman.is_busy(0));
    // A late second return of the same number changes nothing either.
    let (new, _) = foreman.assign(0, &mut [&mut lane], (1, true)).expect("work");
    foreman.returned(0, old, answer("old"), &mut [&mut lane]);
    assert!(foreman.is_busy(0));
    foreman.returned(0, new, answer("new"), &mut [&mut lane]);
    assert_eq!(lane.study().map(|study| study.found.len()), Some(1));
}

#[test]
fn a_question_that_waits_begins_when_the_present_one_is_answered() {
    let mut lane = Lane::default();
    let mut foreman = Foreman::new(1);
    lane.offer(Three::default());
    for _ in 0..2 {
        lane.offer(Three::default());
    }
    assert_eq!(lane.generation(), 1);
    for _ in 0..3 {
        let (number, _) = foreman.assign(0, &mut [&mut lane], (1, true)).expect("work");
        foreman.returned(0, number, answer(""), &mut [&mut lane]);
    }
    // The second of three was never begun.
    assert_eq!((lane.generation(), lane.study().map(Study::progress)), (2, Some(0.0)));
    assert_eq!(lane.finished().map(Study::progress), Some(1.0));
}

#[test]
fn a_piece_that_kills_every_worker_is_given_up() {
    let mut lane = Lane::default();
    lane.ask(Three::default());
    let mut foreman = Foreman::new(1);
    for _ in 0..6 {
        assert!(foreman.assign(0, &mut [&mut lane], (1, true)).is_some());
        foreman.died(0, &mut [&mut lane]);
    }
    assert!(foreman.assign(0, &mut [&mut lane], (1, true)).is_none());
    let study = lane.study().expect("asked");
    assert!(study.finished() && study.found.iter().all(|(_, finding)| finding.is_err()));
}

#[test]
fn the_first_lane_goes_first() {
    let (mut urgent, mut other) = (Lane::default(), Lane::default());
    other.ask(Three::default());
    urgent.ask(Three::default());
    let mut foreman = Foreman::new(4);
    for worker in 0..4 {
        assert!(foreman.assign(worker, &mut [&mut urgent, &mut other], (1, true)).is_some());
    }
    let left = |lane: &Lane<Three>| lane.study().map(|study| 3 - study.handed);
    assert_eq!((left(&urgent), left(&other)), (Some(0), Some(2)));
    assert_eq!(foreman.busy_count(), 4);
}

#[test]
fn of_the_others_one_without_a_picture_goes_first() {
    let (mut a, mut b) = (Lane::default(), Lane::default());
    a.ask(Three { handed: 1, found: vec![(1, Ok(String::new()))], sketch: 0 });
    b.ask(Three::default());
    let mut foreman = Foreman::new(1);
    let (number, _) = foreman.assign(0, &mut [&mut a, &mut b], (0, true)).expect("work");
    assert_eq!(b.study().map(|study| study.handed), Some(1));
    foreman.returned(0, number, answer(""), &mut [&mut a, &mut b]);
}

#[test]
fn while_the_hand_moves_a_sketch_is_drawn_and_lets_one_urgent_piece_go_first() {
    let (mut urgent, mut other) = (Lane::default(), Lane::default());
    urgent.ask(Three::default());
    other.ask(Three { sketch: 2, ..Three::default() });
    let mut foreman = Foreman::new(5);
    let mut given = Vec::new();
    for worker in 0..5 {
        let (number, work) =
            foreman.assign(worker, &mut [&mut urgent, &mut other], (1, false)).expect("work");
        given.push((number, work));
    }
    let handed = |lane: &Lane<Three>| lane.study().map(|study| study.handed);
    // One urgent piece, the sketch, the other urgent pieces; what follows the sketch is for the background.
    assert_eq!((handed(&urgent), handed(&other)), (Some(3), Some(2)));
    let (number, work) = &given[1];
    foreman.returned(1, *number, work.carry_out(), &mut [&mut urgent, &mut other]);
    assert!(foreman.assign(1, &mut [&mut urgent, &mut other], (1, false)).is_none());
}

#[test]
fn a_question_that_waits_begins_when_the_present_one_has_its_sketch() {
    let (mut lane, mut foreman) = (Lane::default(), Foreman::new(1));
    lane.ask(Three { sketch: 2, ..Three::default() });
    lane.offer(Three { sketch: 2, ..Three::default() });
    for generation in [1, 2] {
        assert_eq!(lane.generation(), 1);
        let (number, _) = foreman.assign(0, &mut [&mut lane], (0, true)).expect("work");
        foreman.returned(0, number, answer(""), &mut [&mut lane]);
        assert_eq!(lane.generation(), generation);
    }
    // With its sketch drawn and nothing waiting, the rest follows.
    let mut drawn = 0;
    while let Some((number, _)) = foreman.assign(0, &mut [&mut lane], (0, true)) {
        foreman.returned(0, number, answer(""), &mut [&mut lane]);
        drawn += 1;
    }
    assert_eq!((drawn, lane.generation()), (3, 2));
}
