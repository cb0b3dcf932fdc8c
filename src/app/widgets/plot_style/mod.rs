//! One look for all plots: axes with units, round ticks that are never clipped, a readout, and the app's curves.
//!
//! egui_plot has no logarithmic axes: give [`Axis::logarithmic`] and pass `log10` of the data, see [`to_log`].

mod items;
mod marker;
pub mod views;

use std::ops::RangeInclusive;

use egui_plot::{AxisHints, GridInput, GridMark, HoverPosition, Plot, PlotPoint};

use super::{number, recorder, touch};
use crate::app::{fonts, theme};

pub use crate::export::axis::{Axis, Tick, from_log, to_log};
pub use items::{
    area_above, cell, curve, envelope, faded_points, finite_runs, has_room, label, label_size,
    labelled_place, points, rule, series, series_on_picture, special_point, special_points,
};
pub use marker::{PointDrag, no_data, operating_point};

/// Height below which a plot has no room for long names upright, points.
const LOW: f32 = 190.0;

/// A plot with the app's look: transparent on its card, round ticks, axis names with units, values under the
/// pointer. It is dragged, and zoomed by two fingers or the wheel with Ctrl held; the wheel alone is the page's. Callers
/// add bounds before they show it.
///
/// ```
/// # use harvester_lab::app::widgets::{Series, plot_style::{self, Axis}};
/// # fn draw(ui: &mut egui::Ui, trajectory: &[egui_plot::PlotPoint]) {
/// let (x, y) = (Axis::new("voltage", "v").unit("V"), Axis::new("", "dv/dt"));
/// plot_style::plot(ui, "phase", &x, &y)
///     .show(ui, |plot| plot_style::series(plot, Series::Numeric, "trajectory", trajectory));
/// # }
/// ```
pub fn plot<'a>(ui: &egui::Ui, id: impl egui::AsIdSalt, x: &Axis, y: &Axis) -> Plot<'a> {
    let id = ui.make_persistent_id(id);
    views::begin(ui.ctx(), id, look(ui, id, x, y).allow_scroll(false))
}

/// The same with one view, which nobody changes.
pub fn fixed<'a>(ui: &egui::Ui, id: impl egui::AsIdSalt, x: &Axis, y: &Axis) -> Plot<'a> {
    look(ui, ui.make_persistent_id(id), x, y)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_double_click_reset(false)
}

fn look<'a>(ui: &egui::Ui, id: egui::Id, x: &Axis, y: &Axis) -> Plot<'a> {
    recorder::begin(ui.ctx(), x, y);
    let tokens = theme::tokens(ui);
    // Where the plot is lower than the name of its axis is long, the symbol has to do.
    let low = ui.available_height() < LOW;
    let label = |axis: &Axis| {
        let font = fonts::regular(theme::size::SMALL + 0.5);
        let title = if low && std::ptr::eq(axis, y) { axis.short_title() } else { axis.title() };
        egui::RichText::new(title).font(font).color(tokens.text_weak)
    };
    let hints = |hints: AxisHints<'a>, axis: &Axis, gap: f32| {
        let formatter = axis.clone();
        hints
            .label(label(axis))
            .tick_label_font(fonts::regular(theme::size::SMALL))
            .tick_label_color(tokens.text_weak)
            .label_spacing(egui::Rangef::new(gap, gap + 1.0))
            .formatter(move |mark, range| tick_label(&formatter, mark, range))
    };
    let (x_spacer, y_spacer) = (x.clone(), y.clone());
    let (x_readout, y_readout) = (x.clone(), y.clone());
    Plot::new(id)
        .id(id)
        // Not for the keyboard: what is in it to be pointed at has a control of its own.
        .sense(if touch::in_use(ui.ctx()) {
            egui::Sense::CLICK
        } else {
            egui::Sense::CLICK | egui::Sense::DRAG
        })
        .custom_x_axes(vec![hints(AxisHints::new_x(), x, 26.0)])
        .custom_y_axes(vec![hints(AxisHints::new_y(), y, 13.0).min_thickness(24.0)])
        .x_grid_spacer(move |input| grid(&x_spacer, &input, 54.0))
        .y_grid_spacer(move |input| grid(&y_spacer, &input, 38.0))
        .grid_spacing(egui::Rangef::new(1.0, 30.0))
        .grid_color(tokens.grid)
        .cursor_color(tokens.ruler)
        .show_background(false)
        .show_crosshair(false)
        .allow_axis_zoom_drag(false)
        .allow_boxed_zoom(false)
        .set_margin_fraction(views::MARGIN)
        .label_formatter(move |position| match position {
            HoverPosition::NearDataPoint { plot_name, position, .. } => {
                let values = readout(&x_readout, &y_readout, position);
                Some(if plot_name.is_empty() { values } else { format!("{plot_name}\n{values}") })
            }
            HoverPosition::Elsewhere { .. } => None,
        })
}

