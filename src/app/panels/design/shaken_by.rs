//! What shakes the base: the choice, its numbers, and the recording that was brought.

use egui::{Label, RichText, Ui};

use super::columns;
use crate::app::bench::recorded::BaseRecording;
use crate::app::bench::shaking::{band, duration, recorded};
use crate::app::command::Command;
use crate::app::panels::Context;
use crate::app::text::{fill, tr};
use crate::app::theme;
use crate::app::view::shake::{LEVELS, ShakeView, ShakenBy};
use crate::app::widgets::number::{round_significant, short, significant, with_unit};
use crate::app::widgets::{ParameterSlider, chips};
use crate::model::base_motion::DURATIONS;
use crate::questions::design::measured::Kind;

/// Least width of a slider where two stand side by side.
const SLIDER: f32 = 300.0;

/// The kinds of shaking, with the sine where that is one of them.
pub(in crate::app::panels) fn choose(context: &mut Context<'_>, ui: &mut Ui, with_sine: bool) {
    let shake = &context.view.design.shake;
    let before = if with_sine { shake.everywhere.then_some(shake.by) } else { Some(shake.by) };
    let mut by = before;
    let kinds = [
        (None, tr("sine")),
        (Some(ShakenBy::Noise), tr("noise")),
        (Some(ShakenBy::Chirp), tr("chirp")),
        (Some(ShakenBy::Recorded), tr("recording")),
    ];
    let offered = if with_sine { &kinds[..] } else { &kinds[1..] };
    ui.horizontal_wrapped(|ui| chips(ui, tr("Shaken by"), &mut by, offered));
    if by != before {
        context.redesign(|design| {
            let shake = &mut design.shake;
            shake.everywhere = if with_sine { by.is_some() } else { shake.everywhere };
            if let Some(by) = by.filter(|by| *by != shake.by) {
                // A band and a duration that suit one do not suit another.
                (shake.by, shake.band, shake.duration) = (by, None, None);
            }
        });
    }
}

/// Its numbers.
pub(in crate::app::panels) fn controls(context: &mut Context<'_>, ui: &mut Ui) {
    let before = &context.view.design.shake;
    let mut shake = before.clone();
    match shake.by {
        ShakenBy::Recorded => recording(context, ui, &mut shake),
        ShakenBy::Noise | ShakenBy::Chirp => made(context, ui, &mut shake),
    }
    if shake != *before {
        context.redesign(|design| design.shake = shake);
    }
}

/// A slider of half the width, where that is enough.
fn slider(ui: &mut Ui, name: &str, value: &mut f64, range: (f64, f64), unit: &str) -> bool {
    let room = ui.max_rect().width();
    let side_by_side = 0.5 * (room - ui.spacing().item_spacing.x);
    let width = if side_by_side >= SLIDER { side_by_side } else { room };
    *value = round_significant(*value, 4);
    ui.allocate_ui(egui::vec2(width.floor(), 26.0), |ui| {
        let slider = ParameterSlider::new(name, "", value, range.0..=range.1).logarithmic().unit(unit);
        let slider = if side_by_side >= SLIDER { slider.compact() } else { slider };
        slider.show(ui).changed
    })
    .inner
}

/// Of noise and chirps.
fn made(context: &Context<'_>, ui: &mut Ui, shake: &mut ShakeView) {
    let (mut from, mut to) = band(context.view);
    let mut lasts = duration(context.view);
    ui.horizontal_wrapped(|ui| {
        if shake.by == ShakenBy::Chirp {
            let scales = [(false, tr("Hz a second")), (true, tr("octaves a second"))];
            chips(ui, tr("Speed"), &mut shake.octaves, &scales);
        } else if ui.button(tr("Another noise")).clicked() {
            shake.seed = (shake.seed + 1) % 1000;
        }
        let own = shake.band.is_some() || shake.duration.is_some();
        if ui.add_enabled(own, egui::Button::new(tr("Usual band"))).clicked() {
            (shake.band, shake.duration) = (None, None);
        }
    });
    let name = if shake.by == ShakenBy::Noise { tr("Level, rms") } else { tr("Level, peak") };
    let first = from.min(to);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 20.0;
        slider(ui, name, &mut shake.level, (LEVELS.0.max(1e-4), LEVELS.1.min(10.0)), "g");
        let longest = (DURATIONS.0.max(0.1 * lasts), DURATIONS.1.min(10.0 * lasts));
        if slider(ui, tr("Duration"), &mut lasts, longest, "s") {
            shake.duration = Some(lasts);
        }
        let usual = (0.05 * first, 50.0 * first);
        let changed =
            slider(ui, tr("From"), &mut from, usual, "Hz") | slider(ui, tr("To"), &mut to, usual, "Hz");
        if changed {
            shake.band = Some((from, to));
        }
    });
}

