//! How the device is shaken on the page Shake, and what it gives in a sentence.

use egui::{RichText, Ui};

use crate::app::bench::shaking::{band, duration, question, runs};
use crate::app::panels::Context;
use crate::app::text::{fill, say, tr};
use crate::app::theme;
use crate::app::view::shake::{DURATIONS, LEVELS, ShakeView, ShakenBy};
use crate::app::widgets::number::{round_significant, significant, with_unit};
use crate::app::widgets::{Card, ParameterSlider, chips};
use crate::questions::shake::{Found, Harvested, ShakeAnswer, ShakenRun};
use crate::scheduler::{Asked as _, Failure, Study as _, Table};

/// Least width of a slider where two stand side by side.
const SLIDER: f32 = 300.0;

/// Asks for the runs.
pub(in crate::app::panels) fn ask(asking: &mut super::super::spec::Asking<'_>) {
    if let Some(runs) = runs(asking.view) {
        asking.studies.tabulate(runs);
    }
}

/// The newest runs, when they are those of the shaking in view.
pub(in crate::app::panels) fn found<'a>(
    context: &Context<'a>,
) -> Option<Result<Vec<&'a Found>, &'a Failure>> {
    let study: &Table<ShakenRun> = context.studies.lanes.study()?;
    let wanted = runs(context.view)?;
    (study.asked() == wanted.asked()).then(|| study.found().flatten().collect())
}

/// What the runs so far say.
pub(in crate::app::panels) fn summary(context: &Context<'_>) -> Option<ShakeAnswer> {
    question(context.view).1.summary(&found(context)?.ok()?)
}

/// Draws the card.
pub(super) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    Card::new(tr("The base is shaken")).hugging().show(ui, |ui| {
        controls(context, ui);
        ui.add_space(4.0);
        sentence(context, ui);
    });
}

fn controls(context: &mut Context<'_>, ui: &mut Ui) {
    let before = context.view.design.shake;
    let mut shake = before;
    let (mut from, mut to) = band(context.view);
    let mut lasts = duration(context.view);
    ui.horizontal_wrapped(|ui| {
        let kinds = [(ShakenBy::Noise, tr("noise")), (ShakenBy::Chirp, tr("chirp up and down"))];
        if chips(ui, tr("Shaken by"), &mut shake.by, &kinds) {
            shake.duration = None;
        }
        match shake.by {
            ShakenBy::Noise => {
                if ui.button(tr("Another noise")).clicked() {
                    shake.seed = (shake.seed + 1) % 1000;
                }
            }
            ShakenBy::Chirp => {
                let scales = [(false, tr("Hz a second")), (true, tr("octaves a second"))];
                chips(ui, tr("Speed"), &mut shake.octaves, &scales);
            }
        }
        let own = shake.band.is_some() || shake.duration.is_some();
        if ui.add_enabled(own, egui::Button::new(tr("Usual band"))).clicked() {
            (shake.band, shake.duration) = (None, None);
        }
    });
    let name = if shake.by == ShakenBy::Noise { tr("Level, rms") } else { tr("Level, peak") };
    let first = from.min(to);
    let room = ui.available_width();
    let side_by_side = 0.5 * (room - ui.spacing().item_spacing.x);
    let width = if side_by_side >= SLIDER { side_by_side } else { room };
    ui.horizontal_wrapped(|ui| {
        let slider = |ui: &mut Ui, name: &str, value: &mut f64, range: (f64, f64), unit: &str| {
            *value = round_significant(*value, 4);
            ui.allocate_ui(egui::vec2(width.floor(), 26.0), |ui| {
                let slider = ParameterSlider::new(name, "", value, range.0..=range.1);
                slider.logarithmic().unit(unit).compact().show(ui).changed
            })
            .inner
        };
        slider(ui, name, &mut shake.level, (LEVELS.0.max(1e-4), LEVELS.1.min(10.0)), "g");
        let usual = (0.05 * first, 50.0 * first);
        let changed =
            slider(ui, tr("From"), &mut from, usual, "Hz") | slider(ui, tr("To"), &mut to, usual, "Hz");
        if changed {
            shake.band = Some((from, to));
        }
        let longest = (DURATIONS.0.max(0.1 * lasts), DURATIONS.1.min(10.0 * lasts));
        if slider(ui, tr("Duration"), &mut lasts, longest, "s") {
            shake.duration = Some(lasts);
        }
    });
    if shake != before {
        look(context, shake);
    }
}

