//! The tokens turned into an egui style.

use egui::style::{HandleShape, Selection, Style, TextCursorStyle, WidgetVisuals, Widgets};
use egui::{Color32, CornerRadius, FontFamily, FontId, Margin, Shadow, Stroke, TextStyle, Vec2, Visuals};

use super::palette::Tokens;
use super::{radius, size};
use crate::app::fonts;

pub(super) fn style(tokens: &Tokens) -> Style {
    let mut style = Style { visuals: visuals(tokens), animation_time: 0.12, ..Style::default() };
    style.text_styles = [
        (TextStyle::Small, fonts::regular(size::SMALL)),
        (TextStyle::Body, fonts::regular(size::BODY)),
        (TextStyle::Button, fonts::regular(size::BODY)),
        (TextStyle::Heading, fonts::semibold(size::HEADING)),
        (TextStyle::Monospace, FontId::new(size::BODY, FontFamily::Monospace)),
    ]
    .into();
    let spacing = &mut style.spacing;
    spacing.item_spacing = Vec2::new(8.0, 6.0);
    spacing.button_padding = Vec2::new(10.0, 5.0);
    spacing.interact_size = Vec2::new(36.0, 26.0);
    spacing.window_margin = Margin::same(16);
    spacing.menu_margin = Margin::same(8);
    spacing.icon_width = 16.0;
    spacing.icon_width_inner = 9.0;
    spacing.tooltip_width = 320.0;
    spacing.scroll.bar_width = 7.0;
    spacing.scroll.floating_width = 5.0;
    spacing.scroll.foreground_color = false;
    style.interaction.tooltip_delay = 0.35;
    // Labels are not texts to copy from; selecting them would swallow drags on a touch screen.
    style.interaction.selectable_labels = false;
    style
}

fn visuals(tokens: &Tokens) -> Visuals {
    let base = if tokens.dark { Visuals::dark() } else { Visuals::light() };
    let shadow = Shadow {
        offset: [0, 6],
        blur: 24,
        spread: 0,
        color: Color32::from_black_alpha(if tokens.dark { 120 } else { 40 }),
    };
    Visuals {
        weak_text_color: Some(tokens.text_weak),
        widgets: widgets(tokens),
        selection: Selection {
            bg_fill: tokens.accent.gamma_multiply(if tokens.dark { 0.45 } else { 0.28 }),
            stroke: Stroke::new(1.0, tokens.text_strong),
        },
        hyperlink_color: tokens.accent,
        faint_bg_color: tokens.inset,
        extreme_bg_color: tokens.field,
        text_edit_bg_color: Some(tokens.field),
        code_bg_color: tokens.inset,
        warn_fg_color: tokens.warning,
        error_fg_color: tokens.danger,
        window_corner_radius: CornerRadius::same(radius::CARD + 2),
        window_shadow: shadow,
        window_fill: tokens.card,
        window_stroke: Stroke::new(1.0, tokens.outline),
        menu_corner_radius: CornerRadius::same(radius::CARD),
        panel_fill: tokens.page,
        popup_shadow: shadow,
        text_cursor: TextCursorStyle {
            stroke: Stroke::new(1.5, tokens.accent),
            ..TextCursorStyle::default()
        },
        indent_has_left_vline: false,
        slider_trailing_fill: true,
        handle_shape: HandleShape::Circle,
        disabled_alpha: 0.45,
        ..base
    }
}

fn widgets(tokens: &Tokens) -> Widgets {
    let look = |fill: Color32, text: Color32, outline: Color32| WidgetVisuals {
        // That of boxes to tick; buttons have the other one.
        bg_fill: tokens.track,
        weak_bg_fill: fill,
        bg_stroke: Stroke::new(1.0, outline),
        corner_radius: CornerRadius::same(radius::CONTROL),
        fg_stroke: Stroke::new(1.0, text),
        expansion: 0.0,
    };
    Widgets {
        noninteractive: look(tokens.card, tokens.text, tokens.outline),
        inactive: look(tokens.field, tokens.text, tokens.edge().color),
        hovered: look(tokens.hover, tokens.text_strong, tokens.edge().color),
        active: look(tokens.hover, tokens.text_strong, tokens.accent),
        open: look(tokens.hover, tokens.text_strong, tokens.edge().color),
    }
}
