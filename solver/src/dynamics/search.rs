//! Finds what motion a start leads to, a slice at a time.
//!
//! 1. The motion is integrated to the end of the horizon, stroboscopic states kept. At an eighth, a quarter and half of
//!    it (when it may end early) and at the end, the states are asked whether they recur; then Newton's iteration from
//!    the last state looks for the periodic motion. It counts as reached when it is stable and the states have arrived
//!    there, or are near and approach it as fast as its multipliers say.
//! 2. What does not settle that way is followed further for its Lyapunov exponents. Negative: a periodic motion is
//!    being approached; it is looked for once more, also with long periods and from farther away. Zero: quasiperiodic,
//!    when the stroboscopic points lie on closed curves (or fill a surface and the second exponent is zero as well).
//!    Positive: chaotic, unless the run is still near an unstable periodic motion or leaves one. The record is doubled while it does
//!    not decide.
//!
//! A chaotic transient that outlives the record counts as chaotic, and a periodic motion of more than 64 excitation
//! periods is never found.

use super::lyapunov::{self, Exponent, KNOWN, Sign};
use super::meter::Meter;
use super::motion::{Horizon, Motion, Reached, Undecided};
use super::orbit::Orbit;
use super::period_map::MOST_PERIODS;
use super::poincare::Recurrence;
use super::strobe::{NEAR, Strobe};
use super::tangent::Tangents;
use super::{Collocation, Instability, IntegrationError, Outcome, Settings};
use crate::model::ReducedSystem;

/// Fewest excitation periods of a run: as many as recurrence needs.
const LEAST_PERIODS: usize = 64;
/// Parts of the run at which it may end early.
const CHECKPOINTS: [f64; 3] = [0.125, 0.25, 0.5];
/// Least record of the exponent, relative to the duration of the run.
const LEAST_RECORD: f64 = 0.5;
/// Steps between looks at the time.
const CHUNK: usize = 32;
/// Distance from a periodic motion, relative to the amplitude, at which a motion with its exponent is in its reach.
const FAR: f64 = 0.5;
/// Half width of a positive exponent, relative to it, with which a chart is content.
const CERTAIN: f64 = 0.5;
/// Largest dimension of a set of points that counts as curves, and as a surface.
const CURVE: f64 = 1.35;
const SURFACE: f64 = 2.35;

/// The search for the motion that one start leads to.
pub struct Search {
    system: ReducedSystem,
    initial: Vec<f64>,
    horizon: Horizon,
    integrator: Collocation,
    strobe: Strobe,
    /// Stroboscopic instants passed, the start among them.
    instants: usize,
    /// Instants at which the states are looked at, the next one last.
    checkpoints: Vec<usize>,
    recurrence: Option<Recurrence>,
    record: Option<Record>,
}

/// What is recorded for the exponent.
struct Record {
    tangents: Tangents,
    meter: Meter,
    periods: usize,
    doublings: u32,
}

impl std::fmt::Debug for Search {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Search")
            .field("horizon", &self.horizon)
            .field("time", &self.integrator.time())
            .finish()
    }
}

impl Search {
    /// Prepares the search for what the start of `system` in `initial` (length 2N + 1) at t = 0 leads to.
    ///
    /// # Errors
    /// [`IntegrationError::InitialState`].
    pub fn new(system: &ReducedSystem, initial: &[f64], horizon: Horizon) -> Result<Self, IntegrationError> {
        let periods = horizon.t_end / system.parameters.period();
        let end = (periods.ceil() as usize).max(LEAST_PERIODS);
        let mut checkpoints = vec![end];
        if horizon.ends_early {
            let early = CHECKPOINTS.iter().rev().map(|part| (part * periods).ceil() as usize);
            checkpoints.extend(early.filter(|instant| *instant >= LEAST_PERIODS));
        }
        Ok(Self {
            integrator: Collocation::new(system, initial, Settings::default())?,
            strobe: Strobe::new(system),
            system: system.clone(),
            initial: initial.to_vec(),
            horizon,
            instants: 0,
            checkpoints,
            recurrence: None,
            record: None,
        })
    }

