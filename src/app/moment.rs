//! What is taken back and done again.

use std::rc::Rc;

use super::bench::variant::Variant;
use super::session::Shown;
use super::view::View;

/// What a step restores: the view, less its looks, the curves kept for comparison, and the pinned designs.
#[derive(Clone)]
pub(super) struct Moment {
    pub view: View,
    pub pinned: Option<Rc<Shown>>,
    pub variants: Rc<Vec<Variant>>,
}

impl PartialEq for Moment {
    fn eq(&self, other: &Self) -> bool {
        let pins = (self.pinned.as_ref().map(Rc::as_ptr), other.pinned.as_ref().map(Rc::as_ptr));
        self.view == other.view && pins.0 == pins.1 && Rc::ptr_eq(&self.variants, &other.variants)
    }
}