/// Grid lines about `wanted` points apart; `input.base_step_size` is one point's length.
fn grid(axis: &Axis, input: &GridInput, wanted: f64) -> Vec<GridMark> {
    let length = (input.bounds.1 - input.bounds.0) / input.base_step_size;
    let ticks = axis.ticks(input.bounds, length, wanted).into_iter();
    ticks.map(|tick| GridMark { value: tick.at, step_size: tick.step }).collect()
}

/// The label of a tick; none where it would stick out of the plot into the other axis's labels.
fn tick_label(axis: &Axis, mark: GridMark, range: &RangeInclusive<f64>) -> String {
    let place = (mark.value - range.start()) / (range.end() - range.start());
    if (0.025..=0.985).contains(&place) {
        axis.label(Tick { at: mark.value, step: mark.step_size })
    } else {
        String::new()
    }
}

/// `v = 12.3 V, dv/dt = −45` for a place in plot coordinates.
pub fn readout(x: &Axis, y: &Axis, position: &PlotPoint) -> String {
    let part = |axis: &Axis, coordinate: f64| {
        let value = number::significant(axis.value(coordinate), 4);
        let unit = if axis.has_unit() { format!(" {}", axis.unit_text()) } else { String::new() };
        format!("{} = {value}{unit}", axis.symbol())
    };
    format!("{}, {}", part(x, position.x), part(y, position.y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::widgets::Series;
    use crate::app::widgets::harness::Harness;

    #[test]
    fn readouts_carry_symbols_and_units() {
        let (x, y) = (Axis::new("voltage", "v").unit("V"), Axis::new("damping", "α").logarithmic());
        assert_eq!(readout(&x, &y, &PlotPoint::new(12.3, -3.0)), "v = 12.30 V, α = 0.001000");
    }

    #[test]
    fn a_plot_with_everything_in_it_draws() {
        let mut harness = Harness::new(500.0, 400.0);
        let curve: Vec<PlotPoint> =
            (0..300).map(|i| PlotPoint::new(i as f64, (i as f64 * 0.1).sin())).collect();
        let gappy = [PlotPoint::new(0.0, 0.0), PlotPoint::new(1.0, f64::NAN), PlotPoint::new(2.0, 1.0)];
        let (times, low, high) = ([0.0, 100.0, 300.0], [-1.0, -0.5, -0.2], [1.0, 0.5, 0.2]);
        let (x, y) = (Axis::new("time", "t"), Axis::new("voltage", "v").unit("V"));
        harness.settle(|ui| {
            plot(ui, "everything", &x, &y).height(300.0).show(ui, |plot| {
                for kind in
                    [Series::Numeric, Series::Theory, Series::Published, Series::Coupled, Series::Ghost]
                {
                    series(plot, kind, "curve", &curve);
                }
                series(plot, Series::Exact, "gappy", &gappy);
                points(plot, Series::Poincare, "points", &curve);
                envelope(plot, Series::Numeric, "history", &times, &low, &high);
                area_above(plot, Series::Exact, &curve, 2.0);
                labelled_place(plot, "period doubling", [100.0, 1.5], Series::Exact);
            });
        });
    }
}
