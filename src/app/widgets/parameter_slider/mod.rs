//! The control for one number: name, symbol, exact value, track with marks.

mod field;
mod mapping;
mod marks;
mod rows;
#[cfg(test)]
mod tests;
mod track;
mod typed;

use std::ops::RangeInclusive;

use egui::{Align2, Area, Frame, Order, Response, Sense, Ui, pos2, vec2};

use self::mapping::Mapping;
use self::rows::{Needs, Rows};
use super::icon::{self, Icon};
use super::symbol::symbol;
use crate::app::text::{fill, tr};
use crate::app::{fonts, theme};

pub use marks::Mark;
pub use track::is_track;

/// Width of the message at a field, points.
const COMPLAINT: f32 = 220.0;

/// What one frame of a slider did.
#[derive(Debug, Clone)]
pub struct SliderResponse {
    /// The value is another than before the frame.
    pub changed: bool,
    /// The user is done for now: refine whatever was computed coarsely.
    pub released: bool,
    /// Why the typed text was refused; also shown under the control.
    pub error: Option<String>,
    /// The track, for focus and geometry.
    pub track: Response,
}

/// A slider with a name, an exact value to type, marks, keyboard steps and a reset.
///
/// ```
/// # use harvester_lab::app::widgets::ParameterSlider;
/// # fn draw(ui: &mut egui::Ui, damping: &mut f64) {
/// let response = ParameterSlider::new("Damping", "α", damping, 1e-5..=1e-1).logarithmic().show(ui);
/// if response.changed { /* compute */ }
/// # }
/// ```
pub struct ParameterSlider<'a> {
    name: &'a str,
    symbol: &'a str,
    value: &'a mut f64,
    range: RangeInclusive<f64>,
    logarithmic: bool,
    floor: Option<f64>,
    marks: &'a [Mark],
    default: Option<f64>,
    unit: &'a str,
    tooltip: &'a str,
    equation: &'a str,
    secondary: &'a str,
    compact: bool,
}

impl<'a> ParameterSlider<'a> {
    /// A linear slider for `value` within `range`; `name` also identifies it, so it must be unique among siblings.
    pub fn new(name: &'a str, symbol: &'a str, value: &'a mut f64, range: RangeInclusive<f64>) -> Self {
        Self {
            name,
            symbol,
            value,
            range,
            logarithmic: false,
            floor: None,
            marks: &[],
            default: None,
            unit: "",
            tooltip: "",
            equation: "",
            secondary: "",
            compact: false,
        }
    }

    /// Spreads values by ratio. A range that starts at zero gets a stop for zero left of `end / 10⁴`.
    pub fn logarithmic(mut self) -> Self {
        self.logarithmic = true;
        self
    }

    /// Like [`Self::logarithmic`], for a range that starts at zero: `smallest` is the smallest positive value that
    /// the track reaches. Smaller ones can be typed.
    pub fn logarithmic_from(mut self, smallest: f64) -> Self {
        self.logarithmic = true;
        self.floor = Some(smallest);
        self
    }

    /// Values to snap to on a click, most important first.
    pub fn marks(mut self, marks: &'a [Mark]) -> Self {
        self.marks = marks;
        self
    }

    /// The value to which a double click on the name, or the reset button, returns.
    pub fn default_value(mut self, default: f64) -> Self {
        self.default = Some(default);
        self
    }

    /// The unit, shown after the value; none for dimensionless numbers.
    pub fn unit(mut self, unit: &'a str) -> Self {
        self.unit = unit;
        self
    }

    /// What the parameter is, in a sentence, shown while the pointer rests on the name.
    pub fn tooltip(mut self, tooltip: &'a str) -> Self {
        self.tooltip = tooltip;
        self
    }

    /// Where the paper defines the parameter, such as `Eq. 8`; part of the tooltip.
    pub fn equation(mut self, equation: &'a str) -> Self {
        self.equation = equation;
        self
    }

    /// A quiet line under the track, such as the frequency in hertz.
    pub fn secondary(mut self, secondary: &'a str) -> Self {
        self.secondary = secondary;
        self
    }

    /// One row only: name, short track, value. Marks and the secondary line are left out.
    pub fn compact(mut self) -> Self {
        self.compact = true;
        self
    }

