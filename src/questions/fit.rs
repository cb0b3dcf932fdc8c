//! Dimensions fitted to a measured voltage over frequency.

use nanoserde::{DeBin, SerBin};
use serde::{Deserialize, Serialize};

use super::design::fit::{Normal, voltages};
use super::design::tolerance::dimensions;
use super::error::{RequestError, failed};
use super::question::Question;
use crate::model::{Dimension, ModelError, Shaking};
use crate::scenario::{Scenario, counted};
use crate::scheduler::{Asked, Budget, Failure, Order, Piece, Study, complete_within};

/// Measured points, and dimensions that are fitted.
pub const POINTS: (usize, usize) = (2, 2000);
const FREE: (usize, usize) = (1, 6);
/// Step of a logarithm for a derivative.
const DIFFERENCE: f64 = 1e-4;
/// Most steps, and the change of all logarithms that ends them; its square for the fall of the sum of squares.
const STEPS: usize = 60;
const SETTLED: f64 = 1e-7;
/// Damping at first, by how much it falls and grows, and what of it gives up.
const DAMPING: f64 = 0.1;
const FALLS: f64 = 0.2;
const GROWS: f64 = 5.0;
const HOPELESS: f64 = 1e10;
/// What is added to voltages before their logarithms are compared, over the highest, and most steps in which they are.
const FLOOR: f64 = 1e-3;
const COARSE_STEPS: usize = 30;
/// Longest step of a logarithm.
const LONGEST: f64 = 0.4;

/// Dimensions that bring the device closest to what was measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Fit {
    /// Frequency (Hz) and root mean square voltage (V).
    pub data: Vec<[f64; 2]>,
    /// Dimensions that are fitted.
    #[serde(default = "usual")]
    pub free: Vec<String>,
    /// What of the base's motion stays over the frequencies.
    #[serde(default)]
    pub hold: Shaking,
}

fn usual() -> Vec<String> {
    vec![Dimension::Viscosity.field().to_owned()]
}

/// The device that comes closest.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FitAnswer {
    /// One a dimension fitted.
    pub fitted: Vec<Fitted>,
    /// Root mean square of what is left between computed and measured (V), at the start and at the result.
    pub left: [f64; 2],
    /// Computed voltages (V) at the frequencies of the data, at the start.
    pub start: Vec<f64>,
    /// The same at the result.
    pub result: Vec<f64>,
    /// Whether it has settled.
    pub converged: bool,
    /// Steps taken.
    pub steps: usize,
}

/// A dimension that was fitted.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Fitted {
    /// The dimension.
    pub name: &'static str,
    /// Its value at the start (SI).
    pub start: f64,
    /// The value that fits best.
    pub value: f64,
    /// Its standard error; null where the data tell nothing of it.
    pub standard_error: Option<f64>,
}

impl Question for Fit {
    const TASK: &'static str = "fit";
    const COUNTS_LOSS: bool = true;
    type Answer = FitAnswer;

    fn answer(&self, scenario: Scenario, budget: &Budget<'_>) -> Result<FitAnswer, RequestError> {
        let mut study = FitStudy::new(scenario, self.clone())?;
        complete_within(&mut study, budget);
        failed(study.failure())?;
        if !study.finished() {
            budget.lacks("the fit was not followed to its end".to_owned());
        }
        Ok(FitAnswer {
            fitted: study.fitted(),
            left: study.left(),
            start: study.start_curve().unwrap_or_default().to_vec(),
            result: study.curve().unwrap_or_default().to_vec(),
            converged: study.converged(),
            steps: study.steps(),
        })
    }
}

/// The voltages of one device over frequency.
#[derive(Debug, Clone, PartialEq, SerBin, DeBin)]
pub struct Voltages {
    /// The device.
    pub scenario: Scenario,
    /// What of the base's motion stays.
    pub shaking: Shaking,
    /// Dimensions with other values (SI).
    pub dimensions: Vec<(Dimension, f64)>,
    /// Frequencies (Hz).
    pub frequencies: Vec<f64>,
}

