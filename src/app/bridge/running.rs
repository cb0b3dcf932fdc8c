//! The app that runs, for what reaches it from outside of its frames.

use std::cell::RefCell;
use std::rc::Rc;

use super::frames::Recorder;
use super::storage::Keeper;
use crate::app::App;
use crate::app::crew::Crew;

/// What the exported functions need to reach.
pub(super) struct Running {
    pub(super) app: Rc<RefCell<App>>,
    pub(super) crew: Rc<RefCell<Crew>>,
    pub(super) context: egui::Context,
    pub(super) recorder: Recorder,
    pub(super) keeper: Rc<RefCell<Keeper>>,
}

thread_local! {
    pub(super) static RUNNING: RefCell<Option<Running>> = const { RefCell::new(None) };
}

/// Changes the running app from outside of its frames. One that is busy or has crashed is left alone.
pub(super) fn change(with: impl FnOnce(&mut App, &mut Keeper)) {
    RUNNING.with_borrow(|slot| {
        if let Some(running) = slot
            && let Ok(mut app) = running.app.try_borrow_mut()
            && let Ok(mut keeper) = running.keeper.try_borrow_mut()
        {
            with(&mut app, &mut keeper);
            keeper.touch();
            running.context.request_repaint();
        }
    });
}

/// The context of the running app.
pub(super) fn context() -> Option<egui::Context> {
    RUNNING.with_borrow(|slot| slot.as_ref().map(|running| running.context.clone()))
}
