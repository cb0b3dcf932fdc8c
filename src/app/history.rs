//! Undo and redo: what there was before each step, and what was taken back.
//!
//! A whole gesture is one step: changes merge while a pointer or a key is held down, and a press begins a new step.

use std::collections::VecDeque;

use egui::Event;

/// Steps that can be taken back; older ones are forgotten.
const STEPS: usize = 300;

/// The states before and after the present one, which the owner keeps.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct History<S> {
    past: VecDeque<S>,
    future: Vec<S>,
    /// Whether the gesture under way has its step.
    under_way: bool,
}

/// What the hand does in a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Hand {
    /// A pointer or a key goes down.
    pub presses: bool,
    /// One is down, or goes up in this very frame.
    pub holds: bool,
}

impl Hand {
    /// What pointers and keys do in this frame.
    pub(super) fn of(context: &egui::Context) -> Self {
        context.input(|input| {
            let key = |event: &Event| matches!(event, Event::Key { pressed: true, repeat: false, .. });
            let pointer = &input.pointer;
            Self {
                presses: pointer.any_pressed() || input.events.iter().any(key),
                holds: pointer.any_down() || pointer.any_released() || !input.keys_down.is_empty(),
            }
        })
    }
}

impl<S> Default for History<S> {
    fn default() -> Self {
        Self { past: VecDeque::new(), future: Vec::new(), under_way: false }
    }
}

impl<S> History<S> {
    /// Whether there is a step to take back, and one to take again.
    pub(super) fn can(&self) -> (bool, bool) {
        (!self.past.is_empty(), !self.future.is_empty())
    }

    /// Call it once a frame, before anything is noted.
    pub(super) fn begin_frame(&mut self, hand: Hand) {
        if hand.presses || !hand.holds {
            self.under_way = false;
        }
    }

    /// Notes that the state, which was `before`, has changed. Another change of the same gesture needs no note.
    pub(super) fn note(&mut self, before: S, hand: Hand) {
        self.future.clear();
        if self.under_way {
            return;
        }
        if self.past.len() == STEPS {
            self.past.pop_front();
        }
        self.past.push_back(before);
        self.under_way = hand.holds;
    }

    /// The state before the last step, in exchange for the `present` one.
    pub(super) fn undo(&mut self, present: S) -> Option<S> {
        let before = self.past.pop_back()?;
        self.future.push(present);
        self.under_way = false;
        Some(before)
    }

    /// The state after the step that was taken back last, in exchange for the `present` one.
    pub(super) fn redo(&mut self, present: S) -> Option<S> {
        let after = self.future.pop()?;
        self.past.push_back(present);
        self.under_way = false;
        Some(after)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const REST: Hand = Hand { presses: false, holds: false };
    const PRESS: Hand = Hand { presses: true, holds: true };
    const HOLD: Hand = Hand { presses: false, holds: true };

    /// A state with its history, as the app has them.
    #[derive(Default)]
    struct Page {
        state: i32,
        history: History<i32>,
    }

    impl Page {
        fn frame(&mut self, hand: Hand, state: i32) {
            self.history.begin_frame(hand);
            if state != self.state {
                self.history.note(self.state, hand);
                self.state = state;
            }
        }

        fn undo(&mut self) -> i32 {
            self.state = self.history.undo(self.state).unwrap_or(self.state);
            self.state
        }

        fn redo(&mut self) -> i32 {
            self.state = self.history.redo(self.state).unwrap_or(self.state);
            self.state
        }
    }

    #[test]
    fn steps_are_taken_back_and_again() {
        let mut page = Page::default();
        assert_eq!((page.undo(), page.redo(), page.history.can()), (0, 0, (false, false)));
        for state in 1..=3 {
            page.frame(REST, state);
        }
        assert_eq!([page.undo(), page.undo()], [2, 1]);
        assert_eq!(page.history.can(), (true, true));
        assert_eq!([page.redo(), page.redo(), page.redo()], [2, 3, 3]);
        assert_eq!([page.undo(), page.undo(), page.undo(), page.undo()], [2, 1, 0, 0]);
        page.frame(REST, 7);
        assert_eq!(page.history.can(), (true, false));
        assert_eq!([page.redo(), page.undo()], [7, 0]);
    }

    #[test]
    fn a_drag_is_one_step_and_the_next_one_another() {
        let mut page = Page::default();
        page.frame(PRESS, 0);
        for state in 1..=50 {
            page.frame(HOLD, state);
        }
        // The frame in which the pointer goes up still belongs to the drag.
        page.frame(HOLD, 51);
        // Pressed again before any frame without: another drag.
        page.frame(PRESS, 60);
        page.frame(HOLD, 61);
        page.frame(REST, 61);
        page.frame(REST, 70);
        assert_eq!([page.undo(), page.undo(), page.undo(), page.undo()], [61, 51, 0, 0]);
        assert_eq!([page.redo(), page.redo(), page.redo()], [51, 61, 70]);
    }

    #[test]
    fn undoing_in_the_middle_of_a_drag_ends_its_step() {
        let mut page = Page::default();
        page.frame(PRESS, 1);
        page.frame(HOLD, 2);
        assert_eq!(page.undo(), 0);
        page.frame(HOLD, 3);
        page.frame(HOLD, 4);
        assert_eq!([page.undo(), page.redo()], [0, 4]);
    }

    #[test]
    fn hundreds_of_steps_are_kept_and_not_more() {
        let mut page = Page::default();
        for state in 1..=1000 {
            page.frame(REST, state);
        }
        let mut steps = 0;
        while page.history.can().0 {
            page.undo();
            steps += 1;
        }
        assert_eq!((steps, page.state), (STEPS, 1000 - STEPS as i32));
        const { assert!(STEPS >= 200) };
        while page.history.can().1 {
            page.redo();
        }
        assert_eq!(page.state, 1000);
    }
}
