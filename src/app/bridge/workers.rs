//! Web workers as the crew's hands. Each runs this same module, started by `assets/shell/worker.js`, so page and workers
//! cannot be of different versions.

use std::cell::{Cell, RefCell};
use std::rc::{Rc, Weak};
use std::sync::Arc;

use js_sys::{Function, Uint8Array};
use nanoserde::{DeBin, SerBin};
use wasm_bindgen::prelude::{Closure, wasm_bindgen};
use wasm_bindgen::{JsCast as _, JsValue};
use web_sys::{MessageEvent, Worker};

use crate::app::crew::{Crew, Workers};
use crate::questions::list;
use crate::scheduler::budget::now;
use crate::scheduler::{Failure, Finding, Work};

/// Fewest and most workers.
const COUNTS: (usize, usize) = (2, 8);
/// Seconds between two messages on how far a piece is.
const BETWEEN_PARTS: f64 = 0.05;

/// A piece on its way to a worker, and what comes back.
#[derive(SerBin, DeBin)]
struct Order {
    number: u64,
    /// Name of the piece, and the piece.
    name: String,
    piece: Vec<u8>,
}

#[derive(SerBin, DeBin)]
struct Report {
    number: u64,
    outcome: Outcome,
}

#[derive(SerBin, DeBin)]
enum Outcome {
    Found(Vec<u8>),
    Failed(Failure),
    /// It is under way, and so far, 0 to 1.
    Partly(f64),
}

/// Inside a worker: carries out an order and reports, in the binary form of messages. Until then `post` sends how far it is:
/// such messages leave a worker while it computes.
#[wasm_bindgen]
pub fn carry_out(order: &[u8], post: &Function) -> Vec<u8> {
    let (number, finding) = match Order::deserialize_bin(order) {
        Ok(Order { number, name, piece }) => {
            let told = Cell::new(now());
            let tell = |part: f64| {
                if now() - told.get() >= BETWEEN_PARTS {
                    told.set(now());
                    let report = Report { number, outcome: Outcome::Partly(part) }.serialize_bin();
                    // What does not arrive is told again soon.
                    let _ = post.call1(&JsValue::NULL, &Uint8Array::from(report.as_slice()));
                }
            };
            (number, list::carry_out(&name, &piece, &tell))
        }
        Err(error) => (0, Err(Failure::Verbatim(error.to_string()))),
    };
    let outcome = finding.map_or_else(Outcome::Failed, Outcome::Found);
    Report { number, outcome }.serialize_bin()
}

/// What the crew's messages lead to.
pub(super) type Taken = Rc<dyn Fn(&Rc<RefCell<Crew>>)>;

/// A worker with the functions that its events call.
struct Hand {
    worker: Worker,
    _on_message: Closure<dyn FnMut(MessageEvent)>,
    _on_error: Closure<dyn FnMut(JsValue)>,
}

impl Drop for Hand {
    fn drop(&mut self) {
        self.worker.set_onmessage(None);
        self.worker.set_onerror(None);
        self.worker.terminate();
    }
}

/// The page's workers.
pub(super) struct WebWorkers {
    hands: Vec<Option<Hand>>,
    crew: Weak<RefCell<Crew>>,
    taken: Taken,
}

impl WebWorkers {
    /// As many as the machine has cores; they bring their findings to `crew`, and then `taken` is called. `None` where
    /// the browser has no workers.
    pub(super) fn hire(crew: Weak<RefCell<Crew>>, taken: Taken) -> Option<Self> {
        let cores = web_sys::window().map_or(0.0, |window| window.navigator().hardware_concurrency());
        let count = (cores as usize).clamp(COUNTS.0, COUNTS.1);
        let mut workers = Self { hands: Vec::new(), crew, taken };
        for number in 0..count {
            let hand = workers.hand(number)?;
            workers.hands.push(Some(hand));
        }
        Some(workers)
    }

    fn hand(&self, number: usize) -> Option<Hand> {
        let worker = super::shell::worker(&wasm_bindgen::module()).dyn_into::<Worker>().ok()?;
        let (crew, taken) = (self.crew.clone(), Rc::clone(&self.taken));
        let on_message = Closure::new(move |event: MessageEvent| {
            let Some(crew) = crew.upgrade() else { return };
            let message =
                event.data().dyn_into::<Uint8Array>().map(|bytes| bytes.to_vec()).unwrap_or_default();
            if let Ok(report) = Report::deserialize_bin(&message) {
                let mut crew = crew.borrow_mut();
                match report.outcome {
                    Outcome::Found(message) => {
                        crew.returned(number, report.number, Ok(Finding::Message(message)));
                    }
                    Outcome::Failed(why) => crew.returned(number, report.number, Err(why)),
                    Outcome::Partly(part) => crew.told(number, report.number, part),
                }
            }
            taken(&crew);
        });
        let (crew, taken) = (self.crew.clone(), Rc::clone(&self.taken));
        let on_error = Closure::new(move |_: JsValue| {
            let Some(crew) = crew.upgrade() else { return };
            // Replacing the worker drops this very function: not while it runs.
            let taken = Rc::clone(&taken);
            wasm_bindgen_futures::spawn_local(async move {
                crew.borrow_mut().died(number);
                taken(&crew);
            });
        });
        worker.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
        worker.set_onerror(Some(on_error.as_ref().unchecked_ref()));
        Some(Hand { worker, _on_message: on_message, _on_error: on_error })
    }
}

impl Workers for WebWorkers {
    fn count(&self) -> usize {
        self.hands.len()
    }

    fn give(&mut self, worker: usize, number: u64, work: Arc<dyn Work>) {
        let order = Order { number, name: work.name().to_owned(), piece: work.message() };
        let message = Uint8Array::from(order.serialize_bin().as_slice());
        if let Some(Some(hand)) = self.hands.get(worker) {
            // A worker that cannot be reached is found overdue and replaced.
            let _ = hand.worker.post_message(&message);
        }
    }

    fn replace(&mut self, worker: usize) {
        let hired = self.hand(worker);
        if let Some(hand) = self.hands.get_mut(worker) {
            *hand = hired;
        }
    }
}
