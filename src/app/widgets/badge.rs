//! Pills that say how far a computation is.

use egui::{Response, Sense, Ui, WidgetInfo, pos2, vec2};

use super::icon;
use crate::app::{fonts, theme};

/// What a badge announces; each has a colour and a sign of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BadgeKind {
    /// Work goes on; a turning arc.
    Computing,
    /// The result is final.
    Converged,
    /// Worth the user's attention.
    Warning,
    /// The computation failed.
    Error,
    /// Plain information.
    Neutral,
}

/// Shows a pill with a sign and `text`.
pub fn badge(ui: &mut Ui, kind: BadgeKind, text: &str) -> Response {
    pill(ui, kind, text, text)
}

/// Shows the sign alone; `text` is its tooltip and its name for screen readers.
pub fn sign(ui: &mut Ui, kind: BadgeKind, text: &str) -> Response {
    pill(ui, kind, "", text).on_hover_text(text)
}

fn pill(ui: &mut Ui, kind: BadgeKind, shown: &str, text: &str) -> Response {
    let tokens = theme::tokens(ui);
    let colour = match kind {
        BadgeKind::Computing => tokens.accent,
        BadgeKind::Converged => tokens.ok,
        BadgeKind::Warning => tokens.warning,
        BadgeKind::Error => tokens.danger,
        BadgeKind::Neutral => tokens.text_weak,
    };
    let galley = ui.painter().layout_no_wrap(shown.to_owned(), fonts::regular(theme::size::SMALL), colour);
    let width = if shown.is_empty() { 24.0 } else { galley.size().x + 30.0 };
    let (rect, response) = ui.allocate_exact_size(vec2(width, 21.0), Sense::hover());
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Status, enabled, text));
    let edge = egui::Stroke::new(1.0, if tokens.contrast { colour } else { egui::Color32::TRANSPARENT });
    ui.painter().rect(rect, 10, tokens.tint(colour), edge, egui::StrokeKind::Inside);
    let sign = pos2(rect.left() + 12.0, rect.center().y);
    let stroke = egui::Stroke::new(1.6, colour);
    match kind {
        BadgeKind::Computing => icon::spinner(ui, sign, 4.0, colour),
        BadgeKind::Converged => {
            let tick = vec![sign + vec2(-3.6, 0.2), sign + vec2(-1.0, 2.8), sign + vec2(3.8, -2.8)];
            ui.painter().add(egui::Shape::line(tick, stroke));
        }
        BadgeKind::Warning | BadgeKind::Error => {
            ui.painter().line_segment([sign - vec2(0.0, 4.2), sign + vec2(0.0, 1.0)], stroke);
            ui.painter().circle_filled(sign + vec2(0.0, 3.6), 1.1, colour);
        }
        BadgeKind::Neutral => {
            ui.painter().circle_filled(sign, 2.6, colour);
        }
    }
    ui.painter().galley(pos2(rect.left() + 21.0, rect.center().y - 0.5 * galley.size().y), galley, colour);
    response
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::widgets::harness::Harness;

    #[test]
    fn every_kind_announces_its_text() {
        let mut harness = Harness::new(400.0, 200.0);
        let kinds = [
            BadgeKind::Computing,
            BadgeKind::Converged,
            BadgeKind::Warning,
            BadgeKind::Error,
            BadgeKind::Neutral,
        ];
        harness.settle(|ui| {
            for kind in kinds {
                badge(ui, kind, &format!("{kind:?}"));
            }
        });
        for kind in kinds {
            harness.find(egui::Role::Status, &format!("{kind:?}"));
        }
    }
}
