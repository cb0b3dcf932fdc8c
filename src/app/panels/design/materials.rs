//! The ceramics of Table 2 on the device, side by side.

use egui::{Grid, RichText, Ui};

use super::safety;
use crate::app::command::Command;
use crate::app::panels::{Context, grid};
use crate::app::text::{fill, marked, say, tr};
use crate::app::theme;
use crate::app::widgets::number::{significant, with_unit};
use crate::app::widgets::{Card, chips_after, touch};
use crate::model::Limits;
use crate::model::limits::Standing;
use crate::model::materials::Ceramic;
use crate::questions::design::materials::{MaterialRow, with_ceramic};
use crate::questions::materials::Fitted;
use crate::scheduler::{Failure, Table};
use crate::sentence::Sentence;
use crate::theory::Resonance;

/// Draws the page.
pub(super) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    let hint = context.computing::<Table<Fitted>>(tr("Table 2 and section 5.4"));
    Card::new(tr("Ceramics on this device")).hint(&hint).hugging().show(ui, |ui| {
        choices(context, ui);
        ui.add_space(6.0);
        // Its bar says that there is more.
        let visible = egui::scroll_area::ScrollBarVisibility::AlwaysVisible;
        let scroll = touch::sideways(ui.ctx()).id_salt("ceramics").scroll_bar_visibility(visible);
        scroll.show(ui, |ui| table(context, ui));
        ui.add_space(6.0);
        notes(context, ui);
    });
    ui.add_space(grid::GAP);
    Card::new(tr("Limits")).hugging().show(ui, |ui| super::limits::controls(context, ui));
}

fn choices(context: &mut Context<'_>, ui: &mut Ui) {
    let modes = context.view.scenario.model.modes;
    let (mut mode, mut resonance) = (context.view.design.mode.clamp(1, modes), context.view.design.resonance);
    let names: Vec<String> = (1..=modes).map(|mode| fill("mode {mode}", &[("mode", &mode)])).collect();
    let all: Vec<(usize, &str)> = (1..=modes).zip(names.iter().map(String::as_str)).collect();
    let resonances = [(Resonance::First, "2ω₁"), (Resonance::Sum, "ω₁+ω₂"), (Resonance::Second, "2ω₂")];
    ui.horizontal_wrapped(|ui| {
        let given = tr("quality factor given to");
        let mut changed = chips_after(ui, given, tr("Quality factor of"), &mut mode, &all);
        changed |= chips_after(ui, tr("tongue near"), tr("Tongue near"), &mut resonance, &resonances);
        if changed {
            context.redesign(|design| (design.mode, design.resonance) = (mode, resonance));
        }
    });
}

const HEADINGS: [&str; 10] = [
    "",
    marked("ceramic"),
    "Q",
    "tan δ",
    "α",
    marked("threshold"),
    marked("at"),
    marked("tongue open"),
    marked("power"),
    marked("peak / allowed"),
];

fn table(context: &mut Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let present = context.view.scenario.base().ceramic;
    let Some(study) = context.studies.lanes.study::<Table<Fitted>>() else { return };
    let rows: Vec<Option<Result<&MaterialRow, &Failure>>> = study.found().collect();
    ui.spacing_mut().interact_size.y = 24.0;
    Grid::new("ceramics").num_columns(HEADINGS.len()).spacing([18.0, 4.0]).show(ui, |ui| {
        for text in HEADINGS {
            ui.label(RichText::new(tr(text)).small().color(tokens.text_weak));
        }
        ui.end_row();
        for (ceramic, row) in Ceramic::ALL.into_iter().zip(rows) {
            let material = ceramic.material();
            let used = present == Some(ceramic);
            let label = if used { tr("in use") } else { tr("use") };
            if ui.add_enabled(!used, egui::Button::new(RichText::new(label).small())).clicked() {
                adopt(context, ceramic);
            }
            let colour = if used { tokens.accent } else { tokens.text_strong };
            ui.label(RichText::new(material.name).color(colour));
            ui.label(material.quality_factor.to_string());
            let bound = if material.dissipation_is_bound { "< " } else { "" };
            ui.label(format!("{bound}{} %", significant(100.0 * material.dissipation_factor, 2)));
            match row {
                Some(Ok(row)) => found(context, ui, row),
                Some(Err(failure)) => {
                    ui.label(RichText::new(say(failure)).small().color(tokens.warning));
                }
                None => {
                    ui.label(RichText::new(tr("computing")).small().color(tokens.text_weak));
                }
            }
            ui.end_row();
        }
    });
}

