//! What is being studied for the page: one lane a topic, the newest question of each.

use crate::questions::continuation::{Continue, Response};
use crate::questions::design::linear::LinearBest;
use crate::questions::inspection::{Inspect, Inspection};
use crate::questions::list;
use crate::questions::response::ResponseCurve;
use crate::questions::tongues::TongueStudy;
use crate::scenario::Scenario;
use crate::scheduler::{Asked as _, Failure, Lanes, Piece, Single, Table};

/// The lanes, and what the Design tab knows besides.
pub(in crate::app) struct Studies {
    /// One a topic.
    pub lanes: Lanes,
    /// Whether the search for a design was ended.
    pub(super) ended: bool,
    /// The linear device at its best, and for which scenario.
    pub(super) reference: Option<(Scenario, Option<LinearBest>)>,
}

/// Response curves to draw.
pub(in crate::app) struct Followed<'a> {
    /// The question that they answer.
    pub question: &'a Continue,
    /// The curves, or why there are none.
    pub curves: Result<&'a [ResponseCurve], &'a Failure>,
    /// Whether it is the newest question.
    pub newest: bool,
}

impl Default for Studies {
    fn default() -> Self {
        Self { lanes: list::lanes(), ended: false, reference: None }
    }
}

impl Studies {
    /// Whether anything is under way or waits to be, besides requests from outside.
    pub(in crate::app) fn is_busy(&self) -> bool {
        self.lanes.progress().any(|(name, _)| name != list::ANSWERS)
    }

    /// Asks for one piece of work, when the present one of its kind is done.
    pub(in crate::app) fn offer<P: Piece + Clone + PartialEq>(&mut self, piece: P) {
        self.lanes.offer(piece, |piece| Some(Single::new(piece)));
    }

    /// Asks for a table.
    pub(in crate::app) fn tabulate<P: Piece + Clone + PartialEq>(&mut self, table: Table<P>) {
        self.lanes.ask(table.asked().clone(), |_| Some(table));
    }

    /// The newest exact tongues, and whether they belong to `structure`.
    pub(in crate::app) fn tongues(&self, structure: &Scenario) -> Option<(&TongueStudy, bool)> {
        let study: &TongueStudy = self.lanes.finished().or_else(|| self.lanes.study())?;
        Some((study, study.asked().0 == *structure))
    }

    /// The newest response curves.
    pub(in crate::app) fn response(&self) -> Option<Followed<'_>> {
        let study: &Single<Response> = self.lanes.finished()?;
        let curves = study.found()?.map(Vec::as_slice);
        let wanted: Option<&Single<Response>> = self.lanes.wanted();
        let newest = wanted.is_some_and(|wanted| wanted.asked() == study.asked());
        Some(Followed { question: &study.asked().question, curves, newest })
    }

    /// The newest verdict and its evidence, and whether it belongs to `scenario`.
    pub(in crate::app) fn inspection(&self, scenario: &Scenario) -> Option<(&Inspection, bool)> {
        let study: &Single<Inspect> = self.lanes.finished()?;
        Some((study.found()?.ok()?, study.asked().scenario == *scenario))
    }
}
