//! What is being studied for the page: one lane a topic, the newest question of each.

use super::bench::BenchStudies;
use super::lane::{offer, open};
use crate::app::embed::{self, Embed};
use crate::app::map::{self, Structure};
use crate::app::questions;
use crate::app::session::Session;
use crate::app::view::design::{DesignView, Page};
use crate::app::view::{Layer, Panel, Tab, View};
use crate::dynamics::bifurcations::tongue::Window;
use crate::jobs::foreman::{Lane, Traffic};
use crate::jobs::inspection::Inspection;
use crate::jobs::response::ResponseCurve;
use crate::jobs::study::answers::Answers;
use crate::jobs::study::basin::Basin;
use crate::jobs::study::curves::CurvesStudy;
use crate::jobs::study::motion_chart::MotionChart;
use crate::jobs::study::multiplier_chart::MultiplierChart;
use crate::jobs::study::single::Single;
use crate::jobs::study::sweep::{Direction, SweepStudy};
use crate::jobs::study::tongues::TongueStudy;
use crate::jobs::work::{Finding, Work};
use crate::scenario::Scenario;

/// Half the width of the window in which exact tongues are traced: a little more than a map shows.
const TONGUE_SPAN: f64 = 0.8;
/// Upper ends of that window: the lowest one above what the map shows is taken.
const TONGUE_LIMITS: [f64; 2] = [0.04, 0.2];

/// How many lanes there are.
const LANES: usize = 17;

/// The lanes.
pub(in crate::app) struct Studies {
    /// Requests from outside.
    pub answers: Lane<Answers>,
    /// Verdict on the scenario in view.
    inspection: Lane<Single>,
    /// Exact tongues of the device in view.
    tongues: Lane<TongueStudy>,
    /// Response curves of the sweep in view.
    response: Lane<Single>,
    /// Sweep up and down.
    pub sweep: Lane<SweepStudy>,
    /// Bifurcation curves in the plane in view.
    pub curves: Lane<CurvesStudy>,
    /// Chart of the forced motion's stability.
    pub multipliers: Lane<MultiplierChart>,
    /// Chart of the motions reached.
    pub motions: Lane<MotionChart>,
    /// Basins of attraction.
    pub basin: Lane<Basin>,
    /// The design bench.
    pub bench: BenchStudies,
}

/// Response curves to draw.
pub(in crate::app) struct Response<'a> {
    /// The question that they answer.
    pub question: &'a Work,
    /// The curves, or why there are none.
    pub curves: Result<&'a [ResponseCurve], &'a str>,
    /// Whether it is the newest question.
    pub newest: bool,
}

impl Default for Studies {
    fn default() -> Self {
        let mut answers = Lane::default();
        answers.ask(Answers::default());
        Self {
            answers,
            inspection: Lane::default(),
            tongues: Lane::default(),
            response: Lane::default(),
            sweep: Lane::default(),
            curves: Lane::default(),
            multipliers: Lane::default(),
            motions: Lane::default(),
            basin: Lane::default(),
            bench: BenchStudies::default(),
        }
    }
}

impl Studies {
    /// How many of the lanes are urgent: they are served also while the user's hand moves.
    pub(super) const URGENT: usize = 4;

