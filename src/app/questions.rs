//! What the view asks the crew: the questions behind charts, sweeps and curves.

use super::map::{self, Boundaries};
use super::session::Session;
use super::view::{MapWindow, SweepView, View};
use crate::dynamics::bifurcations::tongue::Window;
use crate::model::{Along, Parameter, ParameterSet};
use crate::questions::basin::Basin;
use crate::questions::chart::{Chart, Quantity};
use crate::questions::checks::Span;
use crate::questions::curves::Curves;
use crate::questions::sweep::{Direction, Sweep};
use crate::scenario::{Forgotten, Scenario};

/// Columns and rows of the chart of multipliers.
const CHART: (usize, usize) = (256, 256);
/// The same of the chart of motions, and of the plane of starts.
const MOTIONS: (usize, usize) = (80, 60);
const BASIN: usize = 64;
/// Half the width of the window in which exact tongues are traced: a little more than a map shows.
const TONGUE_SPAN: f64 = 0.8;
/// The same where a map shows all of them, so that they end where the motion does, not in the middle of it.
const WHOLE_TONGUE_SPAN: f64 = 3.5;
/// Upper ends of that window: the lowest one above what the map shows is taken.
const TONGUE_LIMITS: [f64; 2] = [0.04, 0.2];
/// A structural parameter is swept from its value over this to its value times this.
const SPAN: f64 = 4.0;
/// A sweep that would be empty is widened to this fraction of the parameter's whole range.
const LEAST_SPAN: f64 = 1e-3;

/// The chart over the window of the map: of multipliers, or of the motions reached from the scenario's start.
pub(super) fn chart(view: &View, boundaries: &Boundaries) -> (Scenario, Chart) {
    let (low, high) = boundaries.range(view.map);
    let low = low.max(Parameter::Omega.range().0);
    let quantity = view.layer;
    let multipliers = quantity == Quantity::Multiplier;
    let (columns, rows) = if multipliers { CHART } else { MOTIONS };
    let omega = Span { from: low, to: high, count: columns };
    let beta =
        Span { from: 0.0, to: boundaries.ceiling(view.map, view.scenario.parameters.beta), count: rows };
    let excitation = [Forgotten::Number(Parameter::Omega, low), Forgotten::Number(Parameter::Beta, 0.0)];
    let scenario = view.scenario.forgetting(&excitation).forgetting(&[Forgotten::Duration]);
    let scenario = if multipliers { scenario.forgetting(&[Forgotten::Start]) } else { scenario };
    (scenario, Chart { omega, beta, quantity })
}

/// The exact tongues of the device in view, whatever its excitation and start.
pub(super) fn tongues(view: &View, boundaries: &Boundaries) -> (Scenario, Window) {
    let ceiling = boundaries.ceiling(view.map, view.scenario.parameters.beta);
    let limit = TONGUE_LIMITS.into_iter().find(|limit| *limit >= ceiling).unwrap_or(TONGUE_LIMITS[1]);
    let span = if view.map == MapWindow::All { WHOLE_TONGUE_SPAN } else { TONGUE_SPAN };
    (map::structure(&view.scenario), Window { span, limit })
}

/// The basins of the scenario in view, whatever its start.
pub(super) fn basin(view: &View) -> (Scenario, Basin) {
    let scenario = view.scenario.forgetting(&[Forgotten::Start, Forgotten::Duration]);
    (scenario, Basin { count: Some(BASIN), ..Basin::default() })
}

/// The sweep that the tab shows, with its branches.
pub(super) fn sweep(view: &View, session: &Session) -> (Scenario, Sweep) {
    let SweepView { parameter, count, dwell, .. } = view.sweep;
    let (from, to) = sweep_range(view, session);
    let anywhere = ParameterSet::default().get(parameter);
    let scenario = view.scenario.forgetting(&[Forgotten::Duration, Forgotten::Number(parameter, anywhere)]);
    let (direction, along) = (Direction::Up, Along::default());
    let (transient, kept) = (dwell.discarded, dwell.kept);
    let (branches, logarithmic) = (true, false);
    let sweep =
        Sweep { parameter, from, to, count, direction, transient, kept, branches, along, logarithmic };
    (scenario, sweep)
}

