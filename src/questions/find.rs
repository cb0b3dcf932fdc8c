//! The best design over chosen variables within limits. The search is differential evolution, a generation of independent
//! candidates at a time, then rounds of a local search from the best places, and in the end the neighbours of the best one,
//! which tell a summit from a cliff.

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

use super::design::evolution::Evolution;
use super::design::polish::Polish;
use super::design::space::{DesignSpace, Evaluation, Objective, Variable, evaluate};
use super::error::{RequestError, failed};
use super::motions::Coordinate;
use super::question::Question;
use crate::model::{Device, Limits, ModelError, ParameterSet, Shaking};
use crate::scenario::{Scenario, counted};
use crate::scheduler::{Budget, Failure, Order, Piece, Study, complete_within};

/// Members of the population for each variable.
const PER_VARIABLE: usize = 8;
/// Places from which the local search starts, and how far apart they are at least (of the ranges).
const STARTS: usize = 3;
const APART: f64 = 0.08;
/// Rounds of the local search.
pub const ROUNDS: usize = 16;
/// How far the neighbours of the best are, as a part of each variable's value.
pub const NEIGHBOURS: f64 = 1e-3;
/// Part of the objective that a neighbour may lose on a summit; what loses more lies on a cliff.
const CLIFF: f64 = 0.1;
/// Numbers of generations that may be asked for.
pub const GENERATIONS: (usize, usize) = (1, 500);

/// A better design.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Find {
    /// What is varied.
    pub variables: Vec<Named>,
    /// What is to be good.
    #[serde(default = "default_objective")]
    pub objective: Objective,
    /// What must be kept; the voltage by the ceramic where none is given.
    #[serde(default)]
    pub limits: Limits,
    /// What of the base's motion candidates have in common.
    #[serde(default)]
    pub hold: Shaking,
    /// Generations of the search.
    #[serde(default = "default_generations")]
    pub generations: usize,
    /// The same seed gives the same search.
    #[serde(default)]
    pub seed: u64,
}

/// A variable by name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Named {
    /// One of the ten numbers, or a dimension of the device such as `resistance`.
    pub name: String,
    /// Its lowest value.
    pub from: f64,
    /// Its highest value.
    pub to: f64,
    /// Whether it is varied on a logarithmic scale.
    #[serde(default)]
    pub logarithmic: bool,
}

/// A better design.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FindAnswer {
    /// Values of the variables, in their order.
    pub values: Vec<f64>,
    /// What is known of them; limits are kept when the violation is 0.
    pub evaluation: Evaluation,
    /// The ten numbers of the design.
    pub parameters: ParameterSet,
    /// The same in SI units.
    pub device: Device,
    /// What a change of each variable by a thousandth does, in their order.
    pub sensitivity: Vec<NamedSensitivity>,
    /// Whether the design stands on a cliff: one of these changes takes more than a tenth of the objective.
    pub cliff: bool,
    /// Best value after each generation, and then after each round of the local search; null as long as there was none.
    pub history: Vec<Option<f64>>,
    /// Number of candidates evaluated.
    pub evaluations: usize,
}

/// What a small change of a variable does to the design.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NamedSensitivity {
    /// The variable.
    pub name: String,
    /// Its value before and after that of the design.
    pub at: [f64; 2],
    /// What is known there.
    pub evaluation: [Evaluation; 2],
    /// The part of the objective that the worse of them loses; 1 where nothing lasts.
    pub loss: f64,
}

/// The peak of the base's acceleration (g) that candidates of a scenario have in common, when they have.
pub(super) fn held(hold: Shaking, scenario: &Scenario) -> Option<f64> {
    let p = &scenario.parameters;
    (hold == Shaking::Acceleration).then(|| scenario.units().acceleration(p.beta, p.omega))
}

const fn default_objective() -> Objective {
    Objective::Power
}

const fn default_generations() -> usize {
    20
}

