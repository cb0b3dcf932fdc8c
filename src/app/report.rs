//! State and results as JSON, for `window.harvester` and its users.

use serde::Serialize;

use super::crew::Studies;
use super::session::{Session, Status};
use super::view::View;
use crate::dynamics::attractors::poincare::{PhasePoint, Recurrence};
use crate::dynamics::integration::summary::Summary;
use crate::dynamics::{Outcome, Verdict};
use crate::scenario::Scenario;

#[derive(Serialize)]
struct State<'a> {
    view: &'a View,
    /// "done", "computing" or "failed".
    status: &'static str,
    error: Option<String>,
    /// Numbers of the newest question and of the one whose answer is shown.
    generation: u64,
    shown_generation: Option<u64>,
    /// Frames from question to answer, the last ones.
    frames_to_answer: &'a std::collections::VecDeque<u64>,
    result: Option<Answer<'a>>,
    /// Verdict on the scenario in view, once it is there.
    verdict: Option<&'a Verdict>,
    /// Done part, 0 to 1, of what is being computed beside the run.
    progress: Vec<(&'static str, f64)>,
}

#[derive(Serialize)]
struct Answer<'a> {
    scenario: &'a Scenario,
    outcome: Outcome,
    end_time: f64,
    final_state: &'a [f64],
    steps: usize,
    summary: Option<Summarised>,
    recurrence: Option<Recurrence>,
    strobe_count: usize,
    last_strobe: Option<&'a PhasePoint>,
}

/// A summary, whose tip has two names of its own, too.
#[derive(Serialize)]
struct Summarised {
    #[serde(flatten)]
    summary: Summary,
    tip_min: f64,
    tip_max: f64,
}

impl From<Summary> for Summarised {
    fn from(summary: Summary) -> Self {
        let (tip_min, tip_max) = summary.measures.tip;
        Self { summary, tip_min, tip_max }
    }
}

/// The answer of `harvester.state()`.
pub(super) fn state(view: &View, session: &Session, studies: &Studies) -> String {
    let progress: Vec<(&str, f64)> = studies.lanes.progress().collect();
    let (status, error) = match session.status() {
        Status::Done => ("done", None),
        Status::Computing(_) => ("computing", None),
        Status::Failed(why) => ("failed", Some(why.to_string())),
    };
    let result = session.shown.as_ref().map(|shown| Answer {
        scenario: &shown.scenario,
        outcome: shown.run.outcome(),
        end_time: shown.run.trajectory.end_time(),
        final_state: shown.run.trajectory.final_state(),
        steps: shown.run.trajectory.len(),
        summary: shown.run.summary.map(Summarised::from),
        recurrence: shown.run.recurrence,
        strobe_count: shown.run.strobe.len(),
        last_strobe: shown.run.strobe.last(),
    });
    let state = State {
        view,
        status,
        error,
        generation: session.generation,
        shown_generation: session.shown.as_ref().map(|shown| shown.generation),
        frames_to_answer: &session.delays,
        result,
        verdict: studies
            .inspection(&view.scenario)
            .filter(|(_, current)| *current)
            .map(|(found, _)| &found.verdict),
        progress,
    };
    serde_json::to_string(&state).unwrap_or_default()
}
