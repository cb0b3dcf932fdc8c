//! What lies over the page until it is closed.

use egui::{Context, Id, Modal, Ui};

use super::touch;

/// A sheet over the page, known by its name, that Escape or a click beside it closes.
#[derive(Debug, Clone, Copy)]
pub struct Overlay {
    name: &'static str,
    width: f32,
}

impl Overlay {
    /// One of that name and `width` (points), which a narrow page makes narrower.
    pub const fn new(name: &'static str, width: f32) -> Self {
        Self { name, width }
    }

    fn id(self) -> Id {
        Id::unique(self.name)
    }

    /// Whether it is shown.
    pub fn is_open(self, context: &Context) -> bool {
        context.data(|data| data.get_temp(self.id())).unwrap_or(false)
    }

    /// Shows it.
    pub fn open(self, context: &Context) {
        self.set(context, true);
    }

    fn set(self, context: &Context, open: bool) {
        context.data_mut(|data| data.insert_temp(self.id(), open));
        context.request_repaint();
    }

    /// Draws it, if it is shown, with what `content` draws; returning true closes it.
    pub fn show(self, ui: &Ui, content: impl FnOnce(&mut Ui) -> bool) {
        if !self.is_open(ui.ctx()) {
            return;
        }
        let page = ui.ctx().content_rect().size();
        let frame = egui::Frame::popup(ui.style()).inner_margin(20);
        let shown = Modal::new(self.id()).frame(frame).show(ui.ctx(), |ui| {
            ui.set_width(self.width.min(page.x - 64.0));
            content(ui)
        });
        if shown.inner || shown.should_close() {
            self.set(ui.ctx(), false);
        }
    }

    /// Draws `content` so that it scrolls where the page is low, with `besides` points of the page's height for what stands
    /// outside of it.
    pub fn scrolled<R>(ui: &mut Ui, besides: f32, content: impl FnOnce(&mut Ui) -> R) -> R {
        let room = ui.ctx().content_rect().height() - besides;
        // In a modal it would shrink to what its first picture had.
        touch::scroll_area(ui.ctx()).max_height(room).min_scrolled_height(room).show(ui, content).inner
    }
}