impl Question for Find {
    const TASK: &'static str = "find";
    const TAKES: &'static [&'static str] = &["initial", "t_end"];
    const COUNTS_LOSS: bool = true;
    type Answer = FindAnswer;

    fn answer(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<FindAnswer, RequestError> {
        scenario.validate()?;
        let variable = |named: &Named| {
            let coordinate = Coordinate::named(&named.name, scenario.model.modes).ok_or_else(|| {
                let problem = "allowed are the ten numbers and the device's dimensions".to_owned();
                RequestError::Field { field: format!("variables: {}", named.name), problem }
            })?;
            Ok(Variable { coordinate, range: (named.from, named.to), logarithmic: named.logarithmic })
        };
        for (i, named) in self.variables.iter().enumerate() {
            if self.variables[..i].iter().any(|other| other.name == named.name) {
                let problem = format!("`{}` is varied already", named.name);
                return Err(RequestError::Field { field: format!("variables[{i}].name"), problem });
            }
        }
        let variables = self.variables.iter().map(variable).collect::<Result<_, RequestError>>()?;
        let acceleration = held(self.hold, &scenario);
        let (objective, limits) = (self.objective, self.limits);
        let space = DesignSpace { scenario, variables, objective, limits, acceleration };
        let mut study = FindStudy::new(space, self.generations, self.seed)?;
        complete_within(&mut study, budget);
        failed(study.failure())?;
        let missing = || RequestError::Study("no candidate was evaluated".to_owned());
        let best = study.best().ok_or_else(missing)?;
        let scenario = study.scenario(best)?;
        let sensitivity = self.variables.iter().zip(study.sensitivities()).map(|(named, found)| {
            let at = found.neighbours.map(|(value, _)| value);
            let evaluation = found.neighbours.map(|(_, evaluation)| evaluation);
            NamedSensitivity { name: named.name.clone(), at, evaluation, loss: found.loss }
        });
        Ok(FindAnswer {
            values: best.values.clone(),
            evaluation: best.evaluation,
            parameters: scenario.parameters,
            device: scenario.device()?,
            sensitivity: sensitivity.collect(),
            cliff: study.sensitivities().iter().any(Sensitivity::cliff),
            history: study.history().iter().map(|best| best.evaluation.value).collect(),
            evaluations: study.visited().len(),
        })
    }
}

/// A candidate of a search or a cell of a map.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Evaluate {
    /// What is searched.
    pub space: DesignSpace,
    /// A value for each variable.
    pub values: Vec<f64>,
}

impl Piece for Evaluate {
    const NAME: &'static str = "candidate";
    type Found = Evaluation;

    fn carry_out(&self) -> Result<Evaluation, Failure> {
        Ok(evaluate(&self.space, &self.values)?)
    }
}

/// A candidate.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// A value for each variable, in its unit.
    pub values: Vec<f64>,
    /// What is known of it.
    pub evaluation: Evaluation,
}

/// What a small change of one variable does to the best candidate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensitivity {
    /// The variable's value before and after it, each with what is known there.
    pub neighbours: [(f64, Evaluation); 2],
    /// The part of the objective that the worse of them loses (dimensionless), 1 where nothing lasts; negative when both
    /// are better.
    pub loss: f64,
}

impl Sensitivity {
    /// Whether the best stands on a cliff: a change by [`NEIGHBOURS`] takes more than a tenth.
    pub fn cliff(&self) -> bool {
        !(self.loss <= CLIFF)
    }
}

/// What a search does.
#[derive(Debug, Clone)]
enum Phase {
    Evolution(Evolution),
    Polish(Polish),
    Neighbours,
    Done,
}

/// A search under way. It is cancelled by dropping it.
#[derive(Debug, Clone)]
pub struct FindStudy {
    space: DesignSpace,
    generations: usize,
    seed: u64,
    phase: Phase,
    /// The places tried at present, in the unit cube; those of the neighbours are values.
    trials: Vec<Vec<f64>>,
    /// How many sets of trials are done.
    generation: usize,
    handed: usize,
    sensitivities: Vec<Sensitivity>,
    evaluations: Vec<Option<Evaluation>>,
    best: Option<Candidate>,
    history: Vec<Candidate>,
    /// Every candidate with its evaluation, for a picture of the search.
    visited: Vec<Candidate>,
    failure: Option<Failure>,
    stopped: bool,
}

