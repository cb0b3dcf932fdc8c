//! What the Paper tab computes beside the run in view: the same motion under the exact force law, and the boundaries
//! of a figure for its four dampings.

use super::figures::{BoundaryFigure, Figure};
use super::map::Tongue;
use crate::dynamics::Outcome;
use crate::dynamics::integration::summary::Summary;
use crate::model::{ForceLaw, ParameterSet};
use crate::questions::RunJob;
use crate::scenario::{ModelChoice, Scenario};
use crate::theory::{CoupledModes, Published};

/// The run in view repeated with the exact magnet force.
#[derive(Debug)]
pub(super) enum ExactRun {
    /// Still being computed.
    Computing(Box<RunJob>),
    /// How it ended, with its last tenth.
    Done(Outcome, Option<Summary>),
    /// It has no answer.
    Failed,
}

/// Comparison for the scenario of a figure.
#[derive(Debug, Default)]
pub(super) struct Comparison {
    scenario: Option<Scenario>,
    /// The exact law's run, once a figure was loaded.
    pub exact: Option<ExactRun>,
    figure: Option<(u8, ParameterSet, ModelChoice)>,
    /// One tongue for each damping of the figure in view.
    pub tongues: Vec<(f64, Tongue)>,
}

impl Comparison {
    /// Prepares what `figure` needs for `scenario`; cheap when nothing changed.
    pub(super) fn follow(&mut self, figure: &Figure, scenario: &Scenario) {
        match figure.boundaries() {
            Some(boundaries) => self.trace(figure.number, boundaries, scenario),
            None if self.scenario.as_ref() != Some(scenario) => {
                let model = ModelChoice { force: ForceLaw::Exact, ..scenario.model };
                let exact = Scenario { model, ..scenario.clone() };
                self.exact = Some(
                    RunJob::new(&exact).map_or(ExactRun::Failed, |job| ExactRun::Computing(Box::new(job))),
                );
                self.scenario = Some(scenario.clone());
            }
            None => {}
        }
    }

    /// The figure's four boundaries for the structure in view, with the figure's dampings.
    fn trace(&mut self, number: u8, figure: BoundaryFigure, scenario: &Scenario) {
        let p = &scenario.parameters;
        let structure = ParameterSet { alpha: 0.0, beta: 0.0, omega: 1.0, ..*p };
        let key = (number, structure, scenario.model);
        if self.figure.as_ref() == Some(&key) {
            return;
        }
        self.figure = Some(key);
        self.tongues = figure
            .dampings
            .into_iter()
            .filter_map(|alpha| {
                let system = scenario.model.system(ParameterSet { alpha, ..structure }).ok()?;
                let published = Published::new(&system).ok()?;
                let coupled = CoupledModes::new(&system).ok();
                Some((alpha, Tongue::new(figure.resonance, figure.half_width, &published, coupled.as_ref())))
            })
            .collect();
    }

    /// Goes on with the exact run for `steps` steps; whether there is more to do.
    pub(super) fn advance(&mut self, steps: usize) -> bool {
        let Some(ExactRun::Computing(job)) = &mut self.exact else { return false };
        match job.advance(steps) {
            Ok(None) => return true,
            Ok(Some(run)) => self.exact = Some(ExactRun::Done(run.outcome(), run.summary)),
            Err(_) => self.exact = Some(ExactRun::Failed),
        }
        false
    }
}
