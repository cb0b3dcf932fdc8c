//! Power into a store behind a full-wave rectifier, over the voltage of the store.

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

use super::design::RectifiedPoint;
use super::design::load::linear_loads;
use super::design::rectified::{best_between, open_circuit};
use super::error::{RequestError, failed};
use crate::model::ModelError;
use crate::scenario::{Scenario, counted};
use crate::scheduler::{Asked, Budget, Failure, Order, Piece, Study, complete_within};

/// Voltages of a store, and drops of a diode (V).
pub const VOLTAGES: (f64, f64) = (1e-6, 1e6);
/// See [`VOLTAGES`].
pub const DROPS: (f64, f64) = (0.0, 100.0);
/// Voltages of a curve.
const COUNTS: (usize, usize) = (0, 200);

/// A full-wave rectifier of ideal diodes that drop a voltage, and a store held at one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, SerBin, DeBin)]
#[serde(default, deny_unknown_fields)]
pub struct Rectifier {
    /// Voltage of the store (V), beside those of the curve.
    pub voltage: Option<f64>,
    /// Forward drop of a diode (V), two of which are in the way of the current.
    pub drop: f64,
    /// Voltages of the curve, equally spaced below the open-circuit voltage; none with 0.
    pub count: usize,
}

impl Default for Rectifier {
    fn default() -> Self {
        Self { voltage: None, drop: 0.0, count: 24 }
    }
}

/// Power into the store.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RectifierAnswer {
    /// Forward drop of a diode (V).
    pub drop: f64,
    /// Largest voltage with open electrodes (V); null when the motion ends.
    pub open_circuit: Option<f64>,
    /// At the voltage asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_voltage: Option<RectifiedPoint>,
    /// Over the voltage of the store.
    pub curve: Vec<RectifiedPoint>,
    /// At the best voltage; null where nothing reaches the store.
    pub best: Option<RectifiedPoint>,
    /// The best resistive load of the device without magnets (ohm) and its power (W), to compare with.
    pub resistive_linear: [f64; 2],
}

impl Rectifier {
    /// Checks its numbers.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range.
    pub fn validate(&self) -> Result<(), ModelError> {
        if let Some(voltage) = self.voltage {
            ModelError::check("rectifier.voltage", voltage, VOLTAGES, " V")?;
        }
        ModelError::check("rectifier.drop", self.drop, DROPS, " V")?;
        counted("rectifier.count", self.count, COUNTS)
    }

    /// Its answer about `scenario`.
    ///
    /// # Errors
    /// [`RequestError`].
    pub(super) fn answer(
        &self,
        scenario: &Scenario,
        budget: &Budget<'_>,
    ) -> Result<RectifierAnswer, RequestError> {
        let mut study = RectifierStudy::new(scenario.clone(), *self)?;
        complete_within(&mut study, budget);
        failed(study.failure())?;
        Ok(RectifierAnswer {
            drop: self.drop,
            open_circuit: study.open_circuit().flatten(),
            at_voltage: study.at_voltage().copied(),
            curve: study.curve().copied().collect(),
            best: study.best().copied(),
            resistive_linear: linear_loads(scenario, &[])?.1,
        })
    }
}

/// The open-circuit voltage of a device.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct OpenCircuit {
    /// The device.
    pub scenario: Scenario,
}

impl Piece for OpenCircuit {
    const NAME: &'static str = "open_circuit";
    type Found = Option<f64>;

    fn carry_out(&self) -> Result<Option<f64>, Failure> {
        Ok(open_circuit(&self.scenario)?)
    }
}

/// Power into a store at one voltage.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Rectified {
    /// The device.
    pub scenario: Scenario,
    /// Voltage of the store (V).
    pub voltage: f64,
    /// Forward drop of a diode (V).
    pub drop: f64,
}

impl Piece for Rectified {
    const NAME: &'static str = "rectified";
    type Found = RectifiedPoint;

    fn carry_out(&self) -> Result<RectifiedPoint, Failure> {
        Ok(RectifiedPoint::of(&self.scenario, self.voltage, self.drop)?)
    }
}

/// The best voltage of a store between two.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct BestVoltage {
    /// The device.
    pub scenario: Scenario,
    /// Lowest and highest voltage (V).
    pub between: (f64, f64),
    /// Forward drop of a diode (V).
    pub drop: f64,
}

impl Piece for BestVoltage {
    const NAME: &'static str = "best_voltage";
    type Found = RectifiedPoint;

    fn carry_out(&self) -> Result<RectifiedPoint, Failure> {
        Ok(best_between(&self.scenario, self.between, self.drop)?)
    }
}

/// A curve over the voltage of the store being computed, every second point first, and then its best.
#[derive(Debug, Clone)]
pub struct RectifierStudy {
    asked: (Scenario, Rectifier),
    own_handed: bool,
    own: Option<RectifiedPoint>,
    open_handed: bool,
    open: Option<Option<f64>>,
    /// Voltages in the order in which they are computed.
    order: Vec<usize>,
    handed: usize,
    curve: Vec<Option<RectifiedPoint>>,
    best_handed: bool,
    best: Option<RectifiedPoint>,
    failure: Option<Failure>,
}

