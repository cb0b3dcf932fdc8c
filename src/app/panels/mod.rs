//! The panels, one file each. They read the view and the session and push commands.
//!
//! A panel's file says in its `PANEL` where it stands, what it draws under which title, what it asks the crew, its name in
//! frames, and whether it can be saved. `view/panel.rs` lists the panels, once, by a macro that hands the list to others:
//! there it becomes `Panel`, the names that views store and links write, here the modules, and in `list` the way from a name
//! to its `Spec`. So the view knows names, and nothing of what draws them. Tabs, keys, frames (`parts`), exports and
//! `app::asking` walk the list. `cargo fmt` does not see modules that a macro declares: the Makefile names their files.

pub(super) mod beam;
pub(super) mod controls;
pub(super) mod design;
pub(super) mod device;
pub(super) mod embedded;
mod facts;
pub(super) mod figure_boundaries;
pub(super) mod figure_panels;
mod frequency;
pub(super) mod greeting;
mod grid;
pub(super) mod lessons;
pub(super) mod list;
pub(super) mod live;
pub(super) mod on_top;
pub(super) mod paper;
pub(super) mod parts;
mod phase_plane;
pub(super) mod plots;
mod share;
pub(super) mod shortcuts;
pub(super) mod spec;
pub(super) mod structure;
pub(super) mod sweep;
pub(super) mod tables;
pub(super) mod top_bar;
pub(super) mod verdict;

use super::bench::Bench;
use super::command::{Command, Commands};
use super::crew::Studies;
use super::embed::Embed;
use super::lessons::Course;
use super::live::Live;
use super::session::{Session, Shown, Status};
use super::view::{View, panels};
use crate::app::text::{fill, tr};
use crate::export::Format;
use crate::scheduler::Study;
use crate::scheduler::lane::Traffic;

macro_rules! files {
    ($($name:ident $file:ident)*) => {
        $(pub(super) mod $file;)*
    };
}
panels!(files);

/// What a panel may look at, and where it leaves its wishes.
pub(super) struct Context<'a> {
    pub view: &'a View,
    pub session: &'a Session,
    pub studies: &'a Studies,
    pub bench: &'a Bench,
    pub course: &'a Course,
    pub live: &'a Live,
    /// The page's own address, without a fragment.
    pub address: &'a str,
    /// What the address asks to be shown of the page; all of it when absent.
    pub embed: Option<&'a Embed>,
    /// Whether there is a step to take back, and one to take again.
    pub steps: (bool, bool),
    /// Whether a clip is being recorded.
    pub records: bool,
    /// Whether what can move by itself does.
    pub moves: bool,
    /// Where the chosen plot stands above the tab, which then leaves its plots out.
    pub on_top: Option<egui::Rect>,
    pub commands: &'a mut Commands,
}

impl<'a> Context<'a> {
    /// Asks for the scenario after `change`.
    pub(super) fn edit(&mut self, change: impl FnOnce(&mut crate::scenario::Scenario)) {
        let mut scenario = self.view.scenario.clone();
        change(&mut scenario);
        self.commands.push(Command::Show(Box::new(scenario)));
    }

    /// Asks for the Design tab after `change`.
    pub(super) fn redesign(&mut self, change: impl FnOnce(&mut super::view::design::DesignView)) {
        let mut design = self.view.design.clone();
        change(&mut design);
        self.commands.push(Command::Design(Box::new(design)));
    }

    /// Where a plot was clicked, for what a click changes. A double click gives the plot its own view, so it takes back
    /// what its first half has changed.
    pub(super) fn clicked<R>(&mut self, plot: &egui_plot::PlotResponse<R>) -> Option<egui::Pos2> {
        let response = &plot.response;
        let id = response.id.with("before a click");
        if response.double_clicked() || response.triple_clicked() {
            let before = response.ctx.data_mut(|data| data.remove_temp(id));
            self.commands.extend(before.map(Command::Show));
            return None;
        }
        let at = response.clicked().then(|| response.interact_pointer_pos()).flatten()?;
        response.ctx.data_mut(|data| data.insert_temp(id, Box::new(self.view.scenario.clone())));
        Some(at)
    }

    /// The newest answer.
    pub(super) fn shown(&self) -> Option<&'a Shown> {
        self.session.shown.as_ref()
    }

    /// Whether what is shown answers an older question: it is then drawn faintly.
    pub(super) fn is_stale(&self) -> bool {
        self.session.status() != Status::Done
    }

    /// How far a study of this kind is, or `otherwise`, when none is under way.
    pub(super) fn computing<S: Study>(&self, otherwise: &str) -> String {
        let part = self.studies.lanes.lane::<S>().and_then(Traffic::progress);
        part.map_or_else(|| otherwise.to_owned(), computing)
    }

    /// Asks for a clip of the card with this title.
    pub(super) fn record(&mut self, ui: &egui::Ui, title: &str, card: egui::Rect) {
        let page = ui.ctx().content_rect();
        let place = |at: egui::Pos2| ((at - page.min) / page.size()).to_pos2();
        let part = egui::Rect::from_min_max(place(card.min), place(card.max));
        let whole = egui::Rect::from_min_max(egui::Pos2::ZERO, egui::pos2(1.0, 1.0));
        self.commands.push(Command::Record(Some((title.to_owned(), part.intersect(whole)))));
    }

    /// Asks for a file of what the card with this title shows.
    pub(super) fn export(&mut self, title: &str, format: Option<Format>) {
        if let Some(format) = format {
            self.commands.push(Command::Export(title.to_owned(), format));
        }
    }
}

/// Says that branches are missing, where `some` are.
fn say_cut(ui: &mut egui::Ui, some: bool) {
    if some {
        let text = tr("Some branches were not followed to their ends: it would take too long.");
        let text = egui::RichText::new(text).small().color(super::theme::tokens(ui).warning);
        ui.add(egui::Label::new(text).wrap());
    }
}

/// What is said of work under way, by its done part, 0 to 1.
fn reading(part: f64) -> String {
    fill("reading {percent} %", &[("percent", &format!("{:.0}", 100.0 * part))])
}

fn computing(part: f64) -> String {
    fill("computing {percent} %", &[("percent", &format!("{:.0}", 100.0 * part))])
}
