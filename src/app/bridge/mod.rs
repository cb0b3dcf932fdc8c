//! The browser side of the front end: starts the app on the page's canvas, keeps its state in local storage and
//! answers `window.harvester`.
//!
//! The page's own script (`assets/shell/start.js`) shows the loading and failure screens, loads this module and turns
//! the exported functions into `window.harvester`.
//!
//! The address is only written to once, when the view departs from the link in it (`bridge/address.rs`).
//!
//! # The shell around the canvas
//!
//! The canvas is opaque to screen readers and to the browser, so `index.html` holds what must not depend on it:
//! screens for loading and failing, native controls, and what keeps the page for use without a network.
//!
//! * `assets/shell/mirror.js` uses nothing but `window.harvester` and its event: `bridge/mirror.rs` compares
//!   `app::mirror::Signs` once a frame and tells the page at most every 200 ms. A change goes through `App::change`,
//!   which reads names and values as links do, so a number is checked in one place. The verdict is spoken when the
//!   hand rests. Tab stays in the canvas until Escape, because egui keeps it.
//! * `keyboard::keep_focus_in_view` scrolls to what Tab has reached; a test walks through every page at two widths.
//! * A panic, a trap of the compiled code and a lost graphics context end in `fail` of `start.js`, with the stored
//!   state. What no script can tell, because none runs, the style sheet shows after ten seconds (`#late`).
//! * `service.js` keeps exactly one build. `scripts/precache.py` writes its files with SHA-256 digests into it after
//!   each build; it installs all of them or none, and a half replaced site fails the digests. It takes over at once,
//!   but the page in view goes on with its own build: names with hashes keep two builds apart, and the cache before
//!   the present one is kept.
//! * The Content-Security-Policy allows no inline script; tests put theirs in from outside.

mod address;
mod around;
mod controls;
pub mod exports;
mod files;
mod frames;
mod mirror;
mod running;
mod shell;
mod storage;
pub mod workers;

use std::cell::{Cell, RefCell};
use std::rc::{Rc, Weak};
use std::time::Duration;

use wasm_bindgen::JsCast as _;

use super::App;
use super::clock::milliseconds;
use super::crew::{Crew, Inline, Workers};
use frames::{Probe, Recorder};
use running::{RUNNING, Running, change};

/// Starts the app on the element with the id `canvas`. Failures are shown on the page, not returned. In a worker, which
/// has no page, nothing happens: it waits for orders.
pub fn start() {
    if web_sys::window().is_none() {
        return;
    }
    std::panic::set_hook(Box::new(|info| shell::fail("Harvester Lab stopped", &info.to_string())));
    let canvas = web_sys::window()
        .and_then(|window| window.document())
        .and_then(|document| document.get_element_by_id("canvas"))
        .and_then(|element| element.dyn_into::<web_sys::HtmlCanvasElement>().ok());
    let Some(canvas) = canvas else {
        shell::fail("Harvester Lab cannot start", "the page has no canvas");
        return;
    };
    let options = eframe::WebOptions {
        webgl_context_option: eframe::WebGlContextOption::WebGl2,
        should_prevent_default: Box::new(keeps),
        ..Default::default()
    };
    wasm_bindgen_futures::spawn_local(async move {
        let runner = eframe::WebRunner::new();
        let started =
            runner.start(canvas, options, Box::new(|creation| Ok(Box::new(Page::new(&creation.egui_ctx)))));
        if let Err(error) = started.await {
            let reason = error.as_string().unwrap_or_else(|| format!("{error:?}"));
            shell::fail("Harvester Lab cannot start", &reason);
        }
    });
}

/// Whether the page uses an event itself, so that the browser must not act on it as well.
fn keeps(event: &egui::Event) -> bool {
    RUNNING.with_borrow(|slot| {
        let app = slot.as_ref().and_then(|running| Some((running.app.try_borrow().ok()?, &running.context)));
        app.is_none_or(|(app, context)| app.keeps(context, event))
    })
}

/// Milliseconds between pictures of work that goes on.
const BETWEEN_PICTURES: f64 = 100.0;

/// A crew of web workers, or of this thread where there can be none.
fn crew(context: egui::Context) -> Rc<RefCell<Crew>> {
    // When the newest picture asked for is due.
    let picture = Cell::new(f64::NEG_INFINITY);
    let taken: workers::Taken = Rc::new(move |crew| {
        exports::settle(&mut crew.borrow_mut());
        // Findings come faster than they need to be drawn: the first at once, the others in company.
        let now = milliseconds();
        if now >= picture.get() {
            picture.set(now.max(picture.get() + BETWEEN_PICTURES));
            context.request_repaint_after(Duration::from_secs_f64(1e-3 * (picture.get() - now)));
        }
    });
    Rc::new_cyclic(|crew: &Weak<RefCell<Crew>>| {
        let hired = workers::WebWorkers::hire(crew.clone(), taken);
        let workers = hired.map_or_else(
            || Box::new(Inline::default()) as Box<dyn Workers>,
            |workers| Box::new(workers) as Box<dyn Workers>,
        );
        RefCell::new(Crew::new(workers))
    })
}

