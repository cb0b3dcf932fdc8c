//! The bar above the plots that says in words what they show.

use egui::collapsing_header::CollapsingState;
use egui::scroll_area::ScrollSource;
use egui::text::{LayoutJob, TextFormat, TextWrapping};
use egui::{Align, Align2, Color32, ScrollArea, Sense, Ui, UiBuilder, Vec2, WidgetInfo, pos2, vec2};

use super::Context;
use super::design::safety::Safety;
use crate::app::reading::{Reading, Tone};
use crate::app::session::{Shown, Status};
use crate::app::text::{fill, tr};
use crate::app::view::Tab;
use crate::app::widgets::icon::BUTTON_SIDE;
use crate::app::widgets::{Icon, icon_button, touch, words_explained};
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

/// Rows of the three parts of the bar, by its width alone: what is beneath must not move while a verdict changes.
struct Rows {
    /// At most. A second one takes the room of one of the facts.
    headline: usize,
    /// Under a headline in one row.
    facts: usize,
    details: usize,
}

impl Rows {
    fn of(width: f32) -> Self {
        let [headline, facts, details] = match width {
            860.0.. => [1, 1, 3],
            560.0.. => [1, 2, 5],
            _ => [2, 3, 8],
        };
        Self { headline, facts, details }
    }
}

/// Draws the bar: what anybody understands, and below it, when unfolded, what is known beside it.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let frame = egui::Frame::new()
        .fill(tokens.card)
        .stroke(tokens.edge())
        .corner_radius(theme::radius::CARD)
        .inner_margin(egui::Margin { left: 16, right: 10, top: 7, bottom: 8 });
    let drawn = frame.show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        ui.spacing_mut().item_spacing.y = 4.0;
        contents(context, ui)
    });
    let rect = drawn.response.rect;
    let stripe = egui::Rect::from_min_max(rect.min, egui::pos2(rect.left() + 5.0, rect.bottom()));
    let rounding = egui::CornerRadius { nw: theme::radius::CARD, sw: theme::radius::CARD, ne: 0, se: 0 };
    ui.painter().rect_filled(stripe, rounding, drawn.inner);
}

