//! Things laid over a plot after it is shown: the point to drag, and a message in place of data.

use egui::{Align2, EventFilter, Id, Key, Pos2, Rect, Response, Sense, Stroke, Ui, Vec2, WidgetInfo, vec2};
use egui_plot::{PlotPoint, PlotResponse};

use super::super::{recorder, touch};
use crate::app::{fonts, theme};
use crate::export::Layer;

/// Radius of the marker and of the area that grabs it, points.
const RADIUS: f32 = 8.0;
const GRAB: f32 = 18.0;

/// What the user did with the operating point.
#[derive(Debug, Clone)]
pub struct PointDrag {
    /// Where it should be now, plot coordinates, when it was moved in this frame.
    pub moved: Option<[f64; 2]>,
    /// The user is done for now.
    pub released: bool,
    /// The marker itself, for focus and geometry.
    pub response: Response,
}

/// Draws ⊕ at `position` over a plot that was just shown, and lets it be dragged or moved with the arrow keys
/// (Shift for small steps). A click anywhere in the plot brings it there. `name` is for screen readers.
pub fn operating_point<R>(ui: &Ui, plot: &PlotResponse<R>, name: &str, position: [f64; 2]) -> PointDrag {
    recorder::over(ui.ctx(), &mut || Layer::Here { name: name.to_owned(), place: position });
    let transform = &plot.transform;
    let frame = *transform.frame();
    let centre = transform.position_from_point(&PlotPoint::new(position[0], position[1]));
    // A point outside of the view waits at its edge, so that it can be fetched back.
    let room = frame.shrink(RADIUS);
    // A plot may be smaller than the marker, for a moment or in a small frame.
    let shown = if room.is_negative() { frame.center() } else { room.clamp(centre) };
    let id = plot.response.id.with("operating point");
    let area = Rect::from_center_size(shown, Vec2::splat(2.0 * GRAB));
    touch::grip(ui, area);
    let response = ui.interact(area, id, Sense::drag());
    let response = response.on_hover_and_drag_cursor(egui::CursorIcon::Grab);
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, enabled, name));
    let dragged = response.dragged().then(|| response.interact_pointer_pos()).flatten();
    let fetched = plot.response.clicked().then(|| plot.response.interact_pointer_pos()).flatten();
    if response.drag_started() || fetched.is_some() {
        response.request_focus();
    }
    let stepped = keyboard(ui, &response, frame).map(|step| shown + step);
    let target = dragged.or(fetched).or(stepped).filter(|_| !frame.is_negative()).map(|at| frame.clamp(at));
    let moved = target.map(|at| transform.value_from_position(at)).map(|point| [point.x, point.y]);
    let hot = response.hovered() || response.dragged() || response.has_focus();
    paint(ui, frame, target.unwrap_or(shown), hot);
    let released = response.drag_stopped() || fetched.is_some() || stepped.is_some();
    PointDrag { moved, released, response }
}

/// The step the arrow keys ask for, on the screen.
fn keyboard(ui: &Ui, response: &Response, frame: Rect) -> Option<Vec2> {
    if !response.has_focus() {
        return None;
    }
    let filter = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    let id: Id = response.id;
    ui.memory_mut(|memory| memory.set_focus_lock_filter(id, filter));
    let step = ui.input(|input| {
        let net = |forth, back| input.num_presses(forth) as f32 - input.num_presses(back) as f32;
        let share = if input.modifiers.shift { 0.001 } else { 0.01 };
        let (x, y) = (net(Key::ArrowRight, Key::ArrowLeft), net(Key::ArrowDown, Key::ArrowUp));
        vec2(x * frame.width(), y * frame.height()) * share
    });
    (step != Vec2::ZERO).then_some(step)
}

fn paint(ui: &Ui, frame: Rect, centre: Pos2, hot: bool) {
    let tokens = theme::tokens(ui);
    let painter = ui.painter().with_clip_rect(frame.intersect(ui.clip_rect()));
    if hot {
        let ruler = Stroke::new(1.0, tokens.ruler);
        painter.hline(frame.x_range(), centre.y, ruler);
        painter.vline(centre.x, frame.y_range(), ruler);
        painter.circle_filled(centre, RADIUS + 6.0, tokens.accent.gamma_multiply(0.3));
    }
    // A rim in the card's colour keeps the sign legible on any curve.
    painter.circle(centre, RADIUS + 1.5, tokens.card, Stroke::new(1.0, tokens.card));
    let stroke = Stroke::new(2.0, if hot { tokens.accent } else { tokens.text_strong });
    painter.circle_stroke(centre, RADIUS, stroke);
    let arm = RADIUS - 2.5;
    painter.line_segment([centre - vec2(arm, 0.0), centre + vec2(arm, 0.0)], stroke);
    painter.line_segment([centre - vec2(0.0, arm), centre + vec2(0.0, arm)], stroke);
}

/// A message in the middle of `rect`, where a plot has nothing to show.
pub fn no_data(ui: &Ui, rect: Rect, message: &str) {
    let tokens = theme::tokens(ui);
    let font = fonts::regular(theme::size::BODY);
    let galley = ui.painter().layout(message.to_owned(), font, tokens.text_weak, 0.8 * rect.width());
    let area = Align2::CENTER_CENTER.align_size_within_rect(galley.size(), rect);
    ui.painter().rect_filled(area.expand2(vec2(14.0, 9.0)), theme::radius::CONTROL, tokens.inset);
    ui.painter().galley(area.min, galley, tokens.text_weak);
}

#[cfg(test)]
mod tests {
    use super::super::{Axis, plot};
    use super::*;
    use crate::app::widgets::harness::Harness;
    use egui::Modifiers;

    #[test]
    fn the_point_is_dragged_fetched_and_stepped() {
        let mut harness = Harness::new(400.0, 300.0);
        let mut position = [5.0, 5.0];
        let (x, y) = (Axis::new("", "ω"), Axis::new("", "β"));
        let mut released = 0;
        let mut draw = |ui: &mut Ui| {
            let shown = plot(ui, "map", &x, &y).allow_drag(false).show(ui, |plot| {
                plot.set_plot_bounds(egui_plot::PlotBounds::from_min_max([0.0; 2], [10.0; 2]))
            });
            let drag = operating_point(ui, &shown, "Operating point", position);
            position = drag.moved.unwrap_or(position);
            released += usize::from(drag.released);
        };
        harness.settle(&mut draw);
        let at = harness.find(egui::Role::Button, "Operating point").bounds.center();
        harness.drag(at, at + vec2(60.0, -40.0), &mut draw);
        harness.click(at, &mut draw);
        harness.settle(&mut draw);
        let marker = harness.find(egui::Role::Button, "Operating point").bounds.center();
        assert!((marker - at).length() < 1.0, "fetched by a click");
        harness.key(Key::ArrowRight, Modifiers::NONE, &mut draw);
        assert!((position[0] - 5.1).abs() < 0.02 && (position[1] - 5.0).abs() < 0.02, "{position:?}");
        assert_eq!(released, 3);
    }
}