impl Piece for Voltages {
    const NAME: &'static str = "voltages";
    type Found = Vec<f64>;

    fn carry_out(&self) -> Result<Vec<f64>, Failure> {
        Ok(voltages(&self.scenario, self.shaking, &self.dimensions, &self.frequencies)?)
    }
}

/// What is being computed.
#[derive(Debug, Clone, PartialEq)]
enum Phase {
    /// The curve at the start.
    Start { handed: bool },
    /// Derivatives, one an unknown.
    Columns { handed: usize, found: Vec<Option<Vec<f64>>> },
    /// The curve after a step.
    Trial { handed: bool, place: Vec<f64>, promised: f64 },
    /// Nothing more.
    Done { converged: bool },
}

/// A fit under way.
#[derive(Debug, Clone)]
pub struct FitStudy {
    asked: (Scenario, Fit),
    free: Vec<(Dimension, f64)>,
    /// Logarithms of the present values.
    place: Vec<f64>,
    start_curve: Option<Vec<f64>>,
    curve: Option<Vec<f64>>,
    normal: Option<Normal>,
    damping: f64,
    /// Added to voltages (V) before their logarithms are compared, as at first they are: a peak in the wrong place then
    /// still shows the way. `None` when they are compared themselves.
    floor: Option<f64>,
    steps: usize,
    phase: Phase,
    failure: Option<Failure>,
}

impl FitStudy {
    /// A fit of the device of `scenario`, which is its start.
    ///
    /// # Errors
    /// [`RequestError`] naming what is out of range.
    pub fn new(scenario: Scenario, fit: Fit) -> Result<Self, RequestError> {
        scenario.validate()?;
        counted("data", fit.data.len(), POINTS)?;
        counted("free", fit.free.len(), FREE)?;
        for (i, [hertz, volts]) in fit.data.iter().enumerate() {
            ModelError::check(&format!("data[{i}][0]"), *hertz, (1e-9, 1e9), " Hz")?;
            ModelError::check(&format!("data[{i}][1]"), *volts, (0.0, 1e9), " V")?;
        }
        let known = dimensions(&scenario)?;
        let mut free = Vec::new();
        for (i, name) in fit.free.iter().enumerate() {
            let found = known.iter().find(|(dimension, _)| dimension.field() == name);
            let twice = fit.free[..i].contains(name);
            let Some(found) = found.filter(|_| !twice) else {
                let names: Vec<&str> = known.iter().map(|(dimension, _)| dimension.field()).collect();
                let names = names.join(", ");
                return Err(RequestError::Field {
                    field: format!("free[{i}]"),
                    problem: format!("`{name}` is not available: allowed are, once each and not 0, {names}"),
                });
            };
            free.push(*found);
        }
        if fit.data.len() < free.len() {
            let (field, minimum, maximum) = ("data".to_owned(), free.len(), POINTS.1);
            return Err(RequestError::Count { field, value: fit.data.len(), minimum, maximum });
        }
        let highest = fit.data.iter().map(|[_, volts]| *volts).fold(0.0, f64::max);
        Ok(Self {
            // Of damping alone no peak moves.
            floor: free
                .iter()
                .any(|(dimension, _)| *dimension != Dimension::Viscosity)
                .then_some(FLOOR * highest)
                .filter(|floor| *floor > 0.0),
            place: free.iter().map(|(_, value)| value.ln()).collect(),
            free,
            asked: (scenario, fit),
            start_curve: None,
            curve: None,
            normal: None,
            damping: DAMPING,
            steps: 0,
            phase: Phase::Start { handed: false },
            failure: None,
        })
    }

    /// What is known of the dimensions fitted.
    pub fn fitted(&self) -> Vec<Fitted> {
        let errors = self.normal.as_ref().and_then(Normal::standard_errors);
        // While damping is left out there are none.
        let errors = errors.filter(|errors| errors.len() == self.free.len());
        let row = |(k, (dimension, start)): (usize, &(Dimension, f64))| {
            let value = self.place[k].exp();
            let standard_error = errors.as_ref().map(|errors| value * errors[k]);
            Fitted { name: dimension.field(), start: *start, value, standard_error }
        };
        self.free.iter().enumerate().map(row).collect()
    }

