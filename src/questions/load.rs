//! Power against the load resistance over decades.

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

use super::checks::Span;
use super::design::load::{
    BestFrequency, LoadPoint, best, best_frequency, decades, forced_loads, linear_loads, reached_loads,
};
use super::design::{Bounds, DesignError, Plant};
use super::error::{RequestError, failed};
use super::harvest::hertz;
use super::question::Question;
use crate::model::{Limits, ModelError, Parameter, Shaking};
use crate::scenario::{Scenario, counted};
use crate::scheduler::{Asked, Budget, Failure, Order, Piece, Study, complete_within};

/// Numbers of loads a decade may have.
pub const PER_DECADE: (usize, usize) = (1, 50);
/// Loads of a piece of work.
const PER_PIECE: usize = 6;

/// Highest resistance of a curve (ohm).
const MOST_OHMS: f64 = 1e15;

/// Power against the load.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Load {
    /// Lowest resistance (ohm); by default three decades below the device's own.
    pub from: Option<f64>,
    /// Highest resistance (ohm); by default six decades above the lowest.
    pub to: Option<f64>,
    /// Loads a decade.
    pub per_decade: usize,
    /// Frequencies (Hz) among which the best one is looked for under each load; their number plays no role.
    pub window: Option<Span>,
    /// What of the base's motion stays at the best frequency.
    pub hold: Shaking,
    /// What must be kept; the voltage by the ceramic where none is given.
    pub limits: Limits,
}

impl Default for Load {
    fn default() -> Self {
        Self {
            from: None,
            to: None,
            per_decade: 10,
            window: None,
            hold: Shaking::Amplitude,
            limits: Limits::default(),
        }
    }
}

/// Power against the load.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoadAnswer {
    /// The linear device at the own frequency: (ohm, W).
    pub linear: Vec<[f64; 2]>,
    /// Its best load (ohm) and power (W).
    pub linear_best: [f64; 2],
    /// The forced motion, stable or not; null where it is lost.
    pub forced: Vec<Option<LoadPoint>>,
    /// The motion reached, carried from the own load to both sides.
    pub reached: Vec<Option<LoadPoint>>,
    /// The best of these that lasts.
    pub reached_best: Option<LoadPoint>,
    /// The best of these that keeps the limits.
    pub reached_best_within_limits: Option<LoadPoint>,
    /// The best frequency for each load, where a window was given.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub best_frequency: Vec<Option<BestFrequency>>,
}

impl Question for Load {
    const TASK: &'static str = "load";
    const TAKES: &'static [&'static str] = &["initial", "t_end"];
    const COUNTS_LOSS: bool = true;
    type Answer = LoadAnswer;

    fn answer(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<LoadAnswer, RequestError> {
        scenario.validate()?;
        let plant = Plant::new(&scenario)?;
        let bounds = Bounds::new(&plant, self.limits.completed(&scenario.base()))?;
        let mut study = LoadStudy::new(scenario, *self)?;
        complete_within(&mut study, budget);
        failed(study.failure())?;
        let cut = study.best_frequencies().iter().flatten().filter(|best| best.cut).count();
        if cut > 0 {
            let count = study.best_frequencies().len();
            budget.lacks(format!(
                "under {cut} of {count} loads the branches were not followed to their ends, which would take too long \
                 (\"cut\"): a better frequency may be among the rest; a narrower window shows more of them"
            ));
        }
        let reached = || study.reached().iter().flatten().copied();
        Ok(LoadAnswer {
            linear: study.linear().to_vec(),
            linear_best: study.linear_best(),
            forced: study.forced().unwrap_or_default().to_vec(),
            reached: study.reached().to_vec(),
            reached_best: best(reached()),
            reached_best_within_limits: best(reached().filter(|point| bounds.allows(&point.measures))),
            best_frequency: study.best_frequencies().to_vec(),
        })
    }
}

/// The forced motion under one load after the other.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Forced {
    /// The device.
    pub scenario: Scenario,
    /// Load resistances (ohm) in their order.
    pub resistances: Vec<f64>,
}

impl Piece for Forced {
    const NAME: &'static str = "forced loads";
    /// One a load, where the forced motion exists.
    type Found = Vec<Option<LoadPoint>>;

    fn carry_out(&self) -> Result<Self::Found, Failure> {
        Ok(forced_loads(&self.scenario, &self.resistances)?)
    }
}

