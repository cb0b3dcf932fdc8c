//! Power against the load resistance over decades.

use serde::{Deserialize, Serialize};

use super::Study;
use crate::jobs::design::load::{BestFrequency, LoadPoint, decades, linear_loads};
use crate::jobs::design::{DesignError, DesignFinding, DesignWork, Plant};
use crate::jobs::response::check_range;
use crate::jobs::work::{Finding, Work};
use crate::model::{Limits, ModelError, Parameter, Shaking};
use crate::scenario::Scenario;

/// Numbers of loads a decade may have.
pub const PER_DECADE: (usize, usize) = (1, 50);
/// Loads of a piece of work.
const PER_PIECE: usize = 6;
/// Tickets: the forced motion, the two chains of motions reached, then the best frequencies.
const FORCED: usize = 0;
const CHAINS: usize = 1;
const BEST: usize = 3;

/// What is asked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LoadQuestion {
    /// The device, its frequency, and the start from which the motion at its own load is reached.
    pub scenario: Scenario,
    /// Lowest and highest resistance (ohm).
    pub range: (f64, f64),
    /// Loads a decade.
    pub per_decade: usize,
    /// Lowest and highest omega (dimensionless) among which the best frequency is looked for; not looked for without.
    pub window: Option<(f64, f64)>,
    /// What of the base's motion stays at the best frequency.
    pub shaking: Shaking,
    /// What must be kept there.
    pub limits: Limits,
}

impl LoadQuestion {
    /// Six decades about the load of `scenario`, or about the best one of the linear device where there is no load; the
    /// limits are the device's own.
    ///
    /// # Errors
    /// [`DesignError`].
    pub fn about(scenario: Scenario, window: Option<(f64, f64)>) -> Result<Self, DesignError> {
        let plant = Plant::new(&scenario)?;
        let own = plant.resistance();
        let middle = if own.is_finite() { own } else { linear_loads(&scenario, &[])?.1[0] };
        // The largest conductance that the model takes ends the range.
        let lowest = 1.0 / (plant.units.power * Parameter::Kappa.range().1);
        let low = (1e-3 * middle).max(1.001 * lowest);
        let limits = Limits::of(&scenario.base());
        Ok(Self {
            scenario,
            range: (low, 1e6 * low),
            per_decade: 10,
            window,
            shaking: Shaking::Amplitude,
            limits,
        })
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
    question: LoadQuestion,
    resistances: Vec<f64>,
    linear: Vec<[f64; 2]>,
    linear_best: [f64; 2],
    forced: Option<Vec<Option<LoadPoint>>>,
    forced_handed: bool,
    chains: [Chain; 2],
    reached: Vec<Option<LoadPoint>>,
    best: Vec<Option<BestFrequency>>,
    best_handed: usize,
    failure: Option<String>,
}

impl LoadStudy {
    /// The linear device is known at once, the rest is to be computed.
    ///
    /// # Errors
    /// [`DesignError`] naming what is out of range.
    pub fn new(question: LoadQuestion) -> Result<Self, DesignError> {
        let plant = Plant::new(&question.scenario)?;
        let (low, high) = question.range;
        ModelError::check("lowest resistance", low, (1e-12, 1e15), " ohm")?;
        ModelError::check("highest resistance", high, (low * (1.0 + 1e-9), 1e15), " ohm")?;
        let (minimum, maximum) = PER_DECADE;
        if !(minimum..=maximum).contains(&question.per_decade) {
            let (field, value) = ("per_decade", question.per_decade);
            return Err(ModelError::Count { field, value, minimum, maximum }.into());
        }
        plant.with_resistance(low)?;
        plant.with_resistance(high)?;
        if let Some(window) = question.window {
            check_range(Parameter::Omega, window)?;
        }
        let resistances = decades(low, high, question.per_decade);
        let (linear, linear_best) = linear_loads(&question.scenario, &resistances)?;
        let count = resistances.len();
        let own = plant.resistance().ln();
        let distance = |i: &usize| (resistances[*i].ln() - own).abs();
        let nearest = (0..count).min_by(|i, j| distance(i).total_cmp(&distance(j))).unwrap_or(0);
        // An open circuit is nearest to the largest load.
        let middle = if own.is_finite() { nearest } else { count - 1 };
        let chain = |indices: Vec<usize>| Chain { indices, done: 0, state: None, under_way: false };
        let chains = [chain((middle..count).collect()), chain((0..=middle).rev().collect())];
        let best = if question.window.is_some() { vec![None; count] } else { Vec::new() };
        Ok(Self {
            question,
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

    /// What is asked.
    pub fn question(&self) -> &LoadQuestion {
        &self.question
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
    pub fn failure(&self) -> Option<&str> {
        self.failure.as_deref()
    }

    fn next_in_chain(&mut self) -> Option<(usize, Work)> {
        let free = |chain: &Chain| !chain.under_way && chain.done < chain.indices.len();
        let which = self.chains.iter().position(free)?;
        let chain = &mut self.chains[which];
        chain.under_way = true;
        let indices = chain.indices.iter().skip(chain.done).take(PER_PIECE);
        let work = DesignWork::ReachedLoads {
            scenario: self.question.scenario.clone(),
            resistances: indices.map(|i| self.resistances[*i]).collect(),
            state: chain.state.clone(),
        };
        Some((CHAINS + which, Work::Design(work)))
    }

    fn next_best(&mut self) -> Option<(usize, Work)> {
        let window = self.question.window?;
        let index = self.best_handed;
        let resistance = *self.resistances.get(index)?;
        self.best_handed += 1;
        let (scenario, limits) = (self.question.scenario.clone(), self.question.limits);
        let shaking = self.question.shaking;
        let work = DesignWork::BestFrequency { scenario, resistance, window, shaking, limits };
        Some((BEST + index, Work::Design(work)))
    }
}

impl Study for LoadStudy {
    fn next(&mut self) -> Option<(usize, Work)> {
        if self.failure.is_some() {
            return None;
        }
        if !std::mem::replace(&mut self.forced_handed, true) {
            let (scenario, resistances) = (self.question.scenario.clone(), self.resistances.clone());
            return Some((FORCED, Work::Design(DesignWork::ForcedLoads { scenario, resistances })));
        }
        self.next_in_chain().or_else(|| self.next_best())
    }

    fn take(&mut self, ticket: usize, finding: Result<Finding, String>) {
        match (ticket, finding) {
            (FORCED, Ok(Finding::Design(DesignFinding::ForcedLoads(points)))) => self.forced = Some(points),
            (CHAINS..BEST, Ok(Finding::Design(DesignFinding::ReachedLoads { points, state }))) => {
                let chain = &mut self.chains[ticket - CHAINS];
                chain.under_way = false;
                chain.state = state;
                for point in points {
                    if let Some(place) =
                        chain.indices.get(chain.done).and_then(|index| self.reached.get_mut(*index))
                    {
                        *place = Some(point);
                    }
                    chain.done += 1;
                }
            }
            (_, Ok(Finding::Design(DesignFinding::BestFrequency(found)))) if ticket >= BEST => {
                if let Some(place) = self.best.get_mut(ticket - BEST) {
                    *place = Some(found);
                }
            }
            (_, Ok(_)) => {
                self.failure = Some("the computation returned something else than asked for".to_owned())
            }
            (_, Err(message)) => self.failure = Some(message),
        }
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
