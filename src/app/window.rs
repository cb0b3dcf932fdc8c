//! The page in a window of its own, for quick looks while working on it: no build for the browser, no server. What only
//! the browser has (address, files, what it remembers, sound) is not there.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use super::App;
use super::crew::{Crew, Workers};
use crate::scheduler::{Failure, Finding, Work};

/// A worker, the number of its piece, and what it found.
type Report = (usize, u64, Result<Finding, Failure>);

/// The threads of rayon as workers.
struct Threads {
    context: egui::Context,
    sender: Sender<Report>,
    receiver: Receiver<Report>,
}

impl Workers for Threads {
    fn count(&self) -> usize {
        rayon::current_num_threads()
    }

    fn give(&mut self, worker: usize, number: u64, work: Arc<dyn Work>) {
        let (sender, context) = (self.sender.clone(), self.context.clone());
        rayon::spawn(move || {
            // Nobody listens any more once the window is closed.
            let _ = sender.send((worker, number, work.carry_out()));
            context.request_repaint();
        });
    }

    /// A thread cannot be stopped: what it still finds is not waited for.
    fn replace(&mut self, _worker: usize) {}

    fn attend(&mut self) -> Option<Report> {
        self.receiver.try_recv().ok()
    }
}

struct Window(App);

impl Window {
    fn new(context: &egui::Context) -> Self {
        let (sender, receiver) = channel();
        let threads = Threads { context: context.clone(), sender, receiver };
        Self(App::new(context, None, Rc::new(RefCell::new(Crew::new(Box::new(threads))))))
    }
}

impl eframe::App for Window {
    fn logic(&mut self, context: &egui::Context, _frame: &mut eframe::Frame) {
        self.0.logic(context);
    }

    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        self.0.ui(ui);
        // There is no browser to carry them out.
        self.0.take_errands();
    }
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// Where there is no screen or no OpenGL.
pub fn open() -> Result<(), eframe::Error> {
    let viewport = egui::ViewportBuilder::default().with_inner_size([1440.0, 900.0]);
    let options = eframe::NativeOptions { viewport, ..Default::default() };
    eframe::run_native(
        "Harvester Lab",
        options,
        Box::new(|creation| Ok(Box::new(Window::new(&creation.egui_ctx)))),
    )
}
