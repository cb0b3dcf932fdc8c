//! What a device delivers at its excitation, and over frequency: the linear device, the branches of periodic motions, what is
//! reached from rest, and what a sweep up and down reaches; all at the scenario's own amplitude of the base, or of its
//! acceleration. Where neighbours of the sampled curves differ, the motion is computed between them until the curve is
//! smooth or the frequency of a change is known.

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

use super::checks::{Span, class};
use super::design::band::{half_power, total, usable};
use super::design::change::{Way as ChangeWay, between, from_rest};
use super::design::linear::{LinearCurve, about_resonances, linear_curve};
use super::design::point::powers;
use super::design::{
    Bounds, DesignError, HarvestPoint, Interval, Operating, Plant, delivering_branches, operating,
};
use super::error::{RequestError, failed};
use super::question::Question;
use super::rectifier::{Rectifier, RectifierAnswer};
use super::response::{ResponseCurve, ResponsePoint, check_range, curve};
use super::subject::ACCELERATION_UNIT;
use super::sweep::{COUNTS, Direction, Sweep, SweepStudy};
use crate::dynamics::attractors::motion::Cell;
use crate::dynamics::attractors::sweep::{Dwell, SweepPoint};
use crate::dynamics::{IntegrationError, Motion, RunError};
use crate::model::layers::Laminate;
use crate::model::{Limits, ModelError, Parameter, Shaking};
use crate::scenario::{Scenario, counted};
use crate::scheduler::{Asked, Budget, Failure, Order, Piece, Study, complete_within};

/// Frequencies of a piece of work.
const PER_PIECE: usize = 8;
/// Distances from a resonance, in its own widths, at which there are starts from rest, and the resonances: those of the modes,
/// and the tongues at twice their frequencies.
const ABOUT_RESONANCE: [f64; 3] = [0.0, 1.0, 3.0];
const RESONANCES: [f64; 2] = [1.0, 2.0];
/// Difference of neighbours in power that is looked into, as a part of the curve's highest power, and how many of them
/// of a curve, the largest first.
const JUMP: f64 = 0.05;
const MOST_CHANGES: usize = 16;

/// What the device harvests.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Harvest {
    /// Frequencies of the curves; no curves when absent.
    pub frequency: Option<Span>,
    /// Whether they are equally spaced on a logarithmic scale.
    pub logarithmic: bool,
    /// What of the base's motion stays over the frequencies.
    pub hold: Shaking,
    /// Power (W) that counts as usable, for the bands; half of the highest of all curves by default.
    pub least: Option<f64>,
    /// What must be kept in the bands within limits; the voltage by the ceramic where none is given.
    pub limits: Limits,
    /// A rectifier and a store in place of the load; none when absent.
    pub rectifier: Option<Rectifier>,
    /// How long a frequency is held in a sweep; requests leave it as it is.
    #[serde(skip)]
    pub dwell: Dwell,
}

/// Frequencies in Hz as lowest and highest omega (dimensionless) of `plant`.
///
/// # Errors
/// [`ModelError`] unless both are positive and ascending.
pub(super) fn hertz(frequency: &Span, plant: &Plant) -> Result<(f64, f64), ModelError> {
    let (lowest, highest) = Parameter::Omega.range();
    let (least, most) = (plant.units.hertz(lowest), plant.units.hertz(highest));
    let from = ModelError::check("frequency.from", frequency.from, (least, most), " Hz")?;
    let to = ModelError::check("frequency.to", frequency.to, (from, most), " Hz")?;
    // Rounding is no reason to leave the range.
    Ok((plant.units.omega(from).max(lowest), plant.units.omega(to).min(highest)))
}

/// What the device harvests.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HarvestAnswer {
    /// What the acceleration counts in.
    pub acceleration_unit: &'static str,
    /// At its own excitation.
    #[serde(flatten)]
    pub operating: Operating,
    /// What goes into a store behind a rectifier, at its own excitation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rectified: Option<RectifierAnswer>,
    /// What the layers of the device decide, or else was given for it; absent where the request is about numbers.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub laminate: Option<Laminate>,
    /// Over frequency, at its own amplitude of the base or of its acceleration.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub curves: Option<Curves>,
}

