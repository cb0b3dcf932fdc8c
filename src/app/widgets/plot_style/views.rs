//! Views of plots that can be moved and zoomed: whether one is the plot's own, the way back to it, and axes that are held.

use std::collections::{HashMap, HashSet};

use egui::{Context, Id, Vec2, Vec2b};
use egui_plot::{Plot, PlotBounds, PlotMemory};

/// Part of the data's extent that a plot's own view shows beyond it, at either end of each axis.
pub(super) const MARGIN: Vec2 = Vec2::new(0.06, 0.08);
/// Seconds after which what is shown is that of the lesson's step, not of the one before.
const SETTLED: f64 = 1.5;

#[derive(Clone, Default)]
struct Views {
    /// Counts the devices shown so far.
    device: u64,
    /// For which device each plot was shown last.
    shown: HashMap<Id, u64>,
    /// The plots of the card being drawn.
    card: Vec<Id>,
    /// Those whose axes are held as they are.
    held: HashSet<Id>,
    /// The running step of a lesson, and when it began: axes only grow in it.
    step: Option<((usize, usize), f64)>,
    /// What plots have shown in it, without margins: lowest and highest of either axis.
    grown: HashMap<Id, [f64; 4]>,
}

fn change<T>(context: &Context, with: impl FnOnce(&mut Views) -> T) -> T {
    context.data_mut(|data| with(data.get_temp_mut_or_default(Id::unique("views of plots"))))
}

/// Says that plots show another device from now on: they begin with their own views.
pub fn another_device(context: &Context) {
    change(context, |views| views.device += 1);
}

/// Says which step of which lesson runs.
pub fn in_step(context: &Context, step: Option<(usize, usize)>) {
    let now = context.input(|input| input.time);
    change(context, |views| {
        if views.step.map(|(step, _)| step) != step {
            views.step = step.map(|step| (step, now));
            views.grown.clear();
        }
    });
}

/// Begins a card.
pub(in crate::app::widgets) fn begin_card(context: &Context) {
    change(context, |views| views.card.clear());
}

/// Whether the hand has changed the view of a plot of the card.
pub(in crate::app::widgets) fn changed(context: &Context) -> bool {
    let card = change(context, |views| views.card.clone());
    card.iter().any(|id| PlotMemory::load(context, *id).is_some_and(|memory| !memory.auto_bounds.all()))
}

/// Whether the axes of the card's plots are held; nothing where it has none that could be.
pub(in crate::app::widgets) fn held(context: &Context) -> Option<bool> {
    change(context, |views| Some(views.held.contains(views.card.first()?)))
}

/// Holds the axes of the card's plots as they are.
pub(in crate::app::widgets) fn hold(context: &Context) {
    change(context, |views| views.held.extend(&views.card));
}

/// Gives the plots of the card their own views again.
pub(in crate::app::widgets) fn fit(context: &Context) {
    change(context, |views| {
        for id in &views.card {
            views.shown.remove(id);
            views.held.remove(id);
            views.grown.remove(id);
        }
    });
    context.request_repaint();
}

/// Notes a plot that can be moved and zoomed.
pub(super) fn begin<'a>(context: &Context, id: Id, plot: Plot<'a>) -> Plot<'a> {
    let (same, held, steps) = change(context, |views| {
        views.card.push(id);
        let same = views.shown.insert(id, views.device) == Some(views.device);
        (same, views.held.contains(&id), views.step)
    });
    let memory = PlotMemory::load(context, id);
    if held {
        if let Some(mut memory) = memory {
            memory.auto_bounds = Vec2b::FALSE;
            memory.store(context, id);
        }
        return plot;
    }
    let plot = if same { plot } else { plot.reset() };
    let own = memory.filter(|memory| memory.auto_bounds.all());
    let Some((bounds, (_, began))) = own.map(|memory| *memory.bounds()).zip(steps) else { return plot };
    let settled = context.input(|input| input.time) - began > SETTLED;
    let grown = change(context, |views| {
        let before = views.grown.get(&id).copied();
        let grown = before.map_or_else(|| extent(&bounds), |before| grown(before, extent(&bounds)));
        if settled && grown.iter().all(|end| end.is_finite()) {
            views.grown.insert(id, grown);
        }
        before
    });
    let Some([left, right, low, high]) = grown else { return plot };
    plot.include_x(left).include_x(right).include_y(low).include_y(high)
}

/// What data a plot's own view shows: lowest and highest of either axis.
fn extent(bounds: &PlotBounds) -> [f64; 4] {
    let ([left, low], [right, high]) = (bounds.min(), bounds.max());
    let margin = |length: f64, part: f32| length * f64::from(part) / (1.0 + 2.0 * f64::from(part));
    let (x, y) = (margin(right - left, MARGIN.x), margin(high - low, MARGIN.y));
    [left + x, right - x, low + y, high - y]
}

fn grown(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    [a[0].min(b[0]), a[1].max(b[1]), a[2].min(b[2]), a[3].max(b[3])]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::widgets::Card;
    use crate::app::widgets::harness::Harness;
    use crate::app::widgets::plot_style::{self, Axis};
    use crate::app::widgets::series::Series;
    use egui_plot::PlotPoint;

    /// Highest value on the vertical axis of a plot of one line, after so many pictures.
    fn top(harness: &mut Harness, height: f64, pictures: usize) -> f64 {
        let line = [PlotPoint::new(0.0, 0.0), PlotPoint::new(1.0, height)];
        let mut top = 0.0;
        for _ in 0..pictures {
            harness.frame(Vec::new(), |ui| {
                Card::new("A plot").show(ui, |ui| {
                    let (x, y) = (Axis::new("x", "x"), Axis::new("y", "y"));
                    let shown = plot_style::plot(ui, "line", &x, &y)
                        .show(ui, |plot| plot_style::series(plot, Series::Numeric, "line", &line));
                    top = shown.transform.bounds().max()[1];
                });
            });
        }
        top
    }

    #[test]
    fn axes_follow_the_data_only_grow_in_a_lessons_step_and_stay_where_they_are_held() {
        let mut harness = Harness::new(500.0, 400.0);
        let close =
            |found: f64, wanted: f64| assert!((found / wanted - 1.0).abs() < 1e-6, "{found} {wanted}");
        close(top(&mut harness, 1.0, 4), 1.08);
        close(top(&mut harness, 0.5, 4), 0.54);
        in_step(&harness.context, Some((1, 1)));
        top(&mut harness, 1.0, 200);
        close(top(&mut harness, 1.0, 4), 1.08);
        close(top(&mut harness, 0.2, 200), 1.08);
        close(top(&mut harness, 3.0, 4), 3.24);
        in_step(&harness.context, Some((1, 2)));
        close(top(&mut harness, 0.5, 4), 0.54);
        in_step(&harness.context, None);
        let button = harness.find(egui::Role::Button, "Hold the axes").bounds.center();
        let line = |ui: &mut egui::Ui| {
            let line = [PlotPoint::new(0.0, 0.0), PlotPoint::new(1.0, 0.5)];
            Card::new("A plot").show(ui, |ui| {
                let (x, y) = (Axis::new("x", "x"), Axis::new("y", "y"));
                plot_style::plot(ui, "line", &x, &y)
                    .show(ui, |plot| plot_style::series(plot, Series::Numeric, "line", &line));
            });
        };
        harness.click(button, line);
        another_device(&harness.context);
        close(top(&mut harness, 9.0, 4), 0.54);
        let button = harness.find(egui::Role::Button, "Let the axes go").bounds.center();
        harness.click(button, line);
        close(top(&mut harness, 9.0, 4), 9.72);
    }
}
