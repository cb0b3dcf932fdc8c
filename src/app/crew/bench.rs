//! What is being studied for the Design tab.

use super::studies::Studies;
use crate::app::bench::questions;
use crate::app::session::Session;
use crate::app::view::View;
use crate::questions::design::Operating;
use crate::questions::design::linear::{LinearBest, linear_at_its_best};
use crate::questions::design::space::DesignSpace;
use crate::questions::find::FindStudy;
use crate::questions::fit::{Fit, FitStudy};
use crate::questions::harvest::{Deliver, HarvestStudy};
use crate::questions::load::LoadStudy;
use crate::questions::shake::AtLevel;
use crate::questions::shaken_run::ShakenRun;
use crate::scenario::Scenario;
use crate::scheduler::{Asked as _, Failure, Piece, Single, Study, Table};
use crate::sentence::Sentence;

/// The same search every time.
const SEED: u64 = 1;

impl Studies {
    /// Asks what the device delivers.
    pub(in crate::app) fn deliver(&mut self, scenario: &Scenario) {
        self.offer(Deliver { scenario: scenario.clone() });
        if self.reference.as_ref().is_none_or(|(of, _)| of != scenario) {
            self.reference = Some((scenario.clone(), linear_at_its_best(scenario).ok()));
        }
    }

    /// Asks for the curves over frequency.
    pub(in crate::app) fn harvest(&mut self, view: &View, session: &Session) {
        let (scenario, question, frequency) = questions::harvest(view, session);
        self.lanes.ask((scenario, question), |(scenario, question)| {
            HarvestStudy::new(scenario, question, frequency).ok()
        });
    }

    /// Asks for the curves over the load.
    pub(in crate::app) fn load(&mut self, view: &View) {
        self.lanes.ask(questions::load(view), |(scenario, question)| LoadStudy::new(scenario, question).ok());
    }

    /// Begins the search for a design, or ends it: one under way keeps its best so far, a finished one is put away.
    ///
    /// # Errors
    /// What of the question is out of range.
    pub(in crate::app) fn search(
        &mut self,
        question: Option<DesignSpace>,
        view: &View,
    ) -> Result<(), Sentence> {
        let Some(lane) = self.lanes.lane_mut::<FindStudy>() else { return Ok(()) };
        let Some(question) = question else {
            let put_away = lane.study().is_none_or(Study::finished);
            lane.redirect(FindStudy::stop);
            self.ended = put_away || lane.study().is_none_or(|study| study.best().is_none());
            return Ok(());
        };
        self.ended = false;
        let study = FindStudy::new(question, view.design.search.generations, SEED);
        lane.ask(study?);
        Ok(())
    }

    /// Goes on with the runs under any shaking, and with those over its level, where they were stopped, or stops them.
    pub(in crate::app) fn shake(&mut self, on: bool) {
        self.turn::<ShakenRun>(on);
        self.turn::<AtLevel>(on);
    }

    /// Once the newest runs are not stopped, what is computed over the level, which was stopped with those before, goes on.
    pub(in crate::app) fn shake_over_levels(&mut self) {
        if self.lanes.study::<Table<ShakenRun>>().is_some_and(|runs| !runs.is_stopped()) {
            self.turn::<AtLevel>(true);
        }
    }

    fn turn<P: Piece + Clone>(&mut self, on: bool) {
        if let Some(lane) = self.lanes.lane_mut::<Table<P>>()
            && lane.study().is_some_and(|table| !table.is_whole() && table.is_stopped() == on)
        {
            lane.redirect(if on { Table::resume } else { Table::stop });
        }
    }

    /// Begins a fit.
    ///
    /// # Errors
    /// What of the question is out of range.
    pub(in crate::app) fn fit(&mut self, (scenario, fit): (Scenario, Fit)) -> Result<(), Sentence> {
        let Some(lane) = self.lanes.lane_mut::<FitStudy>() else { return Ok(()) };
        let study = FitStudy::new(scenario, fit).map_err(|error| Sentence::Verbatim(error.to_string()))?;
        lane.ask(study);
        Ok(())
    }

    /// The search for a design, unless it was ended.
    pub(in crate::app) fn found(&self) -> Option<&FindStudy> {
        self.lanes.study().filter(|_| !self.ended)
    }

    /// What the device delivers, or why nothing is known, and whether it is the device in view.
    pub(in crate::app) fn operating(
        &self,
        scenario: &Scenario,
    ) -> Option<(Result<&Operating, &Failure>, bool)> {
        let study: &Single<Deliver> = self.lanes.finished()?;
        Some((study.found()?, study.asked().scenario == *scenario))
    }

    /// What the linear device would give at its own first resonance (Hz).
    pub(in crate::app) fn linear_at_its_best(&self) -> Option<&LinearBest> {
        self.reference.as_ref().and_then(|(_, best)| best.as_ref())
    }
}
