//! Going to another frequency or load, as a click on a curve or a recommendation asks.

use crate::app::bench::questions;
use crate::app::command::Command;
use crate::app::panels::Context;
use crate::app::view::View;
use crate::app::widgets::number::round_significant;

/// Goes to a frequency (Hz), at the acceleration or the amplitude that is held.
pub(in crate::app::panels) fn go_to(context: &mut Context<'_>, frequency: f64) {
    let mut view = context.view.clone();
    let units = view.scenario.units();
    let p = &mut view.scenario.parameters;
    let omega = round_significant(units.omega(frequency), 5);
    if view.design.holds_acceleration {
        p.beta *= (p.omega / omega).powi(2);
    }
    p.omega = omega;
    keep_window(context, &view);
    context.commands.push(Command::Show(Box::new(view.scenario)));
}

/// Keeps the curves' window as it is where it would follow the frequency to that of `view`.
fn keep_window(context: &mut Context<'_>, view: &View) {
    let [before, after] = [context.view, view].map(|view| questions::window(view, context.session));
    let same = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-9;
    if !same(before.0, after.0) || !same(before.1, after.1) {
        let hertz = |omega| round_significant(view.scenario.units().hertz(omega), 12);
        context.redesign(|design| design.window = Some((hertz(before.0), hertz(before.1))));
    }
}

/// Makes `resistance` (ohm) the load.
pub(in crate::app::panels) fn use_load(context: &mut Context<'_>, resistance: f64) {
    let resistance = round_significant(resistance, 4);
    // After another wish of this frame, if there is one.
    let waiting = context.commands.iter().rev().find_map(|command| match command {
        Command::Show(scenario) => Some((**scenario).clone()),
        _ => None,
    });
    let before = waiting.unwrap_or_else(|| context.view.scenario.clone());
    context.edit(|scenario| {
        *scenario = before;
        scenario.parameters.kappa = 1.0 / (scenario.units().power * resistance);
    });
}
