//! Views of plots that can be moved and zoomed: whether one is the plot's own, and the way back to it.

use std::collections::HashMap;

use egui::{Context, Id};
use egui_plot::{Plot, PlotMemory};

#[derive(Clone, Default)]
struct Views {
    /// Counts the devices shown so far.
    device: u64,
    /// For which device each plot was shown last.
    shown: HashMap<Id, u64>,
    /// The plots of the card being drawn.
    card: Vec<Id>,
}

fn change<T>(context: &Context, with: impl FnOnce(&mut Views) -> T) -> T {
    context.data_mut(|data| with(data.get_temp_mut_or_default(Id::unique("views of plots"))))
}

/// Says that plots show another device from now on: they begin with their own views.
pub fn another_device(context: &Context) {
    change(context, |views| views.device += 1);
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

/// Gives the plots of the card their own views again.
pub(in crate::app::widgets) fn fit(context: &Context) {
    change(context, |views| {
        for id in &views.card {
            views.shown.remove(id);
        }
    });
    context.request_repaint();
}

/// Notes a plot that can be moved and zoomed.
pub(super) fn begin<'a>(context: &Context, id: Id, plot: Plot<'a>) -> Plot<'a> {
    let same = change(context, |views| {
        views.card.push(id);
        views.shown.insert(id, views.device) == Some(views.device)
    });
    if same { plot } else { plot.reset() }
}
