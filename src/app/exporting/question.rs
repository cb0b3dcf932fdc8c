//! What is in view as a request of the native command.

use crate::app::questions;
use crate::app::session::Session;
use crate::app::view::{Tab, View};
use crate::questions::harvest::Harvest;
use crate::questions::verdict::Verdict;
use crate::questions::written;

/// What the tab in view asks the solver, as a request of the native command.
pub(in crate::app) fn request(view: &View, session: &Session) -> String {
    match (view.tab, &session.boundaries) {
        (Tab::Stability, Some(boundaries)) => {
            let (scenario, chart) = questions::chart(view, boundaries);
            written(&chart, &scenario)
        }
        (Tab::Sweep, _) => {
            let (scenario, sweep) = questions::sweep(view, session);
            written(&sweep, &scenario)
        }
        (Tab::Design, _) => written(&Harvest::default(), &view.scenario),
        _ => written(&Verdict {}, &view.scenario),
    }
}