/// Power over frequency.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Curves {
    /// The device without magnets.
    pub linear: LinearCurve,
    /// The forced motion and the doubled ones that leave it.
    pub branches: Vec<BranchCurve>,
    /// Why there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub branches_missing: Option<String>,
    /// What is reached from rest at each frequency: class and point, null where it ended.
    pub from_rest: Vec<Option<(String, HarvestPoint)>>,
    /// What a sweep up reaches, null where it ended.
    pub up: Vec<Option<HarvestPoint>>,
    /// What a sweep down reaches, null where it ended.
    pub down: Vec<Option<HarvestPoint>>,
    /// Bands of these curves.
    pub bands: Vec<Band>,
}

/// A branch of periodic motions.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BranchCurve {
    /// Period in excitation periods.
    pub periods: usize,
    /// Its points.
    pub points: Vec<HarvestPoint>,
    /// Whether each is stable.
    pub stable: Vec<bool>,
}

/// The bands of a curve.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Band {
    /// Which curve.
    pub of: &'static str,
    /// About its highest point, where at least half of its power is reached.
    pub half_power: Option<Interval>,
    /// Where at least `least` is reached.
    pub usable: Vec<Interval>,
    /// Width of these together (Hz).
    pub total: f64,
    /// The parts of these where the limits are kept.
    pub within_limits: Vec<Interval>,
    /// Width of those together (Hz).
    pub total_within_limits: f64,
}

impl Question for Harvest {
    const TASK: &'static str = "harvest";
    const TAKES: &'static [&'static str] = &["initial", "t_end"];
    const COUNTS_LOSS: bool = true;
    type Answer = HarvestAnswer;

    fn answer(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<HarvestAnswer, RequestError> {
        scenario.validate()?;
        if let Some(least) = self.least {
            ModelError::check("least", least, (0.0, 1e6), " W")?;
        }
        self.limits.validate()?;
        let operating = operating(&scenario)?;
        let rectified = self.rectifier.map(|rectifier| rectifier.answer(&scenario, budget)).transpose()?;
        let laminate = scenario.laminate()?;
        let curves = self.frequency.map(|frequency| self.curves(scenario, frequency, budget)).transpose()?;
        Ok(HarvestAnswer { acceleration_unit: ACCELERATION_UNIT, operating, rectified, laminate, curves })
    }
}

impl Harvest {
    fn curves(
        &self,
        scenario: Scenario,
        frequency: Span,
        budget: &Budget<'_>,
    ) -> Result<Curves, RequestError> {
        let plant = Plant::new(&scenario)?;
        let bounds = Bounds::new(&plant, self.limits.completed(&scenario.base()))?;
        let mut study = HarvestStudy::new(scenario, *self, frequency)?;
        complete_within(&mut study, budget);
        failed(study.failure())?;
        let branches = study.branches().and_then(Result::ok).unwrap_or_default();
        if branches.iter().any(|branch| branch.cut) {
            budget
                .lacks("the branches were not followed to their ends, which would take too long".to_owned());
        }
        let branch = |curve| {
            let (points, stable) = study.branch_points(curve).into_iter().unzip();
            BranchCurve { periods: curve.periods, points, stable }
        };
        let class = |(motion, point)| (class(motion), point);
        let linear = study.linear().clone();
        let curves = [
            ("linear", vec![study.linear_points()]),
            ("stable", study.stable_pieces()),
            ("from_rest", study.rest_pieces()),
            ("up", study.swept_pieces(Direction::Up)),
            ("down", study.swept_pieces(Direction::Down)),
        ];
        let points = curves.iter().flat_map(|(_, pieces)| pieces.iter().flatten());
        let least = self.least.unwrap_or(0.5 * points.map(|point| point.measures.power).fold(0.0, f64::max));
        let band = |of, bounds: Bounds, pieces: &[Vec<HarvestPoint>]| {
            let curves = powers(pieces);
            let within_limits = usable(&bounds.powers_within(pieces), least);
            let usable = usable(&curves, least);
            Band {
                of,
                half_power: half_power(&curves),
                total: total(&usable),
                usable,
                total_within_limits: total(&within_limits),
                within_limits,
            }
        };
        let bands = curves.map(|(of, pieces)| match of {
            // Its half-power band is known exactly, and it has no magnets to touch.
            "linear" => {
                let band = band(of, bounds.without_magnets(), &pieces);
                Band { half_power: Some(linear.half_power), ..band }
            }
            _ => band(of, bounds, &pieces),
        });
        Ok(Curves {
            branches: branches.iter().map(branch).collect(),
            branches_missing: study.branches().and_then(Result::err).map(ToString::to_string),
            from_rest: study.from_rest().iter().map(|start| start.flatten().map(class)).collect(),
            up: study.swept(Direction::Up),
            down: study.swept(Direction::Down),
            bands: bands.to_vec(),
            linear,
        })
    }
}

