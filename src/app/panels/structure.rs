//! The folded controls: magnet, beam, circuit, model, start.

use egui::Ui;

use super::Context;
use super::frequency::FREQUENCIES;
use crate::app::text::{fill, tr};
use crate::app::widgets::number::short;
use crate::app::widgets::{Fold, ParameterSlider, chips};
use crate::model::{ForceLaw, MAX_MODES, Parameter, ParameterSet, state_dimension};
use crate::scenario::{END_TIME, Scenario};

/// Degree a Taylor law starts with.
const FIRST_DEGREE: usize = 5;

/// Draws the sections.
pub(super) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    let scenario = context.view.scenario.clone();
    let mut changed = scenario.clone();
    let p = &scenario.parameters;
    let (c0, d, h, eta) = (short(p.c0), short(p.d), short(p.h), short(p.eta));
    let (kappa, theta) = (short(p.kappa), short(p.theta));
    Fold::new(tr("Magnet")).summary(&format!("c₀ {c0}  d {d}  h {h}")).show(ui, |ui| {
        number(ui, &mut changed.parameters, Parameter::C0);
        number(ui, &mut changed.parameters, Parameter::D);
        number(ui, &mut changed.parameters, Parameter::H);
    });
    Fold::new(tr("Beam and tip mass")).summary(&format!("η {eta}")).show(ui, |ui| {
        number(ui, &mut changed.parameters, Parameter::Eta);
    });
    Fold::new(tr("Circuit")).summary(&format!("κ {kappa}  θ {theta}")).show(ui, |ui| {
        number(ui, &mut changed.parameters, Parameter::C);
        number(ui, &mut changed.parameters, Parameter::Kappa);
        number(ui, &mut changed.parameters, Parameter::Theta);
    });
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

/// One compact slider; its range, scale and words.
pub(super) fn number(ui: &mut Ui, set: &mut ParameterSet, parameter: Parameter) {
    let (name, symbol, tooltip, floor) = match parameter {
        Parameter::C0 => (
            tr("Strength"),
            "c₀",
            tr("Magnet strength: positive repels, negative attracts, 0 is no magnet."),
            None,
        ),
        Parameter::D => (
            tr("Gap"),
            "d",
            tr("Distance of the magnets with the beam sagged but unbent by them, in beam lengths."),
            Some(0.01),
        ),
        Parameter::H => (tr("Length"), "h", tr("Length of each magnet, in beam lengths."), Some(1e-5)),
        Parameter::Eta => (tr("Tip mass"), "η", tr("Mass at the tip over the mass of the beam."), Some(1e-3)),
        Parameter::C => {
            (tr("Capacitance"), "c", tr("Capacitance of the ceramic, times one volt squared."), Some(1e-9))
        }
        Parameter::Kappa => (
            tr("Load"),
            "κ",
            tr("Conductance of the load, times one volt squared: large κ is a small resistance."),
            Some(1e-9),
        ),
        Parameter::Theta => {
            (tr("Coupling"), "θ", tr("Electromechanical coupling: bending moment of one volt."), Some(1e-6))
        }
        // These have a place of their own with more room; here they stand in embedded pages.
        Parameter::Alpha => {
            (tr("Damping"), "α", tr("Kelvin-Voigt damping of the beam's material."), Some(1e-6))
        }
        Parameter::Beta => {
            (tr("Excitation"), "β", tr("Amplitude of the base's motion, in beam lengths."), Some(1e-5))
        }
        Parameter::Omega => (tr("Frequency"), "ω", tr("Angular frequency of the base's motion."), None),
    };
    let default = parameter.get(&ParameterSet::default());
    let (low, high) = if parameter == Parameter::Omega { FREQUENCIES } else { parameter.usual() };
    let value = parameter.get_mut(set);
    let (low, high) = (low.min(*value), high.max(*value));
    let slider = ParameterSlider::new(name, symbol, value, low..=high)
        .default_value(default)
        .tooltip(tooltip)
        .equation("Eq. 8")
        .compact();
    match floor {
        Some(smallest) if low == 0.0 => slider.logarithmic_from(smallest),
        Some(_) => slider.logarithmic(),
        None => slider,
    }
    .show(ui);
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
