//! What the device delivers as it is, in large numbers, and whether it bears it.

use egui::{RichText, Ui};

use super::answer;
use super::safety::{self, Judged, Safety};
use crate::app::bench;
use crate::app::panels::Context;
use crate::app::panels::verdict::in_a_line;
use crate::app::text::{fill, say, tr};
use crate::app::theme;
use crate::app::view::design::Page;
use crate::app::widgets::number::{prefix, significant, with_unit};
use crate::app::widgets::{Card, Tile, tiles};
use crate::dynamics::Motion;
use crate::model::ElectricalScaling;
use crate::model::limits::Assessment;
use crate::questions::design::{Harvest, Operating};

/// Least width of a tile, points.
const TILE: f32 = 140.0;

/// Draws the card.
pub(super) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    let found = context.studies.operating(&context.view.scenario);
    Card::new("").hugging().show(ui, |ui| {
        if on_harvest(context) {
            answer::show(context, ui);
        }
        match found {
            None => {
                ui.label(
                    RichText::new(tr("computing what the device delivers ..."))
                        .color(theme::tokens(ui).text_weak),
                );
            }
            Some((Err(message), current)) => {
                let tokens = theme::tokens(ui);
                let colour = if current { tokens.danger } else { tokens.text_weak };
                ui.add(egui::Label::new(RichText::new(say(message) + ".").color(colour)).wrap());
            }
            Some((Ok(operating), current)) => {
                if !current {
                    ui.multiply_opacity(0.55);
                }
                numbers(context, ui, operating);
                sentences(context, ui, operating);
            }
        }
    });
}

fn numbers(context: &Context<'_>, ui: &mut Ui, operating: &Operating) {
    let tokens = theme::tokens(ui);
    let Some(harvest) = &operating.reached.harvest else {
        let word = match operating.reached.motion {
            Motion::Contact { .. } => tr("contact"),
            _ => tr("escape"),
        };
        let tile = Tile {
            name: tr("From this start"),
            value: word,
            unit: "",
            detail: tr("the motion ends: nothing is delivered"),
            colour: Some(tokens.danger),
        };
        tiles(ui, &[tile], TILE);
        return;
    };
    let (power, per_g2) =
        (parts(harvest.measures.power, "W"), parts(harvest.power_per_g2.unwrap_or(0.0), "W/g²"));
    let volts = parts(harvest.measures.v_rms, "V");
    let tip = fill(
        "{from} to {to}",
        &[("from", &significant(harvest.measures.tip.0, 3)), ("to", &significant(harvest.measures.tip.1, 3))],
    );
    let efficiency = harvest.efficiency.map_or("–".to_owned(), |part| significant(100.0 * part, 3));
    let peak = fill("peak {value}", &[("value", &with_unit(harvest.demand.v_peak, "V"))]);
    let into = operating
        .resistance
        .map_or(tr("open circuit").to_owned(), |r| fill("into {load}", &[("load", &with_unit(r, "Ω"))]));
    let at = fill(
        "at {acceleration} g, {hertz} Hz",
        &[
            ("acceleration", &significant(operating.acceleration, 3)),
            ("hertz", &significant(operating.frequency, 4)),
        ],
    );
    let input = fill("of {power} put in", &[("power", &with_unit(harvest.input, "W"))]);
    let closes = gap_in_words(context, harvest);
    let (word, colour, detail) = judged(context, operating)
        .map_or(("–", tokens.text_weak, String::new()), |judged| {
            (judged.word, judged.colour(tokens), judged.detail)
        });
    let plain =
        |name, (value, unit): &'_ (String, String), detail| (name, value.clone(), unit.clone(), detail);
    let all = [
        plain(tr("Voltage, rms"), &volts, peak),
        plain(tr("Power in the load"), &power, into),
        plain(tr("Power per g²"), &per_g2, at),
        (tr("Tip"), tip, "mm".to_owned(), closes),
        (tr("Efficiency"), efficiency, "%".to_owned(), input),
        (tr("Limits"), word.to_owned(), String::new(), detail),
    ];
    let last = all.len() - 1;
    let drawn: Vec<Tile<'_>> = all
        .iter()
        .enumerate()
        .map(|(i, (name, value, unit, detail))| Tile {
            name,
            value,
            unit,
            detail,
            colour: (i == last).then_some(colour),
        })
        .collect();
    tiles(ui, &drawn, TILE);
}

/// A value in digits, and its unit under a prefix.
fn parts(value: f64, unit: &str) -> (String, String) {
    let (factor, sign) = prefix(value);
    (significant(factor * value, 3), format!("{sign}{unit}"))
}

