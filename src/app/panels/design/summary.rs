//! What the device delivers as it is, in large numbers, and whether it bears it.

use egui::{RichText, Ui};

use super::safety::{self, Safety};
use crate::app::bench;
use crate::app::panels::Context;
use crate::app::panels::verdict::SEPARATOR;
use crate::app::theme;
use crate::app::widgets::number::{prefix, significant, with_unit};
use crate::app::widgets::{Card, Tile, tiles};
use crate::dynamics::Motion;
use crate::jobs::design::{Harvest, Operating};
use crate::model::limits::Standing;

/// Least width of a tile, points.
const TILE: f32 = 104.0;

/// Draws the card.
pub(super) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    let found = context.studies.bench.operating(&context.view.scenario);
    Card::new("").hugging().show(ui, |ui| match found {
        None => {
            ui.label(
                RichText::new("computing what the device delivers ...").color(theme::tokens(ui).text_weak),
            );
        }
        Some((Err(message), current)) => {
            let tokens = theme::tokens(ui);
            let colour = if current { tokens.danger } else { tokens.text_weak };
            ui.add(egui::Label::new(RichText::new(format!("{message}.")).color(colour)).wrap());
        }
        Some((Ok(operating), current)) => {
            if !current {
                ui.multiply_opacity(0.55);
            }
            numbers(context, ui, operating);
            sentences(context, ui, operating);
        }
    });
}

fn numbers(context: &Context<'_>, ui: &mut Ui, operating: &Operating) {
    let tokens = theme::tokens(ui);
    let Some(harvest) = &operating.reached.harvest else {
        let word = match operating.reached.motion {
            Motion::Contact { .. } => "contact",
            _ => "escape",
        };
        let tile = Tile {
            name: "From this start",
            value: word,
            unit: "",
            detail: "the motion ends: nothing is delivered",
            colour: Some(tokens.danger),
        };
        tiles(ui, &[tile], TILE);
        return;
    };
    let (power, per_g2) = (parts(harvest.power, "W"), parts(harvest.power_per_g2.unwrap_or(0.0), "W/g²"));
    let volts = parts(harvest.v_rms, "V");
    let tip = format!("{} to {}", significant(harvest.tip.0, 3), significant(harvest.tip.1, 3));
    let efficiency = harvest.efficiency.map_or("–".to_owned(), |part| significant(100.0 * part, 3));
    let peak = format!("peak {}", with_unit(harvest.demand.v_peak, "V"));
    let into =
        operating.resistance.map_or("open circuit".to_owned(), |r| format!("into {}", with_unit(r, "Ω")));
    let at = format!(
        "at {} g, {} Hz",
        significant(operating.acceleration, 3),
        significant(operating.frequency, 4)
    );
    let input = format!("of {} put in", with_unit(harvest.input, "W"));
    let closes = gap_in_words(context, harvest);
    let (word, colour, detail) = safe(context, ui, harvest);
    let plain =
        |name, (value, unit): &'_ (String, String), detail| (name, value.clone(), unit.clone(), detail);
    let all = [
        plain("Voltage, rms", &volts, peak),
        plain("Power in the load", &power, into),
        plain("Power per g²", &per_g2, at),
        ("Tip", tip, "mm".to_owned(), closes),
        ("Efficiency", efficiency, "%".to_owned(), input),
        ("Limits", word.to_owned(), String::new(), detail),
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
    let gap = Safety::of(context.view, context.session).and_then(|safety| safety.gap);
    gap.map_or("no magnets".to_owned(), |gap| {
        format!("closes {} % of the gap", significant((-100.0 * harvest.demand.tip.0 / gap).max(0.0), 2))
    })
}

/// Whether the motion keeps the limits: a word, its colour, and the check that is nearest to failing.
fn safe(context: &Context<'_>, ui: &Ui, harvest: &Harvest) -> (&'static str, egui::Color32, String) {
    let tokens = theme::tokens(ui);
    let Some(safety) = Safety::of(context.view, context.session) else {
        return ("–", tokens.text_weak, String::new());
    };
    let checks = safety.limits.checks(&harvest.demand, safety.gap);
    let detail = safety::worst(&checks).map(safety::in_words).unwrap_or_default();
    match safety::standing(&checks) {
        Standing::Within => ("safe", tokens.ok, detail),
        Standing::Marginal => ("marginal", tokens.warning, detail),
        Standing::Exceeded => ("unsafe", tokens.danger, detail),
    }
}

/// Class, gains, losses, and what to know.
fn sentences(context: &Context<'_>, ui: &mut Ui, operating: &Operating) {
    let tokens = theme::tokens(ui);
    let mut facts = vec![operating.reached.motion.to_string()];
    if let Some(gain) = operating.reached_gain {
        let linear = with_unit(operating.linear.power, "W");
        facts.push(format!("{} the linear device's {linear} at this frequency", times(gain)));
    }
    let best = context.studies.bench.linear_at_its_best();
    if let (Some((frequency, linear)), Some(harvest)) = (best, &operating.reached.harvest)
        && linear.power > 0.0
    {
        let bends = linear.demand.tip.1 > bench::limits(context.view).deflection;
        facts.push(format!(
            "{} its {} at its own resonance, {} Hz, under the same {} g{}",
            times(harvest.power / linear.power),
            with_unit(linear.power, "W"),
            significant(*frequency, 4),
            significant(operating.acceleration, 3),
            if bends { ", where it would bend far beyond a linear beam" } else { "" },
        ));
    }
    if let Some(harvest) = &operating.reached.harvest {
        let mut losses = format!("lost in the beam {}", with_unit(harvest.viscous, "W"));
        if harvest.dielectric > 0.0 {
            losses += &format!(", in the dielectric {}", with_unit(harvest.dielectric, "W"));
        }
        facts.push(losses);
    }
    let kept = context.bench.pinned.as_ref().and_then(|pinned| pinned.operating.as_ref());
    if let Some(kept) = kept.and_then(|kept| kept.reached.harvest.as_ref()) {
        let (volts, watts) = (with_unit(kept.v_rms, "V"), with_unit(kept.power, "W"));
        facts.push(format!("pinned: {volts}, {watts}"));
    }
    let mut remarks = Vec::new();
    if let Some(forced) = operating.forced.filter(|forced| !forced.stable) {
        remarks.push(format!(
            "the forced motion is unstable here (|μ| = {}) and would give {}",
            significant(forced.multiplier, 4),
            with_unit(forced.harvest.power, "W"),
        ));
    }
    if let Ok(device) = bench::device(&context.view.scenario) {
        let sag = bench::limits(context.view).sag(&device);
        if sag.standing == Standing::Exceeded {
            remarks.push(format!("the beam {}, which the model counts as small", safety::in_words(&sag)));
        }
    }
    ui.add_space(4.0);
    ui.label(RichText::new(facts.join(SEPARATOR)).color(tokens.text));
    if !remarks.is_empty() {
        ui.label(RichText::new(remarks.join(SEPARATOR)).small().color(tokens.warning));
    }
}

/// A ratio of powers, be it a gain or a loss.
fn times(ratio: f64) -> String {
    if ratio >= 1.0 {
        format!("{} times", significant(ratio, 3))
    } else {
        format!("only {} % of", significant(100.0 * ratio, 2))
    }
}
