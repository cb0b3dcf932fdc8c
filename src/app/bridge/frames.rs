//! What a frame cost, and which widgets it showed.

use std::{collections::VecDeque, sync::Arc};

use egui::mutex::Mutex;
use serde::Serialize;

use super::controls::{self, Control};

/// Frames remembered.
const KEPT: usize = 2000;

/// Milliseconds and frames after the last question about widgets until their description is no longer made.
const CURIOSITY: f64 = 1500.0;
const CURIOUS_FRAMES: u64 = 20;

/// Milliseconds since the page was opened.
fn now() -> f64 {
    web_sys::window().and_then(|window| window.performance()).map_or(0.0, |clock| clock.now())
}

#[derive(Default)]
struct Record {
    count: u64,
    cpu_ms: VecDeque<f64>,
    total_ms: VecDeque<f64>,
    last_total: Option<f32>,
    /// When the widgets were asked for last, and in which frame.
    asked: Option<(f64, u64)>,
    controls: Vec<Control>,
}

/// Shared between the probe that writes it and the exported functions that read it.
#[derive(Clone, Default)]
pub(super) struct Recorder(Arc<Mutex<Record>>);

/// The answer of `harvester.frames()`.
#[derive(Serialize)]
struct Statistics<'a> {
    count: u64,
    cpu_ms: &'a VecDeque<f64>,
    total_ms: &'a VecDeque<f64>,
}

impl Recorder {
    /// Notes eframe's own time of the previous frame in seconds: logic, layout, tessellation and paint.
    /// It keeps its value when a frame was laid out by an event handler, and is then not counted twice.
    pub(super) fn total(&self, seconds: Option<f32>) {
        let mut record = self.0.lock();
        if let Some(value) = seconds.filter(|_| seconds != record.last_total) {
            record.last_total = seconds;
            push(&mut record.total_ms, f64::from(value) * 1e3);
        }
    }

    /// Frame statistics as JSON.
    pub(super) fn statistics(&self) -> String {
        let record = self.0.lock();
        let statistics =
            Statistics { count: record.count, cpu_ms: &record.cpu_ms, total_ms: &record.total_ms };
        serde_json::to_string(&statistics).unwrap_or_default()
    }

    /// The widgets of the last frame as JSON; the first call only starts their collection.
    pub(super) fn controls(&self, context: &egui::Context) -> String {
        let mut record = self.0.lock();
        let asked = (now(), record.count);
        let idle = record.asked.replace(asked).is_none();
        let list = serde_json::to_string(&record.controls).unwrap_or_default();
        drop(record);
        if idle {
            context.enable_accesskit();
            context.request_repaint();
        }
        list
    }
}

fn push(values: &mut VecDeque<f64>, value: f64) {
    if values.len() == KEPT {
        values.pop_front();
    }
    values.push_back((value * 1e3).round() / 1e3);
}

/// Sees the start and the end of every frame.
pub(super) struct Probe {
    recorder: Recorder,
    began: f64,
}

impl Probe {
    pub(super) fn new(recorder: Recorder) -> Self {
        Self { recorder, began: now() }
    }
}

impl egui::Plugin for Probe {
    fn debug_name(&self) -> &'static str {
        "frame probe"
    }

    fn input_hook(&mut self, _ctx: &egui::Context, _input: &mut egui::RawInput) {
        self.began = now();
    }

    fn output_hook(&mut self, ctx: &egui::Context, output: &mut egui::FullOutput) {
        let ended = now();
        let mut record = self.recorder.0.lock();
        record.count += 1;
        push(&mut record.cpu_ms, ended - self.began);
        if let Some(update) = output.platform_output.accesskit_update.take() {
            record.controls = controls::collect(&update, ctx.zoom_factor());
        }
        // A tree for every frame costs about as much as the frame: stop when nobody asks any more.
        let bored = |(asked, count)| ended - asked > CURIOSITY && record.count - count > CURIOUS_FRAMES;
        if record.asked.is_some_and(bored) {
            record.asked = None;
            record.controls.clear();
            ctx.disable_accesskit();
        }
    }
}
