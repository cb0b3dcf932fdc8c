//! Verdict requests: what motion a start leads to, and what that rests on.

use serde::{Deserialize, Serialize};

use super::{Answer, state};
use crate::dynamics::{Motion, Verdict};
use crate::jobs::RequestError;
use crate::model::{ModelError, ParameterSet};
use crate::scenario::{END_TIME, ModelChoice};

/// A start whose motion is asked for.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct VerdictRequest {
    /// The ten numbers; missing ones are the paper's.
    pub parameters: ParameterSet,
    /// Modes and force law.
    pub model: ModelChoice,
    /// What is shown of the motion (dimensionless): how far it is from its end then is told. The start is followed until its
    /// motion is known, however long that takes.
    pub t_end: f64,
    /// State at time 0, length 2N + 1; rest when absent.
    pub initial: Option<Vec<f64>>,
}

impl Default for VerdictRequest {
    fn default() -> Self {
        Self {
            parameters: ParameterSet::default(),
            model: ModelChoice::default(),
            t_end: 600.0,
            initial: None,
        }
    }
}

/// A verdict with its short form.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VerdictAnswer {
    /// Class, voltage, what it rests on, what coexists and what to know, in words.
    pub sentence: String,
    /// The verdict itself.
    #[serde(flatten)]
    pub verdict: Verdict,
}

impl VerdictRequest {
    /// Computes the answer.
    ///
    /// # Errors
    /// [`RequestError`] when a number is out of range or the motion cannot be integrated.
    pub fn answer(&self) -> Result<Answer, RequestError> {
        ModelError::check("t_end", self.t_end, END_TIME, "")?;
        let system = self.model.system(self.parameters)?;
        state("initial", self.initial.as_ref(), system.dimension())?;
        let initial = self.initial.clone().unwrap_or_else(|| vec![0.0; system.dimension()]);
        let verdict = Verdict::of(&system, &initial, self.t_end)?;
        Ok(Answer::Verdict(Box::new(VerdictAnswer { sentence: sentence(&verdict), verdict })))
    }
}

/// The verdict in a few clauses.
fn sentence(verdict: &Verdict) -> String {
    let mut clauses = vec![verdict.motion.to_string()];
    if verdict.motion != verdict.suspected {
        clauses.push(format!("suspected: {}", verdict.suspected));
    }
    clauses.extend(verdict.v_rms.map(|v_rms| format!("{v_rms:.4} V rms")));
    let agreeing = verdict.rests_on.iter().filter(|piece| piece.agrees == Some(true));
    let ended = matches!(verdict.motion, Motion::Escape { .. } | Motion::Contact { .. });
    if !ended {
        clauses.extend(agreeing.map(|piece| piece.says.clone()));
    }
    clauses.extend(verdict.coexists.iter().map(ToString::to_string));
    clauses.extend(verdict.warnings.iter().map(ToString::to_string));
    clauses.join("; ")
}
