//! Choices side by side: the tabs of the top bar, and small segmented selectors.

use egui::{CornerRadius, Rect, Response, Sense, Ui, WidgetInfo, vec2};

use super::{icon, row};
use crate::app::{fonts, theme};

/// Height of a small choice, in points.
const CHIP_HEIGHT: f32 = 24.0;

/// The tabs of the top bar, the selected one in a pill. Returns whether the choice changed.
pub fn tabs<T: PartialEq + Copy>(ui: &mut Ui, selected: &mut T, choices: &[(T, &str)]) -> bool {
    let before = *selected;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(2.0, 2.0);
        for (choice, name) in choices {
            let active = *choice == *selected;
            let galley = layout(ui, name, active, theme::size::TITLE);
            let size = vec2(galley.size().x + 24.0, 32.0);
            let (rect, response) = ui.allocate_exact_size(size, Sense::click());
            describe(ui, &response, egui::Role::Tab, active, name);
            let tokens = theme::tokens(ui);
            let fill = if active {
                tokens.hover
            } else if response.hovered() {
                tokens.field
            } else {
                tokens.bar
            };
            paint(ui, rect, &response, fill, theme::radius::CONTROL, galley, active);
            if response.clicked() {
                *selected = *choice;
            }
        }
    });
    *selected != before
}

/// A segmented selector for a few short choices; `name` is for screen readers. Returns whether the choice changed.
///
/// Where there is no room in a row that wraps it begins the next one, and where a row is too narrow it breaks into
/// several.
pub fn chips<T: PartialEq + Copy>(ui: &mut Ui, name: &str, selected: &mut T, choices: &[(T, &str)]) -> bool {
    let before = *selected;
    let tokens = theme::tokens(ui);
    let width = chips_width(ui, selected, choices);
    begin_row(ui, width);
    let background = ui.painter().add(egui::Shape::Noop);
    let contents = |ui: &mut Ui| {
        ui.spacing_mut().item_spacing = vec2(2.0, 2.0);
        for (choice, label) in choices {
            let active = *choice == *selected;
            let galley = layout(ui, label, active, theme::size::SMALL + 0.5);
            let (rect, response) =
                ui.allocate_exact_size(vec2(galley.size().x + 18.0, CHIP_HEIGHT), Sense::click());
            describe(ui, &response, egui::Role::RadioButton, active, &format!("{name}: {label}"));
            let fill = if active {
                tokens.accent
            } else if response.hovered() {
                tokens.hover
            } else {
                tokens.field
            };
            paint(ui, rect.shrink(1.0), &response, fill, theme::radius::CONTROL - 1, galley, active);
            if response.clicked() {
                *selected = *choice;
            }
        }
    };
    // A row that can be pushed aside is not broken.
    let row = if row::is_low(ui.ctx()) { ui.horizontal(contents) } else { ui.horizontal_wrapped(contents) };
    let used = row.response.rect;
    let corners = theme::radius::CONTROL;
    let inside = egui::StrokeKind::Inside;
    let shape = egui::epaint::RectShape::new(used, corners, tokens.field, tokens.edge(), inside);
    ui.painter().set(background, shape);
    *selected != before
}

/// The same after a small text, which stands in the row where the choices begin.
pub fn chips_after<T: PartialEq + Copy>(
    ui: &mut Ui,
    text: &str,
    name: &str,
    selected: &mut T,
    choices: &[(T, &str)],
) -> bool {
    let galley = layout(ui, text, false, theme::size::SMALL);
    let width = galley.size().x + ui.spacing().item_spacing.x + chips_width(ui, selected, choices);
    begin_row(ui, width);
    // As high as the choices: in a row it begins, a lower text would stand above their middle.
    let (rect, response) = ui.allocate_exact_size(vec2(galley.size().x, CHIP_HEIGHT), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Label, true, text));
    let corner = egui::pos2(rect.left(), rect.center().y - galley.size().y / 2.0);
    ui.painter().galley(corner, galley, theme::tokens(ui).text_weak);
    chips(ui, name, selected, choices)
}

