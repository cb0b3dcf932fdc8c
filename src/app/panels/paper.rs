//! The paper's figures, one click each, with what the paper saw and what is computed here.

use egui::{RichText, Ui};

use super::{Context, figure_boundaries, figure_panels, grid, tables};
use crate::app::command::Command;
use crate::app::figures::{self, FIGURES, Figure};
use crate::app::text::{fill, tr};
use crate::app::widgets::{BadgeKind, badge, chips};
use crate::app::{caption, fonts, theme};
use crate::model::Parameter;
use crate::scenario::Scenario;
use crate::sentence::Say;

/// The number under which the tables are chosen.
pub(in crate::app) const TABLES: u8 = 1;

/// Draws the tab.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    choose(context, ui);
    ui.add_space(8.0);
    let Some(figure) = figures::figure(context.view.figure) else {
        tables::show(context, ui);
        return;
    };
    describe(context, ui, figure);
    if context.on_top.is_some() {
        return;
    }
    ui.add_space(10.0);
    match figure.boundaries() {
        Some(boundaries) => figure_boundaries::show(context, ui, &boundaries),
        None => {
            let panels = figure_panels::panels(figure);
            grid::grid(ui, panels, &mut |ui, panel| {
                figure_panels::show(context, ui, figure, *panel, &[]);
            });
        }
    }
}

fn choose(context: &mut Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let labels: Vec<String> = FIGURES.iter().map(|figure| figure.number.to_string()).collect();
    let mut choices: Vec<(u8, &str)> =
        FIGURES.iter().zip(&labels).map(|(figure, label)| (figure.number, label.as_str())).collect();
    choices.push((TABLES, tr("Tables")));
    let mut number = context.view.figure;
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(tr("Figure")).color(tokens.text_weak));
        if chips(ui, tr("Figure"), &mut number, &choices) {
            context.commands.push(Command::LoadFigure(number));
        }
    });
}

/// Title, the paper's words, and ours.
fn describe(context: &mut Context<'_>, ui: &mut Ui, figure: &Figure) {
    let tokens = theme::tokens(ui);
    let frame = egui::Frame::new()
        .fill(tokens.card)
        .corner_radius(theme::radius::CARD)
        .inner_margin(egui::Margin::symmetric(16, 11));
    frame.show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        ui.horizontal_wrapped(|ui| {
            let title = fill(
                "Figure {number}  ·  {title}",
                &[("number", &figure.number), ("title", &tr(figure.title))],
            );
            ui.label(
                RichText::new(title).font(fonts::semibold(theme::size::TITLE)).color(tokens.text_strong),
            );
            let changed = figure.scenario().map(|own| changes(&own, &context.view.scenario));
            if let Some(changed) = changed.filter(|changed| !changed.is_empty()) {
                let list = [("list", &changed.join(", ") as &dyn Say)];
                badge(ui, BadgeKind::Warning, &fill("changed: {list}", &list));
                if ui.button(fill("Load Figure {number}", &[("number", &figure.number)])).clicked() {
                    context.commands.push(Command::LoadFigure(figure.number));
                }
            }
        });
        ui.add_space(2.0);
        paragraph(ui, tr("The paper: "), tr(figure.paper));
        paragraph(ui, tr("This model: "), &caption::caption(context.session, figure));
    });
}

/// What of a figure's own scenario is another in the one that is shown: what it is called on the page.
fn changes(own: &Scenario, shown: &Scenario) -> Vec<&'static str> {
    let parameters = Parameter::ALL
        .into_iter()
        .filter(|parameter| own.parameters.get(*parameter) != shown.parameters.get(*parameter))
        .map(|parameter| parameter.fact().symbol);
    let rest = [
        (own.model.modes != shown.model.modes, tr("modes")),
        (own.model.force != shown.model.force, tr("force law")),
        (own.model.residual_moment != shown.model.residual_moment, tr("the modes left out")),
        (own.initial != shown.initial, tr("start")),
        (own.t_end != shown.t_end, tr("duration")),
    ];
    parameters.chain(rest.into_iter().filter(|(differs, _)| *differs).map(|(_, name)| name)).collect()
}

fn paragraph(ui: &mut Ui, lead: &str, text: &str) {
    let tokens = theme::tokens(ui);
    let mut job = egui::text::LayoutJob::default();
    let format = |colour, font| egui::TextFormat { font_id: font, color: colour, ..Default::default() };
    job.append(lead, 0.0, format(tokens.text_weak, fonts::semibold(theme::size::BODY)));
    job.append(text, 0.0, format(tokens.text, fonts::regular(theme::size::BODY)));
    ui.add(egui::Label::new(job).wrap());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ForceLaw;

    #[test]
    fn what_differs_from_a_figure_is_named() {
        let own = figures::figure(9).and_then(Figure::scenario).expect("a scenario");
        let mut shown = own.clone();
        shown.device = Some(crate::model::Device::default());
        assert!(changes(&own, &shown).is_empty());
        shown.parameters.omega += 1e-6;
        shown.parameters.c0 = 0.5;
        shown.model.force = ForceLaw::Exact;
        shown.t_end += 1.0;
        assert_eq!(changes(&own, &shown), ["ω", "c₀", "force law", "duration"]);
    }
}
