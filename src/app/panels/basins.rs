//! Which motion each start leads to, in the plane of the first mode's displacement and velocity.

use egui::{Color32, Id, RichText, Ui};
use egui_plot::{PlotBounds, PlotPoint};

use super::Context;
use super::spec::{Asking, Place, Spec};
use crate::app::text::{fill, marked, say, tr};
use crate::app::theme::{self, Tokens};
use crate::app::view::Tab;
use crate::app::widgets::number::{round_significant, significant};
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{attractor_row, draw_raster, fading, raster, recorder};
use crate::app::{colours, questions};
use crate::dynamics::attractors::motion::Motion;
use crate::questions::basin::{Attractor, BasinStudy};
use crate::scenario::Scenario;
use crate::scheduler::{Asked as _, Study as _};

/// Attractors that are listed.
const LISTED: usize = 6;
/// Width from which the list stands beside the plot.
const BESIDE: f32 = 400.0;
const LIST_WIDTH: f32 = 190.0;
/// Height up to which it stands there in any case, and the part of the width that it takes at most.
const LOW: f32 = 320.0;
const SHARE: f32 = 0.45;

/// The basins.
pub(super) const PANEL: Spec =
    Spec::new(Place::Tab(Tab::Stability), |_| tr("Basins of attraction"), contents)
        .hint(|context| context.computing::<BasinStudy>(tr("click to start there")))
        .asking(ask)
        .embedded("basins", marked("Basins of attraction"));

fn ask(Asking { view, studies, .. }: &mut Asking<'_>) {
    studies.lanes.offer(questions::basin(view), |(scenario, basin)| BasinStudy::new(scenario, basin).ok());
}

fn contents(context: &mut Context<'_>, ui: &mut Ui) {
    let Some(basin) = context.studies.lanes.study::<BasinStudy>() else { return };
    let attractors = basin.attractors();
    if ui.available_width() < BESIDE && ui.available_height() > LOW {
        list(context, ui, &attractors);
        plot(context, ui, basin, &attractors);
        return;
    }
    let area = ui.available_rect_before_wrap();
    let (left, right) = area.split_left_right_at_x(area.right() - LIST_WIDTH.min(SHARE * area.width()));
    ui.scope_builder(egui::UiBuilder::new().max_rect(left), |ui| plot(context, ui, basin, &attractors));
    let right = right.shrink2(egui::vec2(8.0, 0.0));
    ui.scope_builder(egui::UiBuilder::new().max_rect(right), |ui| list(context, ui, &attractors));
}

/// The colours of attractors: that of its class, as in the other charts, for the first found of each; the others of a
/// class take one that is left.
fn colours_of(attractors: &[Attractor], tokens: &Tokens) -> Vec<Color32> {
    let left = [tokens.numeric, tokens.warning, tokens.ok, tokens.exact, tokens.poincare];
    let left = left.map(|colour| tokens.inset.lerp_to_gamma(colour, 0.85));
    let mut found: Vec<usize> = (0..attractors.len()).collect();
    found.sort_by_key(|index| attractors[*index].number);
    let mut colours = vec![tokens.track; attractors.len()];
    let mut taken: Vec<Color32> = Vec::new();
    for index in found {
        let motion = attractors[index].cell.motion;
        let wanted = colours::motion(motion, tokens);
        if matches!(motion, Motion::Escape { .. } | Motion::Contact { .. } | Motion::Undecided { .. }) {
            colours[index] = wanted;
            continue;
        }
        let mut choices = std::iter::once(wanted).chain(left);
        let colour = choices.find(|colour| !taken.contains(colour)).unwrap_or(wanted);
        taken.push(colour);
        colours[index] = colour;
    }
    colours
}

/// What it is, without what differs from start to start.
fn name(attractor: &Attractor) -> String {
    match attractor.cell.motion {
        Motion::Escape { .. } => tr("escape").to_owned(),
        Motion::Contact { .. } => tr("contact").to_owned(),
        Motion::Undecided { .. } => tr("undecided").to_owned(),
        motion => format!("{}, {} V", say(&motion), significant(attractor.cell.measures.v_rms, 3)),
    }
}

