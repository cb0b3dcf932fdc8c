//! The page's address: the link with which it was opened, and the next one.

use std::cell::RefCell;

use wasm_bindgen::prelude::Closure;
use wasm_bindgen::{JsCast as _, JsValue};

use crate::app::text::Language;

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

/// The language that the address asks for (`?lang=de`), which is taken out of it: what is chosen later holds after a reload.
pub(super) fn take_language() -> Option<Language> {
    let window = web_sys::window()?;
    let search = window.location().search().ok()?;
    let asked = |part: &&str| part.starts_with("lang=");
    let parts = || search.trim_start_matches('?').split('&');
    let language = Language::of_tag(parts().find(asked)?.trim_start_matches("lang="));
    let rest: Vec<&str> = parts().filter(|part| !asked(part)).collect();
    let path = window.location().pathname().unwrap_or_default();
    let search = if rest.is_empty() { String::new() } else { format!("?{}", rest.join("&")) };
    let address = path + &search + &fragment();
    // Where the browser refuses, the address keeps asking.
    let _ = window.history().ok()?.replace_state_with_url(&JsValue::NULL, "", Some(&address));
    language
}

/// The language in which the page's script has begun.
pub(super) fn page_language() -> Language {
    let root = web_sys::window().and_then(|window| window.document()?.document_element());
    let tag = root.and_then(|root| root.get_attribute("lang")).unwrap_or_default();
    Language::of_tag(&tag).unwrap_or_default()
}

/// The lesson that the address names (`?lesson=name.json`).
pub(super) fn lesson() -> Option<String> {
    let search = search();
    let mut entries = form_urlencoded::parse(search.trim_start_matches('?').as_bytes());
    entries.find(|(name, _)| name == "lesson").map(|(_, name)| name.into_owned())
}

thread_local! {
    /// The place in the page that the browser's history stands at.
    static PLACE: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Makes a new place in the page one of the browser's history, for its buttons back and forward.
pub(super) fn visit(place: String) {
    PLACE.with_borrow_mut(|before| {
        if before.as_ref() == Some(&place) {
            return;
        }
        if let Some(history) = web_sys::window().and_then(|window| window.history().ok()) {
            let state = JsValue::from_str(&place);
            // Where the browser refuses, back leads out of the page, as without.
            let _ = if before.is_some() {
                history.push_state(&state, "")
            } else {
                history.replace_state_with_url(&state, "", None)
            };
        }
        *before = Some(place);
    });
}

/// Calls `return_to` with a place to which the user goes back or forward.
pub(super) fn watch_places(return_to: fn(&str)) {
    let Some(window) = web_sys::window() else { return };
    let listener = Closure::<dyn FnMut(JsValue)>::new(move |event: JsValue| {
        let state = js_sys::Reflect::get(&event, &JsValue::from_str("state")).ok();
        if let Some(place) = state.and_then(|state| state.as_string()) {
            PLACE.set(Some(place.clone()));
            return_to(&place);
        }
    });
    window.set_onpopstate(Some(listener.as_ref().unchecked_ref()));
    listener.forget();
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

/// Takes this fragment out of the address: it does not say any more what is shown, and a reload should go on with that.
/// One that has come in the meantime stays, to be opened.
pub(super) fn forget_fragment(opened: &str) {
    if opened.is_empty() || fragment() != opened {
        return;
    }
    if let Some(history) = web_sys::window().and_then(|window| window.history().ok()) {
        let state = history.state().unwrap_or(JsValue::NULL);
        // Where the browser refuses, the old link stays, which is still a link.
        let _ = history.replace_state_with_url(&state, "", Some(&(base() + &search())));
    }
}
