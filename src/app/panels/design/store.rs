//! The rectifier: the drop of its diodes, and the best voltage of its store.

use egui::{RichText, Ui};

use crate::app::panels::{Context, computing};
use crate::app::text::{fill, say, tr};
use crate::app::theme;
use crate::app::widgets::ParameterSlider;
use crate::app::widgets::number::{significant, with_unit};
use crate::questions::rectifier::RectifierStudy;
use crate::scheduler::Study as _;

/// Highest drop on the slider (V).
const MOST: f64 = 2.0;

/// Draws the card's contents.
pub(super) fn controls(context: &mut Context<'_>, ui: &mut Ui) {
    let mut drop = context.view.design.diode_drop;
    let slider = ParameterSlider::new(tr("Drop of a diode"), "", &mut drop, 0.0..=MOST).unit("V");
    slider
        .tooltip(tr(
            "Two diodes of the bridge are in the way of the current; Schottky diodes drop 0.2 to 0.4 V each.",
        ))
        .compact()
        .show(ui);
    if drop != context.view.design.diode_drop {
        context.redesign(|design| design.diode_drop = drop);
    }
    let weak = theme::tokens(ui).text;
    let line = |ui: &mut Ui, text: String| {
        ui.add(egui::Label::new(RichText::new(text).small().color(weak)).wrap());
    };
    let Some(study) = context.studies.lanes.study::<RectifierStudy>() else { return };
    if !study.finished() {
        line(ui, computing(study.progress()));
    }
    if let Some(open) = study.open_circuit().flatten() {
        line(ui, fill("open electrodes reach {volts}", &[("volts", &with_unit(open, "V"))]));
    }
    if let Some(best) = study.best() {
        let (volts, power) = (with_unit(best.voltage, "V"), with_unit(best.power(), "W"));
        line(ui, fill("best: {power} at {volts} in the store", &[("power", &power), ("volts", &volts)]));
        if let Some(delivered) = &best.delivered {
            let current = with_unit(delivered.current, "A");
            let percent = delivered.efficiency.map_or(f64::NAN, |part| 100.0 * part);
            line(
                ui,
                fill(
                    "{current} on average; {percent} % of what the base puts in",
                    &[("current", &current), ("percent", &significant(percent, 3))],
                ),
            );
        }
        line(ui, say(&best.steady));
    }
    let undecided = study.curve().filter(|point| point.delivered.is_none()).count();
    if undecided > 0 {
        line(ui, fill("{count} voltages without a steady cycle", &[("count", &undecided)]));
    }
}
