//! The magnets' force over the range of the tip, as each force law has it.

use egui::Ui;
use egui_plot::PlotPoint;

use super::Context;
use super::spec::{Place, Spec};
use crate::app::text::{marked, tr};
use crate::app::theme;
use crate::app::view::design::Page;
use crate::app::widgets::number::prefix;
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Series, legend};
use crate::export::Pen;
use crate::questions::design::trust::{LAWS, force_beyond_linear};
use crate::spacing::equally_spaced;

/// Names of the laws compared, and what stands for each.
pub(super) const NAMES: [&str; 4] =
    [marked("quadratic"), marked("cubic"), marked("Taylor 5"), marked("exact")];
const LINES: [Series; 4] = [Series::Published, Series::Coupled, Series::Best, Series::Exact];
/// Points of a curve.
const POINTS: usize = 161;
/// How much of the range is shown beyond the motion on either side, and the range in gaps where there is no motion.
const MARGIN: f64 = 0.12;
const HALF_RANGE: f64 = 0.6;

/// The curves.
pub(super) const PANEL: Spec = Spec::new(Place::Page(Page::Trust), |_| tr("The magnets' force"), contents)
    .hint(|_| tr("beyond the linear part").to_owned())
    .embedded("force", marked("The magnets' force"));

fn contents(context: &mut Context<'_>, ui: &mut Ui) {
    let entries: Vec<(Series, &str)> = LINES.into_iter().zip(NAMES.map(tr)).collect();
    legend::legend(ui, &entries);
    match range(context) {
        Some(range) => plot(context, ui, range),
        None => plot_style::no_data(ui, ui.available_rect_before_wrap(), tr("There are no magnets.")),
    }
}

/// Lowest and highest tip displacement of the motion reached (beam lengths), and whether there is such a motion.
fn range(context: &Context<'_>) -> Option<(f64, f64, bool)> {
    let gap = context.session.boundaries.as_ref()?.gap?;
    let found = context.studies.operating(&context.view.scenario);
    let reached = found.and_then(|(operating, _)| operating.as_ref().ok()?.reached.harvest.as_ref());
    Some(match reached {
        Some(harvest) => (harvest.demand.tip.0, harvest.demand.tip.1, true),
        None => (-HALF_RANGE * gap, HALF_RANGE * gap, false),
    })
}

fn plot(context: &Context<'_>, ui: &mut Ui, (low, high, moves): (f64, f64, bool)) {
    let scenario = &context.view.scenario;
    let (Ok((system, _)), Ok(device)) = (scenario.validate(), scenario.device()) else { return };
    let units = scenario.units();
    let newton = device.bending_stiffness() / device.beam_length.powi(2);
    let margin = if moves { MARGIN * (high - low) } else { 0.0 };
    let places = equally_spaced((low - margin, high + margin), POINTS);
    let of = |law| places.clone().filter_map(move |tip| Some((tip, force_beyond_linear(&system, law, tip)?)));
    let curves = LAWS.map(|law| of.clone()(law).collect::<Vec<_>>());
    let largest = curves[0].iter().map(|(_, force)| (newton * force).abs()).fold(0.0, f64::max);
    let (factor, sign) = prefix(largest);
    let (x, y) = (
        Axis::new(tr("tip displacement"), "s").unit("mm"),
        Axis::new(tr("force beyond the linear part"), "R").unit(format!("{sign}N")),
    );
    let lines = curves.map(|curve| {
        let point =
            |(tip, force): (f64, f64)| PlotPoint::new(units.millimetres(tip), factor * newton * force);
        curve.into_iter().map(point).collect::<Vec<_>>()
    });
    let colour = theme::tokens(ui).ruler;
    plot_style::plot(ui, ("magnet force", y.title()), &x, &y).show(ui, |plot| {
        if moves {
            plot_style::rule(plot, true, tr("closest"), units.millimetres(low), colour, Pen::Line(1.0));
            plot_style::rule(plot, true, tr("farthest"), units.millimetres(high), colour, Pen::Line(1.0));
        }
        for ((line, kind), name) in lines.iter().zip(LINES).zip(NAMES) {
            plot_style::series(plot, kind, tr(name), line);
        }
    });
}