fn chips_width<T: PartialEq>(ui: &Ui, selected: &T, choices: &[(T, &str)]) -> f32 {
    let galleys =
        choices.iter().map(|(choice, label)| layout(ui, label, choice == selected, theme::size::SMALL + 0.5));
    galleys.map(|galley| galley.size().x + 20.0).sum()
}

/// Ends a begun row that wraps where `width` has no room in it.
fn begin_row(ui: &mut Ui, width: f32) {
    let begun = ui.cursor().left() > ui.max_rect().left() + 1.0;
    if begun && ui.layout().main_wrap() && width > ui.available_size_before_wrap().x {
        ui.end_row();
    }
}

fn layout(ui: &Ui, text: &str, active: bool, size: f32) -> std::sync::Arc<egui::Galley> {
    let font = if active { fonts::semibold(size) } else { fonts::regular(size) };
    ui.painter().layout_no_wrap(text.to_owned(), font, egui::Color32::PLACEHOLDER)
}

fn describe(ui: &Ui, response: &Response, role: egui::Role, active: bool, name: &str) {
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::selected(role, enabled, active, name));
}

fn paint(
    ui: &Ui,
    rect: Rect,
    response: &Response,
    fill: egui::Color32,
    corner: u8,
    text: std::sync::Arc<egui::Galley>,
    active: bool,
) {
    let tokens = theme::tokens(ui);
    let edge = if active { tokens.edge() } else { egui::Stroke::NONE };
    ui.painter().rect(rect, CornerRadius::same(corner), fill, edge, egui::StrokeKind::Inside);
    icon::focus_ring(ui, rect, response);
    let colour = match (active, fill == tokens.accent) {
        (true, true) => tokens.on_accent,
        (true, false) => tokens.text_strong,
        _ if response.hovered() => tokens.text_strong,
        _ => tokens.text_weak,
    };
    ui.painter().galley_with_override_text_color(rect.center() - 0.5 * text.size(), text, colour);
    response.clone().on_hover_cursor(egui::CursorIcon::PointingHand);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::widgets::harness::Harness;

    #[test]
    fn clicking_selects() {
        let mut harness = Harness::new(600.0, 200.0);
        let (mut tab, mut law) = (0, 'q');
        let mut draw = |ui: &mut Ui| {
            tabs(ui, &mut tab, &[(0, "Explore"), (1, "Stability"), (2, "Sweep")]);
            chips(ui, "Force law", &mut law, &[('q', "quadratic"), ('e', "exact")]);
        };
        harness.settle(&mut draw);
        let stability = harness.find(egui::Role::Tab, "Stability").bounds.center();
        let exact = harness.find(egui::Role::RadioButton, "Force law: exact").bounds.center();
        harness.click(stability, &mut draw);
        harness.click(exact, &mut draw);
        assert_eq!((tab, law), (1, 'e'));
    }

    #[test]
    fn a_text_before_choices_goes_to_the_next_row_with_them() {
        for (width, together) in [(500.0, true), (300.0, true), (120.0, false)] {
            let mut harness = Harness::new(width, 300.0);
            let mut kick = 1;
            harness.settle(|ui| {
                ui.horizontal_wrapped(|ui| {
                    ui.add_space(0.6 * ui.available_width());
                    let choices = [(1, "20 %"), (2, "50 %"), (3, "100 %")];
                    chips_after(ui, "kick", "Strength", &mut kick, &choices);
                });
            });
            let text = harness.find(egui::Role::Label, "kick").bounds;
            let first = harness.find(egui::Role::RadioButton, "Strength: 20 %").bounds;
            let beside = first.left() > text.right() && first.y_range().contains(text.center().y);
            assert_eq!(beside, together, "{width}: {text:?}, {first:?}");
            assert!(first.right() <= width && text.right() <= width, "{width}: {text:?}, {first:?}");
        }
    }
}
