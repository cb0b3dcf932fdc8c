//! What the verdict rests on, piece by piece.

use egui::{RichText, Ui};

use super::Context;
use super::spec::{Place, Spec};
use crate::app::text::{marked, say, tr};
use crate::app::view::Tab;
use crate::app::widgets::touch;
use crate::app::{fonts, theme};
use crate::dynamics::attractors::evidence::EvidenceSource;

/// The evidence, in words.
pub(super) const PANEL: Spec =
    Spec::new(Place::Tab(Tab::Stability), |_| tr("What the verdict rests on"), contents)
        .hint(|_| tr("multipliers, recurrence, exponent, spectrum").to_owned())
        .embedded("evidence", marked("Evidence"))
        .without_plot();

fn contents(context: &mut Context<'_>, ui: &mut Ui) {
    touch::scroll_area(ui.ctx()).auto_shrink(false).show(ui, |ui| list(context, ui));
}

fn list(context: &mut Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let Some((found, current)) = context.studies.inspection(&context.view.scenario) else { return };
    if !current {
        ui.multiply_opacity(0.55);
    }
    let verdict = &found.verdict;
    ui.spacing_mut().item_spacing.y = 6.0;
    for piece in &verdict.rests_on {
        let (sign, colour) = match piece.agrees {
            Some(true) => (tr("in favour"), tokens.ok),
            Some(false) => (tr("against"), tokens.danger),
            None => (tr("open"), tokens.text_weak),
        };
        row(ui, title(piece.source()), sign, colour, &say(&piece.shows));
    }
    for other in &verdict.coexists {
        row(ui, tr("Coexisting motion"), "", tokens.warning, &say(other));
    }
    for warning in &verdict.warnings {
        row(ui, tr("Note"), "", tokens.warning, &say(warning));
    }
}

fn row(ui: &mut Ui, title: &str, sign: &str, colour: egui::Color32, text: &str) {
    let tokens = theme::tokens(ui);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 8.0;
        let font = fonts::semibold(theme::size::SMALL + 1.0);
        ui.label(RichText::new(title).font(font).color(colour));
        if !sign.is_empty() {
            ui.label(RichText::new(sign).small().color(colour));
        }
        ui.label(RichText::new(text).small().color(tokens.text));
    });
}

fn title(source: EvidenceSource) -> &'static str {
    match source {
        EvidenceSource::Run => tr("Run"),
        EvidenceSource::Multipliers => tr("Multipliers"),
        EvidenceSource::Recurrence => tr("Recurrence"),
        EvidenceSource::Points => tr("Poincaré points"),
        EvidenceSource::Beside => tr("Other starts"),
        EvidenceSource::Rotation => tr("Rotation number"),
        EvidenceSource::ZeroOne => tr("0-1 test"),
        EvidenceSource::Exponent => tr("Lyapunov exponent"),
        EvidenceSource::Spectrum => tr("Spectrum"),
    }
}
