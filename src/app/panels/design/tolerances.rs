//! How much dimensions scatter, what that leaves, and which of them matters most.

use egui::{Grid, RichText, Ui};

use super::safety;
use crate::app::panels::{Context, computing, grid};
use crate::app::text::{fill, say, tr};
use crate::app::theme;
use crate::app::widgets::number::{significant, with_unit};
use crate::app::widgets::{Card, ParameterSlider};
use crate::model::layers::LayerNumber;
use crate::questions::design::tolerance::Lean;
use crate::questions::motions::Coordinate;
use crate::questions::tolerances::ToleranceStudy;
use crate::scheduler::Study as _;

/// Width of the names in the table, beyond which they break.
const NAME_WIDTH: f32 = 138.0;

/// Draws the cards beside the curve.
pub(super) fn cards(context: &mut Context<'_>, ui: &mut Ui) {
    Card::new(tr("Scatter")).hugging().show(ui, |ui| scatter(context, ui));
    ui.add_space(grid::GAP);
    Card::new(tr("What matters")).hint(tr("% per %")).hugging().show(ui, |ui| table(context, ui));
    ui.add_space(grid::GAP);
    Card::new(tr("Limits")).hugging().show(ui, |ui| super::limits::controls(context, ui));
}

fn scatter(context: &mut Context<'_>, ui: &mut Ui) {
    let mut percent = 100.0 * context.view.design.scatter;
    let slider = ParameterSlider::new(tr("Every dimension"), "", &mut percent, 0.0..=10.0).unit("%");
    slider
        .default_value(1.0)
        .tooltip(tr("Standard deviation over the value, normal and cut at three of them; requests can give one for each dimension."))
        .compact()
        .show(ui);
    if percent != 100.0 * context.view.design.scatter {
        context.redesign(|design| design.scatter = percent / 100.0);
    }
    let colour = theme::tokens(ui).text;
    let line = |ui: &mut Ui, text: String| {
        ui.add(egui::Label::new(RichText::new(text).small().color(colour)).wrap());
    };
    let Some(study) = context.studies.lanes.study::<ToleranceStudy>() else { return };
    if !study.finished() {
        line(ui, computing(study.progress()));
    }
    if let Some(failure) = study.failure() {
        line(ui, say(failure));
    }
    let spread = study.spread();
    if let Some(power) = spread.power {
        let ends = [power.p5, power.p95].map(|power| with_unit(power, "W"));
        line(ui, fill("nine in ten give {from} to {to}", &[("from", &ends[0]), ("to", &ends[1])]));
        line(ui, fill("half give {power} or more", &[("power", &with_unit(power.median, "W"))]));
        let percent = significant(100.0 * spread.within_limits, 3);
        let text = if spread.voltage_checked {
            fill(
                "{percent} % of {count} keep the limits",
                &[("percent", &percent), ("count", &spread.samples)],
            )
        } else {
            fill(
                "{percent} % of {count} keep the limits that are known; the voltage is not checked",
                &[("percent", &percent), ("count", &spread.samples)],
            )
        };
        line(ui, text);
        if let Some(text) = safety::too_much_sag(&context.view.scenario) {
            let text = RichText::new(text).small().color(theme::tokens(ui).warning);
            ui.add(egui::Label::new(text).wrap());
        }
    }
}

fn table(context: &Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let Some(study) = context.studies.lanes.study::<ToleranceStudy>() else { return };
    let mut rows: Vec<(Coordinate, Lean)> =
        study.leans().map(|(dimension, _, lean)| (dimension, *lean)).collect();
    let size = |lean: &Lean| lean.power.map_or(-1.0, f64::abs);
    rows.sort_by(|a, b| size(&b.1).total_cmp(&size(&a.1)));
    let most =
        [study.most(|lean| lean.power), study.most(|lean| lean.frequency), study.most(|lean| lean.threshold)];
    let table = Grid::new("sensitivities").num_columns(4).spacing([8.0, 3.0]).max_col_width(NAME_WIDTH);
    table.striped(true).show(ui, |ui| {
        // A grid knows the width of a new row a frame late; until then its numbers would stand over its name.
        ui.allocate_exact_size(egui::vec2(NAME_WIDTH, 0.0), egui::Sense::hover());
        for text in [tr("power"), tr("resonance"), tr("threshold")] {
            ui.add(egui::Label::new(RichText::new(text).small().color(tokens.text_weak)).extend());
        }
        ui.end_row();
        for (dimension, lean) in rows {
            ui.add(egui::Label::new(RichText::new(name(dimension)).small()).wrap());
            for (value, most) in [lean.power, lean.frequency, lean.threshold].into_iter().zip(&most) {
                let text = value.map_or("–".to_owned(), |value| format!("{value:+.2}"));
                let text = RichText::new(text.replace('-', "−")).small();
                // The largest of each column.
                let strongest = most.is_some_and(|(strongest, _)| strongest == dimension);
                ui.label(if strongest { text.strong().color(tokens.accent) } else { text });
            }
            ui.end_row();
        }
    });
    let text = tr("A dash: the motion changes its class within 0.1 %, or there is no tongue.");
    ui.add(egui::Label::new(RichText::new(text).small().color(tokens.text_weak)).wrap());
}

/// What scatters, in words.
fn name(coordinate: Coordinate) -> &'static str {
    use LayerNumber as N;
    match coordinate {
        Coordinate::Parameter(parameter) => tr(parameter.fact().title),
        Coordinate::Dimension(dimension) => tr(dimension.fact().title),
        // Starts do not scatter.
        Coordinate::Start(_) => "",
        Coordinate::Layer(number) => match number {
            N::Width => tr("width of the beam"),
            N::SubstrateThickness => tr("thickness of the substrate"),
            N::SubstrateModulus => tr("modulus of the substrate"),
            N::SubstrateDensity => tr("density of the substrate"),
            N::CeramicThickness => tr("thickness of a ceramic plate"),
            N::CeramicModulus => tr("modulus of the ceramic"),
            N::CeramicDensity => tr("density of the ceramic"),
            N::D31 => tr("constant d31 of the ceramic"),
            N::Permittivity => tr("permittivity of the ceramic"),
            N::EpoxyThickness => tr("thickness of the epoxy"),
            N::EpoxyModulus => tr("modulus of the epoxy"),
            N::EpoxyDensity => tr("density of the epoxy"),
        },
    }
}
