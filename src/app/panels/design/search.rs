//! A map of any result over two dimensions of the device, and the search for the best.

use egui::{Color32, Id, RichText, Ui};
use egui_plot::PlotBounds;

use crate::app::bench::{self, questions};
use crate::app::colours;
use crate::app::command::Command;
use crate::app::panels::computing;
use crate::app::panels::{Context, device, explore};
use crate::app::text::{fill, reworded, tr, within};
use crate::app::theme;
use crate::app::view::Panel;
use crate::app::view::design::{Aim, Side};
use crate::app::widgets::number::{self, round_significant, significant, with_unit};
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{
    Card, HATCH, ParameterSlider, chips, colour_bar, draw_cells, on_hatching, raster, recorder, swatches,
};
use crate::jobs::design::find::{Evaluation, Objective};
use crate::jobs::study::Study as _;
use crate::jobs::study::find::{Candidate, FindStudy};
use crate::jobs::study::map::DesignMap;
use crate::model::Dimension;

/// Draws the map's card.
pub(super) fn show(context: &mut Context<'_>, ui: &mut Ui) {
    let hint = match context.studies.bench.map.study() {
        Some(map) if !map.finished() => computing(map.progress()),
        _ => tr("drag or click to go there").to_owned(),
    };
    context.plot_card(ui, Panel::DesignMap, tr("Map"), &hint, |context, ui| {
        let Some(map) = context.studies.bench.map.study() else { return };
        header(context, ui, map);
        match map.failure() {
            Some(why) => plot_style::no_data(ui, ui.available_rect_before_wrap(), why),
            None => plot(context, ui, map),
        }
    });
}

