//! What the device gives over the window of frequencies, in one sentence.

use egui::text::{LayoutJob, TextFormat};
use egui::{Color32, Ui};

use super::bands::{Enough, at_end, hertz_list, least};
use super::held::held;
use super::safety::{Judged, Safety};
use crate::app::bench::questions;
use crate::app::bench::variant::{best_curve, highest};
use crate::app::panels::verdict::in_a_line;
use crate::app::panels::{Context, computing};
use crate::app::text::{fill, tr};
use crate::app::widgets::number::{significant, with_unit};
use crate::app::{fonts, theme};
use crate::questions::design::Plant;
use crate::questions::harvest::HarvestStudy;
use crate::scheduler::{Asked as _, Study as _};

/// Part of the best power below which what rest leads to is told beside it.
const AS_MUCH: f64 = 0.9;

/// Draws the sentence, as far as it is known; faintly where it is about another question.
pub(super) fn show(context: &Context<'_>, ui: &mut Ui) {
    let Some(study) = curves(context) else { return };
    let tokens = theme::tokens(ui);
    let mut job = LayoutJob::default();
    let (scenario, question, _) = questions::harvest(context.view, context.session);
    let fade = if *study.asked() == (scenario, question) { 1.0 } else { 0.55 };
    for (text, colour) in pieces(context, study, ui) {
        let colour = colour.unwrap_or(tokens.text_strong).gamma_multiply(fade);
        // A number stays with its unit.
        job.append(
            &in_a_line(&[text]),
            0.0,
            TextFormat::simple(fonts::semibold(theme::size::BODY + 1.0), colour),
        );
    }
    ui.add(egui::Label::new(job).wrap());
    ui.add_space(4.0);
}

/// The curves that the sentence is about.
fn curves<'a>(context: &Context<'a>) -> Option<&'a HarvestStudy> {
    context.studies.lanes.study::<HarvestStudy>().filter(|study| study.failure().is_none())
}

/// Whether the sentence names the linear device's peak at this frequency (Hz).
pub(super) fn names_peak(context: &Context<'_>, frequency: f64) -> bool {
    let near = |study: &HarvestStudy| (study.linear().peak[0] / frequency - 1.0).abs() < 1e-2;
    curves(context).is_some_and(near)
}

/// Its parts, and the colour of what is not as the rest.
fn pieces(context: &Context<'_>, study: &HarvestStudy, ui: &Ui) -> Vec<(String, Option<Color32>)> {
    let (view, tokens) = (context.view, theme::tokens(ui));
    let load = Plant::new(&view.scenario).map_or(f64::NAN, |plant| plant.resistance());
    let into = if load.is_finite() {
        fill("into {load}", &[("load", &with_unit(load, "Ω"))])
    } else {
        tr("open circuit").to_owned()
    };
    let sign = |hertz: f64| if at_end(study.window(), hertz) { "≥\u{a0}" } else { "" };
    let gives = |power: f64, hertz: f64| {
        let power = sign(hertz).to_owned() + &with_unit(power, "W");
        fill("{what} at {hertz} Hz", &[("what", &power), ("hertz", &significant(hertz, 4))])
    };
    let [hertz, power] = study.linear().peak;
    let magnets = view.scenario.parameters.c0 != 0.0;
    let linear = if magnets {
        fill("without magnets {what}", &[("what", &gives(power, hertz))])
    } else {
        String::new()
    };
    let held = held(view);
    let shaken =
        |what: &str| fill("Shaken {held} it gives {what}", &[("held", &held), ("what", &what)]) + " " + &into;
    let curve = best_curve(study);
    let rest = if linear.is_empty() { String::new() } else { format!("; {linear}") };
    let Some(best) = curve.as_deref().and_then(highest) else {
        let so_far = if study.finished() {
            tr("no motion that lasts").to_owned()
        } else {
            computing(study.progress())
        };
        return vec![(shaken(&so_far) + &rest + ".", None)];
    };
    let least = least(view, study);
    let safety = Safety::of(view, context.session);
    let enough =
        Enough::new(curve.as_deref().unwrap_or_default(), least, safety.as_ref().map(|safety| safety.0));
    let (what, power) = (hertz_list(study.window(), &enough.bands), with_unit(least, "W"));
    let band = if enough.bands.is_empty() {
        fill(", nowhere {power} or more", &[("power", &power)])
    } else {
        fill(", {power} or more from {what}", &[("power", &power), ("what", &what)])
    };
    let mut parts = vec![(shaken(&gives(best.measures.power, best.frequency)) + &band, None)];
    let judged =
        safety.and_then(|safety| Judged::of(&safety, &view.scenario, &safety.0.demand(&best.measures)));
    if let Some(judged) = judged {
        let cut = enough.in_words(study.window()).map_or(String::new(), |text| format!(", {text}"));
        parts.push((format!(", {}{cut}", judged.in_words()), Some(judged.colour(tokens))));
    }
    let from_rest = highest(&study.rest_pieces()).map_or(0.0, |point| point.measures.power);
    let mut end = String::new();
    if study.finished() && from_rest < AS_MUCH * best.measures.power {
        end = fill("; from rest at most {power}", &[("power", &with_unit(from_rest, "W"))]);
    }
    end += &rest;
    if !study.finished() {
        end += &format!("; {}", computing(study.progress()));
    }
    parts.push((end + ".", None));
    parts
}
