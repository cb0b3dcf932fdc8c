//! Voltage against its rate of change.

use egui::Ui;

use super::spec::{Place, Spec};
use super::{Context, phase_plane};
use crate::app::text::{marked, tr};
use crate::app::view::Tab;
use crate::app::widgets::{Series, plot_style};
use crate::model::state_dimension;

/// The portrait.
pub(super) const PANEL: Spec = Spec::new(Place::Tab(Tab::Explore), |_| tr("Phase portrait"), portrait)
    .hint(|_| tr("click to start there").to_owned())
    .embedded("phase", marked("Phase portrait"));

fn portrait(context: &mut Context<'_>, ui: &mut Ui) {
    let Some(shown) = context.shown() else { return };
    let curves = &shown.curves;
    let entries = [
        (Series::Numeric, tr("computed")),
        (Series::Ghost, tr("start")),
        (Series::Theory, tr("first-order theory")),
    ];
    phase_plane::legend(ui, &entries, curves);
    let response = phase_plane::plot_around(ui, "phase portrait", curves.extent).show(ui, |plot| {
        if let Some(pinned) = &context.session.pinned {
            plot_style::series(plot, Series::Ghost, tr("pinned"), &pinned.curves.phase);
        }
        plot_style::series(plot, Series::Ghost, tr("start of the motion"), &curves.transient);
        plot_style::series(plot, Series::Numeric, tr("computed"), &curves.phase);
        plot_style::points(plot, Series::Theory, tr("first-order theory"), &curves.theory_phase);
    });
    if let Some(at) = context.clicked(&response) {
        let place = response.transform.value_from_position(at);
        let state = start_at(shown, place.x, place.y);
        context.edit(|scenario| scenario.initial = Some(state));
    }
}

/// A state with the given voltage and rate: mode 1 moves just as fast as the circuit needs, from zero deflection.
fn start_at(shown: &crate::app::session::Shown, v: f64, dv_dt: f64) -> Vec<f64> {
    let system = &shown.run.system;
    let p = &system.parameters;
    let n = system.modes.len();
    let mut state = vec![0.0; state_dimension(n)];
    state[2 * n] = v;
    if system.theta[0] > 0.0 {
        state[n] = (system.capacitance * dv_dt + p.kappa * v) / system.theta[0];
    }
    state
}