    /// The dimensions fitted with their present values.
    pub fn values(&self) -> Vec<(Dimension, f64)> {
        self.dimensions(&self.place)
    }

    /// Computed voltages (V) at the data's frequencies at the start.
    pub fn start_curve(&self) -> Option<&[f64]> {
        self.start_curve.as_deref()
    }

    /// The same at the best so far.
    pub fn curve(&self) -> Option<&[f64]> {
        self.curve.as_deref()
    }

    /// Root mean square of what is left (V) at the start and at the best so far; NaN until it is known.
    pub fn left(&self) -> [f64; 2] {
        let count = self.asked.1.data.len() as f64;
        let left = |curve: &Option<Vec<f64>>| {
            let squares = |curve: &Vec<f64>| {
                curve
                    .iter()
                    .zip(&self.asked.1.data)
                    .map(|(v, [_, measured])| (v - measured).powi(2))
                    .sum::<f64>()
            };
            curve.as_ref().map_or(f64::NAN, |curve| (squares(curve) / count).sqrt())
        };
        [left(&self.start_curve), left(&self.curve)]
    }

    /// Whether it has settled on the best there is.
    pub fn converged(&self) -> bool {
        self.phase == Phase::Done { converged: true }
    }

    /// Steps taken.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Why it cannot go on, if so.
    pub fn failure(&self) -> Option<&Failure> {
        self.failure.as_ref()
    }

    /// A voltage as it is compared.
    fn compared(&self, volts: f64) -> f64 {
        self.floor.map_or(volts, |floor| (volts + floor).ln())
    }

    fn residuals(&self, curve: &[f64]) -> Vec<f64> {
        let pairs = curve.iter().zip(&self.asked.1.data);
        pairs.map(|(computed, [_, measured])| self.compared(*computed) - self.compared(*measured)).collect()
    }

    /// The end of the comparison by logarithms, or of the whole.
    fn end(&mut self, converged: bool) {
        if self.floor.take().is_some() {
            self.damping = DAMPING;
            self.phase = self.next_columns();
        } else {
            self.phase = Phase::Done { converged };
        }
    }

    fn square(&self, curve: &[f64]) -> f64 {
        self.residuals(curve).iter().map(|residual| residual * residual).sum()
    }

    fn dimensions(&self, place: &[f64]) -> Vec<(Dimension, f64)> {
        self.free.iter().zip(place).map(|((dimension, _), value)| (*dimension, value.exp())).collect()
    }

    fn piece(&self, place: &[f64]) -> Voltages {
        let (scenario, fit) = self.asked.clone();
        Voltages {
            scenario,
            shaking: fit.hold,
            dimensions: self.dimensions(place),
            frequencies: fit.data.iter().map(|[hertz, _]| *hertz).collect(),
        }
    }

    fn next_columns(&self) -> Phase {
        Phase::Columns { handed: 0, found: vec![None; self.free.len()] }
    }

    fn take(&mut self, found: Result<Vec<f64>, Failure>, then: impl FnOnce(&mut Self, Vec<f64>)) {
        match found {
            Ok(curve) => then(self, curve),
            Err(failure) => self.failure = Some(failure),
        }
    }

    /// Takes the derivative by an unknown, and with the last of them makes a step.
    fn take_column(&mut self, index: usize, curve: Vec<f64>) {
        let Some(base) = self.curve.clone() else { return };
        let pairs = curve.iter().zip(&base);
        let slope = pairs.map(|(moved, here)| (self.compared(*moved) - self.compared(*here)) / DIFFERENCE);
        let slope = slope.collect();
        let Phase::Columns { found, .. } = &mut self.phase else { return };
        found[index] = Some(slope);
        let mut columns: Vec<Vec<f64>> = found.iter().flatten().cloned().collect();
        if columns.len() == self.free.len() {
            // Damping makes heights and widths of peaks, and comes last: while they are in the wrong place it would vanish.
            if self.floor.is_some() {
                let others = |(dimension, _): &(Dimension, f64)| *dimension != Dimension::Viscosity;
                let mut kept = self.free.iter().map(others);
                columns.retain(|_| kept.next().unwrap_or(true));
            }
            self.normal = Some(Normal::new(&self.residuals(&base), &columns));
            self.begin_step();
        }
    }

