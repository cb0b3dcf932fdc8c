//! Tables 1 and 2, with the dimensionless numbers that follow from the first.

use egui::{Grid, RichText, Ui};

use super::Context;
use super::controls::short;
use crate::app::theme;
use crate::app::widgets::Card;
use crate::model::materials::TABLE_2;
use crate::model::{Device, ElectricalScaling, Parameter};

/// Draws the three tables.
pub(super) fn show(_context: &mut Context<'_>, ui: &mut Ui) {
    Card::new("Table 1 and section 3.2: the device").hugging().show(ui, device);
    ui.add_space(10.0);
    Card::new("Its dimensionless numbers, Eq. 8").hugging().show(ui, numbers);
    ui.add_space(10.0);
    Card::new("Table 2 and section 5.4: piezoelectric ceramics").hugging().show(ui, ceramics);
}

fn heading(ui: &mut Ui, texts: &[&str]) {
    let tokens = theme::tokens(ui);
    for text in texts {
        ui.label(RichText::new(*text).small().color(tokens.text_weak));
    }
    ui.end_row();
}

fn table(ui: &mut Ui, name: &str, contents: impl FnOnce(&mut Ui)) {
    egui::ScrollArea::horizontal().id_salt(name).show(ui, |ui| {
        Grid::new(name).num_columns(2).spacing([26.0, 5.0]).show(ui, contents);
    });
}

fn device(ui: &mut Ui) {
    let d = Device::default();
    let rows: [(&str, &str, f64, &str); 17] = [
        ("ρ", "residual flux density", d.flux_density, "T"),
        ("μ", "permeability of air", d.permeability, "H/m"),
        ("H", "length of a magnet", 1e3 * d.magnet_length, "mm"),
        ("R", "radius of a magnet", 1e3 * d.magnet_radius, "mm"),
        ("S", "common area of the magnets", 1e6 * d.magnet_area, "mm²"),
        ("D", "distance of the magnets", 1e3 * d.magnet_distance, "mm"),
        ("L", "length of the cantilever", 1e3 * d.beam_length, "mm"),
        ("m_b", "mass of the cantilever", 1e3 * d.beam_mass, "g"),
        ("m_t", "mass at the tip", 1e3 * d.tip_mass, "g"),
        ("E", "Young's modulus", 1e-9 * d.youngs_modulus, "GPa"),
        ("I", "second moment of area", 1e12 * d.second_moment, "mm⁴"),
        ("Λ", "viscosity", 1e-6 * d.viscosity, "MPa s"),
        ("g", "gravity", d.gravity, "m/s²"),
        ("C_eq", "capacitance", 1e9 * d.capacitance, "nF"),
        ("R_eq", "load resistance", 1e-6 * d.resistance, "MΩ"),
        ("Θ", "electromechanical coupling", d.coupling, "N/V"),
        ("T", "unit of time √(m_b L³ / EI)", d.time_unit(), "s"),
    ];
    table(ui, "device", |ui| {
        heading(ui, &["symbol", "meaning", "value", "unit"]);
        for (symbol, meaning, value, unit) in rows {
            ui.label(symbol);
            ui.label(meaning);
            ui.label(crate::app::widgets::number::significant(value, 5));
            ui.label(unit);
            ui.end_row();
        }
    });
}

fn numbers(ui: &mut Ui) {
    let device = Device::default();
    let printed = device.dimensionless(ElectricalScaling::AsPrinted);
    let consistent = device.dimensionless(ElectricalScaling::Consistent);
    let (Ok(printed), Ok(consistent)) = (printed, consistent) else { return };
    table(ui, "numbers", |ui| {
        heading(ui, &["number", "as printed", "consistent units"]);
        for parameter in Parameter::ALL {
            ui.label(parameter.field());
            ui.label(short(parameter.get(&printed)));
            ui.label(short(parameter.get(&consistent)));
            ui.end_row();
        }
    });
    let text = "Eq. 8 scales the circuit with L². A moment ΘV needs Θ in N m/V, and then one factor L less; the paper's \
                c, κ and θ follow only from the printed form.";
    ui.add(egui::Label::new(RichText::new(text).small().color(theme::tokens(ui).text_weak)).wrap());
}

fn ceramics(ui: &mut Ui) {
    table(ui, "ceramics", |ui| {
        heading(ui, &["material", "quality factor", "dielectric loss", "largest field [V/mil]"]);
        for material in TABLE_2 {
            ui.label(material.name);
            ui.label(material.quality_factor.to_string());
            let bound = if material.dissipation_is_bound { "< " } else { "" };
            ui.label(format!("{bound}{} %", short(100.0 * material.dissipation_factor)));
            ui.label(
                material.field_limit.map_or("not given".to_owned(), |(low, high)| format!("{low} to {high}")),
            );
            ui.end_row();
        }
    });
}
