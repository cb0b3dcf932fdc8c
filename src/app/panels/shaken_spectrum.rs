//! The voltage's spectrum as it changes while the base is shaken.

use egui::{Id, Ui};
use egui_plot::PlotBounds;

use super::Context;
use super::design::shaking::{ask, found, waiting};
use super::spec::{Place, Spec};
use crate::app::colours;
use crate::app::text::tr;
use crate::app::theme;
use crate::app::view::design::Page;
use crate::app::widgets::number::{exact, with_unit};
use crate::app::widgets::plot_style::{self, Axis};
use crate::app::widgets::{colour_bar, draw_raster, raster, recorder, row};
use crate::questions::shaken_run::ShakenRun;
use crate::scheduler::Table;

/// Decades that are shown below the highest amplitude.
const DECADES: f64 = 3.0;

/// The spectrogram.
pub(super) const PANEL: Spec =
    Spec::new(Place::Page(Page::Shake), |_| tr("Spectrogram of the voltage"), plot).asking(ask);

fn plot(context: &mut Context<'_>, ui: &mut Ui) {
    let found = found(context).and_then(Result::ok).unwrap_or_default();
    let Some(shown) = found.iter().find_map(|run| run.spectrogram.as_ref()).filter(|shown| shown.columns > 0)
    else {
        return plot_style::no_data(ui, ui.available_rect_before_wrap(), &waiting(context));
    };
    let tokens = theme::tokens(ui);
    let highest = shown.amplitudes.iter().copied().fold(0.0, f32::max).max(f32::MIN_POSITIVE);
    let [faintest, strongest] =
        [10_f64.powf(-DECADES), 1.0].map(|part| with_unit(part * f64::from(highest), "V"));
    row(ui, |ui| colour_bar(ui, &faintest, &strongest, &colours::sequential));
    let lane = context.studies.lanes.generation::<Table<ShakenRun>>();
    let revision = lane << 3 ^ tokens.number() << 62 ^ 1;
    let size = (shown.columns, shown.rows);
    let picture = raster(ui, Id::unique("spectrogram"), revision, size, &|column, row| {
        let part = 1.0 + (shown.at(column, row) / f64::from(highest)).log10() / DECADES;
        Some(colours::sequential(part.clamp(0.0, 1.0)))
    });
    // The raster's outer cells have their middles at the ends.
    let ends = |length: f64, count: usize| (0.5 * length / count as f64, length * (1.0 - 0.5 / count as f64));
    let (times, frequencies) = (ends(shown.duration, size.0), ends(shown.highest, size.1));
    let (x, y) = (Axis::new(tr("time"), "t").unit("s"), Axis::new(tr("frequency"), "f").unit("Hz"));
    plot_style::fixed(ui, "spectrogram", &x, &y).show_grid(false).show(ui, |plot| {
        plot.set_plot_bounds(PlotBounds::from_min_max([0.0, 0.0], [shown.duration, shown.highest]));
        if let Some(picture) = &picture {
            draw_raster(plot, picture, times, frequencies, 1.0);
            let value = |column, row| Some(exact(shown.at(column, row)));
            recorder::cells(plot, tr("amplitude of v"), size, [times, frequencies], &value);
        }
    });
}
