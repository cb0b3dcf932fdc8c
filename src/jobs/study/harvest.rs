//! What a device harvests over frequency: the linear device, the branches of periodic motions, what is reached from
//! rest, and what a sweep up and down reaches; all at the scenario's own amplitude of the base, or of its
//! acceleration. Where neighbours of the sampled curves differ, the motion is computed between them until the curve is
//! smooth or the frequency of a change is known.

use serde::{Deserialize, Serialize};

use super::Study;
use super::sweep::{Direction, SweepQuestion, SweepStudy};
use crate::dynamics::Motion;
use crate::dynamics::attractors::sweep::{Dwell, SweepPoint};
use crate::jobs::design::change::Way as ChangeWay;
use crate::jobs::design::linear::{LinearCurve, linear_curve};
use crate::jobs::design::{DesignError, DesignFinding, DesignWork, HarvestPoint, Plant};
use crate::jobs::motions::{Coordinate, MotionPlane};
use crate::jobs::response::{ResponseCurve, ResponsePoint};
use crate::jobs::work::{Finding, Work};
use crate::model::{ModelError, Parameter, Shaking};
use crate::scenario::Scenario;
use crate::spacing::between;

/// Frequencies of a piece of work.
const PER_PIECE: usize = 8;
/// Tickets: the branches, the two ways of the sweep, then the starts from rest.
const BRANCHES: usize = 0;
const SWEEPS: usize = 1;
const STARTS: usize = 3;
/// Difference of neighbours in power that is looked into, as a part of the curve's highest power, and how many of them
/// of a curve, the largest first.
const JUMP: f64 = 0.05;
const MOST_CHANGES: usize = 16;

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

/// A curve that is sampled.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Sampled {
    Swept(Direction),
    FromRest,
}

/// A jump between two neighbours of a sampled curve.
#[derive(Debug, Clone)]
struct Change {
    curve: Sampled,
    /// The first of the neighbours in the curve's order.
    index: usize,
    /// Difference in power (W) that is looked into.
    difference: f64,
    /// The points between them, once they are known; nothing where the motion ends.
    found: Option<Vec<Option<HarvestPoint>>>,
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
    /// For the ways up and down: how many values are done, and the state to go on from (length 2N + 1), at each piece.
    carried: [Vec<(usize, Option<Vec<f64>>)>; 2],
    /// Known once all curves are.
    changes: Option<Vec<Change>>,
    changes_handed: usize,
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
            carried: [vec![(0, None)], vec![(0, None)]],
            changes: None,
            changes_handed: 0,
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

