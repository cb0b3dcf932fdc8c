//! What the device gives under anything but the sine, in sentences.

use egui::{RichText, Ui};

use super::shaken_by;
use crate::app::bench::Bench;
use crate::app::bench::shaking::{band, motion, question, runs};
use crate::app::command::Command;
use crate::app::crew::Studies;
use crate::app::panels::Context;
use crate::app::text::{fill, marked, say, tr};
use crate::app::theme;
use crate::app::view::View;
use crate::app::view::shake::ShakenBy;
use crate::app::widgets::Card;
use crate::app::widgets::number::{significant, with_unit};
use crate::model::base_motion::BaseMotion;
use crate::questions::batch_means::Harvested;
use crate::questions::shake::ShakeAnswer;
use crate::questions::shaken_run::{Found, ShakenRun};
use crate::scheduler::lane::Traffic;
use crate::scheduler::{Asked as _, Failure, Table};
use crate::sentence::Say;

/// Asks for the runs.
pub(in crate::app::panels) fn ask(asking: &mut super::super::spec::Asking<'_>) {
    if let Some(runs) = runs(asking.view, asking.bench) {
        asking.studies.tabulate(runs);
    }
}

/// The newest runs, when they are those of the shaking in view.
pub(in crate::app::panels) fn found<'a>(
    context: &Context<'a>,
) -> Option<Result<Vec<&'a Found>, &'a Failure>> {
    Some(in_view(context.view, context.bench, context.studies)?.found().flatten().collect())
}

/// The newest runs, finished or not, when they are those of the shaking in view.
fn in_view<'a>(view: &View, bench: &Bench, studies: &'a Studies) -> Option<&'a Table<ShakenRun>> {
    let study: &Table<ShakenRun> = studies.lanes.study()?;
    let wanted = runs(view, bench)?;
    (study.asked() == wanted.asked()).then_some(study)
}

/// What is said of runs that are not all there.
fn unfinished(runs: &Table<ShakenRun>, studies: &Studies) -> Option<(Meant, String)> {
    if runs.is_stopped() {
        return Some((Meant::Stopped, tr(STOPPED).to_owned()));
    }
    done(runs, studies).map(|part| (Meant::Computing, super::super::computing(part)))
}

/// How far `runs` are, 0 to 1, while they are under way.
fn done(runs: &Table<ShakenRun>, studies: &Studies) -> Option<f64> {
    let part = studies.lanes.lane::<Table<ShakenRun>>().and_then(Traffic::progress);
    part.filter(|_| !runs.is_stopped())
}

/// What is said of what was stopped.
pub(in crate::app::panels) const STOPPED: &str = marked("Stopped before its end.");

/// What the runs so far say.
pub(in crate::app::panels) fn summary(context: &Context<'_>) -> Option<ShakeAnswer> {
    question(context.view, context.bench)?.1.summary(&found(context)?.ok()?)
}

/// How far the runs under way are, 0 to 1, where what is in view is shaken by them.
pub(in crate::app::panels) fn under_way(context: &Context<'_>) -> Option<f64> {
    let Context { view, bench, studies, .. } = *context;
    let runs = view.shaken().and_then(|_| in_view(view, bench, studies))?;
    done(runs, studies)
}

/// Why there is nothing to show yet.
pub(in crate::app::panels) fn waiting(context: &Context<'_>) -> String {
    let Context { view, bench, studies, .. } = *context;
    let left = in_view(view, bench, studies).and_then(|runs| unfinished(runs, studies));
    left.map_or_else(|| waiting_for(view, bench), |(_, text)| text)
}

fn waiting_for(view: &View, bench: &Bench) -> String {
    if motion(view, bench, view.design.shake.level).is_some() {
        return tr("computing").to_owned();
    }
    bench.vibration.progress().map_or_else(|| tr("waits for a recording").to_owned(), super::super::reading)
}

/// Draws the card of the page Shake.
pub(super) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    Card::new(tr("The base is shaken")).hugging().show(ui, |ui| {
        shaken_by::choose(context, ui, false);
        shaken_by::controls(context, ui);
        ui.add_space(4.0);
        sentence(context, ui);
    });
}

/// Draws what stands in the verdict's place where the base is shaken so on other tabs.
pub(in crate::app::panels) fn in_place_of_verdict(context: &mut Context<'_>, ui: &mut Ui) {
    Card::new("").hugging().show(ui, |ui| sentence(context, ui));
}

/// Draws what stands in the verdict's place on the Live tab: what shakes the base, and where it is in that.
pub(in crate::app::panels) fn while_live(context: &mut Context<'_>, ui: &mut Ui) {
    let weak = theme::tokens(ui).text_weak;
    Card::new("").hugging().show(ui, |ui| {
        let (text, more) = match context.live.shaken() {
            None => (waiting_for(context.view, context.bench), String::new()),
            Some((shaking, time)) => {
                (now_shaken(context, &shaking.motion, time), anew(shaking.duration(), time))
            }
        };
        ui.add(egui::Label::new(RichText::new(text)).wrap());
        ui.add(egui::Label::new(RichText::new(more).small().color(weak)).wrap());
    });
}

fn now_shaken(context: &Context<'_>, motion: &BaseMotion, time: f64) -> String {
    let number = |value: f64| significant(value, 3);
    match motion {
        BaseMotion::Chirp(chirp) => fill(
            "The base is shaken by a sine of {level} g, now at {frequency} Hz.",
            &[("level", &number(chirp.acceleration)), ("frequency", &number(chirp.frequency(time)))],
        ),
        BaseMotion::Noise(_) => {
            let (from, to) = band(context.view);
            fill(
                "The base is shaken by noise of {level} g rms between {from} and {to} Hz: nothing repeats.",
                &[
                    ("level", &number(context.view.design.shake.level)),
                    ("from", &number(from)),
                    ("to", &number(to)),
                ],
            )
        }
        BaseMotion::Recorded(_) => {
            let name = context.view.design.shake.recording.as_ref().map_or("", |named| &named.name);
            fill("The base is shaken as recorded in {name}.", &[("name", &name)])
        }
    }
}

