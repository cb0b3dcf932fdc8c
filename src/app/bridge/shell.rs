//! The calls into the script of the page (`start.js`, `picture.js`, `sound.js` and `stage.js` of `assets/shell`).

use js_sys::Promise;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    /// Takes the loading screen away.
    #[wasm_bindgen(js_namespace = harvesterShell)]
    pub(super) fn ready();

    /// Gives what stands around the canvas the colours of the theme.
    #[wasm_bindgen(js_namespace = harvesterShell)]
    pub(super) fn look(dark: bool, contrast: bool);

    /// Replaces the page by a screen that says what happened and offers the stored state.
    #[wasm_bindgen(js_namespace = harvesterShell)]
    pub(super) fn fail(title: &str, detail: &str);

    /// Has the page's markup in the language of this code, with these texts by their English ones, as JSON.
    #[wasm_bindgen(js_namespace = harvesterShell)]
    pub(super) fn speak(code: &str, words: &str);

    /// The bytes of a file that the page lists under this name (a `meta` element).
    #[wasm_bindgen(js_namespace = harvesterShell, js_name = fetchListed)]
    pub(super) fn fetch_listed(name: &str) -> Promise;

    /// Tells what the native controls mirror has changed to, as JSON.
    #[wasm_bindgen(js_namespace = harvesterShell)]
    pub(super) fn changed(mirror: &str);

    /// Saves a picture of a drawing (SVG) under this name, with `scale` times its pixels.
    #[wasm_bindgen(js_name = harvesterSavePicture)]
    pub(super) fn save_picture(name: &str, drawing: &str, scale: u8) -> Promise;

    /// Plays samples after those before them, at `rate` samples a second; none ends the sound.
    #[wasm_bindgen(js_name = harvesterPlay)]
    pub(super) fn play(samples: &[f32], rate: f64);

    /// Fills the screen with the page, or ends that.
    #[wasm_bindgen(js_namespace = harvesterStage, js_name = fullScreen)]
    pub(super) fn full_screen();

    /// Whether clips can be recorded.
    #[wasm_bindgen(js_namespace = harvesterStage, js_name = canRecord)]
    pub(super) fn can_record() -> bool;

    /// Records a part of the canvas, given as fractions of its sides, for a file of this name.
    #[wasm_bindgen(js_namespace = harvesterStage)]
    pub(super) fn record(name: &str, left: f32, top: f32, width: f32, height: f32) -> Promise;

    /// Ends that, and saves it.
    #[wasm_bindgen(js_namespace = harvesterStage)]
    pub(super) fn stop();

    /// The text of a lesson of this site.
    #[wasm_bindgen(js_namespace = harvesterStage, js_name = fetchLesson)]
    pub(super) fn fetch_lesson(name: &str) -> Promise;

    /// A new worker that has been told to run this (compiled) `module`, or null.
    #[wasm_bindgen(js_namespace = harvesterShell)]
    pub(super) fn worker(module: &JsValue) -> JsValue;
}
