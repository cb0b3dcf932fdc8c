//! Continuation: the branches of periodic motions along any one parameter, stable or not, with their bifurcations.

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

use super::checks::{check_ends, count, state, system};
use super::error::RequestError;
use super::question::Question;
use super::response::{Begin, DOUBLINGS, Followed, ResponseCurve, ResponsePoint};
use super::response::{branches, branches_through, curve, point};
use crate::dynamics::bifurcations::curves::{Criticality, normal_form};
use crate::dynamics::orbits::period_map::MOST_PERIODS;
use crate::dynamics::{self, Bifurcation, BranchEnd, BranchPoint, Effort, Instability, Motion, reach};
use crate::model::{Along, ModelError, Parameter, ParameterSet, ReducedSystem, Shaking};
use crate::scenario::Scenario;
use crate::scheduler::{Budget, Failure, Piece};

/// How often period doublings may be followed.
const MOST_DOUBLINGS: usize = 6;

/// Branches of periodic motions. Without a guess or a start the scenario's own value of the parameter plays no role.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, SerBin, DeBin)]
pub struct Continue {
    /// What changes.
    pub parameter: Parameter,
    /// Its lowest value.
    pub from: f64,
    /// Its highest value.
    pub to: f64,
    /// What of the base's motion stays meanwhile.
    #[serde(default)]
    pub hold: Shaking,
    /// State at t = 0 (length 2N + 1) near a periodic motion at the scenario's own value, which is followed both ways.
    /// When absent, the motion to which the scenario's start leads there, and without one the forced motion.
    #[serde(default)]
    pub guess: Option<Vec<f64>>,
    /// Period of the motion near the guess, in excitation periods, or a multiple of it.
    #[serde(default = "default_periods")]
    pub periods: usize,
    /// How often period doublings are followed.
    #[serde(default = "default_doublings")]
    pub doublings: usize,
}

const fn default_periods() -> usize {
    1
}

const fn default_doublings() -> usize {
    DOUBLINGS
}

/// Branches of periodic motions.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ContinueAnswer {
    /// The branches in the order in which they were found; null when the budget was spent before.
    pub branches: Option<Vec<BranchAnswer>>,
}

/// A branch of periodic motions.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BranchAnswer {
    /// Their period, in excitation periods.
    pub periods: usize,
    /// Where it begins, and why there.
    pub begin: End,
    /// Where it ends, and why there.
    pub end: End,
    /// Whether more of it, or of the branches that leave it, was left out because it would take too long.
    pub cut: bool,
    /// Its points in order.
    pub points: Vec<PointAnswer>,
    /// The changes of stability on it, in order.
    pub bifurcations: Vec<BifurcationAnswer>,
}

/// Why a branch is not followed any further.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum End {
    /// The end of the range.
    Range,
    /// It meets a branch of motions of half its period where these double it.
    BranchPoint {
        /// The parameter's value there.
        value: f64,
        /// Index of that branch, where it was followed from there.
        #[serde(skip_serializing_if = "Option::is_none")]
        branch: Option<usize>,
    },
    /// It is closed: its first point is its last one.
    Closed,
    /// The next point could not be found: the motion touches or escapes, or cannot be resolved.
    Lost {
        /// What the last attempt met.
        reason: String,
    },
    /// The largest number of points was reached.
    Points,
    /// Following it further would take too long.
    Effort,
}

/// A periodic motion on a branch.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PointAnswer {
    /// The parameter's value, means and extremes, and the modulus of the largest multiplier.
    #[serde(flatten)]
    pub point: ResponsePoint,
    /// Excitation amplitude (dimensionless).
    pub beta: f64,
    /// Absolute argument of the largest multiplier (radians).
    pub argument: f64,
    /// Whether all multipliers are inside the unit circle.
    pub stable: bool,
    /// How it is unstable; null when it is stable.
    pub instability: Option<Instability>,
    /// State at t = 0 (length 2N + 1).
    pub state: Vec<f64>,
}

/// A change of stability on a branch.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BifurcationAnswer {
    /// Its kind.
    pub kind: Instability,
    /// To which side motions branch off; null at a fold, and where it is not known.
    pub criticality: Option<Criticality>,
    /// Coefficient of the normal form, as in [`dynamics::bifurcations::curves::CurvePoint`]; null as above.
    pub coefficient: Option<f64>,
    /// How many points of the branch lie before it.
    pub after: usize,
    /// The parameter's value there, means and extremes, and the modulus of the largest multiplier.
    #[serde(flatten)]
    pub point: ResponsePoint,
    /// Excitation amplitude (dimensionless).
    pub beta: f64,
    /// State at t = 0 (length 2N + 1).
    pub state: Vec<f64>,
}

impl Question for Continue {
    const TASK: &'static str = "continue";
    const TAKES: &'static [&'static str] = &["initial"];
    type Answer = ContinueAnswer;

    fn answer(&self, mut scenario: Scenario, budget: &Budget<'_>) -> Result<ContinueAnswer, RequestError> {
        self.check(&scenario)?;
        if self.guess.is_none() && scenario.initial.is_none() {
            scenario.parameters = self.set(&scenario, self.from);
        }
        let dimension = system(&scenario)?.dimension();
        state("guess", self.guess.as_ref(), dimension)?;
        let found = budget.piece(|| self.follow(&scenario)).transpose()?;
        if found.iter().flatten().any(Followed::is_cut) {
            budget
                .lacks("the branches were not followed to their ends, which would take too long".to_owned());
        }
        let answer = |found: &Followed| self.branch(&scenario, found);
        let branches = found.map(|found| found.iter().map(answer).collect::<Result<_, _>>()).transpose()?;
        Ok(ContinueAnswer { branches })
    }
}

