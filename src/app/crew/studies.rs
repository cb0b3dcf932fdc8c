//! What is being studied for the page: one lane a topic, the newest question of each.

use crate::app::map::{self, Structure};
use crate::app::questions;
use crate::app::session::Session;
use crate::app::view::{Layer, Tab, View};
use crate::dynamics::tongue::Window;
use crate::jobs::foreman::{Lane, Traffic};
use crate::jobs::study::Study as _;
use crate::jobs::study::answers::Answers;
use crate::jobs::study::multiplier_chart::{MultiplierChart, MultiplierQuestion};
use crate::jobs::study::response::{ResponseQuestion, ResponseStudy};
use crate::jobs::study::sweep::{Direction, SweepQuestion, SweepStudy};
use crate::jobs::study::tongues::TongueStudy;
use crate::scenario::Scenario;

/// Half the width of the window in which exact tongues are traced: a little more than a map shows.
const TONGUE_SPAN: f64 = 0.8;
/// Upper ends of that window: the lowest one above what the map shows is taken.
const TONGUE_LIMITS: [f64; 2] = [0.04, 0.2];

/// What exact tongues belong to: the device, and how far they were followed.
#[derive(Debug, Clone, PartialEq)]
struct Subject {
    structure: Structure,
    limit: f64,
}

/// The lanes, and what of them outlives a question.
pub(in crate::app) struct Studies {
    /// Requests from outside.
    pub answers: Lane<Answers>,
    tongues: Lane<TongueStudy>,
    /// What the newest tongues belong to.
    subject: Option<Subject>,
    /// The last finished tongues of another device: drawn faintly while the newest are traced.
    before: Option<(Subject, TongueStudy)>,
    /// Chart of the forced motion's stability.
    pub multipliers: Lane<MultiplierChart>,
    /// Sweep up and down.
    pub sweep: Lane<SweepStudy>,
    response: Lane<ResponseStudy>,
    response_before: Option<ResponseStudy>,
}

impl Default for Studies {
    fn default() -> Self {
        let mut answers = Lane::default();
        answers.ask(Answers::default());
        Self {
            answers,
            tongues: Lane::default(),
            subject: None,
            before: None,
            multipliers: Lane::default(),
            sweep: Lane::default(),
            response: Lane::default(),
            response_before: None,
        }
    }
}

impl Studies {
    /// How many of the lanes are urgent: they are served also while the user's hand moves.
    pub(super) const URGENT: usize = 2;

    /// All lanes, most urgent first.
    pub(super) fn lanes(&mut self) -> [&mut dyn Traffic; 5] {
        [&mut self.answers, &mut self.tongues, &mut self.response, &mut self.multipliers, &mut self.sweep]
    }

    /// Asks for what the view shows.
    pub(in crate::app) fn follow(&mut self, view: &View, session: &Session) {
        let beta = view.scenario.parameters.beta;
        let ceiling = map::ceiling(view.map, beta);
        if view.scenario.model.modes > 1 {
            self.ask_tongues(&view.scenario, ceiling);
        }
        match (view.tab, &session.boundaries) {
            (Tab::Stability, Some(boundaries)) if view.layer == Layer::Multiplier => {
                self.ask_multipliers(questions::chart(view, boundaries));
            }
            (Tab::Sweep, _) => {
                self.ask_sweep(questions::sweep(view, session));
                self.ask_response(questions::response(view, session));
            }
            _ => {}
        }
    }

    /// Asks for the exact tongues of the device of `scenario` up to beta = `ceiling`, unless they were asked for last.
    fn ask_tongues(&mut self, scenario: &Scenario, ceiling: f64) {
        let limit = TONGUE_LIMITS.into_iter().find(|limit| *limit >= ceiling).unwrap_or(TONGUE_LIMITS[1]);
        let subject = Subject { structure: Structure::of(scenario), limit };
        if self.subject.as_ref() == Some(&subject) {
            return;
        }
        let window = Window { span: TONGUE_SPAN, limit };
        let newest = self.tongues.ask(TongueStudy::new(scenario.clone(), window));
        let old = self.subject.replace(subject);
        if let Some(finished) = old.zip(newest).filter(|(_, study)| study.finished()) {
            self.before = Some(finished);
        }
    }

    /// The exact tongues to draw, and whether they belong to `structure`: until those are traced, the last ones that
    /// were.
    pub(in crate::app) fn tongues(&self, structure: &Structure) -> Option<(&TongueStudy, bool)> {
        let belongs = |subject: &Subject| subject.structure == *structure;
        let newest = self.tongues.study().filter(|_| self.subject.as_ref().is_some_and(belongs));
        match (newest, &self.before) {
            (Some(newest), Some(_)) if newest.finished() => Some((newest, true)),
            (Some(newest), None) => Some((newest, true)),
            (_, Some((subject, study))) => Some((study, belongs(subject))),
            (None, None) => None,
        }
    }

    /// Asks for a chart, unless it was the last one asked for.
    fn ask_multipliers(&mut self, question: MultiplierQuestion) {
        if self.multipliers.study().is_none_or(|chart| *chart.question() != question) {
            self.multipliers.ask(MultiplierChart::new(question));
        }
    }

    /// Asks for a sweep both ways, unless it was the last one asked for.
    fn ask_sweep(&mut self, question: SweepQuestion) {
        if self.sweep.study().is_none_or(|sweep| *sweep.question() != question) {
            self.sweep.ask(SweepStudy::new(question, &[Direction::Up, Direction::Down]));
        }
    }

    /// Asks for response curves, unless they were asked for last; finished ones are kept until the new ones are there.
    fn ask_response(&mut self, question: ResponseQuestion) {
        if self.response.study().is_none_or(|response| *response.question() != question) {
            let old = self.response.ask(ResponseStudy::new(question));
            self.response_before = old.filter(ResponseStudy::finished).or(self.response_before.take());
        }
    }

    /// The response curves to draw, and whether they are the newest.
    pub(in crate::app) fn response(&self) -> Option<(&ResponseStudy, bool)> {
        let newest = self.response.study().filter(|response| response.finished());
        newest.map(|newest| (newest, true)).or(self.response_before.as_ref().map(|before| (before, false)))
    }
}
