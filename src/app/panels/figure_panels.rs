//! Panels (a) to (d) of a response figure.

use egui::Ui;
use egui_plot::PlotPoint;

use super::{Context, phase_plane};
use crate::app::figures::Figure;
use crate::app::session::Shown;
use crate::app::text::tr;
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Card, Icon, Series};
use crate::theory::SteadyState;

/// Points of a drawn history.
const POINTS: usize = 2400;
/// Theory dots on a period in the terminal interval.
const DOTS_PER_PERIOD: f64 = 15.0;

/// The panels, as the paper letters them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Letter {
    InitialHistory,
    TerminalHistory,
    PhaseDiagram,
    PoincareMap,
}

/// The panels of a figure: an escape has no terminal interval and no Poincare map.
pub(super) fn panels(figure: &Figure) -> &'static [Letter] {
    use Letter::{InitialHistory, PhaseDiagram, PoincareMap, TerminalHistory};
    if figure.number == 12 {
        &[InitialHistory, PhaseDiagram]
    } else {
        &[InitialHistory, TerminalHistory, PhaseDiagram, PoincareMap]
    }
}

impl Letter {
    /// The card's title.
    pub(super) fn title(self, figure: &Figure) -> &'static str {
        match self {
            Self::InitialHistory => tr("(a)  Initial history"),
            Self::TerminalHistory if figure.number == 4 => tr("(b)  Long-term response"),
            Self::TerminalHistory => tr("(b)  Steady-state response"),
            Self::PhaseDiagram if figure.number == 12 => tr("(b)  Phase diagram"),
            Self::PhaseDiagram => tr("(c)  Phase diagram"),
            Self::PoincareMap => tr("(d)  Poincaré map"),
        }
    }
}

/// Draws one panel as a card; the index of the one of these `others` that was chosen in its place.
pub(super) fn show(
    context: &mut Context<'_>,
    ui: &mut Ui,
    figure: &Figure,
    letter: Letter,
    others: &[&str],
) -> Option<usize> {
    let title = letter.title(figure);
    let (initial_until, window) = figure.windows()?;
    let with_theory = letter != Letter::InitialHistory && figure.number != 12;
    let hint = if with_theory { tr("dots: first-order theory") } else { "" };
    let shown = Card::new(title).hint(hint).among(others).exports().show(ui, |ui| {
        if context.is_stale() {
            ui.multiply_opacity(0.55);
        }
        let Some(shown) = context.shown() else { return };
        match letter {
            Letter::InitialHistory => history(ui, figure, shown, [0.0, initial_until], false),
            Letter::TerminalHistory => history(ui, figure, shown, window, true),
            Letter::PhaseDiagram => phase(ui, figure, shown),
            Letter::PoincareMap => strobe(ui, figure, shown),
        }
    });
    context.export(title, shown.export);
    if shown.pressed == Some(Icon::Record) {
        context.record(ui, title, shown.rect);
    }
    shown.chosen
}

fn history(ui: &mut Ui, figure: &Figure, shown: &Shown, [from, to]: [f64; 2], theory: bool) {
    let run = &shown.run;
    // A run of another length shows its own last stretch.
    let late = if theory { (to - run.trajectory.end_time()).max(0.0) } else { 0.0 };
    let (from, to) = ((from - late).max(0.0), (to - late).min(run.trajectory.end_time()));
    let voltage = run.system.dimension() - 1;
    let mut curve = Vec::with_capacity(POINTS);
    if from < to {
        run.trajectory
            .sample(from, to, POINTS, |time, state| curve.push(PlotPoint::new(time, state[voltage])));
    }
    let spacing = run.system.parameters.period() / DOTS_PER_PERIOD;
    let dots: Vec<PlotPoint> = match SteadyState::new(&run.system) {
        Ok(steady) if theory => (0..=((to - from) / spacing).max(0.0) as usize)
            .map(|i| from + spacing * i as f64)
            .map(|time| PlotPoint::new(time, steady.voltage.value(time)))
            .collect(),
        _ => Vec::new(),
    };
    let (x, y) = (Axis::new(tr("time"), "t"), Axis::new(tr("voltage"), "v").unit("V"));
    plot_style::plot(ui, ("figure history", figure.number, theory), &x, &y).show(ui, |plot| {
        plot_style::series(plot, Series::Numeric, tr("computed"), &curve);
        plot_style::points(plot, Series::Theory, tr("first-order theory"), &dots);
    });
}

fn phase(ui: &mut Ui, figure: &Figure, shown: &Shown) {
    let curves = &shown.curves;
    phase_plane::plot(ui, ("figure phase", figure.number)).show(ui, |plot| {
        plot_style::series(plot, Series::Numeric, tr("computed"), &curves.phase);
        if figure.number != 12 {
            plot_style::points(plot, Series::Theory, tr("first-order theory"), &curves.theory_phase);
        }
    });
}

fn strobe(ui: &mut Ui, figure: &Figure, shown: &Shown) {
    let curves = &shown.curves;
    phase_plane::plot_around(ui, ("figure map", figure.number), curves.extent).show(ui, |plot| {
        if let Some(point) = &curves.theory_strobe {
            let place = std::slice::from_ref(point);
            plot_style::points(plot, Series::TheoryPoint, tr("first-order theory"), place);
        }
        plot_style::points(plot, Series::Poincare, tr("computed"), &curves.strobe);
    });
}
