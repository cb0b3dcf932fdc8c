//! The fit of the device to measured voltages: what is fitted, what came out, and with which errors.

use egui::{RichText, Ui};
use egui_plot::PlotPoint;

use crate::app::bench::measured::{FITTED, File, fit};
use crate::app::command::Command;
use crate::app::panels::{Context, computing};
use crate::app::text::{fill, say, tr};
use crate::app::theme;
use crate::app::widgets::number::{significant, with_unit};
use crate::model::Dimension;
use crate::questions::design::measured::Kind;
use crate::questions::fit::FitStudy;
use crate::questions::motions::{Coordinate, at_place};
use crate::scheduler::{Asked as _, Study as _};
use crate::sentence::Sentence;

/// Digits of a value, and of its error.
const DIGITS: usize = 4;
const DIGITS_OF_ERROR: usize = 2;

/// Start and result over frequency (Hz, V), as far as they are known.
pub(in crate::app::panels) fn curves(context: &Context<'_>, file: &File) -> [Vec<PlotPoint>; 2] {
    let Some(study) = context.studies.lanes.study::<FitStudy>() else { return Default::default() };
    let (_, asked) = study.asked();
    if asked.data != fit(file, context.view).1.data {
        return Default::default();
    }
    let curve = |volts: Option<&[f64]>| {
        let mut points: Vec<PlotPoint> = volts
            .unwrap_or_default()
            .iter()
            .zip(&asked.data)
            .map(|(volts, [hertz, _])| PlotPoint::new(*hertz, *volts))
            .collect();
        points.sort_by(|a, b| a.x.total_cmp(&b.x));
        points
    };
    [curve(study.start_curve()), curve(study.curve())]
}

/// The ticks, the button and the result.
pub(in crate::app::panels) fn controls(context: &mut Context<'_>, ui: &mut Ui, file: &File) {
    let tokens = theme::tokens(ui);
    let line = |ui: &mut Ui, text: String, colour: egui::Color32| {
        ui.add(egui::Label::new(RichText::new(text).small().color(colour)).wrap());
    };
    let text = tr("What is fitted to the measured voltages; the device in view is the start.");
    line(ui, text.to_owned(), tokens.text_weak);
    let mut reading = file.reading;
    let magnets = context.view.scenario.parameters.c0 != 0.0;
    for (dimension, ticked) in FITTED.into_iter().zip(&mut reading.fitted) {
        let there = magnets || dimension != Dimension::MagnetDistance;
        *ticked &= there;
        ui.add_enabled(there, egui::Checkbox::new(ticked, tr(dimension.fact().title)));
    }
    if reading != file.reading {
        context.commands.push(Command::Measure(Kind::Voltage, Some(reading)));
    }
    let any = reading.fitted.contains(&true) && file.points.len() > 1;
    if ui.add_enabled(any, egui::Button::new(tr("Fit"))).clicked() {
        context.commands.push(Command::Fit);
    }
    if let Some(reason) = &context.bench.refusal {
        line(ui, say(reason), tokens.danger);
    }
    let Some(study) = context.studies.lanes.study::<FitStudy>() else { return };
    let (scenario, asked) = study.asked();
    let (now, wanted) = fit(file, context.view);
    if *scenario != now || asked.data != wanted.data {
        line(ui, tr("It began from another device or other data.").to_owned(), tokens.text_weak);
    }
    if let Some(why) = study.failure() {
        return line(ui, say(why), tokens.danger);
    }
    if !study.finished() {
        line(ui, computing(study.progress()), tokens.text);
    }
    for fitted in study.fitted() {
        let Some(dimension) = Dimension::named(fitted.name) else { continue };
        let fact = dimension.fact();
        let unit = scenario.scaling.unit(fact.shown.0);
        let value = significant(fact.shown.1 * fitted.value, DIGITS);
        let name = tr(fact.title);
        let text = match fitted.standard_error {
            // An error as large as the value says no more than no error.
            Some(error) if error < fitted.value => {
                let error = significant(fact.shown.1 * error, DIGITS_OF_ERROR);
                fill(
                    "{name}: {value} ± {error} {unit}",
                    &[("name", &name), ("value", &value), ("error", &error), ("unit", &unit)],
                )
            }
            _ => fill(
                "{name}: {value} {unit}, of which the data tell too little",
                &[("name", &name), ("value", &value), ("unit", &unit)],
            ),
        };
        line(ui, text, tokens.text);
    }
    let [before, after] = study.left().map(|left| with_unit(left, tr("V rms")));
    line(
        ui,
        fill("left between them: {before} before, {after} after", &[("before", &before), ("after", &after)]),
        tokens.text,
    );
    if study.finished() && !study.converged() {
        line(ui, tr("The fit has not settled.").to_owned(), tokens.warning);
    }
    if study.finished() && ui.button(tr("Use it")).clicked() {
        let (dimensions, values): (Vec<Coordinate>, Vec<f64>) = study
            .values()
            .into_iter()
            .map(|(dimension, value)| (Coordinate::Dimension(dimension), value))
            .unzip();
        let taken = at_place(&context.view.scenario, &dimensions, &values);
        context.commands.push(Command::Adopt(taken.map(Box::new).map_err(Sentence::from)));
    }
}