impl RectifierStudy {
    /// A study of `scenario`, not yet begun.
    ///
    /// # Errors
    /// [`ModelError`] naming what is out of range.
    pub fn new(scenario: Scenario, rectifier: Rectifier) -> Result<Self, ModelError> {
        rectifier.validate()?;
        scenario.validate()?;
        let count = rectifier.count;
        Ok(Self {
            asked: (scenario, rectifier),
            own_handed: rectifier.voltage.is_none(),
            own: None,
            open_handed: count == 0,
            open: None,
            order: (0..count).skip(1).step_by(2).chain((0..count).step_by(2)).collect(),
            handed: 0,
            curve: vec![None; count],
            best_handed: false,
            best: None,
            failure: None,
        })
    }

    /// Largest voltage with open electrodes (V), `None` in it when the motion ends; `None` until it is known.
    pub fn open_circuit(&self) -> Option<Option<f64>> {
        self.open
    }

    /// The point at the voltage asked for.
    pub fn at_voltage(&self) -> Option<&RectifiedPoint> {
        self.own.as_ref()
    }

    /// The points known so far by ascending voltage.
    pub fn curve(&self) -> impl Iterator<Item = &RectifiedPoint> + Clone {
        self.curve.iter().flatten()
    }

    /// The best voltage; `None` until it is known, or when nothing reaches the store.
    pub fn best(&self) -> Option<&RectifiedPoint> {
        self.best.as_ref()
    }

    /// Why something is missing, if it is and will stay so.
    pub fn failure(&self) -> Option<&Failure> {
        self.failure.as_ref()
    }

    /// What the store's voltage must stay below (V), once it is known and anything reaches the store at all.
    fn top(&self) -> Option<f64> {
        self.open.flatten().map(|open| open - 2.0 * self.asked.1.drop).filter(|top| *top > VOLTAGES.0)
    }

    /// Voltage of a point of the curve (V); at the top itself nothing flows.
    fn voltage(&self, index: usize) -> Option<f64> {
        Some(self.top()? * (index + 1) as f64 / (self.curve.len() + 1) as f64)
    }

    fn whole(&self) -> bool {
        self.curve.iter().all(Option::is_some)
    }

    fn own_order(&mut self) -> Option<Order<Self>> {
        let (scenario, Rectifier { voltage, drop, .. }) = self.asked.clone();
        if std::mem::replace(&mut self.own_handed, true) {
            return None;
        }
        let piece = Rectified { scenario, voltage: voltage?, drop };
        Some(Order::new(piece, |study: &mut Self, found| {
            study.take(found, |study, point| study.own = Some(point))
        }))
    }

    fn take<T>(&mut self, found: Result<T, Failure>, then: impl FnOnce(&mut Self, T)) {
        match found {
            Ok(found) => then(self, found),
            Err(failure) => self.failure = Some(failure),
        }
    }

    fn best_order(&mut self) -> Option<Order<Self>> {
        if !self.whole() || self.curve.is_empty() || std::mem::replace(&mut self.best_handed, true) {
            return None;
        }
        let power = |index: &usize| self.curve[*index].map_or(0.0, |point| point.power());
        let highest = (0..self.curve.len()).max_by(|a, b| power(a).total_cmp(&power(b)))?;
        if power(&highest) <= 0.0 {
            return None;
        }
        let step = self.voltage(0)?;
        let middle = self.voltage(highest)?;
        let (scenario, Rectifier { drop, .. }) = self.asked.clone();
        let known = self.curve[highest]?;
        let between = ((middle - step).max(0.1 * step), middle + step);
        let piece = BestVoltage { scenario, between, drop };
        Some(Order::new(piece, move |study: &mut Self, found| {
            study.take(found, |study, point| {
                // Of two peaks the search may find the lower one.
                study.best = Some(if point.power() >= known.power() { point } else { known });
            });
        }))
    }
}

impl Asked for RectifierStudy {
    type Question = (Scenario, Rectifier);

    fn asked(&self) -> &Self::Question {
        &self.asked
    }
}

impl Study for RectifierStudy {
    fn next(&mut self) -> Option<Order<Self>> {
        if self.failure.is_some() {
            return None;
        }
        if let Some(order) = self.own_order() {
            return Some(order);
        }
        if !std::mem::replace(&mut self.open_handed, true) {
            let piece = OpenCircuit { scenario: self.asked.0.clone() };
            return Some(Order::new(piece, |study: &mut Self, found| {
                study.take(found, |study, open| {
                    study.open = Some(open);
                    if study.top().is_none() {
                        study.curve.clear();
                    }
                });
            }));
        }
        let next = self.order.get(self.handed).and_then(|index| Some((*index, self.voltage(*index)?)));
        let Some((index, voltage)) = next else { return self.best_order() };
        self.handed += 1;
        let (scenario, Rectifier { drop, .. }) = self.asked.clone();
        Some(Order::new(Rectified { scenario, voltage, drop }, move |study: &mut Self, found| {
            study.take(found, |study, point| study.curve[index] = Some(point));
        }))
    }

    fn progress(&self) -> f64 {
        let known = self.curve.iter().flatten().count() + usize::from(self.best.is_some());
        if self.finished() { 1.0 } else { known as f64 / (self.curve.len() + 1) as f64 }
    }

    fn finished(&self) -> bool {
        let own = self.asked.1.voltage.is_none() || self.own.is_some();
        let curve = self.asked.1.count == 0 || (self.open.is_some() && self.whole());
        let dead = self.curve.iter().flatten().all(|point| point.power() <= 0.0);
        self.failure.is_some() || (own && curve && (dead || self.best.is_some()))
    }
}
