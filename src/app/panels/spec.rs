//! What a panel is to the rest of the page.

use egui::Ui;

use super::Context;
use crate::app::bench::Bench;
use crate::app::crew::Studies;
use crate::app::session::Session;
use crate::app::view::design::Page;
use crate::app::view::{Tab, View};

/// Where a panel stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::app) enum Place {
    /// On a tab.
    Tab(Tab),
    /// On a page of the Design tab.
    Page(Page),
}

impl Place {
    /// The place in view.
    pub(in crate::app) fn of(view: &View) -> Self {
        match view.tab {
            Tab::Design => Self::Page(view.design.page),
            // Without the sine there is nothing that repeats.
            Tab::Explore if view.shaken().is_some() => Self::Page(Page::Shake),
            tab => Self::Tab(tab),
        }
    }

    /// The tab on which it is.
    pub(in crate::app) fn tab(self) -> Tab {
        match self {
            Self::Tab(tab) => tab,
            Self::Page(_) => Tab::Design,
        }
    }
}

/// What is in view, and whom to ask for it.
pub(in crate::app) struct Asking<'a> {
    pub view: &'a View,
    pub session: &'a Session,
    pub bench: &'a Bench,
    pub studies: &'a mut Studies,
}

/// A panel: a card with a title, and what the page has to know of it.
pub(in crate::app) struct Spec {
    /// Where it stands.
    pub place: Place,
    /// The card's title.
    pub title: fn(&View) -> &'static str,
    /// What stands quietly beside the title.
    pub hint: fn(&Context<'_>) -> String,
    /// Draws what is in the card.
    pub contents: fn(&mut Context<'_>, &mut Ui),
    /// Asks for what it shows; called every frame in which it is in view.
    pub ask: fn(&mut Asking<'_>),
    /// Its name in the addresses of frames, and what it is called there, when it can stand in one.
    pub embedded: Option<(&'static str, &'static str)>,
    /// Whether there is a plot in it, which can be saved as a file.
    pub exports: bool,
}

impl Spec {
    /// A panel with a plot of what is computed anyway.
    pub(super) const fn new(
        place: Place,
        title: fn(&View) -> &'static str,
        contents: fn(&mut Context<'_>, &mut Ui),
    ) -> Self {
        Self { place, title, hint: |_| String::new(), contents, ask: |_| {}, embedded: None, exports: true }
    }

    /// The same with a hint.
    pub(super) const fn hint(self, hint: fn(&Context<'_>) -> String) -> Self {
        Self { hint, ..self }
    }

    /// The same, asking for what it shows.
    pub(super) const fn asking(self, ask: fn(&mut Asking<'_>)) -> Self {
        Self { ask, ..self }
    }

    /// The same for frames, too, with its name in their addresses and what it is called there.
    pub(super) const fn embedded(self, name: &'static str, title: &'static str) -> Self {
        Self { embedded: Some((name, title)), ..self }
    }

    /// The same without a plot.
    pub(super) const fn without_plot(self) -> Self {
        Self { exports: false, ..self }
    }
}