    /// All lanes with their names, most urgent first.
    fn named_lanes(&mut self) -> [(&'static str, &mut dyn Traffic); LANES] {
        let bench = &mut self.bench;
        [
            ("answers", &mut self.answers),
            ("operating", &mut bench.operating),
            ("tongues", &mut self.tongues),
            ("verdict", &mut self.inspection),
            ("multipliers", &mut self.multipliers),
            ("response", &mut self.response),
            ("sweep", &mut self.sweep),
            ("curves", &mut self.curves),
            ("motions", &mut self.motions),
            ("basin", &mut self.basin),
            ("harvest", &mut bench.harvest),
            ("load", &mut bench.load),
            ("best frequencies", &mut bench.best),
            ("materials", &mut bench.materials),
            ("trust", &mut bench.trust),
            ("find", &mut bench.find),
            ("map", &mut bench.map),
        ]
    }

    /// All lanes, most urgent first.
    pub(super) fn lanes(&mut self) -> [&mut dyn Traffic; LANES] {
        self.named_lanes().map(|(_, lane)| lane)
    }

    /// Whether anything is under way or waits to be, besides requests from outside.
    pub(in crate::app) fn is_busy(&self) -> bool {
        open(&self.tongues)
            || open(&self.inspection)
            || open(&self.multipliers)
            || open(&self.response)
            || open(&self.sweep)
            || open(&self.curves)
            || open(&self.motions)
            || open(&self.basin)
            || self.bench.is_busy()
    }

    /// Names and done parts, 0 to 1, of what is under way.
    pub(in crate::app) fn progress(&mut self) -> Vec<(&'static str, f64)> {
        let lanes = self.named_lanes();
        lanes.into_iter().filter_map(|(name, lane)| Some((name, lane.progress()?))).collect()
    }

    /// Asks for what the view shows.
    pub(in crate::app) fn follow(&mut self, view: &View, session: &Session, embed: Option<&Embed>) {
        let ceiling = map::ceiling(view.map, view.scenario.parameters.beta);
        let designs = embed.is_none() && view.tab == Tab::Design;
        let wanted = |panel| embed.map_or(embed::tab(panel) == view.tab, |embed| embed.shows(panel));
        if designs {
            self.bench.follow(view, session);
        }
        // The goals of a lesson are checked by the verdict, on whatever tab.
        if designs && view.lesson.is_none() {
            return;
        }
        offer(&mut self.inspection, Work::Inspect { scenario: view.scenario.clone() });
        if designs {
            return;
        }
        if view.scenario.model.modes > 1 {
            self.ask_tongues(&view.scenario, ceiling);
        }
        if let Some(boundaries) = &session.boundaries
            && wanted(Panel::Chart)
        {
            self.ask_chart(view, boundaries);
        }
        if wanted(Panel::Curves)
            && let Some(question) = questions::curves(view, session)
            && self.curves.study().is_none_or(|curves| *curves.question() != question)
        {
            self.curves.ask(CurvesStudy::new(question));
        }
        if wanted(Panel::Basins)
            && let Ok(question) = questions::basin(view)
            && self.basin.study().is_none_or(|basin| *basin.question() != question)
            && let Ok(basin) = Basin::new(question)
        {
            self.basin.ask(basin);
        }
        if wanted(Panel::OrbitDiagram) || wanted(Panel::Response) {
            let question = questions::sweep(view, session);
            if self.sweep.study().is_none_or(|sweep| *sweep.question() != question) {
                self.sweep.ask(SweepStudy::new(question, &[Direction::Up, Direction::Down]));
            }
            offer(&mut self.response, questions::response(view, session));
        }
        if embed.is_some() {
            for (panel, page) in [
                (Panel::Harvest, Page::Harvest),
                (Panel::Load, Page::Load),
                (Panel::MagnetForce, Page::Trust),
            ] {
                if wanted(panel) {
                    let design = DesignView { page, ..view.design.clone() };
                    self.bench.follow(&View { design, ..view.clone() }, session);
                }
            }
        }
    }

    /// Asks for the chart over frequency and amplitude.
    fn ask_chart(&mut self, view: &View, boundaries: &map::Boundaries) {
        if view.layer == Layer::Multiplier {
            let question = questions::chart(view, boundaries);
            if self.multipliers.study().is_none_or(|chart| *chart.question() != question) {
                self.multipliers.ask(MultiplierChart::new(question));
            }
        } else {
            let question = questions::motions(view, boundaries);
            if self.motions.study().is_none_or(|chart| *chart.question() != question) {
                self.motions.ask(MotionChart::new(question));
            }
        }
    }

    /// Asks for the exact tongues of the device of `scenario` up to beta = `ceiling`, unless they were asked for last.
    fn ask_tongues(&mut self, scenario: &Scenario, ceiling: f64) {
        let limit = TONGUE_LIMITS.into_iter().find(|limit| *limit >= ceiling).unwrap_or(TONGUE_LIMITS[1]);
        let window = Window { span: TONGUE_SPAN, limit };
        let structure = Structure::of(scenario);
        let same =
            |study: &TongueStudy| study.window() == window && Structure::of(study.scenario()) == structure;
        if !self.tongues.wanted().is_some_and(same) {
            self.tongues.offer(TongueStudy::new(scenario.clone(), window));
        }
    }

    /// The newest exact tongues, and whether they belong to `structure`.
    pub(in crate::app) fn tongues(&self, structure: &Structure) -> Option<(&TongueStudy, bool)> {
        let study = self.tongues.finished().or(self.tongues.study())?;
        Some((study, Structure::of(study.scenario()) == *structure))
    }

    /// The newest response curves.
    pub(in crate::app) fn response(&self) -> Option<Response<'_>> {
        let study = self.response.finished()?;
        let curves = match study.found()? {
            Ok(Finding::Response(curves)) => Ok(curves.as_slice()),
            Ok(_) => return None,
            Err(message) => Err(message.as_str()),
        };
        let newest = self.response.wanted().is_some_and(|wanted| wanted.work() == study.work());
        Some(Response { question: study.work(), curves, newest })
    }

    /// The newest verdict and its evidence, and whether it belongs to `scenario`.
    pub(in crate::app) fn inspection(&self, scenario: &Scenario) -> Option<(&Inspection, bool)> {
        let study = self.inspection.finished()?;
        let Some(Ok(Finding::Inspection(found))) = study.found() else { return None };
        let current = matches!(study.work(), Work::Inspect { scenario: of } if of == scenario);
        Some((found, current))
    }
}