fn gap_in_words(context: &Context<'_>, harvest: &Harvest) -> String {
    let gap = Safety::of(context.view, context.session).and_then(|safety| safety.0.gap);
    gap.map_or(tr("no magnets").to_owned(), |gap| {
        fill(
            "closes {percent} % of the gap",
            &[("percent", &significant((-100.0 * harvest.demand.tip.0 / gap).max(0.0), 2))],
        )
    })
}

/// How the motion reached stands to the limits.
fn judged(context: &Context<'_>, operating: &Operating) -> Option<Judged> {
    let demand = operating.reached.harvest.as_ref()?.demand;
    Judged::of(&Safety::of(context.view, context.session)?, &context.view.scenario, &demand)
}

/// Whether the sentence about the curves over frequency stands above.
fn on_harvest(context: &Context<'_>) -> bool {
    context.view.design.page == Page::Harvest
}

/// Class, gains, losses, and what to know.
fn sentences(context: &Context<'_>, ui: &mut Ui, operating: &Operating) {
    let tokens = theme::tokens(ui);
    let mut facts = vec![say(&operating.reached.motion)];
    if let Some(error) = operating.reached.harvest.and_then(|harvest| harvest.power_error) {
        facts.push(fill("its mean power is known to ± {error}", &[("error", &with_unit(error, "W"))]));
    }
    if let Some(gain) = operating.reached_gain {
        let linear = with_unit(operating.linear.measures.power, "W");
        facts.push(fill(
            "{times} the linear device's {linear} at this frequency",
            &[("times", &times(gain)), ("linear", &linear)],
        ));
    }
    let told = |frequency| on_harvest(context) && answer::names_peak(context, frequency);
    let best = context.studies.linear_at_its_best().filter(|best| !told(best.frequency));
    if let (Some(linear), Some(harvest)) = (best, &operating.reached.harvest)
        && linear.power > 0.0
    {
        let bends = linear.tip > bench::limits(context.view).deflection;
        facts.push(fill(
            "{times} its {power} at its own resonance, {hertz} Hz, under the same {acceleration} g{bends}",
            &[
                ("times", &times(harvest.measures.power / linear.power)),
                ("power", &with_unit(linear.power, "W")),
                ("hertz", &significant(linear.frequency, 4)),
                ("acceleration", &significant(operating.acceleration, 3)),
                ("bends", &if bends { tr(", where it would bend far beyond a linear beam") } else { "" }),
            ],
        ));
    }
    if let Some(harvest) = &operating.reached.harvest {
        let mut losses = fill("lost in the beam {power}", &[("power", &with_unit(harvest.viscous, "W"))]);
        if harvest.dielectric > 0.0 {
            losses += &fill(", in the dielectric {power}", &[("power", &with_unit(harvest.dielectric, "W"))]);
        }
        facts.push(losses);
    }
    let mut remarks = Vec::new();
    if let Some(forced) = operating.forced.filter(|forced| !forced.stable) {
        remarks.push(fill(
            "the forced motion is unstable here (|μ| = {multiplier}) and would give {power}",
            &[
                ("multiplier", &significant(forced.multiplier, 4)),
                ("power", &with_unit(forced.harvest.measures.power, "W")),
            ],
        ));
    }
    if context.view.scenario.scaling == ElectricalScaling::AsPrinted {
        // See `Units::power`.
        let factor = 1.0 / context.view.scenario.units().length;
        remarks.push(fill(
            "input and losses count {factor} times their watts under the printed scaling",
            &[("factor", &significant(factor, 3))],
        ));
    }
    if let Ok(device) = bench::device(&context.view.scenario)
        && bench::printed_for_own(&device, context.view.scenario.scaling)
    {
        remarks.push(
            tr("the electrical scaling is the paper's: choose consistent units for a device of your own")
                .to_owned(),
        );
    }
    let said = judged(context, operating).map(|judged| judged.assessment) == Some(Assessment::ModelNotValid);
    if !(said && on_harvest(context)) {
        remarks.extend(safety::too_much_sag(&context.view.scenario));
    }
    ui.add_space(4.0);
    ui.label(RichText::new(in_a_line(&facts)).color(tokens.text));
    if !remarks.is_empty() {
        ui.label(RichText::new(in_a_line(&remarks)).small().color(tokens.warning));
    }
}

/// A ratio of powers, be it a gain or a loss.
fn times(ratio: f64) -> String {
    // Below that a part would round to 100 %.
    if ratio >= 0.995 {
        fill("{ratio} times", &[("ratio", &significant(ratio, 3))])
    } else {
        fill("only {ratio} % of", &[("ratio", &significant(100.0 * ratio, 2))])
    }
}
