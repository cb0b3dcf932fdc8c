//! What the device with a rectifier settles on, and what it puts into its store.
//!
//! The motion is followed from its start. Now and then Newton's iteration on the stroboscopic map looks for a cycle near
//! the state reached; it counts as reached when it is stable and the run moves towards it as the map's derivative says.
//! The numbers are then those of the cycle itself, however long the rest of the transient takes. Where no cycle of up to
//! `LONGEST` periods is found, means over two halves of a record that agree are the answer, and otherwise there is none; nor
//! where starts that differ by rounding settle otherwise.

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::arrival::beside;
use super::motion::Undecided;
use crate::dynamics::integration::rectified::{RectifiedRun, RectifiedTotals};
use crate::dynamics::integration::{IntegrationError, Measures, Outcome};
use crate::dynamics::orbits::period_map::{distance, scales};
use crate::model::ReducedSystem;
use crate::model::eigenvalues::{SHIFTS, eigenvalues};
use crate::model::energy::energy;
use crate::sentence::{Say, Sentence, in_english, said};

/// Excitation periods before the first look for a cycle, and after which looks come how much later, relative to the time.
const FIRST_LOOK: u64 = 24;
const LATER: f64 = 0.3;
/// Longest cycle looked for (excitation periods).
const LONGEST: usize = 8;
/// Most excitation periods that a start is followed, and half of a record whose means are compared.
const MOST_PERIODS: u64 = 12_000;
const HALF_RECORD: u64 = 512;
/// A cycle may be a chance of a chaotic transient: where a start beside the one asked for is further away than this by then,
/// relative to the size, so many of them are followed to their end, too.
const APART: f64 = 1e-3;
const BESIDE: usize = 2;
/// Largest difference of the means of both halves, relative.
const AGREEMENT: f64 = 1e-3;
/// Newton's iterations, the residual that ends them, and the step of differences, relative to the state's size.
const ITERATIONS: usize = 20;
const CLOSED: f64 = 1e-11;
const DIFFERENCE: f64 = 1e-6;
/// How far a run may be from the cycle it approaches, and how far from where the map's derivative takes it, relative to
/// that distance.
const NEAR: f64 = 0.3;
const LINEAR: f64 = 0.1;
/// Distance, relative to the size, at which it has arrived whatever the derivative says.
const ARRIVED: f64 = 1e-7;
/// Largest modulus of a multiplier that counts as stable: where nothing conducts and nothing leaks, a charge stays for
/// ever, and the multiplier is 1 to the accuracy of differences.
const STABLE: f64 = 1.0 + 1e-6;

/// What a start leads to.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, nanoserde::SerBin, nanoserde::DeBin)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum Steady {
    /// A stable cycle.
    Repeats {
        /// In excitation periods.
        periods: usize,
    },
    /// It does not repeat, but its means stay.
    Stationary,
    /// Neither was found.
    Undecided,
    /// Starts that differ by less than rounding lead to different motions.
    DependsOnRounding,
    /// The tip left.
    Escape,
    /// The magnets touched.
    Contact,
}

impl Say for Steady {
    fn say(&self) -> Sentence {
        match self {
            Self::Repeats { periods } => said("period {periods}", &[("periods", periods)]),
            Self::Stationary => said("it does not repeat, its means stay", &[]),
            Self::Undecided => said("undecided: neither the cycle repeats nor the means stay", &[]),
            Self::DependsOnRounding => said("undecided: {why}", &[("why", &Undecided::DependsOnRounding)]),
            Self::Escape => said("escape", &[]),
            Self::Contact => said("contact", &[]),
        }
    }
}

in_english!(Steady);

/// Mean powers of the device with a rectifier, dimensionless as in [`crate::dynamics::Balance`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RectifiedBalance {
    /// Mean current into the store (power unit per volt).
    pub current: f64,
    /// Power that the shaken base puts in.
    pub input: f64,
    /// Power lost in damping.
    pub viscous: f64,
    /// Power lost in the conductance beside the rectifier.
    pub dielectric: f64,
    /// Power that leaves through the rectifier: threshold times current.
    pub rectifier: f64,
    /// Rate at which the energy of the device grew.
    pub stored: f64,
    /// Extremes, and the root mean square of the voltage; `power` is that which leaves through the rectifier.
    pub measures: Measures,
    /// Switchings of the circuit in an excitation period.
    pub switchings: f64,
}

