//! The beam by its layers: arrangement, materials and thicknesses, the section they make, and what it gives.

use egui::{RichText, Ui};

use crate::app::panels::facts::round;
use crate::app::text::{fill, tr};
use crate::app::theme::{self, Tokens};
use crate::app::widgets::number::{significant, with_unit};
use crate::app::widgets::section_view::{Drawn, section_view};
use crate::app::widgets::{Fold, ParameterSlider, chips};
use crate::model::layers::{Arrangement, Laminate, LayerKind, Plate, Sheet};
use crate::model::substances::{SUBSTANCES, Substance};
use crate::model::{Device, Layers};
use crate::questions::design::published::BIMORPH;

/// Glue to begin with (m).
const GLUE: f64 = 2e-5;

/// Whether layers describe the beam, and these.
pub(super) fn show(ui: &mut Ui, device: &mut Device) {
    let mut layered = device.layers.is_some();
    let choices = [(false, tr("E, I, mass")), (true, tr("layers"))];
    if chips(ui, tr("Beam described by"), &mut layered, &choices) {
        *device = match (layered, BIMORPH.device().layers) {
            (true, Some(layers)) => device.with_layers(layers),
            _ => Device { layers: None, ..*device },
        };
    }
    ui.add_space(4.0);
    let Some(before) = device.layers else { return };
    let mut layers = before;
    let arrangements = [
        (Arrangement::Unimorph, tr("unimorph")),
        (Arrangement::Series, tr("bimorph, series")),
        (Arrangement::Parallel, tr("bimorph, parallel")),
    ];
    chips(ui, tr("Arrangement"), &mut layers.arrangement, &arrangements);
    ui.add_space(4.0);
    section(ui, &layers);
    length(ui, tr("Width"), "b", &mut layers.width, (1e-3, 0.1));
    substrate(ui, &mut layers.substrate);
    ceramic(ui, &mut layers.ceramic);
    epoxy(ui, &mut layers.epoxy);
    if layers != before {
        *device = device.with_layers(layers);
    }
    given(ui, &device.laminate());
}

fn colour(kind: LayerKind, tokens: &Tokens) -> egui::Color32 {
    match kind {
        LayerKind::Substrate => tokens.track,
        LayerKind::Epoxy => tokens.warning,
        LayerKind::Ceramic => tokens.accent,
    }
}

fn section(ui: &mut Ui, layers: &Layers) {
    let tokens = theme::tokens(ui);
    let stack = layers.stack();
    let drawn: Vec<Drawn<'_>> = stack
        .iter()
        .map(|layer| Drawn {
            thickness: round(1e3 * (layer.to - layer.from)),
            colour: colour(layer.kind, tokens),
            name: match layer.kind {
                LayerKind::Substrate => tr("substrate"),
                LayerKind::Epoxy => tr("glue"),
                LayerKind::Ceramic => tr("ceramic"),
            },
        })
        .collect();
    section_view(ui, &drawn, 1e3 * layers.width, 1e3 * layers.neutral_axis());
    ui.add_space(4.0);
}

/// A slider of a length (m) in mm.
fn length(ui: &mut Ui, name: &str, symbol: &str, value: &mut f64, usual: (f64, f64)) {
    scaled(ui, (name, symbol, "mm"), 1e3, value, usual);
}

/// A slider of a number of which `factor` of the unit are one.
fn scaled(
    ui: &mut Ui,
    (name, symbol, unit): (&str, &str, &str),
    factor: f64,
    value: &mut f64,
    (low, high): (f64, f64),
) {
    let mut shown = round(factor * *value);
    let range = round(factor * low).min(shown)..=round(factor * high).max(shown);
    let slider = ParameterSlider::new(name, symbol, &mut shown, range).unit(unit).logarithmic().compact();
    if slider.show(ui).changed {
        *value = shown / factor;
    }
}

/// A choice among the materials that suit.
fn material(
    ui: &mut Ui,
    name: &str,
    piezoelectric: bool,
    now: Option<&'static Substance>,
) -> Option<&'static Substance> {
    let mut chosen = None;
    ui.horizontal(|ui| {
        ui.label(name);
        let shown = now.map_or(tr("own numbers"), |substance| substance.name);
        egui::ComboBox::from_id_salt(name).width(150.0).selected_text(shown).show_ui(ui, |ui| {
            for substance in SUBSTANCES.iter().filter(|s| !piezoelectric || s.piezoelectric.is_some()) {
                let present = now.is_some_and(|now| now.name == substance.name);
                let entry = ui.selectable_label(present, substance.name).on_hover_text(substance.source);
                if entry.clicked() {
                    chosen = Some(substance);
                }
            }
        });
    });
    chosen
}

fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs()
}

