//! What is in view as a request of the native command.

use crate::app::bench::{self, Bench, shaking};
use crate::app::panels::spec::Place;
use crate::app::questions;
use crate::app::session::Session;
use crate::app::view::design::Page;
use crate::app::view::{Tab, View};
use crate::model::base_motion::BaseMotion;
use crate::questions::harvest::Harvest;
use crate::questions::verdict::Verdict;
use crate::questions::written;

/// Most samples of a recording that a program shows.
const MOST_SAMPLES: usize = 2000;

/// What the place in view asks the solver, as a request of the native command.
pub(in crate::app) fn request(view: &View, session: &Session, bench: &Bench) -> String {
    match (Place::of(view), &session.boundaries) {
        (Place::Tab(Tab::Stability), Some(boundaries)) => {
            let (scenario, chart) = questions::chart(view, boundaries);
            written(&chart, &scenario)
        }
        (Place::Tab(Tab::Sweep), _) => {
            let (scenario, sweep) = questions::sweep(view, session);
            written(&sweep, &scenario)
        }
        (Place::Page(page), _) => of_page(page, view, session, bench),
        _ => written(&Verdict {}, &view.scenario),
    }
}

fn of_page(page: Page, view: &View, session: &Session, bench: &Bench) -> String {
    let asked = match page {
        Page::Load => {
            let (scenario, load) = bench::questions::load(view);
            Some(written(&load, &scenario))
        }
        Page::Tolerances => {
            let (scenario, tolerances) = bench::questions::tolerances(view);
            Some(written(&tolerances, &scenario))
        }
        Page::Shake => shaking::question(view, bench)
            .filter(|(_, shake)| is_short(&shake.excitation))
            .map(|(scenario, shake)| written(&shake, &scenario)),
        Page::Harvest | Page::Measured | Page::Variants => {
            let (_, harvest, _) = bench::questions::harvest(view, session);
            let (least, limits) = (view.design.least, view.design.limits);
            Some(written(&Harvest { least, limits, ..harvest }, &view.scenario))
        }
        Page::Materials | Page::Trust | Page::Search => None,
    };
    asked.unwrap_or_else(|| written(&Harvest::default(), &view.scenario))
}

/// Whether it can stand in a program.
fn is_short(motion: &BaseMotion) -> bool {
    !matches!(motion, BaseMotion::Recorded(recorded) if recorded.time.len() > MOST_SAMPLES)
}