/// The bifurcation curves in the plane in view; `None` when it is empty.
pub(super) fn curves(view: &View, session: &Session) -> Option<(Scenario, Curves)> {
    let axes = view.plane.map(|parameter| (parameter, range_of(view, session, parameter)));
    let numbers = axes.map(|(parameter, (low, _))| Forgotten::Number(parameter, low));
    let scenario = view.scenario.forgetting(&numbers).forgetting(&[Forgotten::Start, Forgotten::Duration]);
    let curves = Curves::over(axes);
    curves.plane().is_ok().then_some((scenario, curves))
}

/// The range chosen, or one that shows what is near: the window of the map, or a span about the present value.
pub(super) fn sweep_range(view: &View, session: &Session) -> (f64, f64) {
    let parameter = view.sweep.parameter;
    let (minimum, maximum) = parameter.range();
    let (low, high) = view.sweep.range.unwrap_or_else(|| range_of(view, session, parameter));
    let (low, high) = (low.min(high).clamp(minimum, maximum), low.max(high).clamp(minimum, maximum));
    let usual = parameter.fact().usual;
    let least = LEAST_SPAN * (usual.1 - usual.0);
    if high - low >= least {
        (low, high)
    } else {
        (low.min(maximum - least), low.min(maximum - least) + least)
    }
}

/// A range of a parameter that shows what is near: the window of the map, or a span about a round value near the
/// present one, so that it stays while the value moves a little.
fn range_of(view: &View, session: &Session, parameter: Parameter) -> (f64, f64) {
    let (minimum, maximum) = parameter.range();
    let value = view.scenario.parameters.get(parameter);
    match (parameter, &session.boundaries) {
        (Parameter::Omega, Some(boundaries)) => {
            let (low, high) = boundaries.range(view.map);
            let least = 0.1 * high;
            // A device that works below is in sight, too, with as much room beneath it.
            let least = if value < least { 0.5 * 2.0_f64.powf(value.log2().floor()) } else { least };
            (low.max(least), high)
        }
        (Parameter::Beta, Some(boundaries)) => (0.0, boundaries.ceiling(view.map, value)),
        _ if value == 0.0 => (minimum, 0.1 * maximum),
        _ => {
            let middle = value.signum() * 2.0_f64.powf(value.abs().log2().round());
            let (a, b) = (middle / SPAN, middle * SPAN);
            (a.min(b).max(minimum), a.max(b).min(maximum))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_excitation_in_view_does_not_make_another_chart() {
        let mut view = View::default();
        let (system, _) = view.scenario.validate().expect("a valid start");
        let boundaries = Boundaries::new(map::structure(&view.scenario), &system);
        let before = chart(&view, &boundaries);
        view.scenario.parameters.beta *= 0.9;
        view.scenario.parameters.omega += 0.1;
        assert_eq!(chart(&view, &boundaries), before);
        assert!(before.1.check().is_ok());
        view.scenario.parameters.alpha *= 2.0;
        assert_ne!(chart(&view, &boundaries), before);
    }

    #[test]
    fn the_present_value_lies_in_the_range_to_sweep() {
        let mut view = View { map: MapWindow::All, ..View::default() };
        let mut session = Session::default();
        for omega in [0.3, 1.3667, 2.1968, 4.0, 8.2, 25.0] {
            view.scenario.parameters.omega = omega;
            session.ask(&view.scenario);
            for parameter in Parameter::ALL {
                view.sweep.parameter = parameter;
                let (from, to) = sweep_range(&view, &session);
                let value = view.scenario.parameters.get(parameter);
                assert!((from..=to).contains(&value), "{parameter:?} {omega}: {value} of {from} to {to}");
            }
        }
    }

    #[test]
    fn every_parameter_has_a_range_to_sweep() {
        let mut view = View::default();
        let mut session = Session::default();
        session.ask(&view.scenario);
        for parameter in Parameter::ALL {
            view.sweep.parameter = parameter;
            for value in [Some((3.0, 1.0)), Some((1e9, -1e9)), Some((2.0, 2.0)), None] {
                view.sweep.range = value;
                let (scenario, question) = sweep(&view, &session);
                let (from, to) = question.range();
                let right = question.check().is_ok() && scenario.validate().is_ok();
                assert!(right, "{parameter:?} {value:?} {from} {to}");
                assert!(to > from);
            }
        }
    }
}
