//! What the shaking makes of the device over its level, under noise, or over its frequency, in a chirp.

use egui::Ui;
use egui_plot::PlotPoint;

use super::Context;
use super::design::shaking::{STOPPED, ask, found, waiting};
use super::spec::{Asking, Place, Spec};
use crate::app::bench::shaking::{chirp, levels, over_levels, recorded};
use crate::app::text::tr;
use crate::app::theme;
use crate::app::view::View;
use crate::app::view::design::Page;
use crate::app::view::shake::ShakenBy;
use crate::app::widgets::number::prefix;
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Series, legend};
use crate::export::Pen;
use crate::model::STANDARD_GRAVITY;
use crate::questions::batch_means::Harvested;
use crate::questions::shake::AtLevel;
use crate::scheduler::{Asked as _, Table};

/// The curves.
pub(super) const PANEL: Spec =
    Spec::new(Place::Page(Page::Shake), title, contents).asking(ask_both).hint(hint);

fn hint(context: &Context<'_>) -> String {
    let stopped = context.studies.lanes.study::<Table<AtLevel>>().is_some_and(Table::is_stopped);
    let by_noise = context.view.design.shake.by == ShakenBy::Noise;
    context.computing::<Table<AtLevel>>(if stopped && by_noise { tr(STOPPED) } else { "" })
}

fn title(view: &View) -> &'static str {
    match view.design.shake.by {
        ShakenBy::Noise => tr("Power over the level of the noise"),
        ShakenBy::Chirp => tr("Voltage over the frequency of the chirp"),
        ShakenBy::Recorded => tr("The recorded acceleration"),
    }
}

fn ask_both(asking: &mut Asking<'_>) {
    ask(asking);
    if asking.view.design.shake.by == ShakenBy::Noise
        && let Some(levels) = over_levels(asking.view, asking.bench)
    {
        asking.studies.tabulate(levels);
        asking.studies.shake_over_levels();
    }
}

fn contents(context: &mut Context<'_>, ui: &mut Ui) {
    match context.view.design.shake.by {
        ShakenBy::Noise => over_level(context, ui),
        ShakenBy::Chirp => over_frequency(context, ui),
        ShakenBy::Recorded => recording(context, ui),
    }
}

fn over_level(context: &Context<'_>, ui: &mut Ui) {
    let wanted = over_levels(context.view, context.bench);
    let study = context.studies.lanes.study::<Table<AtLevel>>();
    let asked =
        |study: &&Table<AtLevel>| wanted.as_ref().is_some_and(|wanted| study.asked() == wanted.asked());
    let Some(study) = study.filter(asked) else {
        return plot_style::no_data(ui, ui.available_rect_before_wrap(), &waiting(context));
    };
    legend::legend(
        ui,
        &[
            (Series::Reached, tr("the device, with its standard error")),
            (Series::Linear, tr("without magnets")),
            (Series::Beyond, tr("every run ends early")),
        ],
    );
    let x = Axis::new(tr("acceleration, rms"), "a").unit("g").logarithmic();
    let found = || study.found().flatten().flatten();
    let powers = found().flat_map(|found| found.own.iter().chain(&found.linear)).map(|of| of.power);
    let (factor, sign) = prefix(powers.fold(0.0, f64::max));
    let y = Axis::new(tr("mean power"), "P").unit(format!("{sign}W")).logarithmic();
    let place = |level: f64, power: f64| PlotPoint::new(x.coordinate(level), y.coordinate(factor * power));
    let (mut own, mut linear, mut bars, mut ended) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for (level, found) in levels(context.view).into_iter().zip(study.found()) {
        let Some(Ok(found)) = found else { continue };
        let mut bar = |of: &Harvested| {
            let error = of.power_error.unwrap_or(0.0);
            bars.push([
                place(level, (of.power - error).max(0.01 * of.power)),
                place(level, of.power + error),
            ]);
        };
        if let Some(of) = &found.linear {
            linear.push(place(level, of.power));
            bar(of);
        }
        match (&found.own, &found.linear) {
            (Some(of), _) => {
                own.push(place(level, of.power));
                bar(of);
            }
            (None, Some(linear)) => ended.push(place(level, linear.power)),
            (None, None) => {}
        }
    }
    let here = x.coordinate(context.view.design.shake.level);
    let tokens = theme::tokens(ui);
    plot_style::plot(ui, ("power over the level", sign), &x, &y).show(ui, |plot| {
        plot_style::rule(plot, true, "", here, tokens.ruler, Pen::Line(1.0));
        for bar in &bars {
            plot_style::curve(plot, tr("standard error"), tokens.text_weak, Pen::Line(1.5), bar);
        }
        plot_style::series(plot, Series::Linear, tr("without magnets"), &linear);
        plot_style::points(plot, Series::Reached, tr("the device"), &own);
        plot_style::points(plot, Series::Beyond, tr("every run ends early"), &ended);
    });
}

fn over_frequency(context: &Context<'_>, ui: &mut Ui) {
    let runs = found(context).and_then(Result::ok).unwrap_or_default();
    if runs.is_empty() {
        return plot_style::no_data(ui, ui.available_rect_before_wrap(), &waiting(context));
    }
    legend::legend(
        ui,
        &[
            (Series::Up, tr("going up")),
            (Series::Down, tr("going down")),
            (Series::Linear, tr("without magnets")),
        ],
    );
    let chirp = chirp(context.view, context.view.design.shake.level);
    let turn = 0.5 * chirp.duration;
    let curve = |magnets: bool, back: bool| -> Vec<PlotPoint> {
        let trace = runs.iter().filter(|run| run.magnets == magnets).flat_map(|run| &run.trace);
        let part = trace.filter(|(time, _)| (*time > turn) == back);
        part.map(|(time, voltage)| PlotPoint::new(chirp.frequency(*time), voltage.abs())).collect()
    };
    let (up, down, linear) = (curve(true, false), curve(true, true), curve(false, false));
    let (x, y) = (Axis::new(tr("frequency"), "f").unit("Hz"), Axis::new(tr("voltage"), "|v|").unit("V"));
    plot_style::plot(ui, "over the chirp", &x, &y).include_y(0.0).show(ui, |plot| {
        plot_style::series(plot, Series::Linear, tr("without magnets"), &linear);
        plot_style::points(plot, Series::Up, tr("going up"), &up);
        plot_style::points(plot, Series::Down, tr("going down"), &down);
    });
}

/// What the base does, as it was brought.
fn recording(context: &Context<'_>, ui: &mut Ui) {
    let file = recorded(context.view, context.bench).and(context.bench.vibration.file.as_ref());
    let Some(file) = file else {
        return plot_style::no_data(ui, ui.available_rect_before_wrap(), &waiting(context));
    };
    legend::legend(ui, &[(Series::Measured, tr("recorded"))]);
    let points: Vec<PlotPoint> =
        file.drawn.iter().map(|point| PlotPoint::new(point.x, point.y / STANDARD_GRAVITY)).collect();
    let (x, y) = (Axis::new(tr("time"), "t").unit("s"), Axis::new(tr("acceleration"), "a").unit("g"));
    let colour = theme::tokens(ui).theory;
    plot_style::plot(ui, ("recorded", file.name.as_str()), &x, &y)
        .show(ui, |plot| plot_style::curve(plot, tr("recorded"), colour, Pen::Line(1.4), &points));
}
