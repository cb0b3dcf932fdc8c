//! The Live tab: controls, oscilloscope, phase portrait and beam of a run in which time goes on.

pub(super) mod beam;
mod controls;
pub(super) mod portrait;
mod readout;
pub(super) mod scope;

use egui::{Ui, vec2};

use super::grid::{GAP, LEAST_HEIGHT, TWO_COLUMNS, place};
use super::{Context, plots};
use crate::app::view::Panel;
use crate::app::view::live::{LiveView, Trace};
use crate::app::widgets::plot_style::Axis;
use crate::model::Units;

/// Share of the height that the oscilloscope takes.
const SCOPE: f32 = 0.42;

/// The cards, widest first.
pub(in crate::app) const PANELS: [Panel; 3] = [Panel::Oscilloscope, Panel::LivePortrait, Panel::LiveBeam];

/// Draws the tab.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    controls::show(context, ui);
    ui.add_space(GAP);
    let width = ui.available_width();
    if context.view.enlarged.is_some_and(|panel| PANELS.contains(&panel)) || width < TWO_COLUMNS {
        return plots::cards(context, ui, &PANELS);
    }
    let height = ui.available_height() - GAP;
    let top = (SCOPE * height).floor().max(LEAST_HEIGHT - 30.0);
    place(ui, width, top, &mut |ui| scope::show(context, ui));
    ui.add_space(GAP - ui.spacing().item_spacing.y);
    let (bottom, half) = ((height - top).max(LEAST_HEIGHT), (0.5 * (width - GAP)).floor());
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing = vec2(GAP, 0.0);
        place(ui, half, bottom, &mut |ui| portrait::show(context, ui));
        place(ui, half, bottom, &mut |ui| beam::show(context, ui));
    });
}

/// Asks for another view of the run.
fn look(context: &mut Context<'_>, change: impl FnOnce(&mut LiveView)) {
    let mut live = context.view.live;
    change(&mut live);
    context.commands.push(super::Command::LookLive(live));
}

/// The SI units, where the page shows them.
fn si(context: &Context<'_>) -> Option<Units> {
    (!context.view.design.dimensionless).then(|| context.view.scenario.units())
}

/// What is traced: the places of value and rate in a sample, their factors, and their axes.
struct Traced {
    value: usize,
    factors: [f64; 2],
    axes: [Axis; 2],
}

impl Traced {
    fn of(context: &Context<'_>) -> Self {
        let (time, length) = si(context).map_or((1.0, 1.0), |units| (units.time, units.millimetres(1.0)));
        let is_si = si(context).is_some();
        let unit = |axis: Axis, unit: &str| if is_si { axis.unit(unit) } else { axis };
        match context.view.live.trace {
            Trace::Voltage => {
                let rate = unit(Axis::new("", "dv/dt"), "V/s");
                let axes = [Axis::new(crate::app::text::tr("voltage"), "v").unit("V"), rate];
                Self { value: 0, factors: [1.0, 1.0 / time], axes }
            }
            Trace::Tip => {
                let tip = unit(Axis::new(crate::app::text::tr("tip"), "s"), "mm");
                let factors = [length, length / time];
                Self { value: 2, factors, axes: [tip, unit(Axis::new("", "ds/dt"), "mm/s")] }
            }
        }
    }

    /// Value and rate of a sample, as drawn.
    fn point(&self, sample: &crate::app::live::Sample) -> [f64; 2] {
        [0, 1].map(|part| self.factors[part] * sample.values[self.value + part])
    }

    /// Half heights of the scales, as drawn.
    fn scales(&self, context: &Context<'_>) -> [f64; 2] {
        [0, 1].map(|part| self.factors[part] * context.live.trail.scales[self.value + part])
    }
}