fn substrate(ui: &mut Ui, sheet: &mut Sheet) {
    ui.push_id("substrate", |ui| {
        let now = SUBSTANCES.iter().find(|substance| is_of(sheet, substance));
        if let Some(substance) = material(ui, tr("Substrate"), false, now) {
            (sheet.youngs_modulus, sheet.density) = (substance.youngs_modulus, substance.density);
        }
        length(ui, tr("Thickness"), "h", &mut sheet.thickness, (2e-5, 5e-3));
        Fold::new(tr("Its numbers"))
            .show(ui, |ui| elastic(ui, &mut sheet.youngs_modulus, &mut sheet.density));
    });
}

fn is_of(sheet: &Sheet, substance: &Substance) -> bool {
    same(sheet.youngs_modulus, substance.youngs_modulus) && same(sheet.density, substance.density)
}

fn elastic(ui: &mut Ui, modulus: &mut f64, density: &mut f64) {
    scaled(ui, (tr("Modulus"), "E", "GPa"), 1e-9, modulus, (1e9, 4e11));
    scaled(ui, (tr("Density"), "ρ", "kg/m³"), 1.0, density, (500.0, 2e4));
}

fn ceramic(ui: &mut Ui, plate: &mut Plate) {
    ui.push_id("ceramic", |ui| {
        let numbers = |substance: &Substance| {
            let piezoelectric = substance.piezoelectric?;
            let permittivity = piezoelectric.clamped_permittivity(substance.youngs_modulus);
            let (youngs_modulus, density) = (substance.youngs_modulus, substance.density);
            Some(Plate { youngs_modulus, density, d31: piezoelectric.d31, permittivity, ..Plate::THIN })
        };
        let is_of = |substance: &&Substance| {
            numbers(substance).is_some_and(|of| {
                same(plate.youngs_modulus, of.youngs_modulus)
                    && same(plate.density, of.density)
                    && same(plate.d31, of.d31)
                    && same(plate.permittivity, of.permittivity)
            })
        };
        let now = SUBSTANCES.iter().find(is_of);
        if let Some(found) = material(ui, tr("Ceramic"), true, now).and_then(numbers) {
            *plate = Plate { thickness: plate.thickness, ..found };
        }
        length(ui, tr("Thickness"), "h", &mut plate.thickness, (1e-5, 5e-3));
        Fold::new(tr("Its numbers")).show(ui, |ui| {
            elastic(ui, &mut plate.youngs_modulus, &mut plate.density);
            let mut d31 = plate.d31.abs();
            scaled(ui, (tr("Piezo constant"), "d₃₁", "pm/V"), 1e12, &mut d31, (5e-12, 5e-10));
            if d31 != plate.d31.abs() {
                plate.d31 = d31.copysign(plate.d31);
            }
            scaled(ui, (tr("Permittivity"), "ε", "nF/m"), 1e9, &mut plate.permittivity, (5e-11, 1e-7));
            let text = tr(
                "At constant strain. Data sheets print it at constant stress; the table's are converted: less d₃₁² E.",
            );
            quiet(ui, text);
        });
    });
}

fn epoxy(ui: &mut Ui, epoxy: &mut Option<Sheet>) {
    ui.push_id("epoxy", |ui| {
        let mut glued = epoxy.is_some();
        ui.horizontal(|ui| {
            ui.label(tr("Glue"));
            chips(ui, tr("Glue"), &mut glued, &[(false, tr("left out")), (true, tr("counted"))]);
        });
        if glued != epoxy.is_some() {
            let usual = |substance: &Substance| Sheet {
                thickness: GLUE,
                youngs_modulus: substance.youngs_modulus,
                density: substance.density,
            };
            *epoxy = Substance::named("epoxy").filter(|_| glued).map(usual);
        }
        if let Some(sheet) = epoxy {
            length(ui, tr("Thickness"), "h", &mut sheet.thickness, (1e-6, 1e-3));
            Fold::new(tr("Its numbers"))
                .show(ui, |ui| elastic(ui, &mut sheet.youngs_modulus, &mut sheet.density));
        }
    });
}

/// What the layers give, which is not to be changed here.
fn given(ui: &mut Ui, laminate: &Laminate) {
    let stiffness = laminate.youngs_modulus * laminate.second_moment;
    let numbers = [
        ("EI", format!("{} N m²", significant(stiffness, 5))),
        ("m", format!("{} g", significant(1e3 * laminate.beam_mass, 5))),
        ("C", with_unit(laminate.capacitance, "F")),
        ("Θ", format!("{} µN m/V", significant(1e6 * laminate.coupling, 5))),
    ];
    let numbers: Vec<String> =
        numbers.iter().map(|(name, value)| format!("{name} {value}").replace(' ', "\u{a0}")).collect();
    quiet(ui, &fill("Computed from the layers: {numbers}", &[("numbers", &numbers.join("  ·  "))]));
    ui.add_space(4.0);
}

fn quiet(ui: &mut Ui, text: &str) {
    let colour = theme::tokens(ui).text_weak;
    ui.add(egui::Label::new(RichText::new(text).small().color(colour)).wrap());
}
