//! Sweep requests: the motion at one value of a parameter after another, and the branches of periodic motions there.

use serde::{Deserialize, Serialize};

use super::{Answer, check_ends, count, state};
use crate::dynamics::attractors::sweep::{Dwell, SweepPoint};
use crate::jobs::RequestError;
use crate::jobs::budget::Budget;
use crate::jobs::response::{ResponseCurve, response};
use crate::jobs::study::complete_within;
use crate::jobs::study::sweep::{COUNTS, Direction, SweepQuestion, SweepStudy};
use crate::model::{Parameter, ParameterSet, Shaking};
use crate::scenario::{ModelChoice, Scenario};

/// Most stroboscopic voltages of an answer.
const MOST_STROBES: usize = 200_000;

/// A sweep.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SweepRequest {
    /// The ten numbers; the one swept plays no role.
    #[serde(default)]
    pub parameters: ParameterSet,
    /// Modes and force law.
    #[serde(default)]
    pub model: ModelChoice,
    /// What is swept.
    pub parameter: Parameter,
    /// Its lowest value.
    pub from: f64,
    /// Its highest value.
    pub to: f64,
    /// Number of equally spaced values.
    #[serde(default = "SweepRequest::default_count")]
    pub count: usize,
    /// Which end the sweep starts from.
    #[serde(default)]
    pub direction: Direction,
    /// Excitation periods thrown away at each value.
    #[serde(default = "SweepRequest::default_transient")]
    pub transient: usize,
    /// Excitation periods kept at each value.
    #[serde(default = "SweepRequest::default_kept")]
    pub kept: usize,
    /// Where the first value starts (length 2N + 1), and each after a motion that ended; rest when absent.
    #[serde(default)]
    pub initial: Option<Vec<f64>>,
    /// Whether the branches of periodic motions are followed too.
    #[serde(default)]
    pub branches: bool,
}

/// A sweep.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SweepAnswer {
    /// One a value, in the order in which they were visited.
    pub points: Vec<SweepPoint>,
    /// The forced motion and the doubled ones that leave it, stable or not, when they were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub branches: Option<Vec<ResponseCurve>>,
}

impl SweepRequest {
    const fn default_count() -> usize {
        101
    }

    fn default_transient() -> usize {
        Dwell::default().discarded
    }

    fn default_kept() -> usize {
        Dwell::default().kept
    }

    /// Computes the answer.
    ///
    /// # Errors
    /// [`RequestError`] when a number is out of range or a motion cannot be integrated.
    pub fn answer(&self, budget: &Budget<'_>) -> Result<Answer, RequestError> {
        let range = (self.from, self.to);
        check_ends(self.parameter.field(), range, self.parameter.range())?;
        count("count", self.count, COUNTS)?;
        count("transient", self.transient, Dwell::DISCARDED)?;
        count("kept", self.kept, Dwell::KEPT)?;
        count("count times kept", self.count * self.kept, (1, MOST_STROBES))?;
        let mut parameters = self.parameters;
        *self.parameter.get_mut(&mut parameters) = self.from;
        let system = self.model.system(parameters)?;
        state("initial", self.initial.as_ref(), system.dimension())?;
        let initial = self.initial.clone();
        let scenario = Scenario { parameters, model: self.model, initial, ..Scenario::default() };
        let dwell = Dwell { discarded: self.transient, kept: self.kept };
        let question = SweepQuestion {
            scenario: scenario.clone(),
            parameter: self.parameter,
            shaking: Shaking::Amplitude,
            range,
            count: self.count,
            dwell,
        };
        question.validate()?;
        let mut sweep = SweepStudy::new(question, &[self.direction]);
        complete_within(&mut sweep, budget);
        if let Some(message) = sweep.failure() {
            return Err(RequestError::Study(message.to_owned()));
        }
        let branches = self
            .branches
            .then(|| budget.piece(|| response(&scenario, (self.parameter, Shaking::Amplitude), range)))
            .flatten()
            .transpose()?;
        let cut = branches.iter().flatten().any(|branch| branch.cut);
        if cut {
            budget
                .lacks("the branches were not followed to their ends, which would take too long".to_owned());
        }
        Ok(Answer::Sweep(SweepAnswer { points: sweep.points(self.direction).to_vec(), branches }))
    }
}
