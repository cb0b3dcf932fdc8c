//! Going to another frequency or load, as a click on a curve or a recommendation asks.

use crate::app::command::Command;
use crate::app::panels::Context;
use crate::app::widgets::number::round_significant;

/// Goes to a frequency (Hz), at the acceleration or the amplitude that is held.
pub(in crate::app::panels) fn go_to(context: &mut Context<'_>, frequency: f64) {
    let holds = context.view.design.holds_acceleration;
    context.edit(|scenario| {
        let units = scenario.units();
        let p = &mut scenario.parameters;
        let omega = round_significant(units.omega(frequency), 5);
        if holds {
            p.beta *= (p.omega / omega).powi(2);
        }
        p.omega = omega;
    });
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
