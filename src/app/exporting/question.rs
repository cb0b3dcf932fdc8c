//! What is in view as a request of the native command.

use crate::app::questions;
use crate::app::session::Session;
use crate::app::view::{Tab, View};
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
    match view.tab {
        Tab::Sweep => {
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
        Tab::Design => {
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
