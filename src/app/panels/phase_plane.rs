//! The plane of voltage and rate, which phase portraits and Poincaré maps share.

use egui::Ui;
use egui_plot::Plot;

use crate::app::curves::Curves;
use crate::app::text::{fill, tr};
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Series, legend, number};

/// Free space around the motion, as a factor.
const ROOM: f64 = 1.05;

/// A plot with the plane's axes.
pub(super) fn plot<'a>(ui: &Ui, id: impl egui::AsIdSalt) -> Plot<'a> {
    plot_style::plot(ui, id, &Axis::new(tr("voltage"), "v").unit("V"), &Axis::new("", "dv/dt").unit("V"))
}

/// What the colours say; the first-order theory with its amplitude where it is too large to be drawn.
pub(super) fn legend(ui: &mut Ui, entries: &[(Series, &str)], curves: &Curves) {
    let beyond = |volts| fill("{volts} V, far outside", &[("volts", &number::significant(volts, 3))]);
    legend::legend_with(ui, entries, curves.theory_beyond.map(beyond).as_deref());
}

/// The same with bounds that hold a motion of the given extent in both directions, also where less is drawn.
pub(super) fn plot_around<'a>(ui: &Ui, id: impl egui::AsIdSalt, extent: [f64; 2]) -> Plot<'a> {
    let [width, height] = extent.map(|largest| ROOM * largest);
    plot(ui, id).include_x(-width).include_x(width).include_y(-height).include_y(height)
}