/// What a device harvests under its own excitation.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Deliver {
    /// The device.
    pub scenario: Scenario,
}

impl Piece for Deliver {
    const NAME: &'static str = "operating";
    type Found = Operating;

    fn carry_out(&self) -> Result<Operating, Failure> {
        Ok(operating(&self.scenario)?)
    }
}

/// The branches of periodic motions over frequency.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Branches {
    /// The device.
    pub scenario: Scenario,
    /// What of the base's motion stays at other frequencies.
    pub shaking: Shaking,
    /// Lowest and highest omega (dimensionless).
    pub window: (f64, f64),
}

impl Piece for Branches {
    const NAME: &'static str = "harvest_branches";
    type Found = Vec<ResponseCurve>;

    fn carry_out(&self) -> Result<Self::Found, Failure> {
        let plant = Plant::new(&self.scenario)?.shaken(self.shaking);
        Ok(delivering_branches(&plant, self.window)?.iter().map(curve).collect())
    }
}

/// Starts from rest at several frequencies.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Starts {
    /// The device.
    pub scenario: Scenario,
    /// What of the base's motion stays at other frequencies.
    pub shaking: Shaking,
    /// The frequencies (omega, dimensionless).
    pub omegas: Vec<f64>,
}

impl Piece for Starts {
    const NAME: &'static str = "harvest_starts";
    /// The motion reached at each; nothing where it cannot be integrated.
    type Found = Vec<Option<Cell>>;

    fn carry_out(&self) -> Result<Self::Found, Failure> {
        let plant = Plant::new(&self.scenario)?.shaken(self.shaking);
        let start = |omega: &f64| match from_rest(&plant, *omega) {
            Err(DesignError::Run(RunError::Integration(
                IntegrationError::StepTooSmall { .. } | IntegrationError::TooManySteps { .. },
            ))) => Ok(None),
            found => Ok(Some(found?)),
        };
        self.omegas.iter().map(start).collect()
    }
}

/// Where a curve over frequency changes its motion.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Between {
    /// The device.
    pub scenario: Scenario,
    /// What of the base's motion stays at other frequencies.
    pub shaking: Shaking,
    /// How its motions are reached.
    pub way: ChangeWay,
    /// Two neighbours (omega) in their order.
    pub neighbours: (f64, f64),
    /// Difference in power (W) that is small enough.
    pub difference: f64,
}

impl Piece for Between {
    const NAME: &'static str = "change";
    /// The points between two neighbours of a curve; nothing where the motion ends.
    type Found = Vec<Option<HarvestPoint>>;

    fn carry_out(&self) -> Result<Self::Found, Failure> {
        Ok(between(&self.scenario, self.shaking, &self.way, self.neighbours, self.difference)?)
    }
}

/// A curve that is sampled.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Sampled {
    Swept(Direction),
    FromRest,
}

/// A jump between two neighbours of a sampled curve.
#[derive(Debug, Clone)]
struct Change {
    curve: Sampled,
    /// The first of the neighbours in the curve's order.
    index: usize,
    /// Difference in power (W) that is looked into.
    difference: f64,
    /// The points between them, once they are known; nothing where the motion ends.
    found: Option<Vec<Option<HarvestPoint>>>,
}

