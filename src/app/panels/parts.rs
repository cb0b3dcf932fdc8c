//! What can stand in a frame, by name.

use super::list::spec;
use crate::app::embed::{Part, Parts};
use crate::app::text::marked;
use crate::app::view::{Panel, Tab, View};

/// The parts in their order.
pub(in crate::app) fn parts() -> Parts {
    let plot = |panel: &Panel| {
        let (name, title) = spec(*panel).embedded?;
        Some((Part::Plot(*panel), name, title))
    };
    let (mut parts, others): (Parts, Parts) =
        Panel::ALL.iter().filter_map(plot).partition(|(part, _, _)| stands_on(*part, Tab::Explore));
    parts.insert(0, (Part::Verdict, "verdict", marked("Verdict")));
    parts.push((Part::Beam, "beam", marked("The beam")));
    parts.push((Part::Live, "live", marked("Run and kick")));
    parts.extend(others);
    parts
}

fn stands_on(part: Part, tab: Tab) -> bool {
    matches!(part, Part::Plot(panel) if spec(panel).place.tab() == tab)
}

/// The parts to begin with when what is in view is to be embedded, by their places among all [`parts`].
pub(in crate::app) fn usual(view: &View) -> Vec<usize> {
    let parts = parts();
    let of = |wanted: &dyn Fn(Part) -> bool| -> Vec<usize> {
        (0..parts.len()).filter(|i| wanted(parts[*i].0)).take(2).collect()
    };
    let own = of(&|part| view.enlarged.is_some_and(|panel| part == Part::Plot(panel)));
    let first = [own, of(&|part| stands_on(part, view.tab)), of(&|part| stands_on(part, Tab::Explore))];
    first.into_iter().find(|parts| !parts.is_empty()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_in_view_is_embedded_first() {
        let parts = parts();
        let names = |view: &View| usual(view).iter().map(|i| parts[*i].1).collect::<Vec<_>>();
        assert_eq!(names(&View { enlarged: Some(Panel::Chart), ..View::default() }), ["chart"]);
        assert_eq!(names(&View::default()), ["map", "phase"]);
        assert_eq!(names(&View { tab: Tab::Live, ..View::default() }), ["oscilloscope", "live_phase"]);
        assert_eq!(names(&View { tab: Tab::Design, ..View::default() }), ["harvest", "load"]);
    }
}
