//! Verdict requests: what motion a start leads to, and what that rests on.

use serde::{Deserialize, Serialize};

use super::checks;
use super::error::RequestError;
use super::inspection::Inspection;
use super::question::Question;
use crate::dynamics::{self, Motion};
use crate::scenario::Scenario;
use crate::scheduler::Budget;

/// The motion that the scenario's start leads to; its duration is what is shown of the motion: how far it is from its end
/// then is told. The start is followed until its motion is known, however long that takes.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Verdict {}

/// A verdict with its short form.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VerdictAnswer {
    /// Class, voltage, what it rests on, what coexists and what to know, in words.
    pub sentence: String,
    /// The verdict itself.
    #[serde(flatten)]
    pub verdict: dynamics::Verdict,
}

impl Question for Verdict {
    const TASK: &'static str = "verdict";
    const TAKES: &'static [&'static str] = &["initial", "t_end"];
    type Answer = VerdictAnswer;

    fn answer(&self, scenario: Scenario, _: &Budget<'_>) -> Result<VerdictAnswer, RequestError> {
        let system = checks::system(&scenario)?;
        let initial = scenario.initial.unwrap_or_else(|| vec![0.0; system.dimension()]);
        let Inspection { verdict, .. } = Inspection::of(&system, &initial, scenario.t_end)?;
        Ok(VerdictAnswer { sentence: sentence(&verdict), verdict })
    }
}

/// The verdict in a few clauses.
fn sentence(verdict: &dynamics::Verdict) -> String {
    let mut clauses = vec![verdict.motion.to_string()];
    if verdict.motion != verdict.suspected {
        clauses.push(format!("suspected: {}", verdict.suspected));
    }
    clauses.extend(verdict.v_rms.map(|v_rms| format!("{v_rms:.4} V rms")));
    let agreeing = verdict.rests_on.iter().filter(|piece| piece.agrees == Some(true));
    let ended = matches!(verdict.motion, Motion::Escape { .. } | Motion::Contact { .. });
    if !ended {
        clauses.extend(agreeing.map(ToString::to_string));
    }
    clauses.extend(verdict.coexists.iter().map(ToString::to_string));
    clauses.extend(verdict.warnings.iter().map(ToString::to_string));
    clauses.join("; ")
}
