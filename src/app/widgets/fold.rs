//! A section that folds, with a summary of its contents in the header.

use egui::collapsing_header::CollapsingState;
use egui::{Align2, Rect, Sense, Ui, Vec2, WidgetInfo, pos2, vec2};

use super::icon::{self, Icon};
use crate::app::{fonts, theme};

/// Height of the header, points.
const HEADER: f32 = 34.0;

/// A header `▸ Magnet    c₀ 0.508  d 0.150` with contents that open below it.
///
/// ```
/// # use harvester_lab::app::widgets::Fold;
/// # fn draw(ui: &mut egui::Ui) {
/// Fold::new("Magnet").summary("c₀ 0.508  d 0.150").show(ui, |ui| ui.label("controls"));
/// # }
/// ```
pub struct Fold<'a> {
    name: &'a str,
    summary: &'a str,
    open: bool,
}

impl<'a> Fold<'a> {
    /// A section, folded at first; `name` identifies it, so it must be unique among siblings.
    pub fn new(name: &'a str) -> Self {
        Self { name, summary: "", open: false }
    }

    /// The contents in brief, at the right of the header; cut where there is no room.
    pub fn summary(mut self, summary: &'a str) -> Self {
        self.summary = summary;
        self
    }

    /// Whether it is open the first time it is shown.
    pub fn default_open(mut self, open: bool) -> Self {
        self.open = open;
        self
    }

    /// Draws the header, and the contents when open; returns what they returned.
    pub fn show<R>(self, ui: &mut Ui, add_contents: impl FnOnce(&mut Ui) -> R) -> Option<R> {
        let mut state = self.header(ui);
        let body = state.show_body_unindented(ui, |ui| {
            let margin = egui::Margin { left: 4, right: 2, top: 2, bottom: 8 };
            egui::Frame::NONE.inner_margin(margin).show(ui, add_contents).inner
        });
        body.map(|shown| shown.inner)
    }

    #[inline(never)]
    fn header(&self, ui: &mut Ui) -> CollapsingState {
        let tokens = theme::tokens(ui);
        let id = ui.make_persistent_id(("fold", self.name));
        let mut state = CollapsingState::load_with_default_open(ui.ctx(), id, self.open);
        let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), HEADER), Sense::hover());
        let response = ui.interact(rect, id.with("header"), Sense::click());
        let enabled = ui.is_enabled();
        let was_open = state.is_open();
        response.widget_info(|| WidgetInfo::selected(egui::Role::Button, enabled, was_open, self.name));
        if response.clicked() {
            state.toggle(ui);
        }
        let fill = if response.hovered() { tokens.hover } else { tokens.field };
        ui.painter().rect(rect, theme::radius::CONTROL, fill, tokens.edge(), egui::StrokeKind::Inside);
        icon::focus_ring(ui, rect, &response);
        let chevron = if state.is_open() { Icon::ChevronDown } else { Icon::ChevronRight };
        let place = Rect::from_center_size(pos2(rect.left() + 16.0, rect.center().y), Vec2::splat(12.0));
        icon::paint(ui.painter(), place, chevron, tokens.text_weak);
        let at = pos2(rect.left() + 30.0, rect.center().y);
        let name = ui.painter().text(
            at,
            Align2::LEFT_CENTER,
            self.name,
            fonts::regular(theme::size::BODY),
            tokens.text_strong,
        );
        let free = Rect::from_min_max(pos2(name.right() + 12.0, rect.top()), rect.max - vec2(10.0, 0.0));
        paint_summary(ui, free, self.summary);
        response.on_hover_cursor(egui::CursorIcon::PointingHand);
        state
    }
}

/// Right-aligned quiet text that ends in `…` when it does not fit.
fn paint_summary(ui: &Ui, free: Rect, summary: &str) {
    if summary.is_empty() || free.width() < 24.0 {
        return;
    }
    let colour = theme::tokens(ui).text_weak;
    let font = fonts::regular(theme::size::SMALL);
    let mut job = egui::text::LayoutJob::simple_singleline(summary.to_owned(), font, colour);
    job.wrap = egui::text::TextWrapping::truncate_at_width(free.width());
    let galley = ui.painter().layout_job(job);
    let at = pos2(free.right() - galley.size().x, free.center().y - 0.5 * galley.size().y);
    ui.painter().galley(at, galley, colour);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::widgets::harness::Harness;

    #[test]
    fn a_click_on_the_header_opens_and_closes() {
        let mut harness = Harness::new(300.0, 300.0);
        let mut shown = false;
        let mut draw = |ui: &mut Ui| {
            let summary = "c₀ 0.508  d 0.150  h 0.0042  and much more than fits";
            shown = Fold::new("Magnet").summary(summary).show(ui, |ui| ui.label("inside")).is_some();
        };
        harness.settle(&mut draw);
        let header = harness.find(egui::Role::Button, "Magnet").bounds.center();
        harness.click(header, &mut draw);
        harness.settle(&mut draw);
        assert!(harness.nodes.iter().any(|node| node.label == "inside"));
        harness.click(header, &mut draw);
        (0..30).for_each(|_| harness.frame(Vec::new(), &mut draw));
        assert!(!shown);
    }
}
