//! The calls into the script of the page (`assets/shell/start.js`).

use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    /// Takes the loading screen away.
    #[wasm_bindgen(js_namespace = harvesterShell)]
    pub(super) fn ready();

    /// Replaces the page by a screen that says what happened and offers the stored state.
    #[wasm_bindgen(js_namespace = harvesterShell)]
    pub(super) fn fail(title: &str, detail: &str);

    /// Tells what the native controls mirror has changed to, as JSON.
    #[wasm_bindgen(js_namespace = harvesterShell)]
    pub(super) fn changed(mirror: &str);

    /// A new worker that has been told to run this (compiled) `module`, or null.
    #[wasm_bindgen(js_namespace = harvesterShell)]
    pub(super) fn worker(module: &JsValue) -> JsValue;
}
