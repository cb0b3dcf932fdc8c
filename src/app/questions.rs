//! What the view asks the crew: the questions behind charts, sweeps and curves.

use super::map::{self, Boundaries};
use super::session::Session;
use super::view::View;
use crate::jobs::motions::Coordinate;
use crate::jobs::study::basin::BasinQuestion;
use crate::jobs::study::curves::CurvesQuestion;
use crate::jobs::study::motion_chart::MotionQuestion;
use crate::jobs::study::multiplier_chart::MultiplierQuestion;
use crate::jobs::study::sweep::SweepQuestion;
use crate::jobs::work::Work;
use crate::model::{ModelError, Parameter, ParameterSet, Shaking};
use crate::scenario::Scenario;

/// Columns and rows of the chart of multipliers.
const CHART: (usize, usize) = (256, 256);
/// The same of the chart of motions, and of the plane of starts.
const MOTIONS: (usize, usize) = (80, 60);
const BASIN: (usize, usize) = (64, 64);
/// A structural parameter is swept from its value over this to its value times this.
const SPAN: f64 = 4.0;
/// A sweep that would be empty is widened to this fraction of the parameter's whole range.
const LEAST_SPAN: f64 = 1e-3;

/// The chart over the window of the map.
pub(super) fn chart(view: &View, boundaries: &Boundaries) -> MultiplierQuestion {
    let (low, high) = boundaries.range(view.map);
    let omega = (low.max(Parameter::Omega.range().0), high);
    let beta = (0.0, map::ceiling(view.map, view.scenario.parameters.beta));
    let mut scenario = with(&view.scenario, Parameter::Omega, omega.0);
    scenario.parameters.beta = 0.0;
    scenario.initial = None;
    MultiplierQuestion { scenario, omega, beta, size: CHART }
}

/// The motions reached from the scenario's start over the same window.
pub(super) fn motions(view: &View, boundaries: &Boundaries) -> MotionQuestion {
    let MultiplierQuestion { omega, beta, .. } = chart(view, boundaries);
    let mut scenario = with(&view.scenario, Parameter::Omega, omega.0);
    scenario.parameters.beta = 0.0;
    scenario.t_end = Scenario::default().t_end;
    MotionQuestion {
        scenario,
        x: (Coordinate::Parameter(Parameter::Omega), omega),
        y: (Coordinate::Parameter(Parameter::Beta), beta),
        size: MOTIONS,
    }
}

/// The basins of the scenario in view, whatever its start.
///
/// # Errors
/// [`ModelError`] naming what of the scenario is out of range.
pub(super) fn basin(view: &View) -> Result<BasinQuestion, ModelError> {
    let scenario = Scenario { initial: None, t_end: Scenario::default().t_end, ..view.scenario.clone() };
    BasinQuestion::first_mode(scenario, BASIN)
}

/// The sweep that the tab shows.
pub(super) fn sweep(view: &View, session: &Session) -> SweepQuestion {
    let parameter = view.sweep.parameter;
    let range = sweep_range(view, session);
    let scenario = with(&view.scenario, parameter, parameter.get(&ParameterSet::default()));
    let (count, dwell) = (view.sweep.count, view.sweep.dwell);
    SweepQuestion { scenario, parameter, shaking: Shaking::Amplitude, range, count, dwell }
}

/// The response curves over the same range.
pub(super) fn response(view: &View, session: &Session) -> Work {
    let parameter = view.sweep.parameter;
    let range = sweep_range(view, session);
    let anywhere = parameter.get(&ParameterSet::default());
    let scenario = Scenario { initial: None, ..with(&view.scenario, parameter, anywhere) };
    Work::Response { scenario, parameter, shaking: Shaking::Amplitude, range }
}

/// The bifurcation curves in the plane in view; `None` when it is empty.
pub(super) fn curves(view: &View, session: &Session) -> Option<CurvesQuestion> {
    let axes = view.plane.map(|parameter| (parameter, range_of(view, session, parameter)));
    let mut scenario = Scenario { initial: None, ..view.scenario.clone() };
    scenario.t_end = Scenario::default().t_end;
    for (parameter, (low, _)) in axes {
        *parameter.get_mut(&mut scenario.parameters) = low;
    }
    CurvesQuestion::new(scenario, axes).ok()
}

/// The range chosen, or one that shows what is near: the window of the map, or a span about the present value.
pub(super) fn sweep_range(view: &View, session: &Session) -> (f64, f64) {
    let parameter = view.sweep.parameter;
    let (minimum, maximum) = parameter.range();
    let (low, high) = view.sweep.range.unwrap_or_else(|| range_of(view, session, parameter));
    let (low, high) = (low.min(high).clamp(minimum, maximum), low.max(high).clamp(minimum, maximum));
    let usual = parameter.usual();
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
    let value = parameter.get(&view.scenario.parameters);
    match (parameter, &session.boundaries) {
        (Parameter::Omega, Some(boundaries)) => {
            let (low, high) = boundaries.range(view.map);
            (low.max(0.1 * high), high)
        }
        (Parameter::Beta, _) => (0.0, map::ceiling(view.map, value)),
        _ if value == 0.0 => (minimum, 0.1 * maximum),
        _ => {
            let middle = value.signum() * 2.0_f64.powf(value.abs().log2().round());
            let (a, b) = (middle / SPAN, middle * SPAN);
            (a.min(b).max(minimum), a.max(b).min(maximum))
        }
    }
}

/// The scenario with what plays no role in a question set to a fixed value, so that it does not make it a new one.
fn with(scenario: &Scenario, parameter: Parameter, value: f64) -> Scenario {
    let mut scenario = Scenario { t_end: Scenario::default().t_end, ..scenario.clone() };
    *parameter.get_mut(&mut scenario.parameters) = value;
    scenario
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_excitation_in_view_does_not_make_another_chart() {
        let mut view = View::default();
        let (system, _) = view.scenario.validate().expect("a valid start");
        let boundaries = Boundaries::new(map::Structure::of(&view.scenario), &system);
        let before = chart(&view, &boundaries);
        view.scenario.parameters.beta *= 0.9;
        view.scenario.parameters.omega += 0.1;
        assert_eq!(chart(&view, &boundaries), before);
        assert!(before.validate().is_ok());
        view.scenario.parameters.alpha *= 2.0;
        assert_ne!(chart(&view, &boundaries), before);
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
                let question = sweep(&view, &session);
                assert!(question.validate().is_ok(), "{parameter:?} {value:?} {:?}", question.range);
                assert!(question.range.1 > question.range.0);
            }
        }
    }
}