    /// Goes on for about `steps` steps of the integrator; the motion reached once it is known.
    ///
    /// # Errors
    /// As [`super::Collocation::advance`].
    pub fn advance(&mut self, steps: usize) -> Result<Option<Reached>, IntegrationError> {
        let mut left = steps;
        while left > 0 {
            let chunk = left.min(CHUNK);
            left -= chunk;
            let Self { integrator, strobe, instants, record, .. } = self;
            let outcome = integrator.advance(f64::INFINITY, chunk, &mut |step| {
                if step.index == 0 {
                    strobe.push(step.start);
                    *instants += 1;
                }
                if let Some(record) = record {
                    record.tangents.record(step);
                    record.meter.record(step);
                }
            })?;
            let motion = match outcome {
                None => None,
                Some(Outcome::Contact { time }) => Some(Motion::Contact { time }),
                Some(Outcome::Escaped { time }) => Some(Motion::Escape { time }),
                Some(Outcome::Completed) => Some(Motion::Undecided { why: Undecided::Unresolved }),
            };
            if let Some(motion) = motion {
                self.recurrence = None;
                return Ok(Some(self.reached(motion, None)));
            }
            if let Some(reached) = self.look() {
                return Ok(Some(reached));
            }
        }
        Ok(None)
    }

    /// Part of the run that is done, 0 to 1, and 1 while the exponent is computed.
    pub fn progress(&self) -> f64 {
        let end = self.checkpoints.first().copied().unwrap_or(1);
        if self.record.is_some() { 1.0 } else { (self.instants as f64 / end as f64).min(1.0) }
    }

    /// Looks at the states when it is time to.
    fn look(&mut self) -> Option<Reached> {
        if let Some(record) = &self.record {
            let done = record.tangents.growth()[0].len() >= record.periods;
            return if done { self.judge() } else { None };
        }
        // The instant at t = 0 is the first.
        if self.instants <= *self.checkpoints.last()? {
            return None;
        }
        self.recurrence = self.strobe.recurrence(&self.system);
        let recurring = self.recurrence.and_then(|found| found.period);
        if self.checkpoints.len() > 1 {
            self.checkpoints.pop();
            return self.confirm(recurring?, None).map(|found| self.periodic(found));
        }
        if let Some(found) = self.confirm(recurring.unwrap_or(1), None) {
            return Some(self.periodic(found));
        }
        let period = self.system.parameters.period();
        let least = (LEAST_RECORD * self.horizon.t_end / period).ceil() as usize;
        self.record = Some(Record {
            tangents: Tangents::new(&self.system),
            meter: Meter::default(),
            periods: self.horizon.exponent_periods.max(least).max(lyapunov::LEAST_PERIODS),
            doublings: self.horizon.doublings,
        });
        None
    }