/// What the objective counts in.
fn unit(aim: Aim) -> &'static str {
    match aim {
        Aim::Power => "W",
        Aim::PerG2 => "W/g²",
        Aim::Voltage => "V",
        Aim::Band => "Hz",
        Aim::Threshold => "",
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

fn in_digits(value: f64, aim: Aim) -> String {
    if aim == Aim::Threshold {
        format!("β = {}", significant(value, 3))
    } else {
        with_unit(value, unit(aim))
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
    ui.horizontal_wrapped(|ui| {
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
        &[(tokens.danger, tr("hatched: beyond a limit")), (tokens.track, tr("no motion, no device"))],
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

fn axis(dimension: Dimension, logarithmic: bool) -> Axis {
    let (name, symbol, unit, ..) = device::words(dimension);
    let axis = Axis::new(within(name), symbol).unit(unit);
    if logarithmic { axis.logarithmic() } else { axis }
}

fn plot(context: &mut Context<'_>, ui: &mut Ui, map: &DesignMap) {
    let tokens = theme::tokens(ui);
    let search = context.view.design.search;
    let (low, high) = extremes(map);
    let inverted = matches!(map.question().objective, Objective::Threshold(_));
    let colour = |cell: &Evaluation, hatched: bool| -> Color32 {
        let Some(value) = cell.value else { return tokens.track };
        let share =
            if inverted { (high - value) / (high - low).max(1e-300) } else { value / high.max(1e-300) };
        let colour = colours::sequential(share);
        if hatched { colour.lerp_to_gamma(tokens.danger, 0.9) } else { colour }
    };
    let paint = |column: usize, row: usize| {
        let cell = map.shown((column / HATCH, row / HATCH))?;
        Some(colour(cell, cell.violation > 0.0 && on_hatching(column, row)))
    };
    let generation = context.studies.bench.map.generation();
    let revision = map.version() ^ (generation << 32) ^ tokens.number() << 62;
    let (columns, rows) = map.size();
    let picture = raster(ui, Id::unique("design map"), revision, (HATCH * columns, HATCH * rows), &paint);
    let variables = &map.question().variables;
    let sides = search.sides.map(|side| side.dimension);
    let factors = sides.map(|dimension| device::words(dimension).3);
    let axes = [0, 1].map(|i| axis(sides[i], variables[i].logarithmic));
    let place = |i: usize, value: f64| axes[i].coordinate(factors[i] * value);
    let range = |i: usize| (place(i, variables[i].range.0), place(i, variables[i].range.1));
    let (x, y) = (range(0), range(1));
    let Ok(present) = bench::device(&context.view.scenario) else { return };
    let here = [0, 1].map(|i| place(i, sides[i].get(&present)));
    let best = map.best();
    let id = ("design map", sides.map(|side| side as u8));
    let shown = plot_style::plot(ui, id, &axes[0], &axes[1])
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_double_click_reset(false)
        .show(ui, |plot| {
            plot.set_plot_bounds(PlotBounds::from_min_max([x.0, y.0], [x.1, y.1]));
            if let Some(picture) = &picture {
                draw_cells(plot, picture, HATCH, x, y, if map.version() == 0 { 0.4 } else { 1.0 });
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
            *sides[i].get_mut(&mut device) = round_significant(value, 5);
        }
        adopt(context, device);
    }
}

fn adopt(context: &mut Context<'_>, device: crate::model::Device) {
    let mut scenario = context.view.scenario.clone();
    let scaling = scenario.scaling;
    let taken = scenario.set_device(device, scaling).map(|()| Box::new(scenario));
    context.commands.push(Command::Adopt(taken.map_err(|error| error.to_string())));
}

/// The cards beside the map.
pub(super) fn cards(context: &mut Context<'_>, ui: &mut Ui) {
    Card::new(tr("Varied")).hint(tr("at the base's amplitude")).hugging().show(ui, |ui| sides(context, ui));
    ui.add_space(explore::GAP);
    Card::new(tr("Search")).hugging().show(ui, |ui| search(context, ui));
    ui.add_space(explore::GAP);
    Card::new(tr("Limits")).hugging().show(ui, |ui| super::limits::controls(context, ui));
}

fn sides(context: &mut Context<'_>, ui: &mut Ui) {
    let mut search = context.view.design.search;
    let names = [tr("Across"), tr("Up")];
    for (i, name) in names.into_iter().enumerate() {
        side(context, ui, name, &mut search.sides[i]);
    }
    if search.sides[0].dimension == search.sides[1].dimension {
        // The other side takes what this one had.
        let before = context.view.design.search.sides;
        let changed = usize::from(search.sides[0] == before[0]);
        search.sides[1 - changed] = Side::of(before[changed].dimension);
    }
    let mut third = search.third.is_some();
    if chips(ui, tr("Third"), &mut third, &[(false, tr("two")), (true, tr("three in the search"))]) {
        search.third = third.then(|| Side::of(Dimension::MagnetDistance));
    }
    if let Some(third) = &mut search.third {
        side(context, ui, tr("Besides"), third);
    }
    let doubled =
        search.third.is_some_and(|third| search.sides.iter().any(|side| side.dimension == third.dimension));
    if doubled {
        let taken = search.sides.map(|side| side.dimension);
        let free = Dimension::ALL.into_iter().find(|dimension| !taken.contains(dimension));
        search.third = free.map(Side::of);
    }
    if search != context.view.design.search {
        context.redesign(|design| design.search = search);
    }
}

/// A dimension to choose, and its range.
fn side(context: &Context<'_>, ui: &mut Ui, name: &str, side: &mut Side) {
    let (text, _, unit, factor, _) = device::words(side.dimension);
    ui.push_id(name, |ui| {
        ui.horizontal(|ui| {
            let colour = theme::tokens(ui).text_weak;
            ui.label(RichText::new(name).small().color(colour));
            egui::ComboBox::from_id_salt("dimension")
                .width(190.0)
                .selected_text(whose(side.dimension))
                .show_ui(ui, |ui| {
                    for dimension in Dimension::ALL {
                        if ui.selectable_label(dimension == side.dimension, whose(dimension)).clicked() {
                            *side = Side::of(dimension);
                        }
                    }
                });
        });
        let (low, high) = questions::range_of(context.view, context.session, side);
        let usual = side.dimension.usual();
        let (mut from, mut to) = (round_significant(factor * low, 6), round_significant(factor * high, 6));
        let before = (from, to);
        let (least, most) = ((factor * usual.0).min(from), (factor * usual.1).max(to));
        for (end, value) in [(tr("From"), &mut from), (tr("To"), &mut to)] {
            let slider = ParameterSlider::new(end, "", value, least..=most).unit(unit).compact();
            let slider = if side.dimension.logarithmic() { slider.logarithmic() } else { slider };
            slider.tooltip(text).show(ui);
        }
        if (from, to) != before {
            side.range = Some((from / factor, to / factor));
        }
    });
}

/// A dimension's name with what it belongs to.
fn whose(dimension: Dimension) -> String {
    let (name, ..) = device::words(dimension);
    let of = match dimension {
        Dimension::FluxDensity
        | Dimension::MagnetLength
        | Dimension::MagnetRadius
        | Dimension::MagnetArea => tr("magnets: "),
        Dimension::MagnetDistance => tr("magnets: "),
        Dimension::BeamLength | Dimension::BeamMass | Dimension::YoungsModulus | Dimension::SecondMoment => {
            tr("beam: ")
        }
        Dimension::Viscosity => tr("beam: "),
        Dimension::CeramicThickness | Dimension::LossTangent => tr("ceramic: "),
        Dimension::BaseAmplitude => tr("base: "),
        _ => "",
    };
    if of.is_empty() { name.to_owned() } else { format!("{of}{}", within(name)) }
}

fn search(context: &mut Context<'_>, ui: &mut Ui) {
    let tokens = theme::tokens(ui);
    let small = |text: String| RichText::new(text).small();
    let mut generations = context.view.design.search.generations;
    ui.horizontal_wrapped(|ui| {
        ui.label(small(tr("generations").to_owned()).color(tokens.text_weak));
        if chips(ui, tr("Generations"), &mut generations, &[(10, "10"), (20, "20"), (60, "60")]) {
            context.redesign(|design| design.search.generations = generations);
        }
    });
    if context.view.design.search.aim == Aim::Band {
        let least = context.view.design.least.unwrap_or(questions::LEAST);
        super::bands::least_slider(context, ui, least);
    }
    let found = context.studies.bench.found();
    let label =
        if found.is_some() { tr("Search again from here") } else { tr("Find the best within the limits") };
    if ui.button(label).clicked() {
        context.commands.push(Command::Find(true));
    }
    if let Some(reason) = &context.bench.refusal {
        ui.add(egui::Label::new(small(reworded(reason) + ".").color(tokens.danger)).wrap());
    }
    let Some(study) = found else {
        let text = tr(
            "Varies what is chosen above by differential evolution; the device in view is among the first \
             candidates, and the same search goes the same way again.",
        );
        ui.add(egui::Label::new(small(text.to_owned()).color(tokens.text_weak)).wrap());
        return;
    };
    if !study.finished() {
        ui.horizontal(|ui| {
            if ui.button(tr("Stop")).clicked() {
                context.commands.push(Command::Find(false));
            }
            ui.add(egui::ProgressBar::new(study.progress() as f32).desired_height(8.0));
        });
    }
    if let Some(why) = study.failure() {
        ui.add(egui::Label::new(small(why.to_owned()).color(tokens.danger)).wrap());
    }
    let Some(best) = study.best() else { return };
    result(context, ui, study, best);
}

fn result(context: &mut Context<'_>, ui: &mut Ui, study: &FindStudy, best: &Candidate) {
    let tokens = theme::tokens(ui);
    let aim = match study.question().objective {
        Objective::Power => Aim::Power,
        Objective::PowerPerG2 => Aim::PerG2,
        Objective::Voltage => Aim::Voltage,
        Objective::Band { .. } => Aim::Band,
        Objective::Threshold(_) => Aim::Threshold,
    };
    let value =
        best.evaluation.value.map_or(tr("no lasting motion").to_owned(), |value| in_digits(value, aim));
    let kept = best.evaluation.violation == 0.0;
    let colour = if kept { tokens.ok } else { tokens.danger };
    ui.label(RichText::new(value).font(crate::app::fonts::semibold(theme::size::HEADING)).color(colour));
    let text = fill(
        "best of {count} candidates, {kept}",
        &[
            ("count", &study.visited().len()),
            ("kept", &if kept { tr("within the limits") } else { tr("none keeps the limits") }),
        ],
    );
    ui.label(RichText::new(text).small().color(tokens.text_weak));
    for (variable, value) in study.question().variables.iter().zip(&best.values) {
        if let crate::jobs::motions::Coordinate::Dimension(dimension) = variable.coordinate {
            let (_, _, unit, factor, _) = device::words(dimension);
            let text = format!("{}: {} {unit}", whose(dimension), significant(factor * value, 4));
            ui.label(RichText::new(text).small().color(tokens.text));
        }
    }
    ui.horizontal(|ui| {
        if ui.button(tr("Use it")).clicked() {
            let taken = study.scenario(best).map(Box::new).map_err(|error| error.to_string());
            context.commands.push(Command::Adopt(taken));
        }
        if study.finished() && ui.button(tr("Close")).clicked() {
            context.commands.push(Command::Find(false));
        }
    });
}
