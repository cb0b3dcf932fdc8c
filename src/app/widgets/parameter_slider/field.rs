//! The text field with the exact value, and the message under it when what was typed cannot be used.

use std::ops::RangeInclusive;

use egui::text::CCursorRange;
use egui::{Align2, Frame, Id, Key, Margin, Rect, Stroke, TextEdit, Ui, WidgetInfo};

use super::super::number;
use super::typed;
use crate::app::text::fill;
use crate::app::theme;

/// Left and right of the text, points.
const MARGIN: i8 = 8;

/// What is being typed, and the last complaint; kept between frames.
#[derive(Debug, Clone, Default)]
pub(super) struct Memory {
    text: Option<String>,
    pub(super) error: Option<String>,
    /// The parameter's value of the last frame.
    pub(super) value: f64,
}

impl Memory {
    pub(super) fn load(ui: &Ui, id: Id) -> Self {
        ui.data(|data| data.get_temp(id)).unwrap_or_default()
    }

    pub(super) fn store(self, ui: &Ui, id: Id) {
        ui.data_mut(|data| data.insert_temp(id, self));
    }
}

/// Who is asking, for messages and screen readers.
pub(super) struct Subject<'a> {
    pub(super) name: &'a str,
    pub(super) symbol: &'a str,
    pub(super) unit: &'a str,
}

/// Checks a typed text against the allowed range.
pub(super) fn check(subject: &Subject<'_>, text: &str, range: &RangeInclusive<f64>) -> Result<f64, String> {
    let allowed = range_text(range, subject.unit);
    let Subject { name, symbol, .. } = subject;
    let space = if symbol.is_empty() { "" } else { " " };
    match typed::parse(text, subject.unit) {
        None => Err(fill(
            "{name}: “{text}” is not a number. Allowed: {allowed}.",
            &[("name", &format!("{name}{space}{symbol}")), ("text", &text.trim()), ("allowed", &allowed)],
        )),
        Some(value) if !range.contains(&value) => Err(fill(
            "{name} = {text} is out of range. Allowed: {allowed}.",
            &[("name", &format!("{name}{space}{symbol}")), ("text", &text.trim()), ("allowed", &allowed)],
        )),
        Some(value) => Ok(value),
    }
}

/// `1.00e−4 to 0.100 Hz`.
pub(super) fn range_text(range: &RangeInclusive<f64>, unit: &str) -> String {
    let short = |value: f64| number::typographic(&number::exact(value));
    let text = fill("{from} to {to}", &[("from", &short(*range.start())), ("to", &short(*range.end()))]);
    if unit.is_empty() { text } else { format!("{text} {unit}") }
}

/// The value with its unit, with as many digits as a field of this width has room for; all are there once it is edited.
pub(super) fn fitting(ui: &Ui, value: f64, unit: &str, width: f32) -> String {
    let text = |digits: usize| {
        let shown = number::display_within(value, digits);
        if unit.is_empty() { shown } else { format!("{shown} {unit}") }
    };
    let font = egui::TextStyle::Monospace.resolve(ui.style());
    let fits = |text: &String| {
        let galley = ui.painter().layout_no_wrap(text.clone(), font.clone(), egui::Color32::PLACEHOLDER);
        galley.size().x <= width - 2.0 * f32::from(MARGIN)
    };
    (3..=5).rev().map(text).find(fits).unwrap_or_else(|| text(3))
}

/// Shows the field in `rect`. Returns a newly committed, valid value.
pub(super) fn show(
    ui: &mut Ui,
    id: Id,
    rect: Rect,
    subject: &Subject<'_>,
    value: f64,
    range: &RangeInclusive<f64>,
    memory: &mut Memory,
) -> Option<f64> {
    let tokens = theme::tokens(ui);
    let editing = memory.text.is_some();
    let mut text = memory.text.clone().unwrap_or_else(|| fitting(ui, value, subject.unit, rect.width()));
    let colour = if memory.error.is_some() && editing { tokens.danger } else { tokens.text_strong };
    // The frame is drawn here, so that the field keeps its size in every state.
    let hovered = ui.rect_contains_pointer(rect);
    let ground = if hovered || editing { tokens.hover } else { tokens.field };
    let outline = match (&memory.error, editing) {
        (Some(_), _) => Stroke::new(1.5, tokens.danger),
        (None, true) => Stroke::new(1.5, tokens.accent),
        (None, false) => tokens.edge(),
    };
    ui.painter().rect(rect, theme::radius::CONTROL, ground, outline, egui::StrokeKind::Inside);
    let edit = TextEdit::singleline(&mut text)
        .id(id)
        .font(egui::TextStyle::Monospace)
        .text_color(colour)
        .frame(Frame::NONE.inner_margin(Margin::symmetric(MARGIN, 0)))
        .align(Align2::RIGHT_CENTER)
        .desired_width(rect.width())
        .min_size(rect.size())
        .char_limit(40);
    let mut child = ui.new_child(egui::UiBuilder::new().max_rect(rect).id_salt(id));
    child.shrink_clip_rect(rect.expand(1.0));
    let mut output = edit.show(&mut child);
    let response = &output.response.response;
    let enabled = ui.is_enabled();
    response.widget_info(|| {
        WidgetInfo::text_edit(
            enabled,
            text.clone(),
            text.clone(),
            fill("{name} value", &[("name", &subject.name)]),
        )
    });

    ui.ctx()
        .accesskit_node_builder(id, |node| node.set_label(fill("{name} value", &[("name", &subject.name)])));

    if response.gained_focus() {
        let full = number::exact(value);
        let all = CCursorRange::select_all_str(&full);
        output.state.cursor.set_char_range(Some(all));
        output.state.clone().store(ui.ctx(), id);
        *memory = Memory { text: Some(full), error: None, value };
        return None;
    }
    if response.lost_focus() {
        let typed = memory.text.take().map(|old| if response.changed() { text.clone() } else { old });
        if ui.input(|input| input.key_pressed(Key::Escape)) {
            memory.error = None;
            return None;
        }
        return commit(ui, id, subject, typed, value, range, memory);
    }
    if response.has_focus() {
        if response.changed() {
            memory.error = None;
        }
        memory.text = Some(text);
    }
    None
}

/// Takes over what was typed, or keeps the text and says what is wrong with it.
fn commit(
    ui: &Ui,
    id: Id,
    subject: &Subject<'_>,
    typed: Option<String>,
    value: f64,
    range: &RangeInclusive<f64>,
    memory: &mut Memory,
) -> Option<f64> {
    let typed = typed.filter(|text| *text != number::exact(value))?;
    match check(subject, &typed, range) {
        Ok(new) => {
            memory.error = None;
            Some(new)
        }
        Err(message) => {
            memory.error = Some(message);
            // After Enter the hand is still on the keyboard: let it correct the text.
            if ui.input(|input| input.key_pressed(Key::Enter)) {
                memory.text = Some(typed);
                ui.memory_mut(|focus| focus.request_focus(id));
            }
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_name_field_value_and_range() {
        let subject = Subject { name: "Damping", symbol: "α", unit: "" };
        assert_eq!(check(&subject, "1e-3", &(1e-4..=0.1)), Ok(1e-3));
        let message = check(&subject, "5", &(1e-4..=0.1));
        assert_eq!(message, Err("Damping α = 5 is out of range. Allowed: 1e−4 to 0.1.".to_owned()));
        let message = check(&subject, "much", &(1e-4..=0.1));
        assert_eq!(message, Err("Damping α: “much” is not a number. Allowed: 1e−4 to 0.1.".to_owned()));
    }
}