/// The motion reached under one load after the other.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Reached {
    /// The device, and the start when `state` is absent.
    pub scenario: Scenario,
    /// Load resistances (ohm) in their order.
    pub resistances: Vec<f64>,
    /// State carried over from the load before (length 2N + 1).
    pub state: Option<Vec<f64>>,
}

/// The motions under these loads.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct ReachedLoads {
    /// One a load.
    pub points: Vec<LoadPoint>,
    /// State to go on from (length 2N + 1); absent when the last motion ended.
    pub state: Option<Vec<f64>>,
}

impl Piece for Reached {
    const NAME: &'static str = "reached loads";
    type Found = ReachedLoads;

    fn carry_out(&self) -> Result<ReachedLoads, Failure> {
        let (points, state) = reached_loads(&self.scenario, &self.resistances, self.state.as_deref())?;
        Ok(ReachedLoads { points, state })
    }
}

/// The best frequency under a load.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct BestAt {
    /// The device.
    pub scenario: Scenario,
    /// Load resistance (ohm).
    pub resistance: f64,
    /// Lowest and highest omega (dimensionless).
    pub window: (f64, f64),
    /// What of the base's motion stays at other frequencies.
    pub shaking: Shaking,
    /// What must be kept.
    pub limits: Limits,
}

impl Piece for BestAt {
    const NAME: &'static str = "best frequency";
    type Found = BestFrequency;

    fn carry_out(&self) -> Result<BestFrequency, Failure> {
        let window = (self.window, self.shaking);
        Ok(best_frequency(&self.scenario, self.resistance, window, self.limits)?)
    }
}

/// A chain of motions reached, from the load nearest to the device's own outwards.
#[derive(Debug, Clone)]
struct Chain {
    /// Indices of its loads in their order.
    indices: Vec<usize>,
    done: usize,
    state: Option<Vec<f64>>,
    under_way: bool,
}

/// The curves being computed.
#[derive(Debug, Clone)]
pub struct LoadStudy {
    /// The device, its frequency, and the start from which the motion at its own load is reached.
    asked: (Scenario, Load),
    /// Lowest and highest omega (dimensionless) among which the best frequency is looked for; not looked for without.
    window: Option<(f64, f64)>,
    resistances: Vec<f64>,
    linear: Vec<[f64; 2]>,
    linear_best: [f64; 2],
    forced: Option<Vec<Option<LoadPoint>>>,
    forced_handed: bool,
    chains: [Chain; 2],
    reached: Vec<Option<LoadPoint>>,
    best: Vec<Option<BestFrequency>>,
    best_handed: usize,
    failure: Option<Failure>,
}

impl LoadStudy {
    /// The linear device at the scenario's frequency is known at once, the rest is to be computed. By default the range is six
    /// decades about the load of `scenario`, or about the best one of the linear device where there is no load.
    ///
    /// # Errors
    /// [`DesignError`] naming what is out of range.
    pub fn new(scenario: Scenario, question: Load) -> Result<Self, DesignError> {
        question.limits.validate()?;
        let plant = Plant::new(&scenario)?;
        let window = question.window.map(|window| hertz(&window, &plant)).transpose()?;
        let own = plant.resistance();
        let middle = if own.is_finite() { own } else { linear_loads(&scenario, &[])?.1[0] };
        // The largest conductance that the model takes ends the range.
        let lowest = 1.0 / (plant.units.power * Parameter::Kappa.range().1);
        let low = question.from.unwrap_or((1e-3 * middle).max(1.001 * lowest));
        let high = question.to.unwrap_or(1e6 * low);
        ModelError::check("from", low, (lowest, MOST_OHMS), " ohm")?;
        ModelError::check("to", high, (low * (1.0 + 1e-9), MOST_OHMS), " ohm")?;
        counted("per_decade", question.per_decade, PER_DECADE)?;
        plant.with_resistance(low)?;
        plant.with_resistance(high)?;
        let resistances = decades(low, high, question.per_decade);
        let (linear, linear_best) = linear_loads(&scenario, &resistances)?;
        let count = resistances.len();
        let own = own.ln();
        let distance = |i: &usize| (resistances[*i].ln() - own).abs();
        let nearest = (0..count).min_by(|i, j| distance(i).total_cmp(&distance(j))).unwrap_or(0);
        // An open circuit is nearest to the largest load.
        let middle = if own.is_finite() { nearest } else { count - 1 };
        let chain = |indices: Vec<usize>| Chain { indices, done: 0, state: None, under_way: false };
        let chains = [chain((middle..count).collect()), chain((0..=middle).rev().collect())];
        let best = if window.is_some() { vec![None; count] } else { Vec::new() };
        Ok(Self {
            asked: (scenario, question),
            window,
            linear,
            linear_best,
            forced: None,
            forced_handed: false,
            chains,
            reached: vec![None; count],
            best,
            best_handed: 0,
            failure: None,
            resistances,
        })
    }