impl RectifiedBalance {
    fn new(system: &ReducedSystem, threshold: f64, from: &[f64], to: &[f64], read: &RectifiedTotals) -> Self {
        let mean = |total: f64| total / read.duration;
        let rectifier = mean(threshold * read.charge);
        Self {
            current: mean(read.charge),
            input: mean(read.input),
            viscous: mean(read.viscous),
            dielectric: mean(read.dielectric),
            rectifier,
            stored: mean(energy(system, to) - energy(system, from)),
            measures: Measures {
                v_rms: mean(read.square).sqrt(),
                v_peak: read.v_peak,
                power: rectifier,
                tip: read.tip,
                slope: read.slope,
            },
            switchings: read.switchings as f64 * system.parameters.period() / read.duration,
        }
    }

    /// |input - what leaves - stored| over the largest of them.
    pub fn defect(&self) -> f64 {
        let terms = [self.input, self.viscous, self.dielectric, self.rectifier, self.stored];
        let largest = terms.iter().fold(0.0, |largest: f64, term| largest.max(term.abs()));
        let sum = self.input - self.viscous - self.dielectric - self.rectifier - self.stored;
        if largest > 0.0 { (sum / largest).abs() } else { 0.0 }
    }
}

/// What the start of `system`, whose kappa is what is left without a load, in `initial` (length 2N + 1) leads to with a
/// rectifier that conducts at |v| = `threshold` > 0 (V), its balance, and a state on the motion at a stroboscopic instant;
/// no balance where it is undecided or ended.
///
/// # Errors
/// As [`RectifiedRun::period`].
pub fn settle_rectified(
    system: &ReducedSystem,
    threshold: f64,
    initial: &[f64],
) -> Result<(Steady, Option<RectifiedBalance>, Vec<f64>), IntegrationError> {
    let (settled, run) = follow(system, threshold, initial)?;
    let repeats = matches!(settled.0, Steady::Repeats { .. });
    if !repeats || !parts(system, threshold, (initial, &run))? {
        return Ok(settled);
    }
    let power = |settled: &Settled| settled.1.as_ref().map_or(0.0, |balance| balance.rectifier);
    for moved in beside(system, initial).take(BESIDE) {
        let (other, _) = follow(system, threshold, &moved)?;
        if other.0 != settled.0 || !alike(power(&other), power(&settled)) {
            return Ok((Steady::DependsOnRounding, None, settled.2));
        }
    }
    Ok(settled)
}

/// What was found, its balance and a state on it.
type Settled = (Steady, Option<RectifiedBalance>, Vec<f64>);

/// Whether two means are the same, as far as means of records can be.
fn alike(a: f64, b: f64) -> bool {
    (a - b).abs() <= AGREEMENT * a.abs().max(b.abs())
}

/// Whether a start beside `initial` is elsewhere after as many periods as the `run` from there took.
fn parts(
    system: &ReducedSystem,
    threshold: f64,
    (initial, run): (&[f64], &RectifiedRun),
) -> Result<bool, IntegrationError> {
    let Some(moved) = beside(system, initial).next() else { return Ok(false) };
    let mut other = RectifiedRun::new(system, threshold, &moved)?;
    while other.periods() < run.periods() {
        if other.period(None)?.is_some() {
            return Ok(true);
        }
    }
    let (scales, rest) = (scales(system), vec![0.0; initial.len()]);
    let size = distance(run.state(), &rest, &scales);
    Ok(distance(run.state(), other.state(), &scales) > APART * size)
}

