//! The search for a design: differential evolution, a generation of independent candidates at a time.

use super::Study;
use crate::jobs::design::evolution::Evolution;
use crate::jobs::design::find::{Evaluation, FindQuestion};
use crate::jobs::design::{DesignFinding, DesignWork};
use crate::jobs::motions::at_place;
use crate::jobs::work::{Finding, Work};
use crate::model::ModelError;
use crate::scenario::Scenario;

/// Members of the population for each variable.
const PER_VARIABLE: usize = 8;
/// Numbers of generations that may be asked for.
pub const GENERATIONS: (usize, usize) = (1, 500);

/// A candidate.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// A value for each variable, in its unit.
    pub values: Vec<f64>,
    /// What is known of it.
    pub evaluation: Evaluation,
}

/// A search under way. It is cancelled by dropping it.
#[derive(Debug, Clone)]
pub struct FindStudy {
    question: FindQuestion,
    generations: usize,
    evolution: Evolution,
    generation: usize,
    handed: usize,
    evaluations: Vec<Option<Evaluation>>,
    best: Option<Candidate>,
    history: Vec<Candidate>,
    /// Every candidate with its evaluation, for a picture of the search.
    visited: Vec<Candidate>,
    failure: Option<String>,
    stopped: bool,
}

impl FindStudy {
    /// A search over so many `generations`; the same `seed` gives the same search. Its first candidates hold the
    /// scenario's own device where that lies within the ranges.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range.
    pub fn new(question: FindQuestion, generations: usize, seed: u64) -> Result<Self, ModelError> {
        question.validate()?;
        let (minimum, maximum) = GENERATIONS;
        if !(minimum..=maximum).contains(&generations) {
            return Err(ModelError::Count { field: "generations", value: generations, minimum, maximum });
        }
        let dimension = question.variables.len();
        let evolution = Evolution::new(dimension, PER_VARIABLE * dimension, seed, own(&question));
        let size = evolution.trials().len();
        Ok(Self {
            question,
            generations,
            evolution,
            generation: 0,
            handed: 0,
            evaluations: vec![None; size],
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
    pub fn question(&self) -> &FindQuestion {
        &self.question
    }

    /// The best candidate of the generations done. Its violation is 0 when it keeps the limits.
    pub fn best(&self) -> Option<&Candidate> {
        self.best.as_ref()
    }

    /// The best candidate after each generation.
    pub fn history(&self) -> &[Candidate] {
        &self.history
    }

    /// Every candidate of the generations done, in the order of their evaluation.
    pub fn visited(&self) -> &[Candidate] {
        &self.visited
    }

    /// Why the search ended early, if it did.
    pub fn failure(&self) -> Option<&str> {
        self.failure.as_deref()
    }

    /// The scenario of a candidate, to be loaded.
    ///
    /// # Errors
    /// [`ModelError`] when it is no device.
    pub fn scenario(&self, candidate: &Candidate) -> Result<Scenario, ModelError> {
        let coordinates: Vec<_> =
            self.question.variables.iter().map(|variable| variable.coordinate).collect();
        at_place(&self.question.scenario, &coordinates, &candidate.values)
    }

    fn values(&self, trial: &[f64]) -> Vec<f64> {
        self.question.variables.iter().zip(trial).map(|(variable, share)| variable.at(*share)).collect()
    }

    /// Takes a whole generation over.
    fn advance(&mut self) {
        let objective = self.question.objective;
        let evaluations: Vec<Evaluation> = self.evaluations.iter().flatten().copied().collect();
        for (trial, evaluation) in self.evolution.trials().to_vec().iter().zip(&evaluations) {
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
        let ranks: Vec<_> = evaluations.iter().map(|evaluation| evaluation.rank(&objective)).collect();
        self.evolution.advance(&ranks);
        self.generation += 1;
        self.handed = 0;
        self.evaluations.iter_mut().for_each(|evaluation| *evaluation = None);
    }
}

/// The scenario's own device as shares of the ranges; `None` where it lies outside.
fn own(question: &FindQuestion) -> Option<Vec<f64>> {
    let share = |variable: &crate::jobs::design::find::Variable| {
        let value = variable.coordinate.value(&question.scenario)?;
        let (low, high) = variable.range;
        let share = if variable.logarithmic {
            (value / low).ln() / (high / low).ln()
        } else {
            (value - low) / (high - low)
        };
        (0.0..=1.0).contains(&share).then_some(share)
    };
    question.variables.iter().map(share).collect()
}

impl Study for FindStudy {
    fn next(&mut self) -> Option<(usize, Work)> {
        if self.finished() {
            return None;
        }
        let trial = self.evolution.trials().get(self.handed)?;
        let work =
            DesignWork::Candidate { question: Box::new(self.question.clone()), values: self.values(trial) };
        self.handed += 1;
        Some((self.generation * self.evaluations.len() + self.handed - 1, Work::Design(work)))
    }

    fn take(&mut self, ticket: usize, finding: Result<Finding, String>) {
        let size = self.evaluations.len();
        if self.finished() || ticket / size != self.generation {
            return;
        }
        match finding {
            Ok(Finding::Design(DesignFinding::Candidate(evaluation))) => {
                self.evaluations[ticket % size] = Some(evaluation);
                if self.evaluations.iter().all(Option::is_some) {
                    self.advance();
                }
            }
            Ok(_) => {
                self.failure = Some("the computation returned something else than a candidate".to_owned())
            }
            Err(message) => self.failure = Some(message),
        }
    }

    fn progress(&self) -> f64 {
        let part = self.evaluations.iter().flatten().count() as f64 / self.evaluations.len() as f64;
        (self.generation as f64 + part) / self.generations as f64
    }

    fn finished(&self) -> bool {
        self.stopped || self.failure.is_some() || self.generation >= self.generations
    }
}
