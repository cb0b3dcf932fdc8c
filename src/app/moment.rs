//! What is taken back and done again.

use std::rc::Rc;

use super::session::Shown;
use super::view::View;

/// What a step restores: the view, less its looks, and the curves kept for comparison.
#[derive(Clone)]
pub(super) struct Moment {
    pub view: View,
    pub pinned: Option<Rc<Shown>>,
}

impl PartialEq for Moment {
    fn eq(&self, other: &Self) -> bool {
        let pins = (self.pinned.as_ref().map(Rc::as_ptr), other.pinned.as_ref().map(Rc::as_ptr));
        self.view == other.view && pins.0 == pins.1
    }
}