    /// Draws the control over the available width.
    pub fn show(self, ui: &mut Ui) -> SliderResponse {
        let id = ui.make_persistent_id(("parameter slider", self.name));
        let mapping = if self.logarithmic {
            Mapping::logarithmic(self.range.clone(), self.floor)
        } else {
            Mapping::linear(self.range.clone())
        };
        let width = ui.available_width();
        let needs = Needs {
            unit: self.unit,
            marks: self.marks,
            secondary: !self.secondary.is_empty(),
            compact: self.compact,
        };
        let rows = Rows::arrange(ui, &needs, &mapping, width);
        let before = *self.value;

        let reset = self.name_row(ui, id, &rows);
        let track = track::interact(ui, id, rows.track, self.name, before, &mapping, self.marks);
        let marked = if self.compact {
            None
        } else {
            marks::show(ui, id, self.name, &mapping, self.marks, track::rail(rows.track), rows.all)
        };
        track::paint(ui, &track, rows.track);
        let subject = field::Subject { name: self.name, symbol: self.symbol, unit: self.unit };
        let memory_id = id.with("field memory");
        let mut memory = field::Memory::load(ui, memory_id);
        if memory.value != before {
            // A file, a link or an undo brought another value: the complaint is out of date.
            memory.error = None;
        }
        if memory.error.is_some() && ui.input(|input| input.key_pressed(egui::Key::Escape)) {
            memory.error = None;
        }
        let typed = field::show(ui, id.with("field"), rows.field, &subject, before, &self.range, &mut memory);

        let direct = reset.or(marked).or(typed);
        let new = direct.or(track.value).unwrap_or(before);
        let changed = new != before;
        if changed {
            *self.value = new;
            memory.error = None;
        }
        if let Some(bottom) = rows.secondary.filter(|_| !self.secondary.is_empty()) {
            let font = fonts::regular(theme::size::SMALL);
            ui.painter().text(bottom, Align2::LEFT_TOP, self.secondary, font, theme::tokens(ui).text_weak);
        }
        let error = memory.error.clone();
        memory.value = new;
        memory.store(ui, memory_id);
        if let Some(message) = &error {
            complain(ui, id, rows.field, message);
        }
        SliderResponse { changed, released: track.released || direct.is_some(), error, track: track.response }
    }

    /// Name, symbol and reset button; returns the default when it was asked for.
    fn name_row(&self, ui: &Ui, id: egui::Id, rows: &Rows) -> Option<f64> {
        let tokens = theme::tokens(ui);
        let font = fonts::regular(theme::size::BODY);
        let sign = ui.painter().layout_job(symbol(self.symbol, tokens.text_weak));
        let place = Align2::RIGHT_CENTER.anchor_size(pos2(rows.symbol, rows.name.center().y), sign.size());
        ui.painter().galley(place.min, sign, tokens.text_weak);
        let mut job =
            egui::text::LayoutJob::simple_singleline(self.name.to_owned(), font, tokens.text_strong);
        job.wrap =
            egui::text::TextWrapping::truncate_at_width((place.left() - 6.0 - rows.name.left()).max(10.0));
        let galley = ui.painter().layout_job(job);
        let name = Align2::LEFT_CENTER.anchor_size(rows.name.left_center(), galley.size());
        ui.painter().galley(name.min, galley, tokens.text_strong);

        let label = ui.interact(name.expand2(vec2(2.0, 4.0)), id.with("name"), Sense::CLICK);
        let enabled = ui.is_enabled();
        label.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, enabled, self.name));
        let restored = label.double_clicked();
        if !self.tooltip.is_empty() {
            label.on_hover_ui(|ui| self.explain(ui));
        }
        let default = self.default.filter(|default| *default != *self.value)?;
        let button = ui.interact(rows.reset, id.with("reset"), Sense::CLICK);
        let hint = fill(
            "Reset {name} to {value}",
            &[("name", &self.name), ("value", &super::number::display(default))],
        );
        icon::paint_button(ui, rows.reset, &button, Icon::Reset, &hint);
        let pressed = button.clicked();
        button.on_hover_text(hint);
        (pressed || restored).then_some(default)
    }

    /// The tooltip of the name.
    fn explain(&self, ui: &mut Ui) {
        let tokens = theme::tokens(ui);
        ui.label(symbol(&format!("{} {}", self.name, self.symbol), tokens.text_strong));
        ui.label(self.tooltip);
        if !self.marks.is_empty() && !self.compact {
            ui.label(tr("Click a mark to go to a resonance."));
        }
        let mut facts: Vec<String> = Vec::new();
        if !self.equation.is_empty() {
            facts.push(self.equation.to_owned());
        }
        facts.push(if self.unit.is_empty() {
            tr("dimensionless").to_owned()
        } else {
            fill("in {unit}", &[("unit", &self.unit)])
        });
        facts.push(field::range_text(&self.range, ""));
        ui.label(egui::RichText::new(facts.join("  ·  ")).small().color(tokens.text_weak));
    }
}

/// The message at a field whose text was refused, over what stands below, which stays where it is.
fn complain(ui: &Ui, id: egui::Id, field: egui::Rect, message: &str) {
    if !ui.is_rect_visible(field) {
        return;
    }
    let tokens = theme::tokens(ui);
    let text = egui::RichText::new(message).font(fonts::regular(theme::size::SMALL)).color(tokens.danger);
    // What it covers can still be used.
    Area::new(id.with("complaint"))
        .order(Order::Foreground)
        .interactable(false)
        .pivot(Align2::RIGHT_TOP)
        .fixed_pos(field.right_bottom() + vec2(0.0, 3.0))
        .show(ui.ctx(), |ui| {
            Frame::popup(ui.style()).show(ui, |ui| {
                ui.set_max_width(COMPLAINT);
                ui.add(egui::Label::new(text).wrap().selectable(false));
            });
        });
}
