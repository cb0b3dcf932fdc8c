//! The questions: every one of them stands here, and nowhere else is there a list.

use super::answers::{Answers, Solve};
use super::basin::BasinStudy;
use super::continuation::Response;
use super::curves::{Crossings, CurvesStudy, Trace};
use super::find::{Evaluate, FindStudy};
use super::fit::{FitStudy, Voltages};
use super::harvest::{Between, Branches, Deliver, HarvestStudy, Starts};
use super::inspection::Inspect;
use super::load::{BestAt, Forced, LoadStudy, Reached};
use super::map::DesignMap;
use super::materials::Fitted;
use super::motion_chart::MotionChart;
use super::motions::Motions;
use super::multiplier_chart::{Columns, MultiplierChart};
use super::rectifier::{BestVoltage, OpenCircuit, Rectified, RectifierStudy};
use super::request::Task;
use super::shake::AtLevel;
use super::shaken_run::ShakenRun;
use super::sweep::{Stretch, SweepStudy};
use super::tolerances::{Leaning, Meant, ToleranceStudy};
use super::tongues::{Border, TongueStudy};
use super::trust::Entry;
use crate::scheduler::lane::Traffic;
use crate::scheduler::piece::Hand;
use crate::scheduler::{Failure, Lane, Lanes, Single, Study, Table, Tell};

/// What requests may ask: the native command, JavaScript, and programs that the page writes.
pub const TASKS: &[Task] = &[
    Task::of::<super::modes::Modes>(),
    Task::of::<super::boundary::Boundary>(),
    Task::of::<super::simulate::Simulate>(),
    Task::of::<super::orbit::Orbit>(),
    Task::of::<super::chart::Chart>(),
    Task::of::<super::sweep::Sweep>(),
    Task::of::<super::continuation::Continue>(),
    Task::of::<super::curves::Curves>(),
    Task::of::<super::verdict::Verdict>(),
    Task::of::<super::basin::Basin>(),
    Task::of::<super::harvest::Harvest>(),
    Task::of::<super::load::Load>(),
    Task::of::<super::materials::Materials>(),
    Task::of::<crate::model::Limits>(),
    Task::of::<super::trust::Trust>(),
    Task::of::<super::find::Find>(),
    Task::of::<super::map::Map>(),
    Task::of::<super::shake::Shake>(),
    Task::of::<super::tolerances::Tolerances>(),
    Task::of::<super::fit::Fit>(),
];

/// What workers can do.
pub const HANDS: &[Hand] = &[
    Hand::of::<Solve>(),
    Hand::of::<Deliver>(),
    Hand::of::<Border>(),
    Hand::of::<Inspect>(),
    Hand::of::<Columns>(),
    Hand::of::<Response>(),
    Hand::of::<Stretch>(),
    Hand::of::<Crossings>(),
    Hand::of::<Trace>(),
    Hand::of::<Motions>(),
    Hand::of::<Branches>(),
    Hand::of::<Starts>(),
    Hand::of::<Between>(),
    Hand::of::<Forced>(),
    Hand::of::<Reached>(),
    Hand::of::<BestAt>(),
    Hand::of::<OpenCircuit>(),
    Hand::of::<Rectified>(),
    Hand::of::<BestVoltage>(),
    Hand::of::<Fitted>(),
    Hand::of::<Entry>(),
    Hand::of::<Evaluate>(),
    Hand::of::<ShakenRun>(),
    Hand::of::<AtLevel>(),
    Hand::of::<Meant>(),
    Hand::of::<Voltages>(),
    Hand::of::<Leaning>(),
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
        lane::<RectifierStudy>("rectifier", None),
        lane::<Table<BestAt>>("best frequencies", None),
        lane::<Table<Fitted>>("materials", None),
        lane::<Table<Entry>>("trust", None),
        lane::<FindStudy>("find", None),
        lane::<DesignMap>("map", None),
        lane::<Table<ShakenRun>>("shake", None),
        lane::<Table<AtLevel>>("levels", None),
        lane::<ToleranceStudy>("tolerances", None),
        lane::<FitStudy>("fit", None),
    ];
    Lanes::new(lanes, 4)
}

/// Carries out a piece that came as bytes, on behalf of whoever sent it, telling how far it is; what it found as bytes.
///
/// # Errors
/// As [`Piece::carry_out`](crate::scheduler::Piece::carry_out).
pub fn carry_out(name: &str, message: &[u8], tell: Tell<'_>) -> Result<Vec<u8>, Failure> {
    let unknown = || Failure::Verbatim(format!("no piece is a {name}"));
    let hand = HANDS.iter().find(|hand| hand.name == name).ok_or_else(unknown)?;
    (hand.carry_out)(message, tell)
}
