//! What the oscilloscope and the phase portrait trace, and in which units.

use crate::app::command::Command;
use crate::app::live::Sample;
use crate::app::panels::Context;
use crate::app::text::tr;
use crate::app::view::live::{LiveView, Trace};
use crate::app::widgets::plot_style::Axis;
use crate::model::Units;

/// Asks for another view of the run.
pub(in crate::app::panels) fn look(context: &mut Context<'_>, change: impl FnOnce(&mut LiveView)) {
    let mut live = context.view.live;
    change(&mut live);
    context.commands.push(Command::LookLive(live));
}

/// The SI units, where the page shows them.
pub(in crate::app::panels) fn si(context: &Context<'_>) -> Option<Units> {
    (!context.view.design.dimensionless).then(|| context.view.scenario.units())
}

/// What is traced: the places of value and rate in a sample, their factors, and their axes.
pub(in crate::app::panels) struct Traced {
    pub(in crate::app::panels) value: usize,
    pub(in crate::app::panels) factors: [f64; 2],
    pub(in crate::app::panels) axes: [Axis; 2],
}

impl Traced {
    pub(in crate::app::panels) fn of(context: &Context<'_>) -> Self {
        let (time, length) = si(context).map_or((1.0, 1.0), |units| (units.time, units.millimetres(1.0)));
        let is_si = si(context).is_some();
        let unit = |axis: Axis, unit: &str| if is_si { axis.unit(unit) } else { axis };
        match context.view.live.trace {
            Trace::Voltage => {
                let rate = unit(Axis::new("", "dv/dt"), "V/s");
                let axes = [Axis::new(tr("voltage"), "v").unit("V"), rate];
                Self { value: 0, factors: [1.0, 1.0 / time], axes }
            }
            Trace::Tip => {
                let tip = unit(Axis::new(tr("tip"), "s"), "mm");
                let factors = [length, length / time];
                Self { value: 2, factors, axes: [tip, unit(Axis::new("", "ds/dt"), "mm/s")] }
            }
        }
    }

    /// Value and rate of a sample, as drawn.
    pub(in crate::app::panels) fn point(&self, sample: &Sample) -> [f64; 2] {
        [0, 1].map(|part| self.factors[part] * sample.values[self.value + part])
    }

    /// Half heights of the scales, as drawn.
    pub(in crate::app::panels) fn scales(&self, context: &Context<'_>) -> [f64; 2] {
        [0, 1].map(|part| self.factors[part] * context.live.trail.scales[self.value + part])
    }
}
