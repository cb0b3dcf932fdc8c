//! The panels by their names, and which stand where.

use super::spec::{Place, Spec};
use crate::app::view::{Panel, panels};

macro_rules! specs {
    ($($name:ident $file:ident)*) => {
        /// What a panel is to the rest of the page.
        pub(in crate::app) const fn spec(panel: Panel) -> &'static Spec {
            match panel {
                $(Panel::$name => &super::$file::PANEL,)*
            }
        }
    };
}
panels!(specs);

/// The panels at a place, in their order.
pub(in crate::app) fn at(place: Place) -> Vec<Panel> {
    Panel::ALL.iter().copied().filter(|panel| spec(*panel).place == place).collect()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::app::embed::Part;
    use crate::app::panels::parts::parts;
    use crate::app::rehearsal::Desk;
    use crate::app::view::View;

    #[test]
    fn every_panel_fills_the_page_where_it_stands() {
        for panel in Panel::ALL.iter().copied() {
            let place = spec(panel).place;
            let mut view = View { tab: place.tab(), enlarged: Some(panel), ..View::default() };
            if let Place::Page(page) = place {
                view.design.page = page;
            }
            let title = (spec(panel).title)(&view);
            let mut desk = Desk::new(1440.0, 900.0, &view.to_value().to_string());
            desk.work(3);
            desk.harness.find(egui::Role::Button, "Show all plots");
            assert!(desk.harness.texts.iter().any(|(text, _)| text == title), "{title} is not drawn");
        }
    }

    #[test]
    fn parts_of_frames_have_names_of_their_own_that_the_readme_tells() {
        let readme = include_str!("../../../README.md");
        let row = readme.lines().find(|line| line.starts_with("| `embed` |")).expect("a row of names");
        let told: BTreeSet<&str> = row.split('`').skip(3).step_by(2).collect();
        let names: Vec<&str> = parts().iter().map(|(_, name, _)| *name).collect();
        assert_eq!(names.iter().copied().collect::<BTreeSet<_>>(), told);
        assert_eq!(names.len(), told.len());
        assert!(parts().iter().any(|(part, _, _)| *part == Part::Beam));
    }
}
