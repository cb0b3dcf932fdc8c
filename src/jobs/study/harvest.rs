//! What a device harvests over frequency: the linear device, the branches of periodic motions, what is reached from
//! rest, and what a sweep up and down reaches; all at the scenario's own amplitude of the base, or of its
//! acceleration.

use serde::{Deserialize, Serialize};

use super::Study;
use super::sweep::{Direction, SweepQuestion, SweepStudy};
use crate::dynamics::Motion;
use crate::dynamics::sweep::{Dwell, SweepPoint};
use crate::jobs::design::linear::{LinearCurve, linear_curve};
use crate::jobs::design::{DesignError, HarvestPoint, Plant};
use crate::jobs::motions::{Coordinate, MotionPlane};
use crate::jobs::response::{ResponseCurve, ResponsePoint};
use crate::jobs::work::{Finding, Work};
use crate::model::{ModelError, Parameter, Shaking};
use crate::scenario::Scenario;

/// Frequencies of a piece of work.
const PER_PIECE: usize = 8;
/// Tickets: the branches, the two ways of the sweep, then the starts from rest.
const BRANCHES: usize = 0;
const SWEEPS: usize = 1;
const STARTS: usize = 3;

/// What is asked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HarvestQuestion {
    /// The device; its omega and its start play no role, except that the dielectric loss is that at its omega.
    pub scenario: Scenario,
    /// Lowest and highest omega (dimensionless).
    pub window: (f64, f64),
    /// What of the base's motion stays over them.
    pub shaking: Shaking,
    /// Number of frequencies of sweeps and starts, 2 to 2000.
    pub count: usize,
    /// How long a frequency is held in a sweep.
    pub dwell: Dwell,
}

/// The curves being computed.
#[derive(Debug, Clone)]
pub struct HarvestStudy {
    question: HarvestQuestion,
    plant: Plant,
    linear: LinearCurve,
    branches: Option<Result<Vec<ResponseCurve>, String>>,
    branches_handed: bool,
    sweeps: SweepStudy,
    starts: Vec<Option<Option<(Motion, HarvestPoint)>>>,
    starts_handed: usize,
    failure: Option<String>,
}

impl HarvestStudy {
    /// The linear device is known at once, the rest is to be computed.
    ///
    /// # Errors
    /// [`DesignError`] naming what is out of range.
    pub fn new(question: HarvestQuestion) -> Result<Self, DesignError> {
        let plant = Plant::new(&question.scenario)?.shaken(question.shaking);
        let (low, high) = (question.window.0, Parameter::Beta.range().1);
        ModelError::check("beta at the lowest frequency", plant.beta_at(low), (0.0, high), "")?;
        let rest = Scenario { initial: None, ..plant.scenario.clone() };
        let sweep = SweepQuestion {
            scenario: rest,
            parameter: Parameter::Omega,
            shaking: question.shaking,
            range: question.window,
            count: question.count,
            dwell: question.dwell,
        };
        sweep.validate()?;
        let linear = linear_curve(&plant, question.window, question.count)?;
        Ok(Self {
            linear,
            branches: None,
            branches_handed: false,
            sweeps: SweepStudy::new(sweep, &[Direction::Up, Direction::Down]),
            starts: vec![None; question.count],
            starts_handed: 0,
            plant,
            question,
            failure: None,
        })
    }

    /// What is asked.
    pub fn question(&self) -> &HarvestQuestion {
        &self.question
    }

    /// The device without its magnets.
    pub fn linear(&self) -> &LinearCurve {
        &self.linear
    }

    /// The same as points of a curve.
    pub fn linear_points(&self) -> Vec<HarvestPoint> {
        let points = self.linear.points.iter();
        points.map(|point| HarvestPoint::of_linear(&self.plant, *point)).collect()
    }

    /// The forced branch and the doubled ones; why there are none, or `None` until they are known.
    pub fn branches(&self) -> Option<Result<&[ResponseCurve], &str>> {
        self.branches.as_ref().map(|found| found.as_deref().map_err(String::as_str))
    }

    /// A branch's points in SI units, each with whether it is stable.
    pub fn branch_points(&self, curve: &ResponseCurve) -> Vec<(HarvestPoint, bool)> {
        let point =
            |point: &ResponsePoint| (HarvestPoint::of_branch(&self.plant, point), point.multiplier < 1.0);
        curve.points.iter().map(point).collect()
    }

    /// What the sweep has reached so far, in the order of its way; `None` where the motion ended.
    pub fn swept(&self, direction: Direction) -> Vec<Option<HarvestPoint>> {
        let point = |point: &SweepPoint| (!point.ended).then(|| HarvestPoint::of_sweep(&self.plant, point));
        self.sweeps.points(direction).iter().map(point).collect()
    }

    /// The same in pieces, cut where the motion ended.
    pub fn swept_pieces(&self, direction: Direction) -> Vec<Vec<HarvestPoint>> {
        pieces(self.swept(direction))
    }