fn look(context: &mut Context<'_>, shake: ShakeView) {
    context.redesign(|design| design.shake = shake);
}

/// `12.3 µW (± 3 %)`, without the error where there is none.
fn power(found: &Harvested) -> String {
    let value = with_unit(found.power, "W");
    match found.power_error {
        Some(error) => format!("{value} (± {} %)", significant(100.0 * error / found.power, 2)),
        None => value,
    }
}

fn sentence(context: &Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let line = |ui: &mut Ui, text: String, colour| {
        ui.add(egui::Label::new(RichText::new(text).color(colour)).wrap());
    };
    let found = match found(context) {
        Some(Ok(found)) => found,
        Some(Err(failure)) => return line(ui, say(failure), tokens.danger),
        None => Vec::new(),
    };
    let Some(answer) = question(context.view).1.summary(&found) else {
        return line(ui, tr("computing").to_owned(), tokens.text_weak);
    };
    let ended = |word: &str, at: f64| {
        let time = significant(at, 3);
        if word == "contact" {
            fill("The magnets touch after {time} s: there the model ends.", &[("time", &time)])
        } else {
            fill("The tip escapes after {time} s: this force law lets it go.", &[("time", &time)])
        }
    };
    if answer.outcome != "completed" {
        line(ui, ended(answer.outcome, answer.t_outcome), tokens.danger);
    }
    let noise = context.view.design.shake.by == ShakenBy::Noise;
    if let (Some(own), Some(linear)) = (&answer.measured, &answer.linear) {
        let values = [power(own), power(linear)];
        let text = if noise {
            fill(
                "On average it gives {own}; without its magnets, under the same noise, {linear}.",
                &[("own", &values[0]), ("linear", &values[1])],
            )
        } else {
            fill(
                "Over the whole chirp it gives {own} on average; without its magnets {linear}.",
                &[("own", &values[0]), ("linear", &values[1])],
            )
        };
        line(ui, text, tokens.text);
    }
    if let Some(gain) = answer.gain {
        let gained = significant(gain, 3);
        let text = match answer.gain_error {
            Some(error) => {
                let beyond = (gain - 1.0).abs() > 2.0 * error;
                let verdict = match (beyond, gain > 1.0) {
                    (true, true) => tr("The magnets help."),
                    (true, false) => tr("The magnets cost power."),
                    (false, _) => tr("Whether the magnets help is not decided by runs so short."),
                };
                let ratio = fill(
                    "That is {gain} ± {error} times as much.",
                    &[("gain", &gained), ("error", &significant(error, 2))],
                );
                format!("{ratio} {verdict}")
            }
            None if noise => {
                let ratio = fill("That is {gain} times as much.", &[("gain", &gained)]);
                format!("{ratio} {}", tr("The runs are too short to say how sure that is."))
            }
            None => fill("That is {gain} times as much.", &[("gain", &gained)]),
        };
        line(ui, text, tokens.text);
    }
    let unfinished = context.studies.lanes.study::<Table<ShakenRun>>().filter(|study| !study.finished());
    let text = match (unfinished, noise) {
        (Some(study), _) => super::super::computing(study.progress()),
        (None, true) => tr("Under noise nothing repeats: there is no verdict, no Poincaré map and no branch, only means with their errors.").to_owned(),
        (None, false) => tr("Where the motion jumps up and where it jumps down differ: that is hysteresis.").to_owned(),
    };
    line(ui, text, tokens.text_weak);
}