    /// The loads (ohm), ascending.
    pub fn resistances(&self) -> &[f64] {
        &self.resistances
    }

    /// The linear device at the scenario's frequency: (ohm, W).
    pub fn linear(&self) -> &[[f64; 2]] {
        &self.linear
    }

    /// Its best load and power there (ohm, W), by the closed form.
    pub fn linear_best(&self) -> [f64; 2] {
        self.linear_best
    }

    /// The forced motion, one a load where it exists; `None` until it is known.
    pub fn forced(&self) -> Option<&[Option<LoadPoint>]> {
        self.forced.as_deref()
    }

    /// The motion reached, carried from the device's own load to both sides; one a load where it is known.
    pub fn reached(&self) -> &[Option<LoadPoint>] {
        &self.reached
    }

    /// The best frequency for each load where it is known; empty when none was asked for.
    pub fn best_frequencies(&self) -> &[Option<BestFrequency>] {
        &self.best
    }

    /// Why something is missing, if it is and will stay so.
    pub fn failure(&self) -> Option<&Failure> {
        self.failure.as_ref()
    }

    fn next_in_chain(&mut self) -> Option<Order<Self>> {
        let free = |chain: &Chain| !chain.under_way && chain.done < chain.indices.len();
        let which = self.chains.iter().position(free)?;
        let chain = &mut self.chains[which];
        chain.under_way = true;
        let indices = chain.indices.iter().skip(chain.done).take(PER_PIECE);
        let piece = Reached {
            scenario: self.asked.0.clone(),
            resistances: indices.map(|i| self.resistances[*i]).collect(),
            state: chain.state.clone(),
        };
        Some(Order::new(piece, move |study: &mut Self, found| match found {
            Ok(found) => {
                let chain = &mut study.chains[which];
                chain.under_way = false;
                chain.state = found.state;
                for point in found.points {
                    if let Some(index) = chain.indices.get(chain.done) {
                        study.reached[*index] = Some(point);
                    }
                    chain.done += 1;
                }
            }
            Err(message) => study.failure = Some(message),
        }))
    }

    fn next_best(&mut self) -> Option<Order<Self>> {
        let window = self.window?;
        let index = self.best_handed;
        let resistance = *self.resistances.get(index)?;
        self.best_handed += 1;
        let (scenario, question) = self.asked.clone();
        let limits = question.limits.completed(&scenario.base());
        let shaking = question.hold;
        let piece = BestAt { scenario, resistance, window, shaking, limits };
        Some(Order::new(piece, move |study: &mut Self, found| match found {
            Ok(found) => study.best[index] = Some(found),
            Err(message) => study.failure = Some(message),
        }))
    }
}

impl Asked for LoadStudy {
    type Question = (Scenario, Load);

    fn asked(&self) -> &Self::Question {
        &self.asked
    }
}

impl Study for LoadStudy {
    fn next(&mut self) -> Option<Order<Self>> {
        if self.failure.is_some() {
            return None;
        }
        if !std::mem::replace(&mut self.forced_handed, true) {
            let (scenario, resistances) = (self.asked.0.clone(), self.resistances.clone());
            let piece = Forced { scenario, resistances };
            return Some(Order::new(piece, |study: &mut Self, found| match found {
                Ok(points) => study.forced = Some(points),
                Err(message) => study.failure = Some(message),
            }));
        }
        self.next_in_chain().or_else(|| self.next_best())
    }

    fn progress(&self) -> f64 {
        let forced = usize::from(self.forced.is_some());
        let done = forced + self.reached.iter().flatten().count() + self.best.iter().flatten().count();
        done as f64 / (1 + self.reached.len() + self.best.len()) as f64
    }

    fn finished(&self) -> bool {
        let whole = self.forced.is_some()
            && self.chains.iter().all(|chain| chain.done == chain.indices.len())
            && self.best.iter().all(Option::is_some);
        self.failure.is_some() || whole
    }
}