/// The curves being computed.
#[derive(Debug, Clone)]
pub struct HarvestStudy {
    asked: (Scenario, Harvest),
    /// Lowest and highest omega (dimensionless).
    window: (f64, f64),
    /// Those of the starts from rest: the values of the sweeps, and more about the resonances.
    omegas: Vec<f64>,
    plant: Plant,
    linear: LinearCurve,
    branches: Option<Result<Vec<ResponseCurve>, Failure>>,
    branches_handed: bool,
    sweeps: SweepStudy,
    starts: Vec<Option<Option<(Motion, HarvestPoint)>>>,
    starts_handed: usize,
    /// Known once all curves are.
    changes: Option<Vec<Change>>,
    changes_handed: usize,
    failure: Option<Failure>,
}

impl HarvestStudy {
    /// The curves of `scenario` over the frequencies (Hz); its omega and its start play no role. The linear device is known at once, the rest is to be computed.
    ///
    /// # Errors
    /// [`DesignError`] naming what is out of range.
    pub fn new(scenario: Scenario, question: Harvest, frequency: Span) -> Result<Self, DesignError> {
        let plant = Plant::new(&scenario)?.shaken(question.hold);
        let window = hertz(&frequency, &plant)?;
        let high = Parameter::Beta.range().1;
        ModelError::check("beta at the lowest frequency", plant.beta_at(window.0), (0.0, high), "")?;
        let rest = Scenario { initial: None, ..plant.scenario.clone() };
        let (system, _) = rest.validate()?;
        check_range(Parameter::Omega, window)?;
        let count = frequency.count;
        counted("count", count, COUNTS)?;
        question.dwell.validate()?;
        let sweep = Sweep {
            parameter: Parameter::Omega,
            from: window.0,
            to: window.1,
            count,
            direction: Direction::Up,
            transient: question.dwell.discarded,
            kept: question.dwell.kept,
            branches: false,
            along: plant.along,
            logarithmic: question.logarithmic,
        };
        let values = sweep.values(Direction::Up);
        let linear = linear_curve(&plant, window, values.iter().copied())?;
        // A peak, and a tongue that has just opened, may be narrower than the distance of the values.
        let omegas = about_resonances(&system, window, values.into_iter(), &ABOUT_RESONANCE, &RESONANCES)?;
        Ok(Self {
            linear,
            branches: None,
            branches_handed: false,
            sweeps: SweepStudy::new(rest, sweep, &[Direction::Up, Direction::Down]),
            starts: vec![None; omegas.len()],
            omegas,
            starts_handed: 0,
            changes: None,
            changes_handed: 0,
            plant,
            asked: (scenario, question),
            window,
            failure: None,
        })
    }

    /// Lowest and highest frequency (Hz).
    pub fn window(&self) -> (f64, f64) {
        (self.plant.units.hertz(self.window.0), self.plant.units.hertz(self.window.1))
    }

    /// The device without its magnets.
    pub fn linear(&self) -> &LinearCurve {
        &self.linear
    }

    /// The same as points of a curve.
    pub fn linear_points(&self) -> Vec<HarvestPoint> {
        let points = self.linear.points.iter();
        points.map(|point| HarvestPoint::of_linear(&self.plant, *point)).collect()
    }

    /// The forced branch and the doubled ones; why there are none, or `None` until they are known.
    pub fn branches(&self) -> Option<Result<&[ResponseCurve], &Failure>> {
        self.branches.as_ref().map(|found| found.as_deref())
    }

    /// A branch's points in SI units, each with whether it is stable.
    pub fn branch_points(&self, curve: &ResponseCurve) -> Vec<(HarvestPoint, bool)> {
        let point = |point: &ResponsePoint| {
            (HarvestPoint::new(&self.plant, point.value, &point.measures), point.multiplier < 1.0)
        };
        curve.points.iter().map(point).collect()
    }

    /// What the sweep has reached so far, in the order of its way; `None` where the motion ended.
    pub fn swept(&self, direction: Direction) -> Vec<Option<HarvestPoint>> {
        let point = |point: &SweepPoint| {
            (!point.ended).then(|| HarvestPoint::new(&self.plant, point.value, &point.measures))
        };
        self.sweeps.points(direction).iter().map(point).collect()
    }