fn anew(duration: f64, time: f64) -> String {
    fill(
        "{time} s of {duration} s, then it begins anew.",
        &[("time", &format!("{time:.1}")), ("duration", &significant(duration, 4))],
    )
}

/// `12.3 µW (± 3 %)`, without the error where there is none.
fn power(found: &Harvested) -> String {
    let value = with_unit(found.power, "W");
    match found.power_error {
        Some(error) => format!("{value} (± {} %)", significant(100.0 * error / found.power, 2)),
        None => value,
    }
}

/// How a sentence is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::app) enum Meant {
    /// It says what came out.
    Found,
    /// Something ended early or failed.
    Warning,
    /// It is said beside.
    Aside,
    /// Something is under way, and can be stopped.
    Computing,
    /// Something was stopped, and can be taken up again.
    Stopped,
}

/// What the runs so far say, in sentences.
pub(in crate::app) fn said(view: &View, bench: &Bench, studies: &Studies) -> Vec<(Meant, String)> {
    let runs = in_view(view, bench, studies);
    let found: Result<Vec<&Found>, &Failure> = runs.iter().flat_map(|runs| runs.found().flatten()).collect();
    let found = match found {
        Ok(found) => found,
        Err(failure) => return vec![(Meant::Warning, say(failure))],
    };
    let left = runs.and_then(|runs| unfinished(runs, studies));
    let answer = question(view, bench).and_then(|(_, shake)| shake.summary(&found));
    let Some(answer) = answer else {
        let waiting = || (Meant::Aside, waiting_for(view, bench));
        return vec![left.unwrap_or_else(waiting)];
    };
    // First, so that its button does not move when there is more to say.
    let is_whole = left.is_none();
    let mut lines: Vec<_> = left.into_iter().collect();
    if answer.outcome != "completed" {
        let time = significant(answer.t_outcome, 3);
        let text = if answer.outcome == "contact" {
            fill("The magnets touch after {time} s: there the model ends.", &[("time", &time)])
        } else {
            fill("The tip escapes after {time} s: this force law lets it go.", &[("time", &time)])
        };
        lines.push((Meant::Warning, text));
    }
    let by = view.design.shake.by;
    if let (Some(own), Some(linear)) = (&answer.measured, &answer.linear) {
        let values = [power(own), power(linear)];
        let values = [("own", &values[0] as &dyn Say), ("linear", &values[1])];
        let text = match by {
            ShakenBy::Noise => fill(
                "On average it gives {own}; without its magnets, under the same noise, {linear}.",
                &values,
            ),
            ShakenBy::Chirp => {
                fill("Over the whole chirp it gives {own} on average; without its magnets {linear}.", &values)
            }
            ShakenBy::Recorded => fill(
                "Over the whole recording it gives {own} on average; without its magnets {linear}.",
                &values,
            ),
        };
        lines.push((Meant::Found, text));
    }
    lines.extend(answer.gain.map(|gain| (Meant::Found, gained(by, gain, answer.gain_error))));
    lines.extend(is_whole.then(|| (Meant::Aside, remark(by).to_owned())));
    lines
}

/// What is to be known of such a shaking.
fn remark(by: ShakenBy) -> &'static str {
    match by {
        ShakenBy::Noise => tr(
            "Under noise nothing repeats: there is no verdict, no Poincaré map and no branch, only means with their errors.",
        ),
        ShakenBy::Chirp => {
            tr("Where the motion jumps up and where it jumps down differ: that is hysteresis.")
        }
        ShakenBy::Recorded => {
            tr("One recording is one sample: how much of these means is chance cannot be known from it.")
        }
    }
}

/// What the magnets make of the power, and how sure that is.
fn gained(by: ShakenBy, gain: f64, error: Option<f64>) -> String {
    let times = significant(gain, 3);
    let ratio = || fill("That is {gain} times as much.", &[("gain", &times)]);
    match error {
        Some(error) => {
            let beyond = (gain - 1.0).abs() > 2.0 * error;
            let verdict = match (beyond, gain > 1.0) {
                (true, true) => tr("The magnets help."),
                (true, false) => tr("The magnets cost power."),
                (false, _) => tr("Whether the magnets help is not decided by runs so short."),
            };
            let ratio = fill(
                "That is {gain} ± {error} times as much.",
                &[("gain", &times), ("error", &significant(error, 2))],
            );
            format!("{ratio} {verdict}")
        }
        None if by == ShakenBy::Noise => {
            format!("{} {}", ratio(), tr("The runs are too short to say how sure that is."))
        }
        None => ratio(),
    }
}

fn sentence(context: &mut Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    for (meant, text) in said(context.view, context.bench, context.studies) {
        let colour = match meant {
            Meant::Found => tokens.text,
            Meant::Warning => tokens.danger,
            Meant::Aside | Meant::Computing | Meant::Stopped => tokens.text_weak,
        };
        let text = egui::Label::new(RichText::new(text).color(colour)).wrap();
        if !matches!(meant, Meant::Computing | Meant::Stopped) {
            ui.add(text);
            continue;
        }
        ui.horizontal_wrapped(|ui| {
            ui.add(text);
            let goes_on = meant == Meant::Stopped;
            if ui.button(if goes_on { tr("Compute") } else { tr("Stop") }).clicked() {
                context.commands.push(Command::Shake(goes_on));
            }
        });
    }
}
