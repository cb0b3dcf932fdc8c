//! The beam in the present state.

use std::f64::consts::TAU;

use egui::Ui;

use super::Context;
use super::spec::{Place, Spec};
use crate::app::curves::{self, SIGHT};
use crate::app::text::{fill, marked, tr};
use crate::app::view::Tab;
use crate::app::widgets::BeamView;
use crate::app::widgets::number::short;

/// The beam, a picture.
pub(super) const PANEL: Spec = Spec::new(Place::Tab(Tab::Live), |_| tr("Live beam"), picture)
    .hint(hint)
    .without_plot()
    .embedded("live_beam", marked("Live beam"));

/// How fast it moves, next to the device.
fn hint(context: &Context<'_>) -> String {
    let Some(period) = context.live.period() else { return String::new() };
    let hertz = 1.0 / (period * context.view.scenario.units().time);
    let slower = hertz / context.view.live.speed;
    if (0.95..1.05).contains(&slower) {
        return tr("as fast as the device").to_owned();
    }
    if slower > 1.0 {
        return fill("{times} times slower than the device", &[("times", &short(slower))]);
    }
    fill("{times} times faster than the device", &[("times", &short(1.0 / slower))])
}

fn picture(context: &mut Context<'_>, ui: &mut Ui) {
    let live = context.live;
    let Some((system, state, now)) = live.now() else { return };
    let gap = system.equilibrium.gap;
    if !(now.values[2].abs() < SIGHT.max(2.0 * gap)) {
        ui.label(tr("The tip has left the picture."));
        return;
    }
    let shape = curves::beam(&live.shapes, state);
    let extremes = live.trail.extremes().map(|state| {
        let state = state.filter(|state| state.len() == system.dimension());
        state.map_or_else(Vec::new, |state| curves::beam(&live.shapes, state))
    });
    let within = |shape: &&[[f64; 2]]| !shape.is_empty() && shape.iter().all(|point| point[1].abs() < 1.0);
    let extremes: Vec<&[[f64; 2]]> = extremes.iter().map(Vec::as_slice).filter(within).collect();
    let p = &system.parameters;
    // Where the base is cannot be told from its acceleration: it is drawn at rest.
    let swings = context.live.shaken().is_none();
    let base = if swings { p.beta * (TAU * now.turns.fract()).sin() } else { 0.0 };
    let mut beam = BeamView::new(&shape).base(base).extremes(&extremes);
    if p.c0 != 0.0 {
        beam = beam.magnet(-gap, p.c0 < 0.0).gap((gap + now.values[2]) / gap);
    }
    let height = ui.available_height();
    beam.show(ui, height);
}