/// What a ceramic makes of the device.
fn found(context: &Context<'_>, ui: &mut Ui, row: &MaterialRow) {
    let tokens = theme::tokens(ui);
    ui.label(significant(row.alpha, 3));
    match &row.threshold {
        Some(threshold) => {
            ui.label(format!("{} g", significant(threshold.acceleration, 3)))
                .on_hover_text(format!("β = {}", significant(threshold.beta, 4)));
            ui.label(format!("{} Hz", significant(threshold.frequency, 4)));
        }
        None => {
            ui.label(tr("none"));
            ui.label("–");
        }
    }
    let open = row
        .open
        .map_or(tr("closed").to_owned(), |open| format!("{} Hz", significant(open.to - open.from, 3)));
    let label = ui.label(open);
    if let Some(open) = row.open {
        label.on_hover_text(fill(
            "{from} to {to} Hz",
            &[("from", &significant(open.from, 5)), ("to", &significant(open.to, 5))],
        ));
    }
    let Some(harvest) = &row.reached.harvest else {
        ui.label(RichText::new(say(&row.reached.motion)).color(tokens.danger));
        ui.label("–");
        return;
    };
    ui.label(RichText::new(with_unit(harvest.measures.power, "W")).color(tokens.text_strong)).on_hover_text(
        format!("{}, {}", say(&row.reached.motion), with_unit(harvest.measures.v_rms, tr("V rms"))),
    );
    // The ceramic's own voltage, unless the user chose one.
    let limits = Limits {
        voltage: context.view.design.limits.voltage.or(row.voltage_limit),
        ..context.view.design.limits
    };
    let gap = context.session.boundaries.as_ref().and_then(|boundaries| boundaries.gap);
    let checks = limits.checks(&harvest.demand, gap);
    let colour = match safety::standing(&checks) {
        // What is not checked is not safe.
        Standing::Within if limits.voltage.is_none() => tokens.text_weak,
        Standing::Within => tokens.ok,
        Standing::Marginal => tokens.warning,
        Standing::Exceeded => tokens.danger,
    };
    let allowed = limits.voltage.map_or(tr("not given").to_owned(), |(low, _)| with_unit(low, "V"));
    let text = format!("{} / {allowed}", with_unit(harvest.demand.v_peak, "V"));
    let said: Vec<String> = checks.iter().map(safety::in_words).collect();
    ui.label(RichText::new(text).color(colour)).on_hover_text(said.join("\n"));
}

fn adopt(context: &mut Context<'_>, ceramic: Ceramic) {
    let mode = context.view.design.mode.clamp(1, context.view.scenario.model.modes);
    let taken = with_ceramic(&context.view.scenario, ceramic, mode);
    context.commands.push(Command::Adopt(taken.map(Box::new).map_err(Sentence::from)));
}

fn notes(context: &Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let mode = context.view.design.mode.clamp(1, context.view.scenario.model.modes);
    let text = fill(
        "A ceramic sets the damping α so that mode {mode} alone has its quality factor, and its dissipation factor as a \
         conductance beside the load at the present frequency. Stiffness, mass, coupling and capacitance stay: Table 2 \
         gives none. Threshold: lowest shaking that opens the tongue; tongue open: its width at the present amplitude.",
        &[("mode", &mode)],
    );
    ui.add(egui::Label::new(RichText::new(text).small().color(tokens.text_weak)).wrap());
}