/// Of a recording: how to bring it, how its file is read, and what is done to it.
fn recording(context: &mut Context<'_>, ui: &mut Ui, shake: &mut ShakeView) {
    let tokens = theme::tokens(ui);
    let line = |ui: &mut Ui, text: String, colour| {
        ui.add(Label::new(RichText::new(text).small().color(colour)).wrap());
    };
    let bench = context.bench;
    if let Some(error) = &bench.vibration.error {
        line(ui, format!("{error}."), tokens.danger);
    }
    let found = recorded(context.view, bench);
    if let Some(progress) = bench.vibration.progress() {
        line(ui, super::super::reading(progress), tokens.text_weak);
    } else if found.is_none() {
        let text = match &shake.recording {
            Some(recording) => fill(
                "The recording {name} does not travel in a link: drop its file here, or open it.",
                &[("name", &recording.name)],
            ),
            None => tr(
                "Drop a file with columns of time and acceleration here, or open one. It stays in this browser.",
            )
            .to_owned(),
        };
        line(ui, text, tokens.text_weak);
    }
    ui.horizontal_wrapped(|ui| {
        if ui.button(tr("Open a file")).clicked() {
            context.commands.push(Command::OpenFile);
        }
        if bench.vibration.file.is_none() && ui.button(tr("Try it with a noise")).clicked() {
            context.commands.push(Command::RecordNoise);
        }
    });
    if let Some(found) = found {
        described(context, ui, found);
        let highest = band(context.view).1;
        let mut to = highest;
        ui.horizontal_wrapped(|ui| {
            let (least, nyquist) = (1.0 / found.duration, 0.5 / found.interval);
            if slider(ui, tr("Up to"), &mut to, (least.min(highest), nyquist.max(highest)), "Hz") {
                shake.band = Some((band(context.view).0.min(to), to));
            }
        });
        let mut centred = !shake.with_mean;
        let mean = significant(found.mean, 2);
        ui.checkbox(&mut centred, fill("take its mean of {mean} g away", &[("mean", &mean)]));
        shake.with_mean = !centred;
    }
    if let Some(file) = &bench.vibration.file {
        if file.ask.is_some() {
            columns::preview(ui, file, Kind::Acceleration);
            columns::reading(context, ui, file, Kind::Acceleration);
        } else {
            ui.collapsing(fill("how {name} is read", &[("name", &file.name)]), |ui| {
                columns::reading(context, ui, file, Kind::Acceleration);
            });
        }
    }
}

/// What a recording is, and what was done to it.
fn described(context: &Context<'_>, ui: &mut Ui, found: &BaseRecording) {
    let weak = theme::tokens(ui).text_weak;
    let level = fill(
        "{name}: {samples} samples in {seconds} s, {rms} g rms about the mean.",
        &[
            ("name", &found.recording.name),
            ("samples", &found.time.len()),
            ("seconds", &short(found.duration)),
            ("rms", &significant(found.rms, 3)),
        ],
    );
    let interval = with_unit(found.interval, "s");
    let taken = if found.even {
        fill("They are {interval} apart.", &[("interval", &interval)])
    } else {
        fill(
            "They are not equally far apart: taken anew every {interval}, by cubics.",
            &[("interval", &interval)],
        )
    };
    let highest = band(context.view).1;
    let limited = if found.is_limited(highest) {
        fill("Above {highest} Hz everything is filtered out.", &[("highest", &short(highest))])
    } else {
        tr("Nothing is filtered out at high frequencies.").to_owned()
    };
    ui.add(Label::new(RichText::new(format!("{level} {taken} {limited}")).small().color(weak)).wrap());
}
