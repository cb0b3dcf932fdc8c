//! What the Design tab asks the crew.

use crate::app::bench;
use crate::app::map::HALF_WIDTH;
use crate::app::session::Session;
use crate::app::view::View;
use crate::app::view::design::{Aim, Side};
use crate::app::widgets::number::round_significant;

use crate::model::{Along, Dimension, Parameter, ParameterSet, Scale, Shaking};
use crate::questions::checks::Span;
use crate::questions::design::space::{DesignSpace, Objective, Variable};
use crate::questions::harvest::Harvest;
use crate::questions::load::{BestAt, Load, LoadStudy};
use crate::questions::materials::{Fitted, Materials};
use crate::questions::motions::{Coordinate, at_place};
use crate::questions::rectifier::Rectifier;
use crate::questions::tolerances::Tolerances;
use crate::questions::trust::{Entry, Trust};
use crate::scenario::{Forgotten, Scenario};
use crate::scheduler::Table;

/// Loads whose best frequency is looked for: every so many of those in view.
const EVERY_LOAD: usize = 2;
/// Power (W) that counts in the band of a candidate unless one is chosen.
pub(in crate::app) const LEAST: f64 = 1e-6;
/// Frequencies of the band of a candidate.
const BAND_POINTS: usize = 12;
/// Frequencies of a curve, and ratio of the ends of a window from which there are twice as many.
const FREQUENCIES: usize = 97;
const WIDE: f64 = 3.0;
/// Half width of a window about a frequency far from every resonance, over that frequency.
const ABOUT: f64 = 0.2;
/// Smallest window, over its middle.
const LEAST_WINDOW: f64 = 1e-3;

/// What of the base's motion stays while its frequency changes.
pub(in crate::app) fn shaking(view: &View) -> Shaking {
    if view.design.holds_acceleration { Shaking::Acceleration } else { Shaking::Amplitude }
}

/// The scenario at rest where the frequency of a curve begins, for one in which the present frequency plays no role.
fn at_the_beginning(view: &View, window: (f64, f64)) -> Scenario {
    let scenario = view.scenario.forgetting(&[Forgotten::Start, Forgotten::Duration]);
    // Rounded, so that going along the curve and back makes no other question.
    let set = Along::from(shaking(view)).at(&scenario.parameters, Parameter::Omega, window.0);
    let beta = Forgotten::Number(Parameter::Beta, round_significant(set.beta, 12));
    scenario.forgetting(&[Forgotten::Number(Parameter::Omega, set.omega), beta])
}

/// Lowest and highest omega (dimensionless) of the curves: as chosen, or the map's window about the present frequency.
pub(in crate::app) fn window(view: &View, session: &Session) -> (f64, f64) {
    let (minimum, maximum) = Parameter::Omega.range();
    let omega = view.scenario.parameters.omega;
    let units = view.scenario.units();
    let near = session.boundaries.as_ref().and_then(|boundaries| {
        let resonance = boundaries.resonance_near(omega)?;
        let middle = boundaries.tongue(resonance)?.published_frequency;
        Some((middle - HALF_WIDTH, middle + HALF_WIDTH))
    });
    let (low, high) = match (view.design.window, near) {
        (Some((from, to)), _) => (units.omega(from.min(to)), units.omega(from.max(to))),
        (None, Some(near)) => near,
        (None, None) => {
            // About a round value, so that the window stays while the frequency moves a little.
            let middle = (0.125 * (omega.log2() * 8.0).round()).exp2();
            ((1.0 - ABOUT) * middle, (1.0 + ABOUT) * middle)
        }
    };
    // The same acceleration takes more and more amplitude towards low frequencies.
    let most = Parameter::Beta.range().1 * (1.0 - 1e-9);
    let reach = omega * (view.scenario.parameters.beta / most).sqrt();
    let minimum = if shaking(view) == Shaking::Acceleration { minimum.max(reach) } else { minimum };
    let low = low.clamp(minimum, maximum * (1.0 - LEAST_WINDOW));
    // Rounded, so that a window that is kept in Hz asks the same question.
    let ends = [low, high.clamp(low * (1.0 + LEAST_WINDOW), maximum)];
    ends.map(|end| round_significant(end, 10)).into()
}

/// The curves over frequency.
pub(in crate::app) fn harvest(view: &View, session: &Session) -> (Scenario, Harvest, Span) {
    let window = window(view, session);
    let units = view.scenario.units();
    let count = if window.1 < WIDE * window.0 { FREQUENCIES } else { 2 * FREQUENCIES - 1 };
    let frequency = Span { from: units.hertz(window.0), to: units.hertz(window.1), count };
    let (hold, logarithmic) = (shaking(view), view.design.logarithmic_frequency);
    let question = Harvest { frequency: Some(frequency), logarithmic, hold, ..Harvest::default() };
    (at_the_beginning(view, window), question, frequency)
}

/// The curves over the load, at the frequency in view.
pub(in crate::app) fn load(view: &View) -> (Scenario, Load) {
    (view.scenario.forgetting(&[Forgotten::Duration]), Load::default())
}

/// A rectifier in place of the load, which plays no role then.
pub(in crate::app) fn rectifier(view: &View) -> (Scenario, Rectifier) {
    let kappa = ParameterSet::default().get(Parameter::Kappa);
    let scenario =
        view.scenario.forgetting(&[Forgotten::Duration, Forgotten::Number(Parameter::Kappa, kappa)]);
    (scenario, Rectifier { drop: view.design.diode_drop, ..Rectifier::default() })
}

/// What scatter does to the device in view.
pub(in crate::app) fn tolerances(view: &View) -> (Scenario, Tolerances) {
    let (limits, resonance) = (bench::chosen_limits(view), view.design.resonance);
    let asked = Tolerances { deviation: view.design.scatter, limits, resonance, ..Tolerances::default() };
    (view.scenario.forgetting(&[Forgotten::Duration]), asked)
}