/// Draws what is in the bar; returns its colour.
fn contents(context: &Context<'_>, ui: &mut Ui) -> Color32 {
    let tokens = theme::tokens(ui);
    let format =
        |font, color| TextFormat { font_id: font, color, valign: Align::Center, ..Default::default() };
    let body = |color| format(fonts::regular(theme::size::BODY), color);
    let small = |color| format(fonts::regular(theme::size::SMALL), color);
    let rows = Rows::of(ui.available_width());
    let (mut first, mut second, mut rest) =
        (LayoutJob::default(), LayoutJob::default(), LayoutJob::default());
    let mut colour = tokens.ok;
    let id = ui.make_persistent_id("details of the verdict");
    let mut fold = CollapsingState::load_with_default_open(ui.ctx(), id, false);
    let open = fold.is_open();
    if let Status::Failed(message) = context.session.status() {
        colour = tokens.danger;
        let text = fill("{message}. The last good state stays on the screen.", &[("message", &message)]);
        second.append(&text, 0.0, body(colour));
    } else if let Some((shown, verdict, reading)) = read(context) {
        colour = tone(tokens, &reading);
        first.append(&reading.headline, 0.0, format(fonts::semibold(theme::size::HEADING), colour));
        first.append(&format!("  {}", reading.plain), 2.0, body(tokens.text));
        let mut facts = in_a_line(&reading.facts);
        let settles =
            verdict.is_some_and(|verdict| verdict.v_rms.is_some()) && reading.tone != Tone::Alarming;
        if context.view.tab == Tab::Live && settles {
            // The numbers beside it are those of the moment.
            facts = fill("settled: {facts}", &[("facts", &facts)]);
        }
        second.append(&facts, 0.0, body(tokens.text));
        for text in broken(context, shown, verdict) {
            let text = fill("beyond a limit: {text}", &[("text", &text)]);
            add(&mut second, &text, body(tokens.danger));
        }
        for text in &reading.warnings {
            if open {
                // Whole, where there is room for all of them.
                add(&mut rest, text, small(tokens.warning));
            } else if rows.facts == 1 {
                // There the first row has room.
                add(&mut first, text, small(tokens.warning));
            } else {
                add(&mut second, text, body(tokens.warning));
            }
        }
        for text in &reading.remarks {
            add(&mut rest, text, small(tokens.text_weak));
        }
    }
    let top = ui.cursor().min;
    let right = top.x + ui.available_width();
    let place = egui::Rect::from_min_size(pos2(right - BUTTON_SIDE, top.y - 1.0), Vec2::splat(BUTTON_SIDE));
    // The facts stand right under the headline; the room that either leaves is below both.
    let of = |taken: usize| {
        height(ui, taken, theme::size::HEADING) + height(ui, rows.facts + 1 - taken, theme::size::BODY)
    };
    let room = (1..=rows.headline).map(of).fold(0.0, f32::max) + ui.spacing().item_spacing.y;
    let (block, _) = ui.allocate_exact_size(vec2(right - top.x, room), Sense::hover());
    let mut block = ui.new_child(UiBuilder::new().max_rect(block));
    let taken = paragraph(&mut block, first, rows.headline, right - BUTTON_SIDE - 8.0 - top.x);
    paragraph(&mut block, second, (rows.facts + 1 - taken.max(1)).max(1), right - top.x);
    if open {
        details(ui, rest, rows.details);
    }
    let (icon, label) = if open {
        (Icon::ChevronDown, tr("Hide the details"))
    } else {
        (Icon::ChevronRight, tr("Show the details"))
    };
    let mut corner = ui.new_child(UiBuilder::new().max_rect(place));
    if icon_button(&mut corner, icon, label).clicked() {
        fold.toggle(ui);
    }
    fold.store(ui.ctx());
    colour
}

/// The motion shown, the verdict on it once that is there, and both in words.
fn read<'a>(context: &Context<'a>) -> Option<(&'a Shown, Option<&'a Verdict>, Reading)> {
    let (session, studies) = (context.session, context.studies);
    let shown = context.shown()?;
    let found = studies.inspection(&shown.scenario);
    let verdict = found.filter(|(_, current)| *current).map(|(found, _)| &found.verdict);
    Some((shown, verdict, Reading::new(shown, session.boundaries.as_ref(), verdict)))
}

fn tone(tokens: &theme::Tokens, reading: &Reading) -> Color32 {
    match reading.tone {
        Tone::Alarming => tokens.danger,
        Tone::Notable => tokens.warning,
        Tone::Plain => tokens.ok,
    }
}

/// Draws in one row what the motion is and what it gives.
pub(super) fn row(context: &Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let format = |font, color| TextFormat { font_id: font, color, ..Default::default() };
    let mut text = LayoutJob::default();
    if let Some((_, _, reading)) = read(context) {
        text.append(
            &reading.headline,
            0.0,
            format(fonts::semibold(theme::size::BODY), tone(tokens, &reading)),
        );
        let facts = format!("{SEPARATOR}{}", in_a_line(&reading.facts));
        text.append(&facts, 0.0, format(fonts::regular(theme::size::BODY), tokens.text));
    }
    let width = ui.available_width();
    paragraph(ui, text, 1, width);
}

/// Adds a text of its own colour to others of a line.
fn add(line: &mut LayoutJob, text: &str, format: TextFormat) {
    let before = if line.is_empty() { "" } else { SEPARATOR };
    line.append(&(before.to_owned() + &in_a_line(&[text.to_owned()])), 0.0, format);
}

/// Height of so many rows of a text of this size.
fn height(ui: &Ui, rows: usize, size: f32) -> f32 {
    let row = ui.ctx().fonts_mut(|all| all.row_height(&fonts::regular(size)));
    (row * rows as f32).ceil()
}

