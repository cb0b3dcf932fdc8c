//! Computing what the view asks for, a slice a frame, newest question first.

use std::rc::Rc;

use super::clock::milliseconds;
use super::comparison::Comparison;
use super::curves::Curves;
use super::figures::Figure;
use super::map::{Boundaries, structure};
use crate::questions::{Run, RunJob};
use crate::scenario::Scenario;
use crate::sentence::Sentence;

/// Time a frame may spend on computing.
const BUDGET_MS: f64 = 7.0;
/// Steps between looks at the clock.
const SLICE: usize = 400;
/// A run that has not finished after this time gives way to a newer question.
const PATIENCE_MS: f64 = 250.0;

/// A finished run with its curves.
#[derive(Debug)]
pub(super) struct Shown {
    /// Number of the question it answers.
    pub generation: u64,
    /// What was computed.
    pub scenario: Scenario,
    /// The result.
    pub run: Run,
    /// What the plots draw of it.
    pub curves: Curves,
}

/// Where the computation of the newest question stands.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Status {
    /// What is shown answers it.
    Done,
    /// Under way: done part, 0 to 1.
    Computing(f64),
    /// It has no answer; what is shown is older.
    Failed(Sentence),
}

/// A run under way.
struct Work {
    generation: u64,
    scenario: Scenario,
    job: RunJob,
    started: f64,
}

/// Questions and answers of a page.
#[derive(Default)]
pub(super) struct Session {
    /// Number of the newest question.
    pub generation: u64,
    /// The newest question, until its run begins.
    waiting: Option<Scenario>,
    asked: Option<Scenario>,
    work: Option<Work>,
    failure: Option<Sentence>,
    /// The newest answer.
    pub shown: Option<Shown>,
    /// Boundaries of the structure in view.
    pub boundaries: Option<Boundaries>,
    /// What the Paper tab computes beside the run in view.
    pub comparison: Comparison,
    /// Curves kept for comparison.
    pub pinned: Option<Rc<Shown>>,
    /// Frames between a question and its answer, the last ones, for the page's own statistics.
    pub delays: std::collections::VecDeque<u64>,
    frame: u64,
    asked_in_frame: u64,
}

impl Session {
    /// Asks for `scenario`, unless it was the last thing asked for.
    pub(super) fn ask(&mut self, scenario: &Scenario) {
        if self.asked.as_ref() == Some(scenario) {
            return;
        }
        self.asked = Some(scenario.clone());
        self.waiting = Some(scenario.clone());
        self.generation += 1;
        self.asked_in_frame = self.frame;
        let wanted = structure(scenario);
        if self.boundaries.as_ref().is_none_or(|boundaries| boundaries.structure != wanted)
            && let Ok((system, _)) = scenario.validate()
        {
            self.boundaries = Some(Boundaries::new(wanted, &system));
        }
    }

    /// Where the newest question stands.
    pub(super) fn status(&self) -> Status {
        if let Some(why) = &self.failure {
            Status::Failed(why.clone())
        } else if let Some(work) = &self.work {
            Status::Computing(work.job.progress())
        } else if self.waiting.is_some() {
            Status::Computing(0.0)
        } else {
            Status::Done
        }
    }

    /// Works for at most a frame's budget; call once a frame.
    pub(super) fn work(&mut self) {
        self.frame += 1;
        let start = milliseconds();
        while milliseconds() - start < BUDGET_MS {
            let Some(mut work) = self.next(start) else { return };
            match work.job.advance(SLICE) {
                Ok(Some(run)) => self.show(work, run),
                Ok(None) => self.work = Some(work),
                Err(error) => self.fail(work.generation, error.into()),
            }
        }
    }

    /// Computes what `figure` compares the run in view with, once that is done; whether there is more to do.
    pub(super) fn compare(&mut self, figure: Option<&Figure>, scenario: &Scenario) -> bool {
        let Some(figure) = figure else { return false };
        self.comparison.follow(figure, scenario);
        let start = milliseconds();
        while self.status() == Status::Done && milliseconds() - start < BUDGET_MS {
            if !self.comparison.advance(SLICE) {
                return false;
            }
        }
        self.status() == Status::Done
    }

    /// The run to go on with: the one under way unless it is overdue, else the question that waits.
    fn next(&mut self, now: f64) -> Option<Work> {
        match self.work.take() {
            Some(work) if self.waiting.is_none() || now - work.started < PATIENCE_MS => return Some(work),
            _ => {}
        }
        let scenario = self.waiting.take()?;
        let generation = self.generation;
        match RunJob::new(&scenario) {
            Ok(job) => Some(Work { generation, scenario, job, started: now }),
            Err(error) => {
                self.fail(generation, error.into());
                None
            }
        }
    }

    fn show(&mut self, work: Work, run: Run) {
        let curves = Curves::new(&run);
        if work.generation == self.generation {
            self.failure = None;
            self.delays.push_back(self.frame - self.asked_in_frame);
            if self.delays.len() > 2000 {
                self.delays.pop_front();
            }
        }
        self.shown = Some(Shown { generation: work.generation, scenario: work.scenario, run, curves });
    }

    fn fail(&mut self, generation: u64, why: Sentence) {
        if generation == self.generation {
            self.failure = Some(why);
        }
    }

    /// Keeps the present curves as ghosts, or drops them.
    pub(super) fn pin(&mut self, keep: bool) {
        self.pinned = match &self.shown {
            Some(shown) if keep => Some(Rc::new(Shown {
                generation: shown.generation,
                scenario: shown.scenario.clone(),
                run: shown.run.clone(),
                curves: shown.curves.clone(),
            })),
            _ => None,
        };
    }
}
