//! Keeps the app's state in the browser's local storage.

use super::{App, address};

/// One versioned key, also known to `assets/shell/start.js`, which offers its value after a crash.
const KEY: &str = "harvester-lab.v1";

/// Seconds between two looks at a state that the user is changing.
const PAUSE: f64 = 1.0;

/// Writes the state when it changed, at most once a second while the user is busy.
///
/// Storage can be missing (private windows, blocked cookies) or full; the page then works without memory.
pub(super) struct Keeper {
    storage: Option<web_sys::Storage>,
    written: Option<String>,
    /// The fragment of the address that was opened, and the same link as the app writes it.
    opened: Option<(String, String)>,
    touched: bool,
    looked: f64,
}

impl Keeper {
    /// Reads what the last session left.
    pub(super) fn open() -> Self {
        let storage = web_sys::window().and_then(|window| window.local_storage().ok().flatten());
        let written = storage.as_ref().and_then(|storage| storage.get_item(KEY).ok().flatten());
        Self { storage, written, opened: None, touched: false, looked: 0.0 }
    }

    /// One that neither reads nor writes.
    pub(super) fn absent() -> Self {
        Self { storage: None, written: None, opened: None, touched: false, looked: 0.0 }
    }

    /// The state as last read or written.
    pub(super) fn stored(&self) -> Option<&str> {
        self.written.as_deref()
    }

    /// Says that the state may have changed without any input event.
    pub(super) fn touch(&mut self) {
        self.touched = true;
    }

    /// Says whether the address holds a link: its fragment, and how the app would write it.
    pub(super) fn opened(&mut self, link: Option<(String, String)>) {
        self.opened = link;
    }

    /// Called once a frame.
    pub(super) fn tick(&mut self, app: &App, ctx: &egui::Context) {
        let (now, busy) = ctx.input(|input| (input.time, !input.events.is_empty()));
        self.touched |= busy;
        if !self.touched {
            return;
        }
        let wait = self.looked + PAUSE - now;
        if wait > 0.0 {
            ctx.request_repaint_after_secs(wait as f32 + 0.01);
            return;
        }
        self.looked = now;
        self.touched = false;
        self.keep(app);
    }

    /// Writes now, unless nothing changed.
    pub(super) fn keep(&mut self, app: &App) {
        // Once the view has departed from the link in the address, a reload must not bring it back.
        if let Some((fragment, _)) = self.opened.take_if(|(_, link)| *link != app.fragment()) {
            address::forget_fragment(&fragment);
        }
        let Some(storage) = &self.storage else { return };
        let state = app.stored();
        if self.written.as_ref() != Some(&state) && storage.set_item(KEY, &state).is_ok() {
            self.written = Some(state);
        }
    }
}
