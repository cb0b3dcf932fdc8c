//! Icons drawn with strokes, so that they follow the theme and need no font.

use std::f32::consts::{PI, TAU};

use egui::{
    Color32, CornerRadius, Painter, Pos2, Rect, Response, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, vec2,
};

use crate::app::theme;

/// What an icon button shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Icon {
    /// Four corners outwards: make this card large.
    Enlarge,
    /// Four corners inwards: back to the grid.
    Shrink,
    /// An open circle with an arrow head: back to the default.
    Reset,
    /// A pin: keep these curves as ghosts.
    Pin,
    /// A cross: close or remove.
    Close,
    /// A question mark.
    Help,
    /// A triangle: run.
    Play,
    /// Two bars: hold.
    Pause,
    /// A downward arrow into a tray: export.
    Download,
    /// A sun: go to the light theme.
    Sun,
    /// A crescent: go to the dark theme.
    Moon,
    /// An arrow bending left.
    Undo,
    /// An arrow bending right.
    Redo,
    /// Three dots joined: share.
    Share,
    /// Two sheets: copy.
    Copy,
    /// A letter, small and large: size of type.
    Type,
    /// A disc in a ring: record.
    Record,
    /// A padlock: hold the axes.
    Lock,
    /// A globe: choose a language.
    Globe,
    /// Three lines: menu.
    Menu,
    /// A head pointing right: folded.
    ChevronRight,
    /// A head pointing down: unfolded.
    ChevronDown,
}

/// Draws `icon` centred in `rect` in `colour`; it fills a square of the rectangle's smaller side.
pub fn paint(painter: &Painter, rect: Rect, icon: Icon, colour: Color32) {
    let side = rect.width().min(rect.height());
    let at = |x: f32, y: f32| rect.center() + vec2(x, y) * side * 0.5;
    let stroke = Stroke::new((side * 0.1).max(1.3), colour);
    let line = |points: &[(f32, f32)]| {
        painter.add(Shape::line(points.iter().map(|&(x, y)| at(x, y)).collect(), stroke));
    };
    let solid = |points: &[(f32, f32)]| {
        let corners = points.iter().map(|&(x, y)| at(x, y)).collect();
        painter.add(Shape::convex_polygon(corners, colour, Stroke::NONE));
    };
    let arc = |radius: f32, from: f32, to: f32| {
        let points = (0..=20).map(|i| {
            let angle = from + (to - from) * i as f32 / 20.0;
            at(radius * angle.cos(), radius * angle.sin())
        });
        painter.add(Shape::line(points.collect(), stroke));
    };
    match icon {
        Icon::Enlarge | Icon::Shrink => {
            let (corner, arm) = if icon == Icon::Enlarge { (0.75, 0.2) } else { (0.25, 0.8) };
            for (sx, sy) in [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
                line(&[(sx * arm, sy * corner), (sx * corner, sy * corner), (sx * corner, sy * arm)]);
            }
        }
        Icon::Reset => {
            arc(0.68, -0.6 * PI, 1.1 * PI);
            solid(&[(-0.52, -0.98), (-0.5, -0.28), (0.08, -0.66)]);
        }
        Icon::Pin => {
            line(&[(-0.35, -0.85), (0.35, -0.85)]);
            line(&[(-0.22, -0.85), (-0.28, -0.1), (-0.55, 0.2), (0.55, 0.2), (0.28, -0.1), (0.22, -0.85)]);
            line(&[(0.0, 0.2), (0.0, 0.9)]);
        }
        Icon::Close => {
            line(&[(-0.55, -0.55), (0.55, 0.55)]);
            line(&[(0.55, -0.55), (-0.55, 0.55)]);
        }
        Icon::Help => {
            let hook = (0..=14).map(|i| {
                let angle = PI + 1.45 * PI * i as f32 / 14.0;
                at(0.42 * angle.cos(), -0.4 + 0.42 * angle.sin())
            });
            painter.add(Shape::line(hook.chain([at(0.0, 0.4)]).collect(), stroke));
            painter.circle_filled(at(0.0, 0.8), stroke.width * 0.7, colour);
        }
        Icon::Play => solid(&[(-0.5, -0.75), (0.75, 0.0), (-0.5, 0.75)]),
        Icon::Pause => {
            solid(&[(-0.55, -0.7), (-0.2, -0.7), (-0.2, 0.7), (-0.55, 0.7)]);
            solid(&[(0.2, -0.7), (0.55, -0.7), (0.55, 0.7), (0.2, 0.7)]);
        }
        Icon::Download => {
            line(&[(0.0, -0.8), (0.0, 0.3)]);
            line(&[(-0.4, -0.1), (0.0, 0.32), (0.4, -0.1)]);
            line(&[(-0.75, 0.4), (-0.75, 0.8), (0.75, 0.8), (0.75, 0.4)]);
        }
        Icon::Sun => {
            painter.circle_stroke(rect.center(), side * 0.2, stroke);
            for i in 0..8 {
                let (sin, cos) = (TAU * i as f32 / 8.0).sin_cos();
                line(&[(0.66 * cos, 0.66 * sin), (0.92 * cos, 0.92 * sin)]);
            }
        }
        Icon::Moon => {
            let outer = (0..=20).map(|i| (0.22 * PI + 1.5 * PI * i as f32 / 20.0).sin_cos());
            let inner = (0..=20).map(|i| (1.47 * PI - 0.98 * PI * i as f32 / 20.0).sin_cos());
            let rim = outer.map(|(sin, cos)| at(0.8 * cos, 0.8 * sin));
            let bite = inner.map(|(sin, cos)| at(0.36 + 0.62 * cos, -0.28 + 0.62 * sin));
            painter.add(Shape::closed_line(rim.chain(bite).collect(), stroke));
        }
        Icon::Undo | Icon::Redo => {
            let side = if icon == Icon::Undo { 1.0 } else { -1.0 };
            line(&[(-0.3 * side, -0.75), (-0.75 * side, -0.3), (-0.3 * side, 0.15)]);
            let bend = (0..=12).map(|i| {
                let angle = -0.5 * PI + PI * i as f32 / 12.0;
                at(side * (0.25 + 0.5 * angle.cos()), 0.2 + 0.5 * angle.sin())
            });
            let path = [at(-0.75 * side, -0.3)].into_iter().chain(bend).chain([at(-0.3 * side, 0.7)]);
            painter.add(Shape::line(path.collect(), stroke));
        }
        Icon::Share => {
            line(&[(0.6, -0.62), (-0.6, 0.0), (0.6, 0.62)]);
            for (x, y) in [(0.6, -0.62), (-0.6, 0.0), (0.6, 0.62)] {
                painter.circle_filled(at(x, y), side * 0.14, colour);
            }
        }
        Icon::Copy => {
            let sheet = |x: f32, y: f32| Rect::from_min_max(at(x, y), at(x + 1.05, y + 1.2));
            painter.rect_stroke(sheet(-0.25, -0.4), CornerRadius::same(2), stroke, egui::StrokeKind::Middle);
            line(&[(-0.5, 0.35), (-0.8, 0.35), (-0.8, -0.85), (0.3, -0.85), (0.3, -0.65)]);
        }
        Icon::Type => {
            line(&[(-0.95, 0.75), (-0.55, -0.2), (-0.15, 0.75)]);
            line(&[(-0.8, 0.4), (-0.3, 0.4)]);
            line(&[(-0.1, 0.75), (0.45, -0.85), (1.0, 0.75)]);
            line(&[(0.12, 0.2), (0.78, 0.2)]);
        }
        Icon::Record => {
            painter.circle_stroke(rect.center(), side * 0.45, stroke);
            painter.circle_filled(rect.center(), side * 0.25, colour);
        }
        Icon::Lock => {
            solid(&[(-0.6, -0.1), (0.6, -0.1), (0.6, 0.85), (-0.6, 0.85)]);
            let bow = (0..=12).map(|i| {
                let angle = PI + PI * i as f32 / 12.0;
                at(0.38 * angle.cos(), -0.35 + 0.45 * angle.sin())
            });
            painter.add(Shape::line(
                [at(-0.38, -0.1)].into_iter().chain(bow).chain([at(0.38, -0.1)]).collect(),
                stroke,
            ));
        }
        Icon::Globe => {
            let ring = |width: f32| {
                let points = (0..24).map(|i| {
                    let angle = TAU * i as f32 / 24.0;
                    at(0.9 * width * angle.cos(), 0.9 * angle.sin())
                });
                painter.add(Shape::closed_line(points.collect(), stroke));
            };
            ring(1.0);
            ring(0.42);
            line(&[(-0.9, 0.0), (0.9, 0.0)]);
        }
        Icon::Menu => [-0.55, 0.0, 0.55].into_iter().for_each(|y| line(&[(-0.75, y), (0.75, y)])),
        Icon::ChevronRight => line(&[(-0.25, -0.5), (0.25, 0.0), (-0.25, 0.5)]),
        Icon::ChevronDown => line(&[(-0.5, -0.25), (0.0, 0.25), (0.5, -0.25)]),
    }
}