/// The ceramics on the device in view. What they replace plays no role and must not make another question.
pub(in crate::app) fn materials(view: &View) -> Table<Fitted> {
    let scenario = view.scenario.forgetting(&[Forgotten::Ceramic, Forgotten::Duration]);
    let mode = view.design.mode.clamp(1, view.scenario.model.modes);
    Materials { mode, resonance: view.design.resonance, ..Materials::default() }.table(&scenario)
}

/// The quantity in view over modes and force laws.
pub(in crate::app) fn trust(view: &View) -> Table<Entry> {
    // Every entry has its own model.
    let scenario = view.scenario.forgetting(&[Forgotten::Model, Forgotten::Duration]);
    Trust { quantity: view.design.quantity }.table(&scenario)
}

/// The best frequency of a few loads.
pub(in crate::app) fn best_frequencies(view: &View, session: &Session, loads: &LoadStudy) -> Table<BestAt> {
    let window = window(view, session);
    let kappa = ParameterSet::default().get(Parameter::Kappa);
    let scenario = at_the_beginning(view, window).forgetting(&[Forgotten::Number(Parameter::Kappa, kappa)]);
    let (shaking, limits) = (shaking(view), bench::limits(view));
    let piece = |resistance: &f64| {
        let (scenario, resistance) = (scenario.clone(), *resistance);
        BestAt { scenario, resistance, window, shaking, limits }
    };
    Table::new(loads.resistances().iter().step_by(EVERY_LOAD).map(piece).collect())
}

/// The range of a side of the map (in SI units): as chosen, or about a round value near the present one.
pub(in crate::app) fn range_of(view: &View, session: &Session, side: &Side) -> (f64, f64) {
    let (least, most) = side.dimension.range();
    let (low, high) = side.range.unwrap_or_else(|| {
        let (usual_low, usual_high) = side.dimension.fact().usual;
        let device = view.scenario.device().unwrap_or_default();
        let value = device.get(side.dimension);
        match side.dimension {
            Dimension::Frequency => {
                let (low, high) = window(view, session);
                let units = view.scenario.units();
                (units.hertz(low), units.hertz(high))
            }
            _ if value > 0.0 && value.is_finite() => {
                let span = if side.dimension == Dimension::Resistance { 10.0 } else { 2.0 };
                let middle = round_significant(value.log2().round().exp2(), 1);
                (middle / span, middle * span)
            }
            _ => (usual_low, usual_high),
        }
    });
    let (low, high) = (low.min(high).clamp(least, most), low.max(high).clamp(least, most));
    if high > low { (low, high) } else { (0.5 * low, 1.5 * low.max(1e-12)) }
}

fn variable(view: &View, session: &Session, side: &Side) -> Variable {
    let range = range_of(view, session, side);
    let logarithmic =
        side.dimension.fact().scale == Scale::Logarithmic && range.0 > 0.0 && range.1 > 3.0 * range.0;
    Variable { coordinate: Coordinate::Dimension(side.dimension), range, logarithmic }
}

fn objective(view: &View, session: &Session) -> Objective {
    match view.design.search.aim {
        Aim::Power => Objective::Power,
        Aim::PerG2 => Objective::PowerPerG2,
        Aim::Voltage => Objective::Voltage,
        Aim::Threshold => Objective::Threshold(view.design.resonance),
        Aim::Band => {
            let (low, high) = window(view, session);
            let units = view.scenario.units();
            let (from, to, count) = (units.hertz(low), units.hertz(high), BAND_POINTS);
            Objective::Band { least: view.design.least.unwrap_or(LEAST), from, to, count }
        }
    }
}

/// The base's acceleration (g) that is held while anything else is varied.
fn acceleration(view: &View) -> Option<f64> {
    let p = &view.scenario.parameters;
    // Without the last digits, which change while the frequency is moved at this acceleration.
    let present = || round_significant(view.scenario.units().acceleration(p.beta, p.omega), 5);
    view.design.holds_acceleration.then(present)
}

/// The map in view. What its sides vary must not make another question.
pub(in crate::app) fn map(view: &View, session: &Session) -> DesignSpace {
    let variables: Vec<Variable> =
        view.design.search.sides.iter().map(|side| variable(view, session, side)).collect();
    let mut scenario = view.scenario.clone();
    let coordinates: Vec<Coordinate> = variables.iter().map(|variable| variable.coordinate).collect();
    let middles: Vec<f64> = variables.iter().map(|variable| variable.at(0.5)).collect();
    if let Ok(anywhere) = at_place(&scenario, &coordinates, &middles) {
        scenario = anywhere;
    }
    let objective = objective(view, session);
    let scenario = scenario.forgetting(&[Forgotten::Duration]);
    let acceleration = acceleration(view);
    // The amplitude follows then.
    let usual = ParameterSet::default().get(Parameter::Beta);
    let follows = acceleration.map(|_| Forgotten::Number(Parameter::Beta, usual));
    let scenario = scenario.forgetting(follows.as_slice());
    DesignSpace { scenario, variables, objective, limits: bench::chosen_limits(view), acceleration }
}

/// The search in view, from the device in view.
pub(in crate::app) fn find(view: &View, session: &Session) -> DesignSpace {
    let search = &view.design.search;
    let sides = search.sides.iter().chain(&search.third);
    let variables = sides.map(|side| variable(view, session, side)).collect();
    let objective = objective(view, session);
    let (scenario, limits) = (view.scenario.clone(), bench::chosen_limits(view));
    DesignSpace { scenario, variables, objective, limits, acceleration: acceleration(view) }
}