    /// Begins a step with the present damping, or ends the fit.
    fn begin_step(&mut self) {
        let Some(normal) = &self.normal else { return };
        let most = if self.floor.is_some() { COARSE_STEPS } else { STEPS };
        let step = normal.step(self.damping).filter(|_| self.steps < most && self.damping < HOPELESS);
        let Some(step) = step else { return self.end(false) };
        let longest = step.iter().fold(0.0, |longest: f64, part| longest.max(part.abs()));
        let scale = if longest > LONGEST { LONGEST / longest } else { 1.0 };
        let step: Vec<f64> = step.iter().map(|part| scale * part).collect();
        let promised = normal.promised(&step);
        let mut parts = step.iter();
        let of = |(dimension, _): &(Dimension, f64)| match *dimension {
            Dimension::Viscosity if self.floor.is_some() => 0.0,
            _ => parts.next().copied().unwrap_or(0.0),
        };
        let step: Vec<f64> = self.free.iter().map(of).collect();
        if longest < SETTLED {
            return self.end(true);
        }
        let place = self.place.iter().zip(&step).map(|(value, part)| value + part).collect();
        self.phase = Phase::Trial { handed: false, place, promised };
    }

    /// Takes the curve after a step, which is kept when it is better.
    fn take_trial(&mut self, found: Result<Vec<f64>, Failure>) {
        let Phase::Trial { place, promised, .. } = self.phase.clone() else { return };
        let Some(before) = self.curve.as_ref().map(|curve| self.square(curve)) else { return };
        self.steps += 1;
        // A step to where there is no device is one that is not better.
        let better =
            found.ok().map(|curve| (self.square(&curve), curve)).filter(|(square, _)| *square < before);
        let Some((_, curve)) = better else {
            // Where no fall is promised that rounding would show, this is the bottom.
            if promised <= SETTLED * SETTLED * before {
                return self.end(true);
            }
            self.damping *= GROWS;
            return self.begin_step();
        };
        self.curve = Some(curve);
        self.place = place;
        self.damping *= FALLS;
        // Once more the derivatives, for the errors at the result.
        self.phase = self.next_columns();
    }
}

impl Asked for FitStudy {
    type Question = (Scenario, Fit);

    fn asked(&self) -> &Self::Question {
        &self.asked
    }
}

impl Study for FitStudy {
    fn next(&mut self) -> Option<Order<Self>> {
        if self.failure.is_some() {
            return None;
        }
        let here = self.place.clone();
        match &mut self.phase {
            Phase::Start { handed } if !*handed => {
                *handed = true;
                Some(Order::new(self.piece(&here), |study: &mut Self, found| {
                    study.take(found, |study, curve| {
                        study.start_curve = Some(curve.clone());
                        study.curve = Some(curve);
                        study.phase = study.next_columns();
                    });
                }))
            }
            Phase::Columns { handed, found } if *handed < found.len() => {
                let index = *handed;
                *handed += 1;
                let mut place = here;
                place[index] += DIFFERENCE;
                Some(Order::new(self.piece(&place), move |study: &mut Self, found| {
                    // At the edge of what a device may be there is no device beyond: nothing is known of that unknown there.
                    let curve = found.ok().or_else(|| study.curve.clone()).unwrap_or_default();
                    study.take_column(index, curve);
                }))
            }
            Phase::Trial { handed, place, .. } if !*handed => {
                *handed = true;
                let place = place.clone();
                Some(Order::new(self.piece(&place), |study: &mut Self, found| study.take_trial(found)))
            }
            _ => None,
        }
    }

    fn progress(&self) -> f64 {
        if self.finished() { 1.0 } else { self.steps as f64 / STEPS as f64 }
    }

    fn finished(&self) -> bool {
        self.failure.is_some() || matches!(self.phase, Phase::Done { .. })
    }
}
