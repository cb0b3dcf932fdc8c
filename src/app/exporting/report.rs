//! The report: device, verdict, limits, pinned variants and the plots of Explore, for printing.

use super::BUSY;
use crate::app::bench::facts;
use crate::app::errand::Errand;
use crate::app::panels::design::safety::{Safety, in_words};
use crate::app::panels::design::variants;
use crate::app::reading::Reading;
use crate::app::session::Status;
use crate::app::text::{language, tr};
use crate::app::view::design::Page;
use crate::app::view::{Panel, Tab, View};
use crate::app::widgets::qr_modules;
use crate::app::{App, bench};
use crate::dynamics::Outcome;
use crate::export::Figure;
use crate::export::report::{Report, Words, html};
use crate::model::Parameter;
use crate::model::limits::Standing;
use crate::questions::harvest::HarvestStudy;
use crate::scheduler::{Asked as _, Study as _};

/// Height over width of a plot in a report.
const REPORT_ASPECT: f64 = 0.42;

impl App {
    /// Saves a report on what is in view.
    pub(in crate::app) fn save_report(&mut self) {
        match self.report() {
            Some(report) => {
                let name = "harvester-report.html".to_owned();
                self.errands.push(Errand::Save(name, "text/html;charset=utf-8", html(&report)));
            }
            None => self.tell(tr(BUSY)),
        }
    }

    fn report(&self) -> Option<Report> {
        let shown = self.session.shown.as_ref().filter(|_| self.session.status() == Status::Done)?;
        let provenance = self.provenance(&self.view);
        let crew = self.crew.borrow();
        let found = crew.studies.inspection(&shown.scenario).filter(|(_, current)| *current);
        let verdict = found.map(|(found, _)| &found.verdict);
        let reading = Reading::new(shown, self.session.boundaries.as_ref(), verdict);
        let mut explore = View { tab: Tab::Explore, enlarged: None, ..self.view.clone() };
        // As the verdict is: under the sine.
        explore.design.shake.everywhere = false;
        let plots = self.figures(&explore, None);
        let mut plots: Vec<Vec<Figure>> = plots.into_iter().map(|figure| vec![figure]).collect();
        for index in 1..plots.len() {
            if plots[index][0].title == plots[index - 1][0].title {
                plots[index][0].title += tr(": the end of the run");
            }
        }
        plots.iter_mut().flatten().for_each(|figure| figure.aspect = REPORT_ASPECT);
        let harvest = crew.studies.lanes.study::<HarvestStudy>();
        let (scenario, question, _) = bench::questions::harvest(&self.view, &self.session);
        let asked = (scenario, question);
        if harvest.is_some_and(|study| study.finished() && *study.asked() == asked) {
            plots.push(self.design_figures(Panel::Harvest, Page::Harvest));
        }
        let variants = variants::in_words(&self.view, &self.session, &crew.studies, &self.bench.variants);
        if !variants.is_empty() {
            plots.push(self.design_figures(Panel::Variants, Page::Variants));
        }
        Some(Report {
            words: self.report_words(),
            headline: reading.headline,
            facts: reading.facts,
            remarks: [reading.warnings, reading.remarks].concat(),
            limits: self.limits(),
            variants,
            device: facts::rows(&self.view.scenario),
            plots,
            code: qr_modules(&provenance.link),
            provenance,
        })
    }

    /// The plots of a panel of the Design tab.
    fn design_figures(&self, panel: Panel, page: Page) -> Vec<Figure> {
        let mut view = View { tab: Tab::Design, enlarged: Some(panel), ..self.view.clone() };
        view.design.page = page;
        let mut figures = self.figures(&view, None);
        figures.iter_mut().for_each(|figure| figure.aspect = REPORT_ASPECT);
        figures
    }

    fn report_words(&self) -> Words {
        Words {
            language: language().code(),
            report: tr("Harvester report"),
            beyond: tr("Beyond a limit"),
            within: tr("Within the limits"),
            device: tr("Device"),
            variants: tr("Variants"),
            dimensionless: tr("Dimensionless"),
            parameters: Parameter::ALL.map(|parameter| tr(parameter.fact().title)),
            model: facts::model(&self.view.scenario),
        }
    }

    /// The limits that apply to the motion in view, and whether each is kept.
    fn limits(&self) -> Vec<(String, bool)> {
        let shown = self.session.shown.as_ref();
        let lasting = shown.filter(|shown| shown.run.outcome() == Outcome::Completed);
        let summary = lasting.and_then(|shown| shown.run.summary.as_ref());
        let (Some(summary), Some(safety)) = (summary, Safety::of(&self.view, &self.session)) else {
            return Vec::new();
        };
        let checks = safety.checks(&summary.measures.demand());
        checks.iter().map(|check| (in_words(check), check.standing == Standing::Within)).collect()
    }
}
