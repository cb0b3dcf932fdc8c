//! Files: saved by a link with a download name, opened by the browser's own dialog or dropped on the page.

use egui::DroppedFileHandle;
use wasm_bindgen::prelude::Closure;
use wasm_bindgen::{JsCast as _, JsValue};
use web_sys::{Blob, BlobPropertyBag, HtmlAnchorElement, HtmlInputElement, Url};

use super::running::{change, context};
use super::shell;
use crate::app::errand::Errand;
use crate::app::sharing;
use crate::app::speaking::Words;
use crate::app::text::Language;
use crate::sentence::{Sentence, said};

/// The element that opens the dialog; tests find it by this.
const INPUT: &str = "open-file";
/// How long a saved text stays readable for the browser, in milliseconds.
const SAVING: i32 = 60_000;

/// Does what the app asks of the browser.
pub(super) fn run(errand: &Errand) {
    // Without a page there is nobody to save or open anything for.
    let _ = match errand {
        Errand::Save(name, kind, text) => save(name, kind, text),
        Errand::Picture(name, drawing, scale) => {
            wasm_bindgen_futures::spawn_local(picture(name.clone(), drawing.clone(), *scale));
            Some(())
        }
        Errand::Sound(samples) => {
            shell::play(samples, crate::app::live::RATE);
            Some(())
        }
        Errand::Open => open(),
        Errand::FullScreen => {
            shell::full_screen();
            Some(())
        }
        Errand::Record(name, part) => {
            wasm_bindgen_futures::spawn_local(record(name.clone(), *part));
            Some(())
        }
        Errand::StopRecording => {
            shell::stop();
            Some(())
        }
        Errand::Fetch(language) => {
            wasm_bindgen_futures::spawn_local(learn(*language));
            Some(())
        }
        Errand::Speak(language, words) => {
            shell::speak(language.code(), words);
            Some(())
        }
    };
}

fn document() -> Option<web_sys::Document> {
    web_sys::window()?.document()
}

/// Has the browser draw the picture, and says when it cannot.
async fn picture(name: String, drawing: String, scale: u8) {
    let drawn = shell::save_picture(&name, &drawing, scale);
    if wasm_bindgen_futures::JsFuture::from(drawn).await.is_err() {
        change(|app, _| app.tell("This browser could not make the picture. SVG and CSV need no help of it."));
    }
}

/// Begins a clip, and says when the browser does not.
async fn record(name: String, part: egui::Rect) {
    let begun = shell::record(&name, part.left(), part.top(), part.width(), part.height());
    if wasm_bindgen_futures::JsFuture::from(begun).await.is_err() {
        change(|app, _| app.recording_failed());
    }
}

/// Fetches the lesson that the address names, and begins it.
pub(super) async fn begin_lesson(name: String) {
    let fetched = wasm_bindgen_futures::JsFuture::from(shell::fetch_lesson(&name)).await;
    let text = fetched.ok().and_then(|text| text.as_string());
    change(|app, _| match &text {
        Some(text) => app.open_lesson(&name, text),
        None => app.tell_unopened(&name, &said("this site has no such file", &[])),
    });
}

/// Fetches what a language needs.
async fn learn(language: Language) {
    let words = words(language).await;
    let context = context();
    change(|app, _| {
        if let Some(context) = context {
            app.learn(&context, language, words);
        }
    });
}

async fn words(language: Language) -> Option<Words> {
    let catalogue = fetch(&format!("text-{}", language.code())).await?;
    let font = match language {
        Language::Chinese => Some(fetch("font-zh").await?),
        Language::English | Language::German => None,
    };
    Some(Words { catalogue, font })
}

/// A file of this build, by the name under which the page lists it.
async fn fetch(name: &str) -> Option<Vec<u8>> {
    let bytes = wasm_bindgen_futures::JsFuture::from(shell::fetch_listed(name)).await.ok()?;
    Some(js_sys::Uint8Array::new(&bytes).to_vec())
}

fn save(name: &str, kind: &str, text: &str) -> Option<()> {
    let options = BlobPropertyBag::new();
    options.set_type(kind);
    let parts = js_sys::Array::of1(&JsValue::from_str(text));
    let blob = Blob::new_with_str_sequence_and_options(&parts, &options).ok()?;
    let address = Url::create_object_url_with_blob(&blob).ok()?;
    let anchor: HtmlAnchorElement = document()?.create_element("a").ok()?.dyn_into().ok()?;
    anchor.set_href(&address);
    anchor.set_download(name);
    anchor.click();
    // Not at once: some browsers read it later.
    let forget = Closure::once_into_js(move || Url::revoke_object_url(&address));
    let forget = forget.unchecked_ref();
    web_sys::window()?.set_timeout_with_callback_and_timeout_and_arguments_0(forget, SAVING).ok()?;
    Some(())
}

fn open() -> Option<()> {
    let document = document()?;
    let input: HtmlInputElement = match document.get_element_by_id(INPUT) {
        Some(element) => element.dyn_into().ok()?,
        None => {
            let input: HtmlInputElement = document.create_element("input").ok()?.dyn_into().ok()?;
            input.set_id(INPUT);
            input.set_type("file");
            input.set_accept(".json,.csv,.tsv,.txt,.dat,.lvm,.asc,application/json,text/*");
            input.set_hidden(true);
            let chosen = input.clone();
            let listener = Closure::<dyn FnMut()>::new(move || {
                if let Some(file) = chosen.files().and_then(|files| files.get(0)) {
                    wasm_bindgen_futures::spawn_local(read(file));
                }
            });
            input.set_onchange(Some(listener.as_ref().unchecked_ref()));
            // One for the life of the page.
            listener.forget();
            document.body()?.append_child(&input).ok()?;
            input
        }
    };
    // The same file again is a change, too.
    input.set_value("");
    input.click();
    Some(())
}

async fn read(file: web_sys::File) {
    let contents = contents(&file).await;
    change(|app, _| app.open_file(&file.name(), contents));
}

/// What a file holds. Its beginning is looked at first: what cannot be opened is not read.
async fn contents(file: &web_sys::File) -> Result<Vec<u8>, Sentence> {
    let beginning = file.slice_with_f64_and_f64(0.0, sharing::FIRST as f64).map_err(|_| unreadable())?;
    sharing::look(&file.name(), &bytes(&beginning).await?, file.size() as usize)?;
    bytes(file).await
}

async fn bytes(blob: &Blob) -> Result<Vec<u8>, Sentence> {
    let buffer = wasm_bindgen_futures::JsFuture::from(blob.array_buffer()).await.map_err(|_| unreadable())?;
    Ok(js_sys::Uint8Array::new(&buffer).to_vec())
}

fn unreadable() -> Sentence {
    said("the browser cannot read it", &[])
}

/// Opens what was dropped on the page in this frame.
pub(super) fn take_dropped(context: &egui::Context) {
    let dropped = context.input(|input| input.raw.dropped_files.clone());
    for file in dropped {
        wasm_bindgen_futures::spawn_local(read_dropped(file));
    }
}

async fn read_dropped(file: DroppedFileHandle) {
    if let Some(file) = file.web_file() {
        read(file.clone()).await;
    }
}
