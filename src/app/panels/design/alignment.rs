//! A measured record shifted over the computed run.

use std::f64::consts::TAU;

use egui::{RichText, Ui};
use egui_plot::PlotPoint;

use crate::app::bench::measured::File;
use crate::app::command::Command;
use crate::app::panels::Context;
use crate::app::session::Shown;
use crate::app::text::{fill, tr};
use crate::app::theme;
use crate::app::widgets::ParameterSlider;
use crate::app::widgets::number::with_unit;
use crate::questions::design::alignment::{align, left};
use crate::questions::design::measured::Kind;

/// Most excitation periods by which the run is moved: motions of up to four periods fit somewhere.
const REACH: f64 = 4.0;
/// Most excitation periods that are compared, most pairs of them, and computed voltages for each period.
const COMPARED: f64 = 40.0;
const PAIRS: usize = 400;
const PER_PERIOD: f64 = 120.0;
/// Points of the computed curve.
const POINTS: usize = 3000;
/// Excitation periods of the run that are shown before there is a record.
const BEFORE_A_RECORD: f64 = 12.0;

/// The computed voltage over the record's time: the end of the run, so much earlier as was chosen, at its end.
pub(in crate::app::panels) fn computed(context: &Context<'_>, file: &File) -> Vec<PlotPoint> {
    let (Some(shown), Some([first, last])) = (context.shown(), ends(file)) else { return Vec::new() };
    let unit = context.view.scenario.units().time;
    let end = shown.run.trajectory.end_time() - file.reading.shift * TAU / shown.scenario.parameters.omega;
    voltages(shown, end, (last - first) / unit, POINTS, |time| last + (time - end) * unit)
}

/// The end of the run in view in seconds and volts, where there is no record yet.
pub(in crate::app::panels) fn run_in_view(context: &Context<'_>) -> Vec<PlotPoint> {
    let Some(shown) = context.shown() else { return Vec::new() };
    let unit = context.view.scenario.units().time;
    let span = BEFORE_A_RECORD * TAU / shown.scenario.parameters.omega;
    voltages(shown, shown.run.trajectory.end_time(), span, POINTS / 4, |time| time * unit)
}

/// The computed voltage over `span` up to `end`, both dimensionless, at the places that `seconds` gives to its times.
fn voltages(
    shown: &Shown,
    end: f64,
    span: f64,
    count: usize,
    seconds: impl Fn(f64) -> f64,
) -> Vec<PlotPoint> {
    let mut curve = Vec::with_capacity(count);
    let span = span.min(end);
    if span > 0.0 {
        let voltage = shown.run.system.dimension() - 1;
        shown.run.trajectory.sample(end - span, end, count, |time, state| {
            curve.push(PlotPoint::new(seconds(time), state[voltage]));
        });
    }
    curve
}

/// The shift by hand and by itself, and what it leaves.
pub(in crate::app::panels) fn controls(context: &mut Context<'_>, ui: &mut Ui, file: &File) {
    let mut reading = file.reading;
    ui.add_space(4.0);
    let slider = ParameterSlider::new(tr("Shift"), "", &mut reading.shift, 0.0..=REACH).compact();
    let slider = slider.unit(tr("periods")).default_value(0.0);
    slider.tooltip(tr("By how many excitation periods the computed run is moved.")).show(ui);
    let compared = Compared::of(context, file);
    if ui.button(tr("Align")).clicked()
        && let Some(shift) = compared.as_ref().and_then(Compared::best)
    {
        reading.shift = shift;
    }
    if let Some(left) = compared.and_then(|compared| compared.left(file.reading.shift)) {
        let text = fill("what is left between them: {rms}", &[("rms", &with_unit(left, tr("V rms")))]);
        let colour = theme::tokens(ui).text;
        ui.add(egui::Label::new(RichText::new(text).small().color(colour)).wrap());
    }
    if reading != file.reading {
        context.commands.push(Command::Measure(Kind::Voltage, Some(reading)));
    }
}

/// First and last time of the record (s).
fn ends(file: &File) -> Option<[f64; 2]> {
    let (first, last) = (file.points.first()?, file.points.last()?);
    (last[0] > first[0]).then_some([first[0], last[0]])
}

/// The end of the record beside a run.
struct Compared<'a> {
    shown: &'a Shown,
    /// Time before the record's end (dimensionless), and voltage.
    record: Vec<[f64; 2]>,
    /// Of the excitation.
    period: f64,
}

impl<'a> Compared<'a> {
    /// None while there is no run, or where it is too short.
    fn of(context: &Context<'a>, file: &File) -> Option<Self> {
        let (shown, [first, last]) = (context.shown()?, ends(file)?);
        let unit = context.view.scenario.units().time;
        let period = TAU / shown.scenario.parameters.omega;
        let room = shown.run.trajectory.end_time() - REACH * period;
        let span = ((last - first) / unit).min(COMPARED * period).min(room);
        let begun = file.points.partition_point(|point| (point[0] - last) / unit < -span);
        let taken = file.points.get(begun..).filter(|taken| span > 0.0 && taken.len() > 2)?;
        let pairs = taken.iter().step_by(taken.len().div_ceil(PAIRS));
        let record = pairs.map(|point| [(point[0] - last) / unit, point[1]]).collect();
        Some(Self { shown, record, period })
    }

    /// What is left at a shift (excitation periods), in V rms.
    fn left(&self, shift: f64) -> Option<f64> {
        let run = &self.shown.run;
        let end = run.trajectory.end_time() - shift * self.period;
        let times: Vec<f64> = self.record.iter().map(|[time, _]| end + time).collect();
        let (voltage, mut voltages) = (run.system.dimension() - 1, Vec::with_capacity(times.len()));
        run.trajectory.read_at(&times, |_, state| voltages.push(state[voltage]));
        let differences =
            self.record.iter().zip(voltages).map(|([_, measured], computed)| measured - computed);
        Some(left(differences)).filter(|left| left.is_finite())
    }

    /// The shift (excitation periods) that leaves least.
    fn best(&self) -> Option<f64> {
        let run = &self.shown.run;
        let end = run.trajectory.end_time();
        let from = end + self.record.first()?[0] - REACH * self.period;
        let count = (PER_PERIOD * (end - from) / self.period) as usize + 2;
        let spacing = (end - from) / (count - 1) as f64;
        let (voltage, mut voltages) = (run.system.dimension() - 1, Vec::with_capacity(count));
        run.trajectory.sample(from, end, count, |_, state| voltages.push(state[voltage]));
        let between = |time: f64| {
            let place = ((end + time - from) / spacing).clamp(0.0, (count - 1) as f64);
            let low = (place as usize).min(count - 2);
            let part = place - low as f64;
            voltages[low] * (1.0 - part) + voltages[low + 1] * part
        };
        Some(align(&self.record, REACH * self.period, &between)?.shift / self.period)
    }
}