/// Side of an icon button, points: large enough for a finger together with the space around it.
pub const BUTTON_SIDE: f32 = 26.0;

/// A square button with `icon`. `label` is its tooltip and its name for screen readers.
pub fn icon_button(ui: &mut Ui, icon: Icon, label: &str) -> Response {
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(BUTTON_SIDE), Sense::click());
    paint_button(ui, rect, &response, icon, label);
    response.on_hover_text(label)
}

/// The look and the accessible name of an icon button that was already placed.
pub(super) fn paint_button(ui: &Ui, rect: Rect, response: &Response, icon: Icon, label: &str) {
    let tokens = theme::tokens(ui);
    let lit = response.hovered() || response.has_focus();
    if lit {
        ui.painter().rect_filled(rect, CornerRadius::same(theme::radius::CONTROL), tokens.hover);
    }
    focus_ring(ui, rect, response);
    let colour = if lit { tokens.text_strong } else { tokens.text_weak };
    paint(ui.painter(), Rect::from_center_size(rect.center(), Vec2::splat(13.0)), icon, colour);
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, ui.is_enabled(), label));
}

/// The outline of whatever has the keyboard.
pub(super) fn focus_ring(ui: &Ui, rect: Rect, response: &Response) {
    if response.has_focus() {
        let stroke = Stroke::new(1.5, theme::tokens(ui).accent);
        let corners = CornerRadius::same(theme::radius::CONTROL);
        ui.painter().rect_stroke(rect, corners, stroke, egui::StrokeKind::Inside);
    }
}

/// An arc that turns with time, centred at `centre`: work in progress. Asks for further frames.
pub(super) fn spinner(ui: &Ui, centre: Pos2, radius: f32, colour: Color32) {
    let start = (ui.input(|input| input.time) * 4.0).rem_euclid(f64::from(TAU)) as f32;
    let points = (0..=16).map(|i| {
        let angle = start + 1.4 * PI * i as f32 / 16.0;
        centre + radius * vec2(angle.cos(), angle.sin())
    });
    ui.painter().add(Shape::line(points.collect(), Stroke::new(1.6, colour)));
    ui.ctx().request_repaint_after_secs(0.03);
}