impl FindStudy {
    /// A search over so many `generations`; the same `seed` gives the same search. Its first candidates hold the
    /// scenario's own device where that lies within the ranges.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range.
    pub fn new(space: DesignSpace, generations: usize, seed: u64) -> Result<Self, ModelError> {
        space.validate()?;
        counted("generations", generations, GENERATIONS)?;
        let dimension = space.variables.len();
        let evolution = Evolution::new(dimension, PER_VARIABLE * dimension, seed, own(&space));
        let trials = evolution.trials().to_vec();
        Ok(Self {
            space,
            generations,
            seed,
            phase: Phase::Evolution(evolution),
            evaluations: vec![None; trials.len()],
            trials,
            generation: 0,
            handed: 0,
            sensitivities: Vec::new(),
            best: None,
            history: Vec::new(),
            visited: Vec::new(),
            failure: None,
            stopped: false,
        })
    }

    /// Ends the search with what it has found so far.
    pub fn stop(&mut self) {
        self.stopped = true;
    }

    /// What is searched.
    pub fn question(&self) -> &DesignSpace {
        &self.space
    }

    /// The best candidate of the generations done. Its violation is 0 when it keeps the limits.
    pub fn best(&self) -> Option<&Candidate> {
        self.best.as_ref()
    }

    /// What a small change of each variable does to the best candidate, in their order; empty until the search is done.
    pub fn sensitivities(&self) -> &[Sensitivity] {
        &self.sensitivities
    }

    /// The best candidate after each generation, and then after each round of the local search.
    pub fn history(&self) -> &[Candidate] {
        &self.history
    }

    /// Every candidate of the generations done, in the order of their evaluation.
    pub fn visited(&self) -> &[Candidate] {
        &self.visited
    }

    /// Why the search ended early, if it did.
    pub fn failure(&self) -> Option<&Failure> {
        self.failure.as_ref()
    }

    /// The scenario of a candidate, to be loaded.
    ///
    /// # Errors
    /// [`ModelError`] when it is no device.
    pub fn scenario(&self, candidate: &Candidate) -> Result<Scenario, ModelError> {
        self.space.candidate(&candidate.values)
    }

    fn values(&self, trial: &[f64]) -> Vec<f64> {
        self.space.variables.iter().zip(trial).map(|(variable, share)| variable.at(*share)).collect()
    }

    /// The values of a trial.
    fn values_of(&self, trial: &[f64]) -> Vec<f64> {
        if matches!(self.phase, Phase::Neighbours) { trial.to_vec() } else { self.values(trial) }
    }

    /// Takes a whole set of trials over.
    fn advance(&mut self) {
        let objective = self.space.objective;
        let evaluations: Vec<Evaluation> = self.evaluations.iter().flatten().copied().collect();
        let ranks: Vec<_> = evaluations.iter().map(|evaluation| evaluation.rank(&objective)).collect();
        if matches!(self.phase, Phase::Neighbours) {
            self.compare(&evaluations);
        } else {
            self.take_over(&evaluations);
        }
        self.generation += 1;
        self.phase = match std::mem::replace(&mut self.phase, Phase::Done) {
            Phase::Evolution(mut evolution) => {
                evolution.advance(&ranks);
                if self.generation < self.generations {
                    self.begin(evolution.trials().to_vec());
                    Phase::Evolution(evolution)
                } else {
                    let polish = Polish::new(evolution.best(STARTS, APART), self.seed);
                    self.begin(polish.trials().to_vec());
                    Phase::Polish(polish)
                }
            }
            Phase::Polish(mut polish) => {
                polish.advance(&ranks);
                if self.generation < self.generations + ROUNDS {
                    self.begin(polish.trials().to_vec());
                    Phase::Polish(polish)
                } else {
                    self.begin(self.neighbours());
                    Phase::Neighbours
                }
            }
            Phase::Neighbours | Phase::Done => Phase::Done,
        };
    }

    /// Makes the next set of trials.
    fn begin(&mut self, trials: Vec<Vec<f64>>) {
        self.evaluations = vec![None; trials.len()];
        (self.trials, self.handed) = (trials, 0);
    }

