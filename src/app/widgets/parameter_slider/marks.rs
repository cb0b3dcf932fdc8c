//! Labelled places under a track.

use std::sync::Arc;

use egui::{Galley, Painter, Pos2, Rect, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

use super::super::number;
use super::mapping::Mapping;
use crate::app::text::fill;
use crate::app::{fonts, theme};

/// A value worth snapping to. Earlier marks of a list win when labels compete for room.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// The exact value, in the slider's unit.
    pub value: f64,
    /// A short label such as `2ω₁`.
    pub label: String,
    /// What the value is, for the tooltip.
    pub meaning: String,
}

impl Mark {
    /// A mark at `value`.
    pub fn new(value: f64, label: impl Into<String>, meaning: impl Into<String>) -> Self {
        Self { value, label: label.into(), meaning: meaning.into() }
    }
}

/// Height of a tick and of one row of labels, points.
const TICK: f32 = 6.0;
const ROW: f32 = 14.0;
const ROWS: usize = 2;

/// A mark's place: where the tick stands, and which row holds the label, if there is room for one.
struct Place {
    index: usize,
    x: f32,
    galley: Arc<Galley>,
    label: Option<Rect>,
}

/// Puts labels in the first of two rows where they touch no other; those that fit in neither are dropped.
fn arrange(
    painter: &Painter,
    mapping: &Mapping,
    marks: &[Mark],
    track: Rect,
    outer: Rect,
    colour: egui::Color32,
) -> Vec<Place> {
    let mut places: Vec<Place> = Vec::new();
    for (index, mark) in marks.iter().enumerate().filter(|(_, mark)| mapping.range().contains(&mark.value)) {
        let galley = painter.layout_no_wrap(mark.label.clone(), fonts::regular(theme::size::SMALL), colour);
        let x = track.left() + track.width() * mapping.fraction(mark.value) as f32;
        let width = galley.size().x;
        let left = (x - 0.5 * width).clamp(outer.left(), (outer.right() - width).max(outer.left()));
        let label = (0..ROWS).find_map(|row| {
            let top = track.bottom() + TICK + ROW * row as f32;
            let rect = Rect::from_min_size(pos2(left, top), vec2(width, ROW));
            let free = places.iter().all(|other| match other.label {
                Some(taken) => {
                    // A leader to the second row must not run through a label of the first.
                    let crossed = row == 1 && taken.top() < top && taken.expand(3.0).x_range().contains(x);
                    let crosses =
                        row == 0 && taken.top() > top && rect.expand(3.0).x_range().contains(other.x);
                    !taken.expand2(vec2(5.0, -1.0)).intersects(rect) && !crossed && !crosses
                }
                None => true,
            });
            free.then_some(rect)
        });
        places.push(Place { index, x, galley, label });
    }
    places
}

/// Draws the marks under `track` within the width of `outer`; returns the one that was clicked.
pub(super) fn show(
    ui: &Ui,
    id: egui::Id,
    name: &str,
    mapping: &Mapping,
    marks: &[Mark],
    track: Rect,
    outer: Rect,
) -> Option<f64> {
    let tokens = theme::tokens(ui);
    let mut clicked = None;
    for place in arrange(ui.painter(), mapping, marks, track, outer, tokens.warning) {
        let mark = &marks[place.index];
        let tick = Rect::from_center_size(pos2(place.x, track.bottom() + 0.5 * TICK), vec2(8.0, TICK));
        let target = place.label.map_or(tick, |label| tick.union(label)).expand2(vec2(3.0, 1.0));
        // Not in the Tab order: five marks would bury the sliders. Ctrl with an arrow key reaches them instead.
        let response = ui.interact(target, id.with(("mark", place.index)), Sense::CLICK);
        let enabled = ui.is_enabled();
        response.widget_info(|| {
            WidgetInfo::labeled(
                egui::Role::Button,
                enabled,
                fill("{name} at {mark}", &[("name", &name), ("mark", &mark.label)]),
            )
        });
        let colour = if response.hovered() { tokens.text_strong } else { tokens.warning };
        let foot = place.label.map_or(track.bottom() + TICK - 1.0, |label| label.top() + 1.0);
        let stroke = Stroke::new(if response.hovered() { 2.0 } else { 1.5 }, colour);
        ui.painter().line_segment([pos2(place.x, track.bottom()), pos2(place.x, foot)], stroke);
        if let Some(label) = place.label {
            let lift = 0.5 * (ROW - place.galley.size().y);
            let position: Pos2 = label.left_top() + vec2(0.0, lift);
            ui.painter().galley_with_override_text_color(position, place.galley, colour);
        }
        if response.clicked() {
            clicked = Some(mark.value);
        }
        response.on_hover_cursor(egui::CursorIcon::PointingHand).on_hover_text(format!(
            "{}: {} = {}",
            mark.meaning,
            mark.label,
            number::significant(mark.value, 6)
        ));
    }
    clicked
}

/// Height the marks need below a track of this width, points.
pub(super) fn height(painter: &Painter, mapping: &Mapping, marks: &[Mark], track: Rect, outer: Rect) -> f32 {
    if marks.is_empty() {
        return 0.0;
    }
    let places = arrange(painter, mapping, marks, track, outer, egui::Color32::PLACEHOLDER);
    // Not from zero: a track that is scrolled out of the page lies above it.
    let bottoms = places.iter().filter_map(|place| place.label).map(|label| label.bottom());
    let lowest = bottoms.fold(track.bottom(), f32::max);
    (lowest - track.bottom()).max(TICK)
}

/// The next mark to the right (`forwards`) or left of `value`.
pub(super) fn neighbour(marks: &[Mark], mapping: &Mapping, value: f64, forwards: bool) -> Option<f64> {
    let margin = 1e-9 * value.abs();
    let values = marks.iter().map(|mark| mark.value).filter(|v| mapping.range().contains(v));
    if forwards {
        values.filter(|v| *v > value + margin).min_by(f64::total_cmp)
    } else {
        values.filter(|v| *v < value - margin).max_by(f64::total_cmp)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_never_overlap_and_the_first_always_fits() {
        let mut harness = super::super::super::harness::Harness::new(400.0, 300.0);
        let mapping = Mapping::linear(0.0..=30.0);
        let marks: Vec<Mark> =
            [4.0, 8.1, 17.8, 18.2, 18.6, 18.9, 22.0].iter().map(|v| Mark::new(*v, "ω₁+ω₂", "sum")).collect();
        for width in [60.0, 120.0, 250.0, 380.0] {
            harness.settle(|ui| {
                let track = Rect::from_min_size(pos2(10.0, 10.0), vec2(width, 4.0));
                let places =
                    arrange(ui.painter(), &mapping, &marks, track, track.expand(8.0), egui::Color32::WHITE);
                assert!(places[0].label.is_some());
                let labels: Vec<Rect> = places.iter().filter_map(|place| place.label).collect();
                for (i, first) in labels.iter().enumerate() {
                    assert!(labels[i + 1..].iter().all(|second| !first.shrink(0.5).intersects(*second)));
                }
            });
        }
    }

    #[test]
    fn neighbours_are_found() {
        let mapping = Mapping::linear(0.0..=30.0);
        let marks = [Mark::new(4.0, "a", ""), Mark::new(20.0, "b", ""), Mark::new(99.0, "out", "")];
        assert_eq!(neighbour(&marks, &mapping, 4.0, true), Some(20.0));
        assert_eq!(neighbour(&marks, &mapping, 20.0, true), None);
        assert_eq!(neighbour(&marks, &mapping, 20.0, false), Some(4.0));
    }
}