impl Continue {
    /// Its lowest and highest value.
    pub fn range(&self) -> (f64, f64) {
        (self.from, self.to)
    }

    fn check(&self, scenario: &Scenario) -> Result<(), RequestError> {
        let field = self.parameter.field();
        check_ends(field, self.range(), self.parameter.range())?;
        if self.from == self.to {
            let problem = format!("{} must be above {field}.from", self.to);
            return Err(RequestError::Field { field: format!("{field}.to"), problem });
        }
        count("periods", self.periods, (1, MOST_PERIODS))?;
        count("doublings", self.doublings, (0, MOST_DOUBLINGS))?;
        let started = scenario.initial.is_some();
        if started && self.guess.is_some() {
            let problem = "given beside initial, but a branch starts from one of them".to_owned();
            return Err(RequestError::Field { field: "guess".to_owned(), problem });
        }
        if started || self.guess.is_some() {
            ModelError::check(field, scenario.parameters.get(self.parameter), self.range(), "")?;
        }
        Ok(())
    }

    /// The ten numbers at a value of the parameter.
    fn set(&self, scenario: &Scenario, value: f64) -> ParameterSet {
        Along::from(self.hold).at(&scenario.parameters, self.parameter, value)
    }

    fn follow(&self, scenario: &Scenario) -> Result<Vec<Followed>, RequestError> {
        let (moved, range) = ((self.parameter, self.hold.into()), self.range());
        if self.guess.is_none() && scenario.initial.is_none() {
            return Ok(branches(scenario, moved, range, self.doublings)?);
        }
        let system = scenario.model.system(scenario.parameters)?;
        let orbit = match (&self.guess, &scenario.initial) {
            (None, Some(start)) => reached(&system, start)?,
            (guess, _) => dynamics::Orbit::find(&system, guess.as_deref(), self.periods)?,
        };
        Ok(branches_through(scenario, moved, range, &orbit, self.doublings)?)
    }

    fn branch(&self, scenario: &Scenario, found: &Followed) -> Result<BranchAnswer, RequestError> {
        let Followed { branch, periods, begin, .. } = found;
        let beta = |point: &BranchPoint| self.set(scenario, point.value).beta;
        let answer = |found: &BranchPoint| {
            let largest = found.multipliers.first().copied().unwrap_or_default();
            let stable = found.stable();
            PointAnswer {
                point: point(found),
                beta: beta(found),
                argument: largest.arg().abs(),
                stable,
                instability: (!stable).then(|| Instability::of(largest)),
                state: found.state.clone(),
            }
        };
        let change = |found: &Bifurcation| -> Result<BifurcationAnswer, RequestError> {
            let (kind, state) = (found.kind, found.point.state.clone());
            let there = scenario.model.system(self.set(scenario, found.point.value))?;
            let coefficient = normal_form(&there, kind, *periods, &state).unwrap_or_default();
            Ok(BifurcationAnswer {
                kind,
                criticality: coefficient.and_then(|value| Criticality::of(kind, value)),
                coefficient,
                after: found.after,
                point: point(&found.point),
                beta: beta(&found.point),
                state,
            })
        };
        Ok(BranchAnswer {
            periods: *periods,
            begin: match begin {
                Begin::End(end) => End::of(end),
                Begin::Born { on, value } => End::BranchPoint { value: *value, branch: Some(*on) },
            },
            end: End::of(&branch.end),
            cut: found.is_cut(),
            points: branch.points.iter().map(answer).collect(),
            bifurcations: branch.bifurcations.iter().map(change).collect::<Result<_, _>>()?,
        })
    }
}

/// The periodic motion to which the state `start` of `system` leads.
fn reached(system: &ReducedSystem, start: &[f64]) -> Result<dynamics::Orbit, RequestError> {
    let reached = reach(system, start, Effort::full())?;
    match (reached.motion, reached.orbit) {
        (Motion::Periodic { .. }, Some(orbit)) => Ok(orbit),
        (motion, _) => {
            let problem = format!("it leads to no periodic motion that could be followed ({motion})");
            Err(RequestError::Field { field: "initial".to_owned(), problem })
        }
    }
}

impl End {
    fn of(end: &BranchEnd) -> Self {
        match end {
            BranchEnd::Range => Self::Range,
            BranchEnd::Halved { value } => Self::BranchPoint { value: *value, branch: None },
            BranchEnd::Closed => Self::Closed,
            BranchEnd::Lost { reason } => Self::Lost { reason: reason.to_string() },
            BranchEnd::Points => Self::Points,
            BranchEnd::Effort => Self::Effort,
        }
    }
}

/// The branches to draw.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Response {
    /// The device and its other numbers.
    pub scenario: Scenario,
    /// What is followed.
    pub question: Continue,
}

impl Response {
    /// The branches of the forced motion along `parameter` through `range`; no start leads to them.
    pub fn forced(scenario: &Scenario, parameter: Parameter, hold: Shaking, (from, to): (f64, f64)) -> Self {
        let (guess, periods, doublings) = (None, default_periods(), default_doublings());
        let question = Continue { parameter, from, to, hold, guess, periods, doublings };
        Self { scenario: Scenario { initial: None, ..scenario.clone() }, question }
    }
}

impl Piece for Response {
    const NAME: &'static str = "response";
    /// The branches found.
    type Found = Vec<ResponseCurve>;

    fn carry_out(&self) -> Result<Vec<ResponseCurve>, Failure> {
        let followed = self.question.follow(&self.scenario).map_err(|error| match error {
            RequestError::Orbit(error) => error.into(),
            error => Failure::Verbatim(error.to_string()),
        });
        Ok(followed?.iter().map(curve).collect())
    }
}
