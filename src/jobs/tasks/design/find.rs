//! Find requests: the best design over chosen variables within limits.

use serde::{Deserialize, Serialize};

use super::failed;
use crate::jobs::RequestError;
use crate::jobs::budget::Budget;
use crate::jobs::design::find::{Evaluation, FindQuestion, Objective, Variable};
use crate::jobs::motions::Coordinate;
use crate::jobs::study::complete_within;
use crate::jobs::study::find::{FindStudy, Sensitivity};
use crate::model::{Device, Limits, ParameterSet};
use crate::scenario::Scenario;

/// A better design.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FindTask {
    /// What is varied.
    pub variables: Vec<Named>,
    /// What is to be good.
    #[serde(default = "FindTask::default_objective")]
    pub objective: Objective,
    /// What must be kept; the voltage by the ceramic where none is given.
    #[serde(default)]
    pub limits: Limits,
    /// Generations of the search.
    #[serde(default = "FindTask::default_generations")]
    pub generations: usize,
    /// The same seed gives the same search.
    #[serde(default)]
    pub seed: u64,
}

/// A variable by name.
#[derive(Debug, Clone, PartialEq, Deserialize)]
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

impl FindTask {
    const fn default_objective() -> Objective {
        Objective::Power
    }

    const fn default_generations() -> usize {
        20
    }

    pub(super) fn answer(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<FindAnswer, RequestError> {
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
        let question = FindQuestion { scenario, variables, objective: self.objective, limits: self.limits };
        let mut study = FindStudy::new(question, self.generations, self.seed)?;
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
