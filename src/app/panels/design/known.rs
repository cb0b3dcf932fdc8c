//! How do we know? Published devices, with what was printed of them beside what this program computes.

use std::sync::OnceLock;

use egui::{RichText, Ui};

use crate::app::panels::device::published_name;
use crate::app::text::{fill, tr};
use crate::app::theme;
use crate::app::widgets::Card;
use crate::app::widgets::number::{significant, with_unit};
use crate::questions::design::published::{Origin, Published, What};

/// What is computed for each printed number, in the order of the devices: it depends on nothing in view.
fn computed() -> &'static [Vec<Option<f64>>] {
    static COMPUTED: OnceLock<Vec<Vec<Option<f64>>>> = OnceLock::new();
    COMPUTED.get_or_init(|| {
        let of = |device: &Published| {
            device.printed.iter().map(|printed| device.computed(printed.what).ok()).collect()
        };
        Published::ALL.iter().map(of).collect()
    })
}

/// The card.
pub(super) fn show(ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let quiet = |text: &str| RichText::new(text.to_owned()).small().color(tokens.text_weak);
    Card::new(tr("How do we know?")).hugging().show(ui, |ui| {
        let text = tr(
            "Published devices, entered by their layers like any other: what was printed of them beside what is computed \
             here.",
        );
        ui.add(egui::Label::new(quiet(text)).wrap());
        for (device, computed) in Published::ALL.iter().zip(computed()) {
            ui.add_space(6.0);
            ui.add(egui::Label::new(RichText::new(published_name(device)).strong()).wrap());
            ui.add(egui::Label::new(quiet(device.source)).wrap());
            for (printed, computed) in device.printed.iter().zip(computed) {
                let computed = computed.unwrap_or(f64::NAN);
                let numbers = fill(
                    "{published} published, {computed} here: {difference}",
                    &[
                        ("published", &value(printed.what, printed.value)),
                        ("computed", &value(printed.what, computed)),
                        ("difference", &difference(computed / printed.value - 1.0)),
                    ],
                );
                ui.add_space(3.0);
                let what = format!("{}  ·  {}", in_words(printed.what), origin(printed.origin));
                ui.add(egui::Label::new(quiet(&what)).wrap());
                ui.add(egui::Label::new(numbers).wrap());
            }
        }
        ui.add_space(4.0);
        let text = tr(
            "Computed with 5 modes and the damping that was printed. The 60 mm steel beam is an example: nobody has measured \
             it.",
        );
        ui.add(egui::Label::new(quiet(text)).wrap());
    });
}

fn in_words(what: What) -> String {
    match what {
        What::ShortCircuit => tr("resonance, terminals connected").to_owned(),
        What::OpenCircuit => tr("resonance, terminals open").to_owned(),
        What::PowerPerG2(frequency, load) => fill(
            "mean power at {frequency} Hz into {load}",
            &[("frequency", &frequency), ("load", &with_unit(load, "Ω"))],
        ),
        What::Omega(mode) => fill("natural frequency ω of mode {mode}", &[("mode", &mode)]),
    }
}

fn value(what: What, value: f64) -> String {
    match what {
        What::ShortCircuit | What::OpenCircuit => format!("{} Hz", significant(value, 4)),
        What::PowerPerG2(..) => format!("{} mW/g²", significant(1e3 * value, 5)),
        What::Omega(_) => significant(value, 5),
    }
}

/// In per cent; what rounds to nothing is less than a hundredth.
fn difference(relative: f64) -> String {
    let percent = 100.0 * relative;
    if percent.abs() < 0.01 {
        return "< 0.01 %".to_owned();
    }
    let sign = if percent > 0.0 { "+" } else { "−" };
    format!("{sign}{} %", significant(percent.abs(), 2))
}

fn origin(origin: Origin) -> &'static str {
    match origin {
        Origin::Measured => tr("measured"),
        Origin::Computed => tr("computed there"),
        Origin::ClosedForm => tr("their closed form, evaluated apart"),
    }
}
