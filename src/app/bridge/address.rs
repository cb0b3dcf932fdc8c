//! The page's address: the link with which it was opened, and the next one.

use wasm_bindgen::JsCast as _;
use wasm_bindgen::prelude::Closure;

/// The address of the whole page, without query and fragment; nothing where it cannot be read.
pub(super) fn base() -> String {
    let href = web_sys::window().and_then(|window| window.location().href().ok()).unwrap_or_default();
    href.split(['#', '?']).next().unwrap_or_default().to_owned()
}

/// The part of the address from `?` on, or nothing.
pub(super) fn search() -> String {
    web_sys::window().and_then(|window| window.location().search().ok()).unwrap_or_default()
}

/// The fragment with its `#`, or nothing.
pub(super) fn fragment() -> String {
    web_sys::window().and_then(|window| window.location().hash().ok()).unwrap_or_default()
}

/// Calls `changed` whenever the fragment changes by hand, by a link or by the back button.
pub(super) fn watch(changed: fn()) {
    if let Some(window) = web_sys::window() {
        let listener = Closure::<dyn FnMut()>::new(changed);
        window.set_onhashchange(Some(listener.as_ref().unchecked_ref()));
        // The page listens as long as it lives.
        listener.forget();
    }
}

/// Takes the fragment out of the address: it does not say any more what is shown, and a reload should go on with that.
pub(super) fn forget_fragment() {
    if fragment().is_empty() {
        return;
    }
    if let Some(history) = web_sys::window().and_then(|window| window.history().ok()) {
        // Where the browser refuses, the old link stays, which is still a link.
        let _ = history.replace_state_with_url(&wasm_bindgen::JsValue::NULL, "", Some(&base()));
    }
}
