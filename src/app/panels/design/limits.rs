//! The limits to choose: thickness and voltage of the ceramic, gap, deflection.

use egui::{RichText, Ui};

use super::safety::{self, Safety};
use crate::app::bench;
use crate::app::panels::Context;
use crate::app::text::{fill, tr};
use crate::app::theme;
use crate::app::widgets::number::{round_significant, with_unit};
use crate::app::widgets::{ParameterSlider, chips};
use crate::model::Limits;
use crate::model::limits::Standing;

/// Draws the choices, and how the motion reached stands to each.
pub(super) fn controls(context: &mut Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let before = context.view.design.limits;
    let mut limits = before;
    let base = context.view.scenario.base();
    let published = Limits::of(&base).voltage;
    let mut own = limits.voltage.is_some();
    let choices = [(false, tr("by the ceramic")), (true, tr("own voltage"))];
    if chips(ui, tr("Voltage allowed"), &mut own, &choices) {
        limits.voltage = own.then(|| published.unwrap_or((50.0, 50.0)));
    }
    match &mut limits.voltage {
        Some((low, high)) => {
            let slider = ParameterSlider::new(tr("Peak voltage"), "V", low, 0.01..=1e5);
            slider.logarithmic().unit("V").compact().show(ui);
            *high = *low;
        }
        None => {
            let millimetres = round_significant(1e3 * base.ceramic_thickness, 4);
            let plates = base.layers.map_or(1, |layers| layers.plates_in_series());
            let millimetres =
                if plates == 1 { millimetres.to_string() } else { format!("{plates} × {millimetres}") };
            let text = match (published, base.ceramic) {
                (Some((low, high)), Some(ceramic)) => fill(
                    "{ceramic} of {millimetres} mm bears {low} to {high} (section 5.4, read as peaks; the motion's peak is compared).",
                    &[
                        ("ceramic", &ceramic.material().name),
                        ("millimetres", &millimetres),
                        ("low", &with_unit(low, "V")),
                        ("high", &with_unit(high, "V")),
                    ],
                ),
                (None, Some(ceramic)) => fill(
                    "No field limit is published for {ceramic}.",
                    &[("ceramic", &ceramic.material().name)],
                ),
                (_, None) => {
                    tr("No ceramic chosen: choose one under Materials, or a voltage of your own.").to_owned()
                }
            };
            ui.add(egui::Label::new(RichText::new(text).small().color(tokens.text_weak)).wrap());
        }
    }
    let mut percent = round_significant(100.0 * limits.gap, 6);
    let slider = ParameterSlider::new(tr("Gap closed"), "s/s₀", &mut percent, 1.0..=100.0).unit("%");
    slider
        .tooltip(tr("Part of the gap that the tip may close; at 100 % the magnets touch."))
        .compact()
        .show(ui);
    limits.gap = percent / 100.0;
    let mut percent = round_significant(100.0 * limits.deflection, 6);
    let slider = ParameterSlider::new(tr("Deflection"), "s", &mut percent, 1.0..=100.0).unit("%");
    slider
        .default_value(100.0 * Limits::default().deflection)
        .tooltip(tr("Largest tip displacement over the beam's length; beyond 30 % no beam is a linear one."))
        .compact()
        .show(ui);
    limits.deflection = percent / 100.0;
    if limits != before && limits.validate().is_ok() {
        context.redesign(|design| design.limits = limits);
    }
    checks(context, ui);
}

/// How the motion reached stands to each limit.
fn checks(context: &Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let Some((Ok(operating), _)) = context.studies.operating(&context.view.scenario) else { return };
    let Some(harvest) = &operating.reached.harvest else { return };
    let Some(safety) = Safety::of(context.view, context.session) else { return };
    ui.add_space(4.0);
    for check in safety.checks(&harvest.demand) {
        let (sign, colour) = match check.standing {
            Standing::Within => ("✓", tokens.ok),
            Standing::Marginal => ("±", tokens.warning),
            Standing::Exceeded => ("✕", tokens.danger),
        };
        let text = format!("{sign}  {}", safety::in_words(&check));
        ui.add(egui::Label::new(RichText::new(text).small().color(colour)).wrap());
    }
    if bench::limits(context.view).voltage.is_none() {
        let text = format!("–  {}", tr("the voltage is not checked: no limit is known"));
        ui.add(egui::Label::new(RichText::new(text).small().color(tokens.text_weak)).wrap());
    }
}