    /// The same in pieces, cut where the motion ended, with what is known between the values.
    pub fn swept_pieces(&self, direction: Direction) -> Vec<Vec<HarvestPoint>> {
        let curve = Sampled::Swept(direction);
        pieces(self.refined(curve, self.sampled(curve)))
    }

    /// What is reached from rest, by ascending frequency; `None` until it is known, the inner one where the motion ends
    /// or cannot be followed.
    pub fn from_rest(&self) -> &[Option<Option<(Motion, HarvestPoint)>>] {
        &self.starts
    }

    /// Why something is missing, if it is and will stay so.
    pub fn failure(&self) -> Option<&Failure> {
        self.failure.as_ref().or_else(|| self.sweeps.failure())
    }

    /// The stable pieces of all branches.
    pub fn stable_pieces(&self) -> Vec<Vec<HarvestPoint>> {
        let curves = self.branches().and_then(Result::ok).unwrap_or_default();
        let points = curves.iter().map(|curve| self.branch_points(curve));
        let mut pieces = Vec::new();
        for points in points {
            let runs = points.chunk_by(|a, b| a.1 == b.1).filter(|run| run[0].1);
            pieces.extend(runs.map(|run| run.iter().map(|(point, _)| *point).collect()));
        }
        pieces
    }

    /// What is reached from rest, cut where the motion ends or is not known, with what is known between the frequencies.
    pub fn rest_pieces(&self) -> Vec<Vec<HarvestPoint>> {
        pieces(self.refined(Sampled::FromRest, self.sampled(Sampled::FromRest)))
    }

    fn sampled(&self, curve: Sampled) -> Vec<Option<HarvestPoint>> {
        match curve {
            Sampled::Swept(direction) => self.swept(direction),
            Sampled::FromRest => {
                self.starts.iter().map(|start| start.flatten().map(|(_, point)| point)).collect()
            }
        }
    }

    /// A curve with the points of its changes.
    fn refined(&self, curve: Sampled, samples: Vec<Option<HarvestPoint>>) -> Vec<Option<HarvestPoint>> {
        let changes: Vec<&Change> =
            self.changes.iter().flatten().filter(|change| change.curve == curve).collect();
        let mut points = Vec::with_capacity(samples.len());
        for (index, sample) in samples.into_iter().enumerate() {
            points.push(sample);
            let found = changes.iter().find(|change| change.index == index);
            points.extend(found.and_then(|change| change.found.as_ref()).into_iter().flatten());
        }
        points
    }

    /// The changes of all curves, when these are whole.
    fn plan_changes(&mut self) {
        if self.changes.is_some() || !self.sweeps.finished() || !self.starts.iter().all(Option::is_some) {
            return;
        }
        let mut changes = Vec::new();
        for curve in [Sampled::Swept(Direction::Up), Sampled::Swept(Direction::Down), Sampled::FromRest] {
            let samples = self.sampled(curve);
            let power = |sample: &Option<HarvestPoint>| sample.map_or(0.0, |point| point.measures.power);
            let highest = samples.iter().map(power).fold(0.0, f64::max);
            let mut jumps: Vec<(usize, f64)> = samples
                .windows(2)
                .enumerate()
                .map(|(index, pair)| {
                    let ends = pair[0].is_some() != pair[1].is_some();
                    let difference = (power(&pair[0]) - power(&pair[1])).abs();
                    (index, if ends { f64::INFINITY } else { difference })
                })
                .filter(|(_, difference)| *difference > JUMP * highest)
                .collect();
            jumps.sort_by(|a, b| b.1.total_cmp(&a.1));
            let difference = JUMP * highest;
            let change = |(index, _)| Change { curve, index, difference, found: None };
            changes.extend(jumps.into_iter().take(MOST_CHANGES).map(change));
        }
        self.changes = Some(changes);
    }

