//! The map of a result over two dimensions of the device.

use egui::{Color32, Id, Ui};
use egui_plot::PlotBounds;

use super::design::search::digits::in_digits;
use super::spec::{Asking, Place, Spec};
use super::{Context, facts};
use crate::app::panels::device::adopt;
use crate::app::text::{fill, say, tr};
use crate::app::view::design::{Aim, Page};
use crate::app::widgets::number::{self, round_significant};
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Filling, chips, colour_bar, hatched, recorder, row, swatches};
use crate::app::{bench, colours, theme};
use crate::model::{Dimension, ElectricalScaling};
use crate::questions::design::space::{Evaluation, Objective};
use crate::questions::map::DesignMap;
use crate::scheduler::Asked as _;

/// Columns and rows.
const SIZE: (usize, usize) = (40, 28);

/// The map.
pub(super) const PANEL: Spec = Spec::new(Place::Page(Page::Search), |_| tr("Map"), contents)
    .hint(|context| context.computing::<DesignMap>(tr("drag or click to go there")))
    .asking(ask);

fn ask(Asking { view, session, studies, .. }: &mut Asking<'_>) {
    let question = bench::questions::map(view, session);
    studies.lanes.ask(question, |question| DesignMap::new(question, SIZE).ok());
}

fn contents(context: &mut Context<'_>, ui: &mut Ui) {
    let Some(map) = context.studies.lanes.study::<DesignMap>() else { return };
    header(context, ui, map);
    match map.failure() {
        Some(why) => plot_style::no_data(ui, ui.available_rect_before_wrap(), &say(why)),
        None => plot(context, ui, map),
    }
}

/// What is mapped, with its unit.
fn mapped(aim: Aim) -> &'static str {
    match aim {
        Aim::Power => tr("power in the load [W]"),
        Aim::PerG2 => tr("power per g² [W/g²]"),
        Aim::Voltage => tr("voltage, rms [V]"),
        Aim::Band => tr("width of the band [Hz]"),
        Aim::Threshold => tr("lowest excitation β of the resonance"),
    }
}

fn header(context: &mut Context<'_>, ui: &mut Ui, map: &DesignMap) {
    let mut aim = context.view.design.search.aim;
    let choices = [
        (Aim::Power, tr("power")),
        (Aim::PerG2, tr("per g²")),
        (Aim::Voltage, tr("voltage")),
        (Aim::Band, tr("band")),
        (Aim::Threshold, tr("threshold")),
    ];
    let tokens = theme::tokens(ui);
    let (low, high) = extremes(map);
    row(ui, |ui| {
        if chips(ui, tr("Mapped"), &mut aim, &choices) {
            context.redesign(|design| design.search.pursue(aim));
        }
    });
    ui.horizontal(|ui| {
        let (from, to) = if aim == Aim::Threshold { (high, low) } else { (0.0, high) };
        colour_bar(ui, &in_digits(from, aim), &in_digits(to, aim), &colours::sequential);
    });
    swatches(
        ui,
        &[
            (Filling::Hatching, tr("beyond a limit")),
            (Filling::Plain(tokens.track), tr("no motion, no device")),
        ],
    );
}

/// Lowest and highest value known.
fn extremes(map: &DesignMap) -> (f64, f64) {
    let (columns, rows) = map.size();
    let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
    let values = cells.filter_map(|place| map.cell(place).and_then(|cell| cell.value));
    let (low, high) =
        values.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), value| (low.min(value), high.max(value)));
    (if low.is_finite() { low } else { 0.0 }, high)
}

fn axis(dimension: Dimension, logarithmic: bool, scaling: ElectricalScaling) -> Axis {
    let fact = dimension.fact();
    let axis = facts::axis(fact).unit(scaling.unit(fact.shown.0));
    if logarithmic { axis.logarithmic() } else { axis }
}

fn plot(context: &mut Context<'_>, ui: &mut Ui, map: &DesignMap) {
    let tokens = theme::tokens(ui);
    let search = context.view.design.search;
    let (low, high) = extremes(map);
    let inverted = matches!(map.asked().objective, Objective::Threshold(_));
    let colour = |cell: &Evaluation| -> Color32 {
        let Some(value) = cell.value else { return tokens.track };
        let share =
            if inverted { (high - value) / (high - low).max(1e-300) } else { value / high.max(1e-300) };
        colours::sequential(share)
    };
    let paint = |column: usize, row: usize| {
        let cell = map.shown((column, row))?;
        Some((colour(cell), cell.value.is_some() && cell.violation > 0.0))
    };
    let generation = context.studies.lanes.generation::<DesignMap>();
    let revision = map.version() ^ (generation << 32) ^ tokens.number() << 62;
    let picture = hatched(ui, Id::unique("design map"), revision, map.size(), &paint);
    let variables = &map.asked().variables;
    let sides = search.sides.map(|side| side.dimension);
    let scaling = map.asked().scenario.scaling;
    let factors = sides.map(|dimension| dimension.fact().shown.1);
    let axes = [0, 1].map(|i| axis(sides[i], variables[i].logarithmic, scaling));
    let place = |i: usize, value: f64| axes[i].coordinate(factors[i] * value);
    let range = |i: usize| (place(i, variables[i].range.0), place(i, variables[i].range.1));
    let (x, y) = (range(0), range(1));
    let Ok(present) = bench::device(&context.view.scenario) else { return };
    let here = [0, 1].map(|i| place(i, present.get(sides[i])));
    let best = map.best();
    let id = ("design map", sides.map(|side| side as u8));
    let shown = plot_style::fixed(ui, id, &axes[0], &axes[1]).show_grid(false).show(ui, |plot| {
        plot.set_plot_bounds(PlotBounds::from_min_max([x.0, y.0], [x.1, y.1]));
        if let Some(picture) = &picture {
            picture.draw(plot, x, y, if map.version() == 0 { 0.4 } else { 1.0 });
            let value = |column, row| map.cell((column, row))?.value.map(number::exact);
            recorder::cells(plot, mapped(search.aim), map.size(), [x, y], &value);
        }
        if let Some((at, evaluation)) = best {
            let values = map.values(at);
            let at = egui_plot::PlotPoint::new(place(0, values[0]), place(1, values[1]));
            let name = evaluation.value.map_or(String::new(), |value| in_digits(value, search.aim));
            plot_style::special_point(plot, &fill("best: {name}", &[("name", &name)]), at);
        }
    });
    let drag = plot_style::operating_point(ui, &shown, tr("Device in view"), here);
    if let Some(moved) = drag.moved {
        let mut device = present;
        for i in [0, 1] {
            let (low, high) = variables[i].range;
            let value = (axes[i].value(moved[i]) / factors[i]).clamp(low, high);
            device = device.with(sides[i], round_significant(value, 5));
        }
        if context.view.design.holds_acceleration && !sides.contains(&Dimension::BaseAmplitude) {
            device = device.with_acceleration(present.acceleration());
        }
        let scaling = context.view.scenario.scaling;
        adopt(context, device, scaling);
    }
}
