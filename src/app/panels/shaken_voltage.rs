//! The voltage while the base is shaken by anything, over time.

use egui::Ui;

use super::Context;
use super::design::shaking::{ask, summary, waiting};
use super::spec::{Place, Spec};
use crate::app::text::{marked, tr};
use crate::app::view::design::Page;
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{Series, legend};

/// The voltage.
pub(super) const PANEL: Spec = Spec::new(Place::Page(Page::Shake), |_| tr("Voltage over time"), plot)
    .asking(ask)
    .embedded("shaken", marked("Voltage over time"));

fn plot(context: &mut Context<'_>, ui: &mut Ui) {
    let Some(answer) = summary(context) else {
        return plot_style::no_data(ui, ui.available_rect_before_wrap(), &waiting(context));
    };
    legend::legend(ui, &[(Series::Numeric, tr("lowest and highest voltage"))]);
    // Each part of the run has its lowest and its highest value, in the order of their times.
    let pairs = || answer.time.chunks_exact(2).zip(answer.voltage.chunks_exact(2));
    let times: Vec<f64> = pairs().map(|(time, _)| 0.5 * (time[0] + time[1])).collect();
    let low: Vec<f64> = pairs().map(|(_, v)| v[0].min(v[1])).collect();
    let high: Vec<f64> = pairs().map(|(_, v)| v[0].max(v[1])).collect();
    let (x, y) = (Axis::new(tr("time"), "t").unit("s"), Axis::new(tr("voltage"), "v").unit("V"));
    plot_style::plot(ui, "shaken voltage", &x, &y)
        .show(ui, |plot| plot_style::envelope(plot, Series::Numeric, tr("voltage"), &times, &low, &high));
}