    /// The same in pieces, cut where the motion ended, with what is known between the values.
    pub fn swept_pieces(&self, direction: Direction) -> Vec<Vec<HarvestPoint>> {
        let curve = Sampled::Swept(direction);
        pieces(self.refined(curve, self.sampled(curve)))
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

    /// What is reached from rest, cut where the motion ends or is not known, with what is known between the frequencies.
    pub fn rest_pieces(&self) -> Vec<Vec<HarvestPoint>> {
        pieces(self.refined(Sampled::FromRest, self.sampled(Sampled::FromRest)))
    }

    fn sampled(&self, curve: Sampled) -> Vec<Option<HarvestPoint>> {
        match curve {
            Sampled::Swept(direction) => self.swept(direction),
            Sampled::FromRest => {
                self.starts.iter().map(|start| start.flatten().map(|(_, point)| point)).collect()
            }
        }
    }

    /// A curve with the points of its changes.
    fn refined(&self, curve: Sampled, samples: Vec<Option<HarvestPoint>>) -> Vec<Option<HarvestPoint>> {
        let changes: Vec<&Change> =
            self.changes.iter().flatten().filter(|change| change.curve == curve).collect();
        let mut points = Vec::with_capacity(samples.len());
        for (index, sample) in samples.into_iter().enumerate() {
            points.push(sample);
            let found = changes.iter().find(|change| change.index == index);
            points.extend(found.and_then(|change| change.found.as_ref()).into_iter().flatten());
        }
        points
    }

    /// The changes of all curves, when these are whole.
    fn plan_changes(&mut self) {
        if self.changes.is_some() || !self.sweeps.finished() || !self.starts.iter().all(Option::is_some) {
            return;
        }
        let mut changes = Vec::new();
        for curve in [Sampled::Swept(Direction::Up), Sampled::Swept(Direction::Down), Sampled::FromRest] {
            let samples = self.sampled(curve);
            let power = |sample: &Option<HarvestPoint>| sample.map_or(0.0, |point| point.power);
            let highest = samples.iter().map(power).fold(0.0, f64::max);
            let mut jumps: Vec<(usize, f64)> = samples
                .windows(2)
                .enumerate()
                .map(|(index, pair)| {
                    let ends = pair[0].is_some() != pair[1].is_some();
                    let difference = (power(&pair[0]) - power(&pair[1])).abs();
                    (index, if ends { f64::INFINITY } else { difference })
                })
                .filter(|(_, difference)| *difference > JUMP * highest)
                .collect();
            jumps.sort_by(|a, b| b.1.total_cmp(&a.1));
            let difference = JUMP * highest;
            let change = |(index, _)| Change { curve, index, difference, found: None };
            changes.extend(jumps.into_iter().take(MOST_CHANGES).map(change));
        }
        self.changes = Some(changes);
    }

    fn next_change(&mut self) -> Option<(usize, Work)> {
        let handed = self.changes_handed;
        let Change { curve, index, difference, .. } = self.changes.as_ref()?.get(handed)?;
        let (way, neighbours) = match curve {
            Sampled::FromRest => (ChangeWay::FromRest, (self.omega(*index), self.omega(index + 1))),
            Sampled::Swept(direction) => {
                let values = self.sweeps.question().values(*direction);
                let pieces = &self.carried[usize::from(*direction == Direction::Down)];
                let (begin, state) = pieces.iter().rev().find(|(begin, _)| begin <= index)?;
                let visited = values[*begin..=*index].to_vec();
                let (state, dwell) = (state.clone(), self.question.dwell);
                let way = ChangeWay::Sweep { state, values: visited, dwell };
                (way, (values[*index], values[index + 1]))
            }
        };
        let difference = *difference;
        self.changes_handed += 1;
        let (scenario, shaking) = (self.question.scenario.clone(), self.question.shaking);
        let work = DesignWork::Change { scenario, shaking, way, neighbours, difference };
        Some((STARTS + self.starts.len() + handed, Work::Design(work)))
    }

    fn omega(&self, index: usize) -> f64 {
        between(self.question.window, index, self.question.count)
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
        sweep.or_else(|| self.next_starts()).or_else(|| self.next_change())
    }

    fn take(&mut self, ticket: usize, finding: Result<Finding, String>) {
        match (ticket, finding) {
            (BRANCHES, Ok(Finding::Response(curves))) => self.branches = Some(Ok(curves)),
            (BRANCHES, Err(message)) => self.branches = Some(Err(message)),
            (SWEEPS..STARTS, finding) => {
                let state = match &finding {
                    Ok(Finding::Sweep { state, .. }) => state.clone(),
                    _ => None,
                };
                let way = ticket - SWEEPS;
                self.sweeps.take(way, finding);
                let direction = if way == 0 { Direction::Up } else { Direction::Down };
                self.carried[way].push((self.sweeps.points(direction).len(), state));
            }
            (_, finding) if ticket >= STARTS + self.starts.len() => {
                let index = ticket - STARTS - self.starts.len();
                if let Some(change) = self.changes.as_mut().and_then(|changes| changes.get_mut(index)) {
                    // Where it cannot be computed the line between the neighbours is all there is.
                    change.found = match finding {
                        Ok(Finding::Design(DesignFinding::Change(points))) => Some(points),
                        _ => Some(Vec::new()),
                    };
                }
            }
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
        self.plan_changes();
    }

    fn progress(&self) -> f64 {
        let branches = if self.branches.is_some() { 1.0 } else { 0.0 };
        let starts = self.starts.iter().flatten().count() as f64 / self.starts.len().max(1) as f64;
        let changes = self.changes.as_ref().map_or(0.0, |changes| {
            let known = changes.iter().filter(|change| change.found.is_some()).count();
            if changes.is_empty() { 1.0 } else { known as f64 / changes.len() as f64 }
        });
        0.2 * branches + 0.35 * self.sweeps.progress() + 0.35 * starts + 0.1 * changes
    }

    fn finished(&self) -> bool {
        let known = |changes: &Vec<Change>| changes.iter().all(|change| change.found.is_some());
        let whole = self.branches.is_some() && self.changes.as_ref().is_some_and(known);
        self.failure.is_some() || self.sweeps.failure().is_some() || whole
    }
}
