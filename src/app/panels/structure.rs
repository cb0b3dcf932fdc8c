//! The folded controls: magnet, beam, circuit, model, start.

use egui::Ui;

use super::{Context, facts};
use crate::app::text::{fill, tr};
use crate::app::widgets::number::short;
use crate::app::widgets::{Fold, ParameterSlider, chips};
use crate::model::{ForceLaw, MAX_MODES, Parameter, ParameterSet, Part, state_dimension};
use crate::scenario::{END_TIME, Scenario};

/// Degree a Taylor law starts with.
const FIRST_DEGREE: usize = 5;

/// Draws the sections.
pub(super) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    let scenario = context.view.scenario.clone();
    let mut changed = scenario.clone();
    let layered = scenario.device().is_ok_and(|device| device.layers.is_some());
    let set = &mut changed.parameters;
    for (parts, title) in [
        (&[Part::Magnets][..], tr("Magnet")),
        (&[Part::Beam], tr("Beam and tip mass")),
        (&[Part::Circuit, Part::Ceramic], tr("Circuit")),
    ] {
        let members = Parameter::of(parts);
        let value = |parameter: &Parameter| {
            format!("{} {}", parameter.fact().symbol, short(scenario.parameters.get(*parameter)))
        };
        let summary: Vec<String> = members.iter().map(value).collect();
        Fold::new(title).summary(&summary.join("  ")).show(ui, |ui| {
            for parameter in members {
                // Layers decide these.
                let decided = layered && matches!(parameter, Parameter::C | Parameter::Theta);
                ui.add_enabled_ui(!decided, |ui| number(ui, set, parameter));
            }
        });
    }
    model_and_start(ui, &mut changed);
    if changed != scenario {
        context.edit(|scenario| *scenario = changed);
    }
}

/// The sections that SI units do not change.
pub(super) fn model_and_start(ui: &mut Ui, changed: &mut Scenario) {
    let (in_words, from) = (model_in_words(changed), start_in_words(changed));
    Fold::new(tr("Model")).summary(&in_words).show(ui, |ui| model(ui, changed));
    Fold::new(tr("Start")).summary(&from).show(ui, |ui| start(ui, changed));
}

/// One compact slider.
pub(super) fn number(ui: &mut Ui, set: &mut ParameterSet, parameter: Parameter) {
    facts::of_parameter(set, parameter).compact().show(ui);
}

fn law_in_words(law: ForceLaw) -> String {
    match law {
        ForceLaw::Quadratic => tr("quadratic").into(),
        ForceLaw::Taylor(degree) => fill("Taylor {degree}", &[("degree", &degree)]),
        ForceLaw::Exact => tr("exact").into(),
    }
}

fn model_in_words(scenario: &Scenario) -> String {
    let modes = scenario.model.modes;
    let law = law_in_words(scenario.model.force);
    match modes {
        1 => fill("1 mode · {law} force", &[("law", &law)]),
        modes => fill("{modes} modes · {law} force", &[("modes", &modes), ("law", &law)]),
    }
}

fn model(ui: &mut Ui, scenario: &mut Scenario) {
    ui.label(tr("Modes kept in the truncation, Eq. 30"));
    modes(ui, scenario);
    ui.add_space(4.0);
    ui.label(tr("Magnet force beyond its linear part, Eq. 16"));
    force(ui, scenario);
    ui.add_space(4.0);
    residual_moment(ui, scenario);
    ui.add_space(6.0);
}

/// Whether the circuit feels the modes left out.
fn residual_moment(ui: &mut Ui, scenario: &mut Scenario) {
    let text = tr("Modes left out count in the circuit");
    let explanation = tr(
        "The moment of the voltage bends the modes that are left out, too. With this they count in the circuit as a \
         capacitance beside c. Off in the paper, whose modes converge only like 1/N; on for a device of your own.",
    );
    ui.checkbox(&mut scenario.model.residual_moment, text).on_hover_text(explanation);
}

/// The choice of the number of modes.
pub(super) fn modes(ui: &mut Ui, scenario: &mut Scenario) {
    let numbers: Vec<String> = (1..=MAX_MODES).map(|n| n.to_string()).collect();
    let choices: Vec<(usize, &str)> = (1..=MAX_MODES).zip(numbers.iter().map(String::as_str)).collect();
    let mut modes = scenario.model.modes;
    if chips(ui, tr("Modes"), &mut modes, &choices) {
        scenario.set_modes(modes);
    }
}

/// The choice of the force law.
pub(super) fn force(ui: &mut Ui, scenario: &mut Scenario) {
    let degree = match scenario.model.force {
        ForceLaw::Taylor(degree) => degree,
        _ => FIRST_DEGREE,
    };
    let laws = [
        (ForceLaw::Quadratic, tr("quadratic")),
        (ForceLaw::Taylor(degree), tr("Taylor")),
        (ForceLaw::Exact, tr("exact")),
    ];
    chips(ui, tr("Force law"), &mut scenario.model.force, &laws);
    if let ForceLaw::Taylor(degree) = &mut scenario.model.force {
        let mut value = *degree as f64;
        let slider = ParameterSlider::new(tr("Degree"), "J", &mut value, 2.0..=ForceLaw::MAX_DEGREE as f64);
        slider.tooltip(tr("Highest power of the tip displacement that is kept.")).compact().show(ui);
        *degree = (value.round() as usize).clamp(2, ForceLaw::MAX_DEGREE);
    }
}

fn start_in_words(scenario: &Scenario) -> String {
    let from = if scenario.initial.is_some() { tr("chosen state") } else { tr("from rest") };
    fill("{from} · to t = {time}", &[("from", &from), ("time", &short(scenario.t_end))])
}

fn start(ui: &mut Ui, scenario: &mut Scenario) {
    let modes = scenario.model.modes;
    let mut from_rest = scenario.initial.is_none();
    if chips(ui, tr("Start"), &mut from_rest, &[(true, tr("from rest")), (false, tr("chosen state"))]) {
        scenario.initial = (!from_rest).then(|| vec![0.0; state_dimension(modes)]);
    }
    if let Some(state) = &mut scenario.initial {
        let field = |ui: &mut Ui, name: &str, symbol: &str, value: &mut f64, limit: f64, tooltip: &str| {
            ParameterSlider::new(name, symbol, value, -limit..=limit)
                .default_value(0.0)
                .tooltip(tooltip)
                .compact()
                .show(ui);
        };
        field(
            ui,
            tr("Deflection"),
            "q₁",
            &mut state[0],
            0.5,
            tr("Tip displacement in mode 1, in beam lengths."),
        );
        field(ui, tr("Velocity"), "dq₁/dt", &mut state[modes], 5.0, tr("Tip velocity in mode 1."));
        field(ui, tr("Voltage"), "v", &mut state[2 * modes], 100.0, tr("Voltage at the start, in volts."));
    }
    ParameterSlider::new(tr("Duration"), "t", &mut scenario.t_end, END_TIME.0..=END_TIME.1)
        .logarithmic()
        .default_value(600.0)
        .tooltip(tr("Length of the run, in units of √(m_b L³ / EI): 0.454 s for the paper's device."))
        .compact()
        .show(ui);
    ui.add_space(6.0);
}