    /// Keeps the best of the candidates.
    fn take_over(&mut self, evaluations: &[Evaluation]) {
        let objective = self.space.objective;
        for (trial, evaluation) in self.trials.iter().zip(evaluations) {
            let candidate = Candidate { values: self.values(trial), evaluation: *evaluation };
            let better = self
                .best
                .as_ref()
                .is_none_or(|best| evaluation.rank(&objective) > best.evaluation.rank(&objective));
            if better {
                self.best = Some(candidate.clone());
            }
            self.visited.push(candidate);
        }
        self.history.extend(self.best.clone());
    }

    /// Values of the neighbours of the best, two a variable.
    fn neighbours(&self) -> Vec<Vec<f64>> {
        let Some(best) = &self.best else { return Vec::new() };
        let mut neighbours = Vec::new();
        for (i, variable) in self.space.variables.iter().enumerate() {
            for sign in [-1.0, 1.0] {
                let mut values = best.values.clone();
                values[i] = neighbour(variable, values[i], sign);
                neighbours.push(values);
            }
        }
        neighbours
    }

    fn compare(&mut self, evaluations: &[Evaluation]) {
        let Some(best) = &self.best else { return };
        let smaller_is_better = matches!(self.space.objective, Objective::Threshold(_));
        let loss = |there: &Evaluation| match (best.evaluation.value, there.value) {
            (Some(best), Some(there)) if smaller_is_better => 1.0 - best / there,
            (Some(best), Some(there)) => 1.0 - there / best,
            _ => 1.0,
        };
        let pairs = evaluations.chunks_exact(2).zip(self.trials.chunks_exact(2)).enumerate();
        self.sensitivities = pairs
            .map(|(i, (found, places))| Sensitivity {
                neighbours: [(places[0][i], found[0]), (places[1][i], found[1])],
                loss: loss(&found[0]).max(loss(&found[1])),
            })
            .collect();
    }
}

/// The value beside `value`, or at the end of its range.
fn neighbour(variable: &Variable, value: f64, sign: f64) -> f64 {
    let (low, high) = variable.range;
    let step = if value == 0.0 { NEIGHBOURS * (high - low) } else { NEIGHBOURS * value.abs() };
    (value + sign * step).clamp(low, high)
}

/// The scenario's own device as shares of the ranges; `None` where it lies outside.
fn own(space: &DesignSpace) -> Option<Vec<f64>> {
    let share = |variable: &Variable| {
        let value = variable.coordinate.value(&space.scenario)?;
        let (low, high) = variable.range;
        let share = if variable.logarithmic {
            (value / low).ln() / (high / low).ln()
        } else {
            (value - low) / (high - low)
        };
        (0.0..=1.0).contains(&share).then_some(share)
    };
    space.variables.iter().map(share).collect()
}

impl Study for FindStudy {
    fn next(&mut self) -> Option<Order<Self>> {
        if self.finished() {
            return None;
        }
        let trial = self.trials.get(self.handed)?;
        let values = self.values_of(trial);
        let (set, index) = (self.generation, self.handed);
        self.handed += 1;
        Some(Order::new(Evaluate { space: self.space.clone(), values }, move |study: &mut Self, found| {
            // One of a set before the present one comes too late.
            if study.finished() || study.generation != set {
                return;
            }
            match found {
                Ok(evaluation) => {
                    study.evaluations[index] = Some(evaluation);
                    if study.evaluations.iter().all(Option::is_some) {
                        study.advance();
                    }
                }
                Err(message) => study.failure = Some(message),
            }
        }))
    }

    fn progress(&self) -> f64 {
        if matches!(self.phase, Phase::Done) {
            return 1.0;
        }
        let part = self.evaluations.iter().flatten().count() as f64 / self.evaluations.len().max(1) as f64;
        (self.generation as f64 + part) / (self.generations + ROUNDS + 1) as f64
    }

    fn finished(&self) -> bool {
        self.stopped || self.failure.is_some() || matches!(self.phase, Phase::Done)
    }
}
