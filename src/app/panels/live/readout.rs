//! The run in numbers.

use egui::Ui;

use super::traced::si;
use crate::app::live::End;
use crate::app::panels::Context;
use crate::app::text::{fill, tr};
use crate::app::theme;
use crate::app::widgets::number::{prefix, short, significant};
use crate::app::widgets::{Tile, tiles};

/// Least width of a tile, points.
const TILE: f32 = 140.0;

/// Time, periods, means and the speed.
pub(super) fn show(context: &Context<'_>, ui: &mut Ui) {
    let (Some((_, _, now)), Some(period)) = (context.live.now(), context.live.period()) else { return };
    let units = si(context);
    // Voltages of a tip that has flown off mean nothing.
    let lost = matches!(context.live.ended, Some(End::Outcome(_)));
    let means = context.live.trail.means().filter(|_| !lost);
    let over = means.map_or_else(
        || if lost { String::new() } else { tr("needs a whole period").to_owned() },
        |(_, _, periods)| fill("over the last {count} periods", &[("count", &periods)]),
    );
    let (time, second) = units.map_or((now.time, ""), |units| (units.time * now.time, "s"));
    let dash = || tr("–").to_owned();
    let volts = means.map_or_else(dash, |(volts, _, _)| significant(volts, 3));
    let (power, watt) = match (means, units) {
        (None, _) => (dash(), String::new()),
        (Some((_, power, _)), None) => (significant(power, 3), String::new()),
        (Some((_, power, _)), Some(units)) => {
            let watts = units.watts(power);
            let (factor, name) = prefix(watts);
            (significant(factor * watts, 3), format!("{name}W"))
        }
    };
    let cycle = match units {
        Some(units) => fill("of {period} s each", &[("period", &short(period * units.time))]),
        None => fill("of {period} each", &[("period", &short(period))]),
    };
    let asked = context.view.live.speed;
    let slower = context.live.slower_than(asked);
    let tokens = theme::tokens(ui);
    let speed = short(slower.unwrap_or(asked));
    let pace = match slower {
        Some(_) => fill("{asked} are more than this machine can do", &[("asked", &short(asked))]),
        None => tr("periods a second").to_owned(),
    };
    let turns = format!("{:.1}", (10.0 * now.turns).floor() / 10.0);
    let time = format!("{time:.1}");
    let tile = |name, value, unit, detail, colour| Tile { name, value, unit, detail, colour };
    let all = [
        tile(tr("Time"), &time[..], second, tr("since the start"), None),
        tile(tr("Periods"), &turns, "", &cycle, None),
        tile(tr("Voltage, rms"), &volts, "V", &over, None),
        tile(tr("Power in the load"), &power, &watt, &over, None),
        tile(tr("Speed"), &speed, tr("/s"), &pace, slower.map(|_| tokens.warning)),
    ];
    tiles(ui, &all, TILE);
}