    fn next_change(&mut self) -> Option<Order<Self>> {
        let handed = self.changes_handed;
        let Change { curve, index, difference, .. } = self.changes.as_ref()?.get(handed)?;
        let (way, neighbours) = match curve {
            Sampled::FromRest => (ChangeWay::FromRest, (self.omegas[*index], self.omegas[index + 1])),
            Sampled::Swept(direction) => {
                let values = self.sweeps.question().values(*direction);
                let (begin, state) = self.sweeps.begun(*direction, *index)?;
                let visited = values[*begin..=*index].to_vec();
                let (state, dwell) = (state.clone(), self.asked.1.dwell);
                let way = ChangeWay::Sweep { state, values: visited, dwell };
                (way, (values[*index], values[index + 1]))
            }
        };
        let difference = *difference;
        self.changes_handed += 1;
        let (scenario, shaking) = (self.asked.0.clone(), self.asked.1.hold);
        let piece = Between { scenario, shaking, way, neighbours, difference };
        Some(Order::new(piece, move |study: &mut Self, found| {
            if let Some(change) = study.changes.as_mut().and_then(|changes| changes.get_mut(handed)) {
                // Where it cannot be computed the line between the neighbours is all there is.
                change.found = Some(found.unwrap_or_default());
            }
        }))
    }

    fn next_starts(&mut self) -> Option<Order<Self>> {
        let begin = self.starts_handed;
        let end = (begin + PER_PIECE).min(self.starts.len());
        if begin == end {
            return None;
        }
        self.starts_handed = end;
        let omegas = self.omegas[begin..end].to_vec();
        let (scenario, shaking) = (self.asked.0.clone(), self.asked.1.hold);
        Some(Order::new(Starts { scenario, shaking, omegas }, move |study: &mut Self, found| {
            match found {
                Ok(found) => {
                    for (index, cell) in (begin..).zip(found) {
                        study.starts[index] = Some(study.start_at(index, cell));
                    }
                }
                Err(message) => study.failure = Some(message),
            }
            study.plan_changes();
        }))
    }

    /// What a start from rest leads to at the frequency of this index.
    fn start_at(&self, index: usize, cell: Option<Cell>) -> Option<(Motion, HarvestPoint)> {
        let cell = cell?;
        cell.demand()?;
        let point = HarvestPoint::new(&self.plant, self.omegas[index], &cell.measures);
        Some((cell.motion, point))
    }
}

/// A curve in pieces, cut where there is nothing.
fn pieces(curve: Vec<Option<HarvestPoint>>) -> Vec<Vec<HarvestPoint>> {
    let runs = curve.chunk_by(|a, b| a.is_some() == b.is_some());
    runs.map(|run| run.iter().flatten().copied().collect::<Vec<_>>())
        .filter(|piece| !piece.is_empty())
        .collect()
}

impl Asked for HarvestStudy {
    type Question = (Scenario, Harvest);

    fn asked(&self) -> &Self::Question {
        &self.asked
    }
}

impl Study for HarvestStudy {
    fn next(&mut self) -> Option<Order<Self>> {
        if self.failure.is_some() {
            return None;
        }
        if !std::mem::replace(&mut self.branches_handed, true) {
            let (scenario, shaking) = (self.asked.0.clone(), self.asked.1.hold);
            let piece = Branches { scenario, shaking, window: self.window };
            return Some(Order::new(piece, |study: &mut Self, found| study.branches = Some(found)));
        }
        let sweep = self
            .sweeps
            .next()
            .map(|order| order.within(|study: &mut Self| &mut study.sweeps, Self::plan_changes));
        sweep.or_else(|| self.next_starts()).or_else(|| self.next_change())
    }

    fn progress(&self) -> f64 {
        let branches = if self.branches.is_some() { 1.0 } else { 0.0 };
        let starts = self.starts.iter().flatten().count() as f64 / self.starts.len().max(1) as f64;
        let changes = self.changes.as_ref().map_or(0.0, |changes| {
            let known = changes.iter().filter(|change| change.found.is_some()).count();
            if changes.is_empty() { 1.0 } else { known as f64 / changes.len() as f64 }
        });
        0.2 * branches + 0.35 * self.sweeps.progress() + 0.35 * starts + 0.1 * changes
    }

    fn finished(&self) -> bool {
        let known = |changes: &Vec<Change>| changes.iter().all(|change| change.found.is_some());
        let whole = self.branches.is_some() && self.changes.as_ref().is_some_and(known);
        self.failure.is_some() || self.sweeps.failure().is_some() || whole
    }
}