/// Text in at most so many rows, and how many it takes; what does not fit is told on touch.
fn paragraph(ui: &mut Ui, mut job: LayoutJob, rows: usize, width: f32) -> usize {
    job.wrap = TextWrapping { max_width: width, max_rows: rows, ..Default::default() };
    let galley = ui.painter().layout_job(job);
    let (rect, response) = ui.allocate_exact_size(vec2(width, galley.size().y), Sense::CLICK);
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Label, enabled, galley.text()));
    let place = Align2::LEFT_TOP.align_size_within_rect(galley.size(), rect);
    ui.painter().galley(place.min, galley.clone(), Color32::PLACEHOLDER);
    let response = words_explained(response, galley.text());
    if galley.elided {
        response.on_hover_text(galley.text());
    }
    galley.rows.len()
}

/// Text with room for so many rows; of a longer one the rest is scrolled to, not by the wheel, which is the page's.
fn details(ui: &mut Ui, job: LayoutJob, rows: usize) {
    let room = height(ui, rows, theme::size::SMALL);
    let size = vec2(ui.available_width(), room);
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let mut child = ui.new_child(UiBuilder::new().max_rect(rect));
    let source = ScrollSource { mouse_wheel: false, ..touch::source(ui.ctx()) };
    ScrollArea::vertical()
        .auto_shrink(false)
        .max_height(room)
        .scroll_source(source)
        .show(&mut child, |ui| ui.label(job));
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
    use crate::app::rehearsal::Desk;

    #[test]
    fn plots_beneath_stay_where_they_are_whatever_the_verdict() {
        let mut random = fastrand::Rng::with_seed(17);
        for (width, open) in [(1440.0, true), (1000.0, false), (700.0, true), (360.0, true)] {
            let mut desk = Desk::new(width, 900.0, "{}");
            desk.work(3);
            if open {
                let button = desk.harness.find(egui::Role::Button, "Show the details").bounds.center();
                desk.harness.click(button, |ui| desk.app.ui(ui));
            }
            let (mut tops, mut headlines) = (Vec::new(), Vec::new());
            for point in 0..50 {
                let near = if point % 3 == 0 { 8.1 } else { 1.0 + 40.0 * random.f64() };
                let [omega, beta] = [near + 0.1 * random.f64(), 0.04 * random.f64().powi(2)];
                let law = if point % 2 == 0 { "exact" } else { "quadratic" };
                let json = format!(
                    r#"{{"parameters":{{"omega":{omega},"beta":{beta}}},"model":{{"force":"{law}"}},"t_end":120.0}}"#
                );
                desk.app.load_json(&json).expect("a scenario");
                for frames in [1, 4] {
                    desk.work(frames);
                    // Where there is one column, what stands beneath are the folded sliders.
                    let beneath = if width > 760.0 { "Enlarge: " } else { "Magnet" };
                    tops.push(desk.harness.find(egui::Role::Button, beneath).bounds.top());
                }
                headlines.extend(desk.harness.texts.iter().map(|(text, _)| text.clone()).filter(|text| {
                    ["Period", "Not settled", "Escape", "Contact", "Quasi", "Chaotic"]
                        .iter()
                        .any(|kind| text.starts_with(kind))
                }));
            }
            headlines.sort();
            headlines.dedup_by_key(|text| text.chars().take(8).collect::<String>());
            assert!(headlines.len() >= 4, "{headlines:?}");
            assert!(tops.iter().all(|top| *top == tops[0]), "{width}: {tops:?}");
        }
    }

    #[test]
    fn numbers_keep_their_units() {
        let texts = ["14.2 V rms", "26.3 µW", "from β = 0.00163: |μ| = 1.148", "ends 0.813 % of the way"];
        let line = in_a_line(&texts.map(str::to_owned));
        let shown = "14.2~V rms~~·  26.3~µW~~·  from β~=~0.00163: |μ|~=~1.148~~·  ends 0.813~% of the way";
        assert_eq!(line.replace('\u{a0}', "~"), shown);
    }
}
