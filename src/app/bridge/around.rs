//! What the browser tells of the screen and of who looks at it.

use wasm_bindgen::prelude::Closure;
use wasm_bindgen::{JsCast as _, JsValue};
use web_sys::MediaQueryList;

use crate::app::looks::Wishes;

/// What asks for high contrast: a setting of the system, or colours that the browser forces upon pages.
const CONTRAST: &str = "(prefers-contrast: more), (forced-colors: active)";

/// What asks for stillness.
const STILLNESS: &str = "(prefers-reduced-motion: reduce)";

fn query(text: &str) -> Option<MediaQueryList> {
    web_sys::window()?.match_media(text).ok().flatten()
}

/// Whether fingers may be what the screen is for; a mouse that moves says otherwise.
pub(super) fn has_coarse_pointer() -> bool {
    query("(any-pointer: coarse)").is_some_and(|query| query.matches())
}

/// What the system asks for; looked at once a frame.
pub(super) struct SystemWishes {
    contrast: Option<MediaQueryList>,
    stillness: Option<MediaQueryList>,
}

impl SystemWishes {
    /// Has a frame drawn whenever a wish changes.
    pub(super) fn watch(context: &egui::Context) -> Self {
        let watched = |text| {
            let query = query(text);
            if let Some(query) = &query {
                let context = context.clone();
                let listener = Closure::<dyn FnMut()>::new(move || context.request_repaint());
                query.set_onchange(Some(listener.as_ref().unchecked_ref()));
                // The page listens as long as it lives.
                listener.forget();
            }
            query
        };
        Self { contrast: watched(CONTRAST), stillness: watched(STILLNESS) }
    }

    /// Those of this moment.
    pub(super) fn now(&self) -> Wishes {
        let holds = |query: &Option<MediaQueryList>| query.as_ref().is_some_and(|query| query.matches());
        Wishes { contrast: holds(&self.contrast), stillness: holds(&self.stillness) }
    }
}

/// Tells the page of every finger before eframe does: it takes a finger's press for a mouse's first, and draws at once.
pub(super) fn watch_fingers(context: &egui::Context) {
    let Some(window) = web_sys::window() else { return };
    let context = context.clone();
    let listener = Closure::<dyn FnMut(JsValue)>::new(move |event: JsValue| {
        let kind = js_sys::Reflect::get(&event, &JsValue::from_str("pointerType")).ok();
        if kind.and_then(|kind| kind.as_string()).as_deref() == Some("touch") {
            crate::app::widgets::touch::expect_fingers(&context);
        }
    });
    let function = listener.as_ref().unchecked_ref();
    // Where the browser refuses, the first finger of all counts as a mouse.
    let _ = window.add_event_listener_with_callback_and_bool("pointerdown", function, true);
    listener.forget();
}