    /// Decides by the exponents of the record, or doubles it.
    fn judge(&mut self) -> Option<Reached> {
        let record = self.record.as_ref()?;
        if !record.tangents.resolved() {
            return Some(self.reached(Motion::Undecided { why: Undecided::Unresolved }, None));
        }
        let exponent = Exponent::from_growth(record.tangents.growth(), self.system.parameters.period())?;
        self.recurrence = self.strobe.recurrence(&self.system);
        let recurrence = self.recurrence;
        let recurring = recurrence.and_then(|found| found.period);
        // The record may still hold how an unstable motion was left.
        if let Some(found) = recurring.and_then(|periods| self.confirm(periods, Some(&exponent))) {
            return Some(self.periodic(found));
        }
        let mut dimension = None;
        let why = match exponent.sign() {
            Sign::Negative => {
                let long = self.strobe.closest_return();
                let long = long.and_then(|periods| self.confirm(periods, Some(&exponent)));
                if let Some(found) = long.or_else(|| self.confirm(1, Some(&exponent))) {
                    return Some(self.periodic(found));
                }
                if let Some(Recurrence { period: Some(periods), settled: true, .. }) = recurrence {
                    return Some(self.reached(Motion::Periodic { periods }, Some(exponent)));
                }
                Undecided::TransientNotGone
            }
            Sign::Zero => {
                dimension = self.strobe.dimension();
                let most = if exponent.second_sign() == Sign::Zero { SURFACE } else { CURVE };
                if dimension.is_some_and(|dimension| dimension < most) {
                    return Some(Reached {
                        dimension,
                        ..self.reached(Motion::Quasiperiodic, Some(exponent))
                    });
                }
                Undecided::PointsScattered
            }
            Sign::Positive if recurring.is_some() || self.leaves_slowly(&exponent) => Undecided::NearUnstable,
            Sign::Positive => {
                let enough = if self.horizon.ends_early { CERTAIN } else { KNOWN };
                if exponent.half_width <= enough * exponent.value || record.doublings == 0 {
                    let dimension = self.strobe.dimension();
                    return Some(Reached { dimension, ..self.reached(Motion::Chaotic, Some(exponent)) });
                }
                Undecided::ExponentOpen
            }
            Sign::Open => Undecided::ExponentOpen,
        };
        let record = self.record.as_mut()?;
        if record.doublings == 0 {
            return Some(Reached { dimension, ..self.reached(Motion::Undecided { why }, Some(exponent)) });
        }
        record.doublings -= 1;
        record.periods *= 2;
        record.meter = Meter::default();
        None
    }

    /// The stable motion of `periods` excitation periods that the last states have reached, or of twice as many when
    /// the one of `periods` has doubled; with their distance from it. An `exponent` that is that of its multipliers
    /// shows that already the motion as it is contracts like it, so that it need not be as near.
    fn confirm(&self, periods: usize, exponent: Option<&Exponent>) -> Option<(Orbit, f64)> {
        let last = self.strobe.before_last(0);
        let mut periods = periods;
        loop {
            let orbit = Orbit::find(&self.system, Some(last), periods).ok()?;
            if orbit.stable() {
                let period = self.system.parameters.period();
                let alike = exponent.is_some_and(|exponent| {
                    exponent.sign() == Sign::Negative && exponent.fits(&orbit, period)
                });
                let near = if alike { FAR } else { NEAR };
                return self.strobe.approach(&orbit, near).map(|distance| (orbit, distance));
            }
            let doubled = 2 * orbit.periods;
            if orbit.instability() != Some(Instability::PeriodDoubling)
                || doubled > MOST_PERIODS
                || doubled <= periods
            {
                return None;
            }
            periods = doubled;
        }
    }

    /// Whether `exponent` is the rate at which the unstable periodic motion near the last state is left: just beyond a
    /// boundary that takes longer than the record, and looks like chaos meanwhile.
    fn leaves_slowly(&self, exponent: &Exponent) -> bool {
        let orbit = Orbit::find(&self.system, Some(self.strobe.before_last(0)), 1);
        orbit.is_ok_and(|orbit| !orbit.stable() && exponent.fits(&orbit, self.system.parameters.period()))
    }

    fn periodic(&self, (orbit, distance): (Orbit, f64)) -> Reached {
        let measures = Some(orbit.measures);
        let reached = self.reached(Motion::Periodic { periods: orbit.periods }, None);
        Reached { measures, orbit: Some(orbit), distance: Some(distance), ..reached }
    }

    fn reached(&self, motion: Motion, exponent: Option<Exponent>) -> Reached {
        let ended = matches!(motion, Motion::Escape { .. } | Motion::Contact { .. });
        let measures =
            self.record.as_ref().and_then(|record| record.meter.measures(self.system.parameters.kappa));
        let empty = self.strobe.len() == 0;
        Reached {
            motion,
            measures: if ended { None } else { measures },
            state: if empty { self.initial.clone() } else { self.strobe.before_last(0).to_vec() },
            time: self.system.parameters.period() * self.instants.saturating_sub(1) as f64,
            orbit: None,
            distance: None,
            exponent,
            recurrence: self.recurrence,
            dimension: None,
        }
    }
}
