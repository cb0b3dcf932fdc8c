//! Undo and redo of everything that a command changes.
//!
//! Not undone is what suits the room and the eyes rather than the question: the theme, the size of type, whether the
//! beam moves. Those stay as they are when steps are taken back.
//!
//! `App::step` carries a command out and gives `app::history` the moment before it, if anything changed: the view
//! without its looks, and the pinned curves and designs. Changes merge while a pointer or a key is down, so that a drag is one step. Links, files and
//! `load()` are steps, too.

use std::rc::Rc;

use super::App;
use super::command::Command;
use super::history::Hand;
use super::moment::Moment;
use super::view::View;

impl App {
    pub(super) fn moment(&self) -> Moment {
        let view = self.view.clone().with_looks_of(&View::default());
        Moment { view, pinned: self.session.pinned.clone(), variants: Rc::clone(&self.bench.variants) }
    }

    /// Carries out a command and notes what there was before.
    pub(super) fn step(&mut self, command: Command, hand: Hand) {
        let travels = matches!(command, Command::Undo | Command::Redo);
        let before = self.moment();
        self.carry_out(command);
        if !travels && before != self.moment() {
            self.history.note(before, hand);
        }
    }

    /// Shows another view, as one step. The window of the map follows the point, where `follows`.
    pub(super) fn replace(&mut self, view: View, follows: bool) {
        let before = self.moment();
        self.place(view, follows);
        if before != self.moment() {
            self.history.begin_frame(Hand::default());
            self.history.note(before, Hand::default());
        }
        self.follow();
    }

    /// Shows another view as a part of a step.
    pub(super) fn place(&mut self, view: View, follows: bool) {
        if follows {
            self.view = View { scenario: self.view.scenario.clone(), ..view.clone() };
            self.show(view.scenario);
        } else {
            self.session.ask(&view.scenario);
            self.view = view;
        }
    }

    pub(super) fn undo(&mut self) {
        let present = self.moment();
        if let Some(moment) = self.history.undo(present) {
            self.restore(moment);
        }
    }

    pub(super) fn redo(&mut self) {
        let present = self.moment();
        if let Some(moment) = self.history.redo(present) {
            self.restore(moment);
        }
    }

    /// Exactly what there was: nothing follows anything.
    fn restore(&mut self, moment: Moment) {
        self.view = moment.view.with_looks_of(&self.view);
        self.session.pinned = moment.pinned;
        self.bench.variants = moment.variants;
        self.session.ask(&self.view.scenario);
    }
}
