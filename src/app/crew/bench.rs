//! What is being studied for the Design tab.

use super::lane::{offer, open};
use crate::app::bench::{Pinned, questions};
use crate::app::session::Session;
use crate::app::view::View;
use crate::app::view::design::Page;
use crate::jobs::design::find::FindQuestion;
use crate::jobs::design::linear::{LinearBest, linear_at_its_best};
use crate::jobs::design::{DesignFinding, DesignWork, Operating};
use crate::jobs::foreman::Lane;
use crate::jobs::study::Study as _;
use crate::jobs::study::find::FindStudy;
use crate::jobs::study::harvest::HarvestStudy;
use crate::jobs::study::load::LoadStudy;
use crate::jobs::study::map::DesignMap;
use crate::jobs::study::single::Single;
use crate::jobs::study::table::Table;
use crate::jobs::work::{Finding, Work};
use crate::scenario::Scenario;

/// Columns and rows of a map.
const MAP: (usize, usize) = (40, 28);
/// The same search every time.
const SEED: u64 = 1;

/// The lanes of the bench.
#[derive(Default)]
pub(in crate::app) struct BenchStudies {
    /// What the device delivers as it is.
    pub(super) operating: Lane<Single>,
    /// What it delivers over frequency.
    pub harvest: Lane<HarvestStudy>,
    /// Power against the load.
    pub load: Lane<LoadStudy>,
    /// The best frequency of a few loads.
    pub best: Lane<Table>,
    /// The ceramics side by side.
    pub materials: Lane<Table>,
    /// The model in view against others.
    pub trust: Lane<Table>,
    /// A result over two dimensions.
    pub map: Lane<DesignMap>,
    /// The search for a design.
    pub find: Lane<FindStudy>,
    /// Whether the search was ended.
    ended: bool,
    /// The linear device at its best, and for which scenario.
    reference: Option<(Scenario, Option<LinearBest>)>,
}

impl BenchStudies {
    /// Asks for what the tab shows.
    pub(super) fn follow(&mut self, view: &View, session: &Session) {
        let scenario = &view.scenario;
        let work = Work::Design(DesignWork::Operating { scenario: scenario.clone() });
        offer(&mut self.operating, work);
        if self.reference.as_ref().is_none_or(|(of, _)| of != scenario) {
            self.reference = Some((scenario.clone(), linear_at_its_best(scenario).ok()));
        }
        let page = view.design.page;
        if matches!(page, Page::Harvest | Page::Measured) {
            let question = questions::harvest(view, session);
            if self.harvest.study().is_none_or(|study| *study.question() != question)
                && let Ok(study) = HarvestStudy::new(question)
            {
                self.harvest.ask(study);
            }
        }
        if matches!(page, Page::Harvest | Page::Load)
            && let Some(question) = questions::load(view)
            && self.load.study().is_none_or(|study| *study.question() != question)
            && let Ok(study) = LoadStudy::new(question)
        {
            self.load.ask(study);
        }
        match page {
            Page::Load => {
                if let Some(loads) = self.load.study() {
                    ask(&mut self.best, questions::best_frequencies(view, session, loads));
                }
            }
            Page::Materials => ask(&mut self.materials, questions::materials(view)),
            Page::Trust => ask(&mut self.trust, questions::trust(view)),
            Page::Search => self.ask_map(view, session),
            Page::Harvest | Page::Measured => {}
        }
    }

    fn ask_map(&mut self, view: &View, session: &Session) {
        let question = questions::map(view, session);
        if self.map.study().is_none_or(|study| *study.question() != question)
            && let Ok(study) = DesignMap::new(question, MAP)
        {
            self.map.ask(study);
        }
    }

    /// Begins the search for a design, or ends it: one under way keeps its best so far, a finished one is put away.
    ///
    /// # Errors
    /// One sentence about what of the question is out of range.
    pub(in crate::app) fn search(
        &mut self,
        question: Option<FindQuestion>,
        view: &View,
    ) -> Result<(), String> {
        let Some(question) = question else {
            let under_way = self.find.study_mut().filter(|study| !study.finished());
            self.ended = under_way.is_none_or(|study| {
                study.stop();
                study.best().is_none()
            });
            return Ok(());
        };
        self.ended = false;
        let study = FindStudy::new(question, view.design.search.generations, SEED);
        self.find.ask(study.map_err(|error| error.to_string())?);
        Ok(())
    }

    /// The search for a design, unless it was ended.
    pub(in crate::app) fn found(&self) -> Option<&FindStudy> {
        self.find.study().filter(|_| !self.ended)
    }

    /// Whether anything is under way.
    pub(super) fn is_busy(&self) -> bool {
        open(&self.operating)
            || open(&self.harvest)
            || open(&self.load)
            || open(&self.best)
            || open(&self.materials)
            || open(&self.trust)
            || open(&self.map)
            || open(&self.find)
    }

    /// What the device delivers, or why nothing is known, and whether it is the device in view.
    pub(in crate::app) fn operating(&self, scenario: &Scenario) -> Option<(Result<&Operating, &str>, bool)> {
        let study = self.operating.finished()?;
        let found = match study.found()? {
            Ok(Finding::Design(DesignFinding::Operating(found))) => Ok(&**found),
            Ok(_) => return None,
            Err(message) => Err(message.as_str()),
        };
        let current = matches!(
            study.work(),
            Work::Design(DesignWork::Operating { scenario: of }) if of == scenario
        );
        Some((found, current))
    }

    /// What is known of `scenario`, to be kept.
    pub(in crate::app) fn pinned(&self, scenario: &Scenario) -> Box<Pinned> {
        let operating = self.operating(scenario).and_then(|(found, _)| found.ok().cloned());
        Box::new(Pinned { harvest: self.harvest.study().cloned(), operating })
    }

    /// What the linear device would give at its own first resonance (Hz).
    pub(in crate::app) fn linear_at_its_best(&self) -> Option<&LinearBest> {
        self.reference.as_ref().and_then(|(_, best)| best.as_ref())
    }
}

/// Asks for a table, unless it is the present one.
fn ask(lane: &mut Lane<Table>, table: Table) {
    if lane.study().is_none_or(|present| present.works() != table.works()) {
        lane.ask(table);
    }
}
