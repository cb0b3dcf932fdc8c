//! The bar above the plots that says in words what they show.

use egui::text::{LayoutJob, TextFormat};
use egui::{Align, RichText, Ui};

use super::Context;
use super::design::safety::Safety;
use crate::app::reading::{Reading, Tone};
use crate::app::session::{Shown, Status};
use crate::app::text::fill;
use crate::app::{fonts, theme};
use crate::dynamics::{Outcome, Verdict};
use crate::model::Demand;

/// Between texts of a line: a line may end after the dot.
const SEPARATOR: &str = "\u{a0}\u{a0}·  ";
/// Longest unit, in letters, that stays with its number.
const UNIT: usize = 3;

/// Texts in a line that breaks neither between a number and its unit nor at an equals sign.
pub(super) fn in_a_line(texts: &[String]) -> String {
    let joined = texts.join(SEPARATOR).replace(" = ", "\u{a0}=\u{a0}");
    let mut out = String::with_capacity(joined.len() + 16);
    let mut words = joined.split(' ').peekable();
    while let Some(word) = words.next() {
        out.push_str(word);
        let unit = |next: &&str| {
            !next.is_empty() && next.trim_end_matches(SEPARATOR.trim_end()).chars().count() <= UNIT
        };
        if words.peek().is_some() {
            let together = word.ends_with(|c: char| c.is_ascii_digit()) && words.peek().is_some_and(unit);
            out.push(if together { '\u{a0}' } else { ' ' });
        }
    }
    out
}

/// Draws the bar.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let Some(shown) = context.shown() else { return };
    let failure = match context.session.status() {
        Status::Failed(message) => Some(message),
        _ => None,
    };
    let found = context.studies.inspection(&shown.scenario);
    let verdict = found.filter(|(_, current)| *current).map(|(found, _)| &found.verdict);
    let reading = Reading::new(shown, context.session.boundaries.as_ref(), verdict);
    let colour = match (failure.is_some(), reading.tone) {
        (true, _) | (_, Tone::Alarming) => tokens.danger,
        (_, Tone::Notable) => tokens.warning,
        (_, Tone::Plain) => tokens.ok,
    };
    let broken = broken(context, shown, verdict);
    let frame = egui::Frame::new()
        .fill(tokens.card)
        .stroke(tokens.edge())
        .corner_radius(theme::radius::CARD)
        .inner_margin(egui::Margin { left: 16, right: 12, top: 8, bottom: 9 });
    let drawn = frame.show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        if let Some(message) = failure {
            let text = fill("{message}. The last good state stays on the screen.", &[("message", &message)]);
            ui.label(RichText::new(text).color(tokens.danger));
            return;
        }
        ui.spacing_mut().item_spacing.y = 6.0;
        let format =
            |font, color| TextFormat { font_id: font, color, valign: Align::Center, ..Default::default() };
        let mut line = LayoutJob::default();
        line.append(&reading.headline, 0.0, format(fonts::semibold(theme::size::HEADING), colour));
        let facts = format(fonts::regular(theme::size::BODY), tokens.text);
        line.append(&in_a_line(&reading.facts), 12.0, facts);
        let broken: String = broken
            .iter()
            .map(|text| SEPARATOR.to_owned() + &fill("beyond a limit: {text}", &[("text", text)]))
            .collect();
        line.append(&broken, 0.0, format(fonts::regular(theme::size::BODY), tokens.danger));
        ui.label(line);
        if !reading.remarks.is_empty() {
            let remarks = in_a_line(&reading.remarks);
            ui.label(RichText::new(remarks).small().color(tokens.text_weak));
        }
    });
    let rect = drawn.response.rect;
    let stripe = egui::Rect::from_min_max(rect.min, egui::pos2(rect.left() + 5.0, rect.bottom()));
    let rounding = egui::CornerRadius { nw: theme::radius::CARD, sw: theme::radius::CARD, ne: 0, se: 0 };
    ui.painter().rect_filled(stripe, rounding, colour);
}

/// The limits of the Design tab that the motion in view breaks: that of the verdict, as the facts beside it, else the run.
fn broken(context: &Context<'_>, shown: &Shown, verdict: Option<&Verdict>) -> Vec<String> {
    let lasts = shown.run.outcome() == Outcome::Completed;
    let summary = shown.run.summary.as_ref().filter(|_| lasts);
    let gap = shown.run.system.equilibrium.gap;
    let demand = summary.map(|summary| {
        let found = verdict.and_then(|verdict| {
            let (low, high) = verdict.tip_over_gap?;
            Some(Demand { v_peak: verdict.v_peak?, tip: (gap * low, gap * high), slope: verdict.slope })
        });
        found.unwrap_or_else(|| summary.measures.demand())
    });
    match (Safety::of(context.view, context.session), demand) {
        (Some(safety), Some(demand)) => safety.broken(&demand),
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::in_a_line;

    #[test]
    fn numbers_keep_their_units() {
        let texts = ["14.2 V rms", "26.3 µW", "from β = 0.00163: |μ| = 1.148", "ends 0.813 % of the way"];
        let line = in_a_line(&texts.map(str::to_owned));
        let shown = "14.2~V rms~~·  26.3~µW~~·  from β~=~0.00163: |μ|~=~1.148~~·  ends 0.813~% of the way";
        assert_eq!(line.replace('\u{a0}', "~"), shown);
    }
}