/// What the one start leads to, and its run until that was known.
fn follow(
    system: &ReducedSystem,
    threshold: f64,
    initial: &[f64],
) -> Result<(Settled, RectifiedRun), IntegrationError> {
    let mut follower = Follower {
        system,
        threshold,
        scales: scales(system),
        run: RectifiedRun::new(system, threshold, initial)?,
        trial: RectifiedRun::new(system, threshold, initial)?,
    };
    let ended = |outcome: Outcome, state: &[f64]| {
        let steady =
            if matches!(outcome, Outcome::Contact { .. }) { Steady::Contact } else { Steady::Escape };
        (steady, None, state.to_vec())
    };
    let mut look = FIRST_LOOK;
    while follower.run.periods() < MOST_PERIODS {
        let mut recent = vec![follower.run.state().to_vec()];
        while follower.run.periods() < look || recent.len() <= LONGEST {
            if let Some(outcome) = follower.run.period(None)? {
                return Ok((ended(outcome, follower.run.state()), follower.run));
            }
            recent.push(follower.run.state().to_vec());
            if recent.len() > LONGEST + 1 {
                recent.remove(0);
            }
        }
        if let Some((state, periods)) = follower.cycle(&recent)? {
            let (balance, _) = follower.balance(&state, periods as u64)?;
            return Ok(((Steady::Repeats { periods }, balance, state), follower.run));
        }
        look = follower.run.periods() + ((LATER * follower.run.periods() as f64) as u64).max(FIRST_LOOK / 2);
    }
    let state = follower.run.state().to_vec();
    let (first, middle) = follower.balance(&state, HALF_RECORD)?;
    let (second, end) = follower.balance(&middle, HALF_RECORD)?;
    let (Some(first), Some(second)) = (first, second) else {
        return Ok((ended(Outcome::Escaped { time: 0.0 }, &end), follower.run));
    };
    let stays = alike(first.rectifier, second.rectifier) && alike(first.input, second.input);
    let settled =
        if stays { (Steady::Stationary, Some(second), end) } else { (Steady::Undecided, None, end) };
    Ok((settled, follower.run))
}

/// A cycle, with the derivative of the map of its periods.
struct Cycle {
    state: Vec<f64>,
    derivative: DMatrix<f64>,
}

struct Follower<'a> {
    system: &'a ReducedSystem,
    threshold: f64,
    scales: Vec<f64>,
    run: RectifiedRun,
    /// For Newton's iteration.
    trial: RectifiedRun,
}

