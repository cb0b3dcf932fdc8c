//! The oscilloscope: what is traced over the last excitation periods.

use egui::{RichText, Ui};
use egui_plot::{PlotBounds, PlotPoint};

use super::Context;
use super::live::traced::{Traced, look, si};
use super::spec::{Place, Spec};
use crate::app::live::Sample;
use crate::app::text::{marked, tr};
use crate::app::theme;
use crate::app::view::Tab;
use crate::app::view::live::Trace;
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Series, chips, row};
use crate::export::Pen;

/// Excitation periods a second from which the trace stands still between triggers instead of rolling.
const TRIGGERED_FROM: f64 = 6.0;
/// Windows to choose from: periods of doubled motions divide all of them.
const WINDOWS: [(usize, &str); 3] = [(4, "4"), (12, "12"), (48, "48")];

/// The oscilloscope.
pub(super) const PANEL: Spec = Spec::new(Place::Tab(Tab::Live), |_| tr("Oscilloscope"), contents)
    .hint(|context| if triggered(context) { tr("triggered at phase 0") } else { tr("rolling") }.to_owned())
    .embedded("oscilloscope", marked("Oscilloscope"));

fn triggered(context: &Context<'_>) -> bool {
    // Without a period there is no phase to wait for.
    context.view.live.speed >= TRIGGERED_FROM && context.live.shaken().is_none()
}

fn contents(context: &mut Context<'_>, ui: &mut Ui) {
    choices(context, ui);
    plot(context, ui, triggered(context));
}

fn choices(context: &mut Context<'_>, ui: &mut Ui) {
    let mut live = context.view.live;
    let weak = theme::tokens(ui).text_weak;
    row(ui, |ui| {
        let traces = [(Trace::Voltage, tr("voltage")), (Trace::Tip, tr("tip"))];
        chips(ui, tr("Trace"), &mut live.trace, &traces);
        chips(ui, tr("Periods across"), &mut live.periods, &WINDOWS);
        ui.label(RichText::new(tr("periods")).small().color(weak));
    });
    if live != context.view.live {
        look(context, |view| *view = live);
    }
}

fn plot(context: &Context<'_>, ui: &mut Ui, triggered: bool) {
    let (Some(period), Some(now)) = (context.live.period(), context.live.present()) else { return };
    let traced = Traced::of(context);
    let (units, periods) = (si(context), context.view.live.periods as f64);
    // From turns or time to the axis, where the window begins at 0 or ends there.
    let unit = units.map_or(1.0 / period, |units| units.time);
    let begun = if triggered { (now.turns / periods).floor() * periods } else { now.turns - periods };
    let across = |sample: &Sample, from: f64| match units {
        // The period may have changed on the way.
        Some(_) if triggered => {
            start(context, from, period, &now).map_or(0.0, |time| sample.time - time) * unit
        }
        Some(_) => (sample.time - now.time) * unit,
        None if triggered => sample.turns - from,
        None => sample.turns - now.turns,
    };
    let width = units.map_or(periods, |_| periods * period * unit);
    let place = |sample: &Sample, from: f64| PlotPoint::new(across(sample, from), traced.point(sample)[0]);
    let trail = &context.live.trail;
    let mut present: Vec<PlotPoint> = trail.since(begun).map(|sample| place(sample, begun)).collect();
    present.push(place(&now, begun));
    let mut before: Vec<PlotPoint> = Vec::new();
    if triggered {
        let last = begun - periods;
        let head = present.last().map_or(0.0, |point| point.x);
        let samples = trail.since(last).take_while(|sample| sample.turns <= begun);
        before.extend(samples.map(|sample| place(sample, last)).filter(|point| point.x > head));
    }
    let x = match units {
        Some(_) => Axis::new(tr("time"), "t").unit("s"),
        None if context.live.shaken().is_some() => Axis::new(tr("natural periods"), "ω₁t/2π"),
        None => Axis::new(tr("excitation periods"), "ωt/2π"),
    };
    let [height, _] = traced.scales(context);
    let [y, _] = &traced.axes;
    let bounds = if triggered { [0.0, width] } else { [-width, 0.0] };
    let tokens = theme::tokens(ui);
    plot_style::fixed(ui, "oscilloscope", &x, y).show(ui, |plot| {
        plot.set_plot_bounds(PlotBounds::from_min_max([bounds[0], -height], [bounds[1], height]));
        plot_style::rule(plot, false, "", 0.0, tokens.ruler, Pen::Line(1.0));
        for kick in context.live.trail.kicks.iter().filter(|kick| kick.turns >= begun) {
            let place = place(kick, begun);
            plot_style::rule(plot, true, tr("kick"), place.x, tokens.warning, Pen::Dashes(1.6, 6.0));
        }
        let faint = tokens.numeric.gamma_multiply(0.4);
        plot_style::curve(plot, tr("sweep before"), faint, Pen::Line(1.5), &before);
        plot_style::series(plot, Series::Numeric, y.symbol(), &present);
        if let Some(head) = present.last().filter(|_| triggered) {
            plot_style::points(plot, Series::Numeric, y.symbol(), std::slice::from_ref(head));
        }
    });
}

/// The time at which the window that began at `turns` did so; by the present period where that is not on record.
fn start(context: &Context<'_>, turns: f64, period: f64, now: &Sample) -> Option<f64> {
    let first = context.live.trail.since(turns).next();
    let reference = first.filter(|sample| sample.turns < turns + 1.0).unwrap_or(now);
    let time = reference.time - (reference.turns - turns) * period;
    time.is_finite().then_some(time)
}
