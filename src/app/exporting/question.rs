//! What is in view as a request of the native command.

use crate::app::map::Boundaries;
use crate::app::questions;
use crate::app::session::Session;
use crate::app::view::{Layer, Tab, View};
use crate::app::widgets::number::exact;

/// What the tab in view asks the solver, as a request of the native command.
pub(in crate::app) fn request(view: &View, session: &Session) -> String {
    let value = view.to_value();
    let part = |name: &str| value["scenario"][name].to_string();
    let subject = format!("\"parameters\":{},\n \"model\":{}", part("parameters"), part("model"));
    let initial = if view.scenario.initial.is_some() {
        format!(",\n \"initial\":{}", part("initial"))
    } else {
        String::new()
    };
    let lasting = format!("{initial},\n \"t_end\":{}", part("t_end"));
    match (view.tab, &session.boundaries) {
        (Tab::Stability, Some(boundaries)) => {
            let (quantity, omega, beta) = charted(view, boundaries);
            format!(
                "{{\"task\":\"chart\",\n \"quantity\":\"{quantity}\",\n \"omega\":{omega},\n \"beta\":{beta},\n \
                 {subject}{lasting}}}"
            )
        }
        (Tab::Sweep, _) => {
            let (from, to) = questions::sweep_range(view, session);
            let sweep = &view.sweep;
            format!(
                "{{\"task\":\"sweep\",\n \"parameter\":\"{}\",\"from\":{},\"to\":{},\"count\":{},\n \
                 \"transient\":{},\"kept\":{},\"branches\":true,\n {subject}{initial}}}",
                sweep.parameter.field(),
                exact(from),
                exact(to),
                sweep.count,
                sweep.dwell.discarded,
                sweep.dwell.kept
            )
        }
        (Tab::Design, _) => {
            let scaling = part("scaling");
            let scaling =
                if scaling == "null" { String::new() } else { format!(",\n \"scaling\":{scaling}") };
            let device = match view.scenario.device {
                Some(_) => format!(",\n \"device\":{}", part("device")),
                None => String::new(),
            };
            format!("{{\"task\":\"harvest\",\n {subject}{device}{scaling}{lasting}}}")
        }
        _ => format!("{{\"task\":\"verdict\",\n {subject}{lasting}}}"),
    }
}

/// What the stability chart shows, and over which frequencies and amplitudes.
fn charted(view: &View, boundaries: &Boundaries) -> (&'static str, String, String) {
    let motions = |quantity| {
        let question = questions::motions(view, boundaries);
        (quantity, question.x.1, question.y.1, question.size)
    };
    let (quantity, omega, beta, (columns, rows)) = match view.layer {
        Layer::Multiplier => {
            let question = questions::chart(view, boundaries);
            ("multiplier", question.omega, question.beta, question.size)
        }
        Layer::Motion => motions("motion"),
        Layer::Voltage => motions("v_rms"),
        Layer::Power => motions("power"),
    };
    let span = |(from, to): (f64, f64), count: usize| {
        format!("{{\"from\":{},\"to\":{},\"count\":{count}}}", exact(from), exact(to))
    };
    (quantity, span(omega, columns), span(beta, rows))
}
