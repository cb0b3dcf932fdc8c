//! What is being studied for the page: one lane a topic, the newest question of each.

use crate::app::embed::{self, Embed};
use crate::app::map::{self, Structure};
use crate::app::questions;
use crate::app::session::Session;
use crate::app::view::design::{DesignView, Page};
use crate::app::view::{Panel, Tab, View};
use crate::dynamics::bifurcations::tongue::Window;
use crate::questions::basin::BasinStudy;
use crate::questions::chart::Quantity;
use crate::questions::curves::CurvesStudy;
use crate::questions::design::linear::LinearBest;
use crate::questions::inspection::{Inspect, Inspection};
use crate::questions::list;
use crate::questions::motion_chart::MotionChart;
use crate::questions::multiplier_chart::MultiplierChart;
use crate::questions::response::{Response, ResponseCurve};
use crate::questions::sweep::{Direction, SweepStudy};
use crate::questions::tongues::TongueStudy;
use crate::scenario::Scenario;
use crate::scheduler::{Lanes, Piece, Single};

/// Half the width of the window in which exact tongues are traced: a little more than a map shows.
const TONGUE_SPAN: f64 = 0.8;
/// Upper ends of that window: the lowest one above what the map shows is taken.
const TONGUE_LIMITS: [f64; 2] = [0.04, 0.2];

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
    pub question: &'a Response,
    /// The curves, or why there are none.
    pub curves: Result<&'a [ResponseCurve], &'a str>,
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

    /// Asks for one piece of work, unless it was asked for last.
    pub(super) fn offer<P: Piece + Clone + PartialEq>(&mut self, piece: P) {
        if self.lanes.wanted().is_none_or(|wanted: &Single<P>| *wanted.piece() != piece) {
            self.lanes.offer(Single::new(piece));
        }
    }

    /// Asks for what the view shows.
    pub(in crate::app) fn follow(&mut self, view: &View, session: &Session, embed: Option<&Embed>) {
        let ceiling = map::ceiling(view.map, view.scenario.parameters.beta);
        let designs = embed.is_none() && view.tab == Tab::Design;
        let wanted = |panel| embed.map_or(embed::tab(panel) == view.tab, |embed| embed.shows(panel));
        if designs {
            self.follow_bench(view, session);
        }
        // The goals of a lesson are checked by the verdict, on whatever tab.
        if designs && view.lesson.is_none() {
            return;
        }
        self.offer(Inspect { scenario: view.scenario.clone() });
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
            && self.lanes.study().is_none_or(|study: &CurvesStudy| *study.question() != question)
        {
            self.lanes.ask(CurvesStudy::new(question));
        }
        if wanted(Panel::Basins) {
            let (scenario, basin) = questions::basin(view);
            let same = |study: &BasinStudy| *study.scenario() == scenario && *study.question() == basin;
            if !self.lanes.study().is_some_and(same)
                && let Ok(study) = BasinStudy::new(scenario, basin)
            {
                self.lanes.ask(study);
            }
        }
        if wanted(Panel::OrbitDiagram) || wanted(Panel::Response) {
            let (scenario, sweep) = questions::sweep(view, session);
            self.offer(sweep.response(&scenario));
            let same = |study: &SweepStudy| *study.scenario() == scenario && *study.question() == sweep;
            if !self.lanes.study().is_some_and(same) {
                self.lanes.ask(SweepStudy::new(scenario, sweep, &[Direction::Up, Direction::Down]));
            }
        }
        if embed.is_some() {
            for (panel, page) in [
                (Panel::Harvest, Page::Harvest),
                (Panel::Load, Page::Load),
                (Panel::MagnetForce, Page::Trust),
            ] {
                if wanted(panel) {
                    let design = DesignView { page, ..view.design.clone() };
                    self.follow_bench(&View { design, ..view.clone() }, session);
                }
            }
        }
    }

    /// Asks for the chart over frequency and amplitude.
    fn ask_chart(&mut self, view: &View, boundaries: &map::Boundaries) {
        let (scenario, chart) = questions::chart(view, boundaries);
        if chart.quantity == Quantity::Multiplier {
            let same = |study: &MultiplierChart| study.question() == (&scenario, chart.omega, chart.beta);
            if !self.lanes.study().is_some_and(same) {
                self.lanes.ask(MultiplierChart::new(scenario, chart.omega, chart.beta));
            }
        } else {
            let plane = chart.plane(scenario);
            if self.lanes.study().is_none_or(|study: &MotionChart| *study.question() != plane) {
                self.lanes.ask(MotionChart::new(plane));
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
        if !self.lanes.wanted().is_some_and(same) {
            self.lanes.offer(TongueStudy::new(scenario.clone(), window));
        }
    }

    /// The newest exact tongues, and whether they belong to `structure`.
    pub(in crate::app) fn tongues(&self, structure: &Structure) -> Option<(&TongueStudy, bool)> {
        let study: &TongueStudy = self.lanes.finished().or_else(|| self.lanes.study())?;
        Some((study, Structure::of(study.scenario()) == *structure))
    }

    /// The newest response curves.
    pub(in crate::app) fn response(&self) -> Option<Followed<'_>> {
        let study: &Single<Response> = self.lanes.finished()?;
        let curves = study.found()?.map(Vec::as_slice);
        let wanted: Option<&Single<Response>> = self.lanes.wanted();
        let newest = wanted.is_some_and(|wanted| wanted.piece() == study.piece());
        Some(Followed { question: study.piece(), curves, newest })
    }

    /// The newest verdict and its evidence, and whether it belongs to `scenario`.
    pub(in crate::app) fn inspection(&self, scenario: &Scenario) -> Option<(&Inspection, bool)> {
        let study: &Single<Inspect> = self.lanes.finished()?;
        Some((study.found()?.ok()?, study.piece().scenario == *scenario))
    }
}
