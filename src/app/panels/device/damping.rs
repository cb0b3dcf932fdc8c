//! Damping as it is measured: the ratios of the first modes, of which two set material and air.

use egui::{RichText, Ui};

use crate::app::command::Command;
use crate::app::panels::Context;
use crate::app::panels::facts::round;
use crate::app::text::{fill, tr};
use crate::app::theme;
use crate::app::widgets::ParameterSlider;
use crate::app::widgets::number::significant;
use crate::scenario::ModelChoice;
use crate::sentence::Sentence;

/// Modes whose ratios are shown.
const SHOWN: usize = 3;
/// Smallest and largest ratio (%) on a slider.
const PERCENT: (f64, f64) = (0.01, 20.0);

/// Two sliders, and the ratio of the third mode.
pub(super) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    let scenario = &context.view.scenario;
    let model = ModelChoice { modes: scenario.model.modes.max(SHOWN), ..scenario.model };
    let Ok(system) = model.system(scenario.parameters) else { return };
    let ratios = system.damping_ratios();
    let percent = |ratio: f64| round(100.0 * ratio);
    let (mut first, mut second) = (percent(ratios[0]), percent(ratios[1]));
    let slider = |ui: &mut Ui, (name, symbol): (&str, &str), value: &mut f64, (low, high): (f64, f64)| {
        let (low, high) = (low.min(*value), high.max(*value));
        let tooltip = tr(
            "Measured damping ratio, 1/(2 Q), of a mode with the magnets' linear force. Two of them set the material's part \
             and the air's.",
        );
        let slider = ParameterSlider::new(name, symbol, value, low..=high).logarithmic();
        slider.unit("%").tooltip(tooltip).compact().show(ui).changed
    };
    let moved = slider(ui, (tr("Ratio, mode 1"), "ζ₁"), &mut first, PERCENT);
    // Between the air alone and the material alone.
    let extremes = |alone: &[f64]| {
        let shares = alone.first().zip(alone.get(1)).map(|(first, second)| second / first);
        shares.map(|share| round(100.0 * ratios[0] * share))
    };
    let alone = |alpha: f64, air: f64| {
        let set = crate::model::ParameterSet { alpha, air, ..scenario.parameters };
        model.system(set).map(|system| system.damping_ratios()).unwrap_or_default()
    };
    let ends = extremes(&alone(0.0, 0.01)).zip(extremes(&alone(1e-3, 0.0)));
    let changed = ends.is_some_and(|(least, most)| {
        least > 0.0 && least < most && slider(ui, (tr("Ratio, mode 2"), "ζ₂"), &mut second, (least, most))
    });
    if moved || changed {
        let mut damped = scenario.clone();
        let both = [first / 100.0, second / 100.0];
        // The material alone stays alone while only the first mode is damped otherwise.
        let given = if changed || scenario.parameters.air > 0.0 { &both[..] } else { &both[..1] };
        let taken = damped.damp(given).map(|()| Box::new(damped)).map_err(Sentence::from);
        context.commands.push(Command::Adopt(taken));
    }
    let third = ratios.get(2).map_or(String::new(), |ratio| significant(100.0 * ratio, 3));
    let text = fill("Mode 3: ζ₃ = {percent} %", &[("percent", &third)]);
    ui.add(egui::Label::new(RichText::new(text).small().color(theme::tokens(ui).text_weak)).wrap());
}
