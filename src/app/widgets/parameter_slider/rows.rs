//! Where the parts of a slider go.

use egui::{Rect, Sense, Ui, pos2, vec2};

use super::mapping::Mapping;
use super::marks::{self, Mark};
use super::track;
use crate::app::{fonts, theme};

/// Height of the row with the name, of the track's grab area, and widths of the value field, points.
const NAME_ROW: f32 = 26.0;
const TRACK_ROW: f32 = 24.0;
const FIELD: f32 = 84.0;
const COMPACT_FIELD: f32 = 78.0;
/// Part of a compact row that the field takes at least where there is a unit, and the distance of the track from the symbol,
/// which a handle at its beginning must not touch, points.
const ALIGNED: f32 = 0.3;
const APART: f32 = 9.0;

/// Where the parts of the control go.
pub(super) struct Rows {
    pub(super) all: Rect,
    pub(super) name: Rect,
    /// Right edge of the symbol.
    pub(super) symbol: f32,
    pub(super) reset: Rect,
    pub(super) field: Rect,
    pub(super) track: Rect,
    pub(super) secondary: Option<egui::Pos2>,
}

/// What of a slider needs room.
pub(super) struct Needs<'a> {
    pub(super) unit: &'a str,
    pub(super) marks: &'a [Mark],
    /// Whether there is a line under the track.
    pub(super) secondary: bool,
    /// Whether all of it stands in one row.
    pub(super) compact: bool,
}

impl Rows {
    /// Takes the room the control needs and divides it.
    pub(super) fn arrange(ui: &mut Ui, needs: &Needs<'_>, mapping: &Mapping, width: f32) -> Self {
        let font = fonts::regular(theme::size::BODY);
        let unit = ui.painter().layout_no_wrap(needs.unit.to_owned(), font, egui::Color32::PLACEHOLDER);
        let field = match (needs.compact, needs.unit.is_empty()) {
            (true, true) => COMPACT_FIELD,
            (true, false) => COMPACT_FIELD - 4.0 + unit.size().x,
            (false, true) => FIELD,
            (false, false) => FIELD + 8.0 + unit.size().x,
        };
        let width = width.max(170.0);
        if needs.compact {
            // Tracks under each other end alike, whatever their units are.
            let field = if needs.unit.is_empty() { field } else { field.max(ALIGNED * width) };
            let (all, _) = ui.allocate_exact_size(vec2(width, NAME_ROW), Sense::hover());
            let split = all.left() + 0.38 * width;
            let field = Rect::from_min_max(pos2(all.right() - field, all.top()), all.max);
            let reset = Rect::from_center_size(pos2(field.left() - 10.0, all.center().y), vec2(18.0, 22.0));
            let track =
                Rect::from_min_max(pos2(split + APART, all.top()), pos2(reset.left() - 1.0, all.bottom()));
            let name = Rect::from_min_max(all.min, pos2(split, all.bottom()));
            return Self { all, name, symbol: split, reset, field, track, secondary: None };
        }
        let top_left = ui.cursor().min;
        let row = Rect::from_min_size(top_left, vec2(width, NAME_ROW));
        let track = Rect::from_min_size(row.left_bottom() + vec2(0.0, 1.0), vec2(width, TRACK_ROW));
        let rail = track::rail(track);
        let marks = marks::height(ui.painter(), mapping, needs.marks, rail, row);
        let below = if needs.marks.is_empty() { track.bottom() } else { rail.bottom() + marks + 3.0 };
        let secondary = if needs.secondary { 16.0 } else { 0.0 };
        let height = below + secondary - top_left.y;
        let (all, _) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
        let field = Rect::from_min_max(pos2(row.right() - field, row.top()), row.max);
        let reset = Rect::from_center_size(pos2(field.left() - 16.0, row.center().y), vec2(24.0, 24.0));
        let name = Rect::from_min_max(row.min, pos2(reset.left() - 4.0, row.bottom()));
        Self {
            all,
            name,
            symbol: reset.left() - 4.0,
            reset,
            field,
            track,
            secondary: Some(pos2(row.left(), below)),
        }
    }
}
