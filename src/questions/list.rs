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

/// Gives all tasks to a macro: the question of each, and the file it is in. A line here and that file are a task. Help and
/// README tell them in this order.
macro_rules! tasks {
    ($to:ident) => {
        $to! {
            Modes modes
            Boundary boundary
            Simulate simulate
            Orbit orbit
            Chart chart
            Sweep sweep
            Continue continuation
            Curves curves
            Verdict verdict
            Basin basin
            Harvest harvest
            Load load
            Materials materials
            Limits limits
            Trust trust
            Find find
            Map map
            Shake shake
            Tolerances tolerances
            Fit fit
        }
    };
}
pub(super) use tasks;

macro_rules! questions {
    ($($name:ident $file:ident)*) => {
        /// What requests may ask: the native command, JavaScript, and programs that the page writes.
        pub const TASKS: &[Task] = &[$(Task::of::<super::$file::$name>()),*];
    };
}
tasks!(questions);

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
