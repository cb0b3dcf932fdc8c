//! What the page in view asks the crew: one lane a topic, the newest question of each.

use super::bench::Bench;
use super::crew::Studies;
use super::embed::Embed;
use super::panels::spec::{Asking, Place};
use super::panels::{design, list};
use super::questions;
use super::session::Session;
use super::view::{Panel, Tab, View};
use crate::questions::inspection::Inspect;
use crate::questions::tongues::TongueStudy;

/// Asks for what the view shows, or the frame that holds the page.
pub(super) fn ask(
    studies: &mut Studies,
    view: &View,
    session: &Session,
    bench: &Bench,
    embed: Option<&Embed>,
) {
    let designs = embed.is_none() && view.tab == Tab::Design;
    if designs {
        design::ask(studies, view);
    } else if let Some(boundaries) = &session.boundaries
        && view.scenario.model.modes > 1
    {
        let asked = questions::tongues(view, boundaries);
        studies.lanes.offer(asked, |(scenario, window)| Some(TongueStudy::new(scenario, window)));
    }
    // The goals of a lesson are checked by the verdict, on whatever tab.
    if !designs || view.lesson.is_some() {
        studies.offer(Inspect { scenario: view.scenario.clone() });
    }
    let shown: Vec<Panel> = match embed {
        Some(embed) => Panel::ALL.iter().copied().filter(|panel| embed.shows(*panel)).collect(),
        None => list::at(Place::of(view)),
    };
    for panel in shown.into_iter().map(list::spec) {
        if matches!(panel.place, Place::Page(_)) {
            studies.deliver(&view.scenario);
        }
        (panel.ask)(&mut Asking { view, session, bench, studies });
    }
}
