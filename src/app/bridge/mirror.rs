//! Tells the page when something changed that its native controls mirror.

use super::{App, shell};
use crate::app::mirror::Signs;

/// Seconds between two messages: more often than anyone reads, seldom enough to cost nothing.
const PAUSE: f64 = 0.2;

/// What the page was told last.
#[derive(Default)]
pub(super) struct Mirror {
    told: Option<Signs>,
    when: f64,
}

impl Mirror {
    /// Called once a frame.
    pub(super) fn tick(&mut self, app: &App, ctx: &egui::Context) {
        let (now, hand_moves) = ctx.input(|input| (input.time, input.pointer.any_down()));
        let signs = app.signs(hand_moves);
        if self.told.as_ref() == Some(&signs) {
            return;
        }
        let wait = self.when + PAUSE - now;
        if self.told.is_some() && wait > 0.0 {
            ctx.request_repaint_after_secs(wait as f32 + 0.01);
            return;
        }
        shell::changed(&app.mirror_json(&signs));
        (self.told, self.when) = (Some(signs), now);
    }
}
