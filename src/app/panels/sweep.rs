//! The Sweep tab: the motion along a range of one parameter, up and down, and the periodic motions that there are.

use egui::Ui;

use super::{Context, facts, grid, plots, verdict};
use crate::app::command::Command;
use crate::app::questions;
use crate::app::text::tr;
use crate::app::view::{Output, SweepView};
use crate::app::widgets::{Card, ParameterSlider, chips_after};
use crate::dynamics::attractors::sweep::Dwell;
use crate::model::Parameter;

/// Periods thrown away and kept.
const HOLDS: [(Dwell, &str); 3] = [
    (Dwell { discarded: 60, kept: 32 }, "60 + 32"),
    (Dwell { discarded: 200, kept: 64 }, "200 + 64"),
    (Dwell { discarded: 1000, kept: 128 }, "1000 + 128"),
];
const COUNTS: [(usize, &str); 3] = [(120, "120"), (240, "240"), (600, "600")];
/// Widths from which the choices stand in two rows, and in one.
const WIDE: f32 = 700.0;
const WIDEST: f32 = 980.0;

/// Draws the tab.
pub(in crate::app) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    verdict::show(context, ui);
    ui.add_space(grid::GAP - ui.spacing().item_spacing.y);
    choices(context, ui);
    ui.add_space(grid::GAP);
    plots::cards(context, ui);
}

fn choices(context: &mut Context<'_>, ui: &mut Ui) {
    let mut sweep = context.view.sweep;
    let width = ui.available_width();
    let (wide, halved) = (width >= WIDE, (WIDE..WIDEST).contains(&width));
    Card::new("").hugging().show(ui, |ui| {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 8.0;
            let parameters = Parameter::ALL.map(|parameter| (parameter, parameter.fact().symbol));
            if chips_after(ui, tr("sweep"), tr("Swept parameter"), &mut sweep.parameter, &parameters) {
                sweep.range = None;
            }
            chips_after(ui, tr("values"), tr("Number of values"), &mut sweep.count, &COUNTS);
            if halved {
                ui.end_row();
            }
            chips_after(ui, tr("periods dropped + kept"), tr("Periods"), &mut sweep.dwell, &HOLDS);
            let outputs =
                [(Output::Voltage, tr("voltage")), (Output::Power, tr("power")), (Output::Tip, tr("tip"))];
            chips_after(ui, tr("curves of"), tr("Response of"), &mut sweep.output, &outputs);
        });
        ui.add_space(4.0);
        let range = questions::sweep_range(context.view, context.session);
        if wide {
            let usual = std::mem::replace(&mut ui.spacing_mut().item_spacing.x, 28.0);
            ui.columns(2, |columns| {
                columns.iter_mut().for_each(|column| column.spacing_mut().item_spacing.x = usual);
                ends(columns, &mut sweep, range);
            });
        } else {
            ends(std::slice::from_mut(ui), &mut sweep, range);
        }
    });
    if sweep != context.view.sweep {
        context.commands.push(Command::Sweep(sweep));
    }
}

/// The sliders for both ends of the range, one a column.
fn ends(columns: &mut [Ui], sweep: &mut SweepView, range: (f64, f64)) {
    let fact = sweep.parameter.fact();
    let (minimum, maximum) = (fact.usual.0.min(range.0), fact.usual.1.max(range.1));
    let (mut low, mut high) = range;
    let end = |ui: &mut Ui, name: &str, value: &mut f64| {
        let slider = ParameterSlider::new(name, fact.symbol, value, minimum..=maximum).compact();
        facts::spread(slider, fact, minimum).show(ui);
    };
    let last = columns.len() - 1;
    end(&mut columns[0], tr("From"), &mut low);
    end(&mut columns[last], tr("To"), &mut high);
    if (low, high) != range {
        sweep.range = Some((low, high));
    }
}