/// The attractors found, most frequent first; a click starts on one.
fn list(context: &mut Context<'_>, ui: &mut Ui, attractors: &[Attractor]) {
    let tokens = theme::tokens(ui);
    ui.label(RichText::new(tr("share of the starts")).small().color(tokens.text_weak));
    let colours = colours_of(attractors, tokens);
    for (attractor, colour) in attractors.iter().zip(colours).take(LISTED) {
        let share = format!("{} %", significant(100.0 * attractor.fraction, 3));
        let name = name(attractor);
        if attractor_row(ui, colour, &name, &share).clicked() {
            let start = attractor.start.clone();
            context.edit(|scenario| scenario.initial = Some(start));
        }
    }
    if let Some(more) = attractors.len().checked_sub(LISTED).filter(|more| *more > 0) {
        ui.label(RichText::new(fill("and {more} more", &[("more", &more)])).small().color(tokens.text_weak));
    }
}

fn plot(context: &mut Context<'_>, ui: &mut Ui, basin: &BasinStudy, attractors: &[Attractor]) {
    let tokens = theme::tokens(ui);
    let [(i, x_range), (j, y_range)] = basin.sides();
    let size = basin.chart().asked().size;
    let lane = context.studies.lanes.generation::<BasinStudy>();
    let known = basin.is_replaceable();
    let revision = basin.chart().version() ^ (lane << 32) ^ tokens.number() << 62;
    let colours = colours_of(attractors, tokens);
    let picture = raster(ui, Id::unique("basins"), revision, size, &|column, row| {
        // The last picture stays until there is another one, coarse as it may be.
        let cell = basin.shown(column, row).filter(|_| known)?;
        Some(cell.and_then(|index| colours.get(index)).copied().unwrap_or(tokens.inset))
    });
    let opacity = fading(ui, Id::unique("basins"), known);
    let (x, y) = (Axis::new(tr("start"), "q₁"), Axis::new("", "dq₁/dt"));
    let start = start(&context.view.scenario);
    let here = [start[i], start[j]];
    let shown = plot_style::fixed(ui, "basins", &x, &y).show_grid(false).show(ui, |plot| {
        let (x, y) = (x_range, y_range);
        plot.set_plot_bounds(PlotBounds::from_min_max([x.0, y.0], [x.1, y.1]));
        if let Some(picture) = &picture {
            draw_raster(plot, picture, x, y, opacity);
            let value = |column, row| {
                basin.chart().cell(column, row)?;
                attractors.get(basin.shown(column, row)??).map(name)
            };
            recorder::cells(plot, tr("motion reached"), size, [x, y], &value);
        }
        let places: Vec<(String, PlotPoint)> = attractors
            .iter()
            .filter(|attractor| matches!(attractor.cell.motion, Motion::Periodic { .. }))
            .map(|attractor| {
                let place = PlotPoint::new(attractor.start[i], attractor.start[j]);
                (say(&attractor.cell.motion), place)
            })
            .collect();
        plot_style::special_points(plot, &places);
    });
    let drag = plot_style::operating_point(ui, &shown, tr("Start"), here);
    if let Some([q, rate]) = drag.moved {
        context.edit(|scenario| {
            let mut state = start.clone();
            (state[i], state[j]) = (round_significant(q, 4), round_significant(rate, 4));
            scenario.initial = Some(state);
        });
    }
}

/// The start of a scenario, length 2N + 1.
fn start(scenario: &Scenario) -> Vec<f64> {
    let dimension = crate::model::state_dimension(scenario.model.modes);
    scenario.initial.clone().filter(|state| state.len() == dimension).unwrap_or_else(|| vec![0.0; dimension])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Measures;
    use crate::dynamics::attractors::motion::Cell;

    #[test]
    fn a_class_has_its_colour_of_the_charts_and_two_of_a_class_differ() {
        let tokens = theme::tokens_in(&egui::Context::default());
        let of = |number: usize, motion: Motion| {
            let measures = Measures { v_rms: 1.0, power: 1.0, tip: (-1.0, 1.0), v_peak: 1.0, slope: 0.0 };
            let cell = Cell { motion, measures };
            Attractor { cell, start: vec![0.0; 5], number, cells: 1, fraction: 0.2 }
        };
        let (one, two) = (Motion::Periodic { periods: 1 }, Motion::Periodic { periods: 2 });
        let ended = [Motion::Escape { time: 1.0 }, Motion::Contact { time: 1.0 }];
        let motions = [two, one, one, ended[0], ended[1], Motion::Chaotic];
        let all: Vec<Attractor> =
            motions.into_iter().enumerate().map(|(i, motion)| of(5 - i, motion)).collect();
        let colours = colours_of(&all, tokens);
        for index in [0, 2, 3, 4, 5] {
            assert_eq!(colours[index], colours::motion(motions[index], tokens), "{index}");
        }
        assert_eq!(colours.iter().filter(|colour| **colour == colours[1]).count(), 1);
    }
}