/// Shows what the address asks for.
fn open_address() {
    change(|app, keeper| {
        let fragment = address::fragment();
        app.open_link(&fragment);
        if !app.is_embedded() {
            keeper.opened((!fragment.is_empty()).then(|| (fragment, app.fragment())));
        }
    });
}

/// The app as eframe sees it.
struct Page {
    app: Rc<RefCell<App>>,
    keeper: Rc<RefCell<storage::Keeper>>,
    mirror: mirror::Mirror,
    recorder: Recorder,
    wishes: around::SystemWishes,
    /// The look that the shell was told last.
    look: Option<(bool, bool)>,
    shown: bool,
}

impl Page {
    fn new(context: &egui::Context) -> Self {
        let search = address::search();
        let embedded = crate::app::embed::Embed::read(&search, &crate::app::panels::parts::parts()).is_some();
        // An embedded page begins with what its address says, and leaves what the whole page remembers alone.
        let keeper = if embedded { storage::Keeper::absent() } else { storage::Keeper::open() };
        let is_first_visit = !embedded && keeper.stored().is_none() && address::fragment().is_empty();
        if is_first_visit {
            crate::app::panels::greeting::SHEET.open(context);
        }
        let crew = crew(context.clone());
        let mut app = App::new(context, keeper.stored(), Rc::clone(&crew));
        app.prefer_language(address::page_language());
        let asked = address::take_language();
        app.set_address(address::base());
        if let Some(language) = asked {
            app.choose_language(language);
        }
        app.embed(&search);
        let wishes = around::SystemWishes::watch(context);
        app.set_wishes(wishes.now());
        around::watch_fingers(context);
        if around::has_coarse_pointer() {
            crate::app::widgets::touch::expect_fingers(context);
        }
        let app = Rc::new(RefCell::new(app));
        let keeper = Rc::new(RefCell::new(keeper));
        let recorder = Recorder::default();
        context.add_plugin(Probe::new(recorder.clone()));
        RUNNING.set(Some(Running {
            app: Rc::clone(&app),
            crew,
            context: context.clone(),
            recorder: recorder.clone(),
            keeper: Rc::clone(&keeper),
        }));
        open_address();
        address::watch(open_address);
        if !embedded {
            address::watch_places(|place| change(|app, _| app.return_to(place)));
            crate::app::widgets::card::offer_clips(context, shell::can_record());
        }
        if let Some(name) = address::lesson() {
            wasm_bindgen_futures::spawn_local(files::begin_lesson(name));
        }
        Self { app, keeper, mirror: mirror::Mirror::default(), recorder, wishes, look: None, shown: false }
    }
}

impl eframe::App for Page {
    fn logic(&mut self, ctx: &egui::Context, frame: &mut eframe::Frame) {
        self.recorder.total(frame.info().cpu_usage);
        files::take_dropped(ctx);
        let mut app = self.app.borrow_mut();
        app.logic(ctx);
        exports::settle_running();
        self.keeper.borrow_mut().tick(&app, ctx);
    }

    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        self.app.borrow_mut().set_wishes(self.wishes.now());
        self.app.borrow_mut().ui(ui);
        let look = self.app.borrow().look(ui.ctx());
        if self.look != Some(look) {
            self.look = Some(look);
            shell::look(look.0, look.1);
        }
        let errands = self.app.borrow_mut().take_errands();
        errands.iter().for_each(files::run);
        // In the language chosen from the first picture on.
        if !self.shown && !self.app.borrow().awaits_words() {
            self.shown = true;
            shell::ready();
        }
        if !self.app.borrow().is_embedded() {
            address::visit(self.app.borrow().whereabouts());
        }
        self.mirror.tick(&self.app.borrow(), ui.ctx());
    }

    fn raw_input_hook(&mut self, ctx: &egui::Context, raw_input: &mut egui::RawInput) {
        self.app.borrow().sift(ctx, &mut raw_input.events);
    }

    fn save(&mut self, _storage: &mut dyn eframe::Storage) {
        self.keeper.borrow_mut().keep(&self.app.borrow());
    }

    fn persist_egui_memory(&self) -> bool {
        false
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        visuals.panel_fill.to_normalized_gamma_f32()
    }

    fn as_any_mut(&mut self) -> Option<&mut dyn std::any::Any> {
        Some(self)
    }
}
