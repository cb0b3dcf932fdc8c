//! The questions: every one of them stands here, and nowhere else is there a list.

use super::answers::{Answers, Solve};
use super::basin::{Basin, BasinStudy};
use super::boundary::Boundary;
use super::chart::Chart;
use super::curves::{Along, CurvesStudy, Trace};
use super::find::{Evaluate, Find, FindStudy};
use super::harvest::{Between, Deliver, Harvest, HarvestStudy};
use super::inspection::Inspect;
use super::load::{BestAt, Forced, Load, LoadStudy, Reached};
use super::map::{DesignMap, Map};
use super::materials::{Fitted, Materials};
use super::modes::Modes;
use super::motion_chart::MotionChart;
use super::motions::Motions;
use super::multiplier_chart::{Columns, MultiplierChart};
use super::orbit::Orbit;
use super::request::Task;
use super::response::Response;
use super::simulate::Simulate;
use super::sweep::{Stretch, Sweep, SweepStudy};
use super::tongues::{Border, TongueStudy};
use super::trust::{Entry, Trust};
use super::verdict::Verdict;
use crate::model::Limits;
use crate::scheduler::lane::Traffic;
use crate::scheduler::piece::Hand;
use crate::scheduler::{Failure, Lane, Lanes, Single, Study, Table};

/// What requests may ask: the native command, JavaScript, and programs that the page writes.
pub const TASKS: [Task; 15] = [
    Task::of::<Modes>(),
    Task::of::<Boundary>(),
    Task::of::<Simulate>(),
    Task::of::<Orbit>(),
    Task::of::<Chart>(),
    Task::of::<Sweep>(),
    Task::of::<Verdict>(),
    Task::of::<Basin>(),
    Task::of::<Harvest>(),
    Task::of::<Load>(),
    Task::of::<Materials>(),
    Task::of::<Limits>(),
    Task::of::<Trust>(),
    Task::of::<Find>(),
    Task::of::<Map>(),
];

/// What workers can do.
pub const HANDS: [Hand; 17] = [
    Hand::of::<Solve>(),
    Hand::of::<Deliver>(),
    Hand::of::<Border>(),
    Hand::of::<Inspect>(),
    Hand::of::<Columns>(),
    Hand::of::<Response>(),
    Hand::of::<Stretch>(),
    Hand::of::<Along>(),
    Hand::of::<Trace>(),
    Hand::of::<Motions>(),
    Hand::of::<Between>(),
    Hand::of::<Forced>(),
    Hand::of::<Reached>(),
    Hand::of::<BestAt>(),
    Hand::of::<Fitted>(),
    Hand::of::<Entry>(),
    Hand::of::<Evaluate>(),
];

fn lane<S: Study>(name: &'static str, first: Option<S>) -> (&'static str, Box<dyn Traffic>) {
    let mut lane = Lane::default();
    first.into_iter().for_each(|study| lane.ask(study));
    (name, Box::new(lane))
}

/// The lane of requests from outside.
pub const ANSWERS: &str = "answers";

/// What the page may study at the same time, most urgent first; the first four also while the user's hand moves.
pub fn lanes() -> Lanes {
    let lanes = vec![
        lane(ANSWERS, Some(Answers::default())),
        lane::<Single<Deliver>>("operating", None),
        lane::<TongueStudy>("tongues", None),
        lane::<Single<Inspect>>("verdict", None),
        lane::<MultiplierChart>("multipliers", None),
        lane::<Single<Response>>("response", None),
        lane::<SweepStudy>("sweep", None),
        lane::<CurvesStudy>("curves", None),
        lane::<MotionChart>("motions", None),
        lane::<BasinStudy>("basin", None),
        lane::<HarvestStudy>("harvest", None),
        lane::<LoadStudy>("load", None),
        lane::<Table<BestAt>>("best frequencies", None),
        lane::<Table<Fitted>>("materials", None),
        lane::<Table<Entry>>("trust", None),
        lane::<FindStudy>("find", None),
        lane::<DesignMap>("map", None),
    ];
    Lanes::new(lanes, 4)
}

/// Carries out a piece that came as bytes, on behalf of whoever sent it; what it found as bytes.
///
/// # Errors
/// As [`Piece::carry_out`](crate::scheduler::Piece::carry_out).
pub fn carry_out(name: &str, message: &[u8]) -> Result<Vec<u8>, Failure> {
    let unknown = || Failure::Verbatim(format!("no piece is a {name}"));
    let hand = HANDS.iter().find(|hand| hand.name == name).ok_or_else(unknown)?;
    (hand.carry_out)(message)
}