impl Follower<'_> {
    /// The balance over so many periods from `state`, and the state after them; none when the motion ended.
    fn balance(
        &mut self,
        state: &[f64],
        periods: u64,
    ) -> Result<(Option<RectifiedBalance>, Vec<f64>), IntegrationError> {
        let mut totals = RectifiedTotals::default();
        self.trial.begin(state);
        let from = self.trial.state().to_vec();
        for _ in 0..periods {
            if self.trial.period(Some(&mut totals))?.is_some() {
                return Ok((None, self.trial.state().to_vec()));
            }
        }
        let to = self.trial.state().to_vec();
        Ok((Some(RectifiedBalance::new(self.system, self.threshold, &from, &to, &totals)), to))
    }

    /// The state so many periods later; `None` when the motion ends before.
    fn map(&mut self, state: &[f64], periods: usize) -> Result<Option<Vec<f64>>, IntegrationError> {
        self.trial.begin(state);
        for _ in 0..periods {
            if self.trial.period(None)?.is_some() {
                return Ok(None);
            }
        }
        Ok(Some(self.trial.state().to_vec()))
    }

    /// The stable cycle that the run approaches, with its periods, if there is one near its last states `recent`.
    fn cycle(&mut self, recent: &[Vec<f64>]) -> Result<Option<(Vec<f64>, usize)>, IntegrationError> {
        let Some(last) = recent.last() else { return Ok(None) };
        let back = |periods: usize| distance(last, &recent[recent.len() - 1 - periods], &self.scales);
        let distances: Vec<f64> = (1..recent.len()).map(back).collect();
        let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
        // The shortest of those that return as well as any.
        let candidate = distances.iter().position(|distance| *distance <= 2.0 * least).unwrap_or(0) + 1;
        let last = last.clone();
        for periods in if candidate == 1 { vec![1] } else { vec![1, candidate] } {
            if let Some(state) = self.near(&last, periods)? {
                return Ok(Some((state, periods)));
            }
        }
        Ok(None)
    }

    fn near(&mut self, last: &[f64], periods: usize) -> Result<Option<Vec<f64>>, IntegrationError> {
        let Some(Cycle { state: cycle, derivative }) = self.newton(last, periods)? else { return Ok(None) };
        let Some(values) = eigenvalues(&derivative, SHIFTS, 4e-16) else { return Ok(None) };
        if values.iter().any(|value| value.norm() > STABLE) {
            return Ok(None);
        }
        let size = self.size(&cycle);
        let away = distance(last, &cycle, &self.scales);
        if away <= ARRIVED * size {
            return Ok(Some(cycle));
        }
        let Some(next) = self.map(last, periods)? else { return Ok(None) };
        let offset = DVector::from_iterator(last.len(), last.iter().zip(&cycle).map(|(a, b)| a - b));
        let expected: Vec<f64> = (derivative * offset).iter().zip(&cycle).map(|(a, b)| a + b).collect();
        let off = distance(&next, &expected, &self.scales);
        Ok((away <= NEAR * size && off <= LINEAR * away).then_some(cycle))
    }

    /// How large a cycle is, in the measure of distances.
    fn size(&self, state: &[f64]) -> f64 {
        distance(state, &vec![0.0; state.len()], &self.scales)
    }

    /// What each entry of the state adds to the charge c v - sum of theta_k q_k, which stays while nothing conducts and
    /// nothing leaks.
    fn charge(&self) -> DVector<f64> {
        let n = self.system.modes.len();
        let mut row = DVector::zeros(self.scales.len());
        for (entry, theta) in row.iter_mut().zip(&self.system.theta) {
            *entry = -theta;
        }
        row[2 * n] = self.system.capacitance;
        row
    }

    /// Newton's iteration on the map of so many periods from `start`, and the map's derivative at its end.
    fn newton(&mut self, start: &[f64], periods: usize) -> Result<Option<Cycle>, IntegrationError> {
        let count = start.len();
        let mut state = start.to_vec();
        let mut before = f64::INFINITY;
        let row = self.charge();
        let charge = row.dot(&DVector::from_column_slice(start));
        for _ in 0..ITERATIONS {
            self.trial.begin(&state);
            state.copy_from_slice(self.trial.state());
            let Some(image) = self.map(&state, periods)? else { return Ok(None) };
            let open = self.trial.stayed_open();
            let size = self.size(&state);
            let mut derivative = DMatrix::zeros(count, count);
            for j in 0..count {
                let mut moved = state.clone();
                // Towards rest: a voltage at the threshold can only fall.
                let step = DIFFERENCE * size * self.scales[j] * if state[j] > 0.0 { -1.0 } else { 1.0 };
                moved[j] += step;
                let Some(there) = self.map(&moved, periods)? else { return Ok(None) };
                let column = there.iter().zip(&image).map(|(a, b)| (a - b) / step);
                derivative.set_column(j, &DVector::from_iterator(count, column));
            }
            let residual = distance(&image, &state, &self.scales);
            if residual <= CLOSED * size {
                return Ok(Some(Cycle { state: image, derivative }));
            }
            if !(residual < 4.0 * before) {
                return Ok(None);
            }
            before = before.min(residual);
            let mut defect = DVector::from_iterator(count, image.iter().zip(&state).map(|(a, b)| a - b));
            let mut matrix = DMatrix::identity(count, count) - &derivative;
            if open && self.system.parameters.kappa == 0.0 {
                // There is a cycle for every charge: the one that belongs to the start's is meant.
                let mut along = DVector::zeros(count);
                along[count - 1] = 1.0 / self.system.capacitance;
                let lacks = charge - row.dot(&DVector::from_column_slice(&state));
                matrix += &along * row.transpose();
                defect += along * lacks;
            }
            let Some(step) = matrix.lu().solve(&defect) else { return Ok(None) };
            for (value, step) in state.iter_mut().zip(step.iter()) {
                *value += step;
            }
            if state.iter().any(|value| !value.is_finite() || value.abs() > 1e6) {
                return Ok(None);
            }
        }
        Ok(None)
    }
}