    /// What is reached from rest, by ascending frequency; `None` until it is known, the inner one where the motion ends
    /// or cannot be followed.
    pub fn from_rest(&self) -> &[Option<Option<(Motion, HarvestPoint)>>] {
        &self.starts
    }

    /// Why something is missing, if it is and will stay so.
    pub fn failure(&self) -> Option<&str> {
        self.failure.as_deref().or_else(|| self.sweeps.failure())
    }

    /// The stable pieces of all branches.
    pub fn stable_pieces(&self) -> Vec<Vec<HarvestPoint>> {
        let curves = self.branches().and_then(Result::ok).unwrap_or_default();
        let points = curves.iter().map(|curve| self.branch_points(curve));
        let mut pieces = Vec::new();
        for points in points {
            let runs = points.chunk_by(|a, b| a.1 == b.1).filter(|run| run[0].1);
            pieces.extend(runs.map(|run| run.iter().map(|(point, _)| *point).collect()));
        }
        pieces
    }

    /// What is reached from rest, cut where the motion ends or is not known.
    pub fn rest_pieces(&self) -> Vec<Vec<HarvestPoint>> {
        pieces(self.starts.iter().map(|start| start.flatten().map(|(_, point)| point)).collect())
    }

    fn omega(&self, index: usize) -> f64 {
        let (low, high) = self.question.window;
        low + (high - low) * index as f64 / (self.question.count - 1) as f64
    }

    fn next_starts(&mut self) -> Option<(usize, Work)> {
        let begin = self.starts_handed;
        let end = (begin + PER_PIECE).min(self.starts.len());
        if begin == end {
            return None;
        }
        self.starts_handed = end;
        let plane = MotionPlane {
            scenario: Scenario { initial: None, ..self.plant.scenario.clone() },
            x: Coordinate::Parameter(Parameter::Omega),
            y: Coordinate::Parameter(Parameter::Beta),
        };
        let places =
            (begin..end).map(|index| [self.omega(index), self.plant.beta_at(self.omega(index))]).collect();
        Some((STARTS + begin / PER_PIECE, Work::Motions { plane, places }))
    }
}

/// A curve in pieces, cut where there is nothing.
fn pieces(curve: Vec<Option<HarvestPoint>>) -> Vec<Vec<HarvestPoint>> {
    let runs = curve.chunk_by(|a, b| a.is_some() == b.is_some());
    runs.map(|run| run.iter().flatten().copied().collect::<Vec<_>>())
        .filter(|piece| !piece.is_empty())
        .collect()
}

impl Study for HarvestStudy {
    fn next(&mut self) -> Option<(usize, Work)> {
        if self.failure.is_some() {
            return None;
        }
        if !std::mem::replace(&mut self.branches_handed, true) {
            let (scenario, range) = (self.plant.scenario.clone(), self.question.window);
            let (parameter, shaking) = (Parameter::Omega, self.question.shaking);
            return Some((BRANCHES, Work::Response { scenario, parameter, shaking, range }));
        }
        let sweep = self.sweeps.next().map(|(ticket, work)| (SWEEPS + ticket, work));
        sweep.or_else(|| self.next_starts())
    }

    fn take(&mut self, ticket: usize, finding: Result<Finding, String>) {
        match (ticket, finding) {
            (BRANCHES, Ok(Finding::Response(curves))) => self.branches = Some(Ok(curves)),
            (BRANCHES, Err(message)) => self.branches = Some(Err(message)),
            (SWEEPS..STARTS, finding) => self.sweeps.take(ticket - SWEEPS, finding),
            (_, Ok(Finding::Motions(found))) => {
                let begin = (ticket - STARTS) * PER_PIECE;
                for (index, signature) in (begin..).zip(found) {
                    let cell =
                        signature.map(|signature| signature.cell).filter(|cell| cell.demand().is_some());
                    let point = |omega| {
                        cell.map(|cell| {
                            let volts = (cell.v_rms, cell.v_peak);
                            (cell.motion, HarvestPoint::new(&self.plant, omega, volts, cell.tip, cell.slope))
                        })
                    };
                    let found = point(self.omega(index));
                    if let Some(place) = self.starts.get_mut(index) {
                        *place = Some(found);
                    }
                }
            }
            (_, Ok(_)) => {
                self.failure = Some("the computation returned something else than asked for".to_owned())
            }
            (_, Err(message)) => self.failure = Some(message),
        }
    }

    fn progress(&self) -> f64 {
        let branches = if self.branches.is_some() { 1.0 } else { 0.0 };
        let starts = self.starts.iter().flatten().count() as f64 / self.starts.len().max(1) as f64;
        0.2 * branches + 0.4 * self.sweeps.progress() + 0.4 * starts
    }

    fn finished(&self) -> bool {
        let whole =
            self.branches.is_some() && self.sweeps.finished() && self.starts.iter().all(Option::is_some);
        self.failure.is_some() || whole
    }
}
