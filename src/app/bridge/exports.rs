//! The functions behind `window.harvester`.

use std::cell::RefCell;
use std::collections::HashMap;

use js_sys::{Function, Promise};
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

use super::running::{RUNNING, Running};
use crate::app::App;
use crate::app::crew::Crew;

thread_local! {
    /// What resolves and rejects the promises of requests under way.
    static PROMISES: RefCell<HashMap<usize, (Function, Function)>> = RefCell::default();
}

/// Runs `with` on the running app. It fails before the start, and after a crash inside a frame.
fn running<T>(with: impl FnOnce(&Running) -> Result<T, String>) -> Result<T, JsError> {
    RUNNING
        .with_borrow(|slot| slot.as_ref().map_or_else(|| Err("the app is not running".to_owned()), with))
        .map_err(|message| JsError::new(&message))
}

const BUSY: &str = "the app is busy";

/// Lets `with` change the running app, has it drawn again and remembered.
fn changing(with: impl FnOnce(&mut App) -> Result<(), String>) -> Result<(), JsError> {
    running(|running| {
        with(&mut *running.app.try_borrow_mut().map_err(|_| BUSY)?)?;
        running.keeper.try_borrow_mut().map_err(|_| BUSY)?.touch();
        running.context.request_repaint();
        Ok(())
    })
}

/// Scenario and results as JSON.
///
/// # Errors
/// When the app is not running.
#[wasm_bindgen]
pub fn state() -> Result<String, JsError> {
    running(|running| Ok(running.app.try_borrow().map_err(|_| BUSY)?.state_json()))
}

/// Replaces the scenario by one given as JSON.
///
/// # Errors
/// One line that says what is wrong with it; the scenario shown stays.
#[wasm_bindgen]
pub fn load(json: &str) -> Result<(), JsError> {
    changing(|app| app.load_json(json))
}

/// Puts another value in an entry of the view; names and values are those of links.
///
/// # Errors
/// One line that names the entry, the value and what is allowed; nothing changes then.
#[wasm_bindgen]
pub fn change(name: &str, value: &str) -> Result<(), JsError> {
    changing(|app| app.change(name, value))
}

/// Takes the last step back.
///
/// # Errors
/// When the app is not running.
#[wasm_bindgen]
pub fn undo() -> Result<(), JsError> {
    changing(|app| {
        app.undo();
        Ok(())
    })
}

/// Takes it again.
///
/// # Errors
/// When the app is not running.
#[wasm_bindgen]
pub fn redo() -> Result<(), JsError> {
    changing(|app| {
        app.redo();
        Ok(())
    })
}

/// Answers one request of the solver, as the native command does, in a worker. The promise is rejected with one line
/// that names the field, its value and the allowed range.
///
/// # Errors
/// When the app is not running.
#[wasm_bindgen]
pub fn solve(json: String) -> Result<Promise, JsError> {
    running(|running| {
        let number = running.crew.try_borrow_mut().map_err(|_| BUSY)?.ask(json).ok_or(BUSY)?;
        running.context.request_repaint();
        Ok(Promise::new(&mut |resolve, reject| {
            PROMISES.with_borrow_mut(|promises| promises.insert(number, (resolve, reject)));
        }))
    })
}

/// Settles the promises whose answers have come in.
pub(super) fn settle(crew: &mut Crew) {
    for (number, answer) in crew.take_answers() {
        let promise = PROMISES.with_borrow_mut(|promises| promises.remove(&number));
        let Some((resolve, reject)) = promise else { continue };
        // A promise's own functions do not fail.
        let _ = match answer {
            Ok(json) => resolve.call1(&JsValue::NULL, &JsValue::from_str(&json)),
            Err(message) => reject.call1(&JsValue::NULL, &JsError::new(&message).into()),
        };
    }
}

/// The same for the app that is running.
pub(super) fn settle_running() {
    RUNNING.with_borrow(|slot| {
        if let Some(running) = slot
            && let Ok(mut crew) = running.crew.try_borrow_mut()
        {
            settle(&mut crew);
        }
    });
}

/// Times of the last frames as JSON.
///
/// # Errors
/// When the app is not running.
#[wasm_bindgen]
pub fn frames() -> Result<String, JsError> {
    running(|running| Ok(running.recorder.statistics()))
}

/// The widgets on the screen as JSON. Empty at first: ask again a frame later.
///
/// # Errors
/// When the app is not running.
#[wasm_bindgen]
pub fn controls() -> Result<String, JsError> {
    running(|running| Ok(running.recorder.controls(&running.context)))
}

/// Writes the state to local storage at once: the page is about to be hidden or closed.
///
/// # Errors
/// When the app is not running.
#[wasm_bindgen]
pub fn keep() -> Result<(), JsError> {
    running(|running| {
        let app = running.app.try_borrow().map_err(|_| BUSY)?;
        running.keeper.try_borrow_mut().map_err(|_| BUSY)?.keep(&app);
        Ok(())
    })
}
